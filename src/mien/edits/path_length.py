"""Lengthen or shorten the paths along which the body moves.

To the motion: the movement around the slow mean pose grows or shrinks, most where it lasts about a tenth
of a second to a second; its timing stays. To the viewer: longer paths look strong, energetic or excited,
shorter ones weak, tired, afraid or sad.

The rotations are coded as direction vectors, split into frequency bands with zero phase shift, and put
together with other gains. The hips turn free of the heading, so that the way someone walks does not
bend; they do not travel here: ``foot_plant`` rebuilds that from the feet.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Annotated, Literal

import numpy as np

from ..errors import RecipeError
from ..kinematics.body import Body
from ..kinematics.bones import main_bones
from ..kinematics.heading import heading_free
from ..kinematics.loops import Boundary, period
from ..motion import Motion
from ..rotations import directions, quaternion
from ..signal import multiresolution
from ..typing import Array
from .registry import Param, edit

# So many rotations are worked on at a time: fast, as they fit the cache, and little memory.
CHUNK = 1 << 15
# Half the reach in seconds of the low-pass with an edge at 1 Hz, twice over for the ringing beyond.
EDGE_SUPPORT = 1.3


@edit(
    kind="pose",
    paper="Förger 2011, section 3.4.1; Bruderlin & Williams 1995",
    equation="x' = g_high x + (g_mid - g_high) G_2 x + (g_low - g_mid) G_6 x, x = direction vectors",
    deviations="the bands of a 100 Hz clip are used at every frame rate (mode bands: the clip's own); the "
    "hips' heading is left alone; loops are filtered round; mode edges has borders where they are said to be",
)
def path_length(
    motion: Motion,
    *,
    mid: Annotated[float, Param("gain of 1 to 12.5 Hz: the movement itself", 0.0, 4.0, neutral=1.0)] = 1.0,
    low: Annotated[float, Param("gain below 1 Hz: the mean pose", 0.25, 4.0, neutral=1.0)] = 1.0,
    high: Annotated[float, Param("gain above 12.5 Hz: mostly noise", 0.0, 4.0, neutral=1.0)] = 1.0,
    mode: Annotated[
        Literal["hz", "bands", "edges"],
        Param("bands of a 100 Hz clip; the clip's own whole bands; or bands between the given edges"),
    ] = "hz",
    edge_low: Annotated[float, Param("border of low and mid, mode edges", 0.1, 50.0, unit="Hz")] = 1.0,
    edge_high: Annotated[float, Param("border of mid and high, mode edges", 0.2, 200.0, unit="Hz")] = 12.5,
    boundary: Annotated[
        Boundary,
        Param("beyond the ends: hold the pose, go round as a loop, or go round if it is a loop"),
    ] = "auto",
    orthogonalise: Annotated[
        directions.Orthogonalise,
        Param("keep each bone's direction and let its twist give way, or share the error"),
    ] = "gram-schmidt",
    joints: Sequence[int] | None = None,
) -> Motion:
    """Lengthen (mid above 1) or shorten (below 1) the paths of the movement around its slow mean.

    ``H = g_low G_6 + g_mid (G_2 - G_6) + g_high (1 - G_2)`` on the direction vectors of every joint from
    the hips down (Förger 2011, equations 1 to 3). As only directions matter, all gains equal change
    nothing. The nominal borders of 1 and 12.5 Hz have their half amplitudes at 0.5 and 8.2 Hz; with
    ``mode="edges"`` they lie at ``edge_low`` and ``edge_high``. ``joints`` limits the work.
    Raises ``BodyError`` where no body is found and ``RecipeError`` where the edges are in the wrong order.
    """
    if not edge_low < edge_high:
        raise RecipeError(
            f"path_length: edge_low ({edge_low:g} Hz) must be below edge_high ({edge_high:g} Hz)"
        )
    if low == mid == high:
        return motion
    body = Body.of(motion)
    hips = body.roles["hips"]
    below = motion.skeleton.descendants(hips)
    rotations, frame = heading_free(motion, body, steady=True)
    frames = period(rotations[:, below], boundary)
    change = _filter(mode, motion.fps, (low, mid, high), (edge_low, edge_high), frames > 0)
    u, v = directions.axes(main_bones(motion.skeleton))
    wanted = below if joints is None else [j for j in below if j in set(joints)]
    for some in _chunks(wanted, len(motion)):
        before = rotations[:, some]
        codes = _round(change, directions.encode(before, u[some], v[some]), frames)
        rotations[:, some] = directions.decode(
            codes, u[some], v[some], orthogonalise=orthogonalise, fallback=before
        )
    rotations[:, hips] = quaternion.continuous(quaternion.multiply(frame, rotations[:, hips]))
    return motion.with_(rotations=rotations)


def _filter(
    mode: str, fps: float, gains: tuple[float, float, float], edges: tuple[float, float], wrap: bool
) -> Callable[[Array], Array]:
    if mode == "bands":
        return partial(multiresolution.regain_bands, fps=fps, gains=gains, wrap=wrap)
    if mode == "hz":
        response = partial(multiresolution.reference_response, gains=multiresolution.three_bands(*gains))
        support = multiresolution.REFERENCE_SUPPORT
    else:
        response = partial(multiresolution.edge_response, gains=gains, edges=edges)
        support = EDGE_SUPPORT / edges[0]
    return partial(multiresolution.regain, fps=fps, response=response, support=support, wrap=wrap)


def _round(change: Callable[[Array], Array], codes: Array, frames: int) -> Array:
    """Filter one round; a last frame that repeats the first changes as the first does."""
    if frames in (0, len(codes)):
        return change(codes)
    out = np.empty_like(codes)
    out[:frames] = change(codes[:frames])
    out[frames:] = out[:1] + codes[frames:] - codes[:1]
    return out


def _chunks(joints: list[int], frames: int) -> list[list[int]]:
    many = max(CHUNK // frames, 1)
    return [joints[i : i + many] for i in range(0, len(joints), many)]
