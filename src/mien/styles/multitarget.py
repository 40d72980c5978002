"""Blend clips of one skeleton at any weights, also apart for each band of frequencies.

Multitarget motion interpolation (Bruderlin & Williams 1995): the clips are aligned in time, their signals
added with weights. Poses are added as direction vectors, the way over the ground as steps seen in the
heading of each clip, and the planted feet are then put back where the blend of the clips' feet stands.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import floor

import numpy as np

from ..edits.foot_plant import foot_plant
from ..errors import MienError
from ..kinematics import alignment
from ..kinematics.alignment import Alignment, Method
from ..kinematics.body import Body
from ..kinematics.bones import main_bones
from ..kinematics.fk import fk, world
from ..kinematics.heading import heading_free
from ..motion import Motion, Skeleton
from ..rotations import directions, quaternion
from ..signal.sampling import spline
from ..typing import Array, Integers
from .footing import feet_of, with_feet
from .route import Route, blended, route_of
from .shares import Shares, shares
from .skeletons import on_one_skeleton

# Where weights beyond 0 to 1 would make time stand still or run back, it goes at this share of the
# fastest clip's pace.
SLOWEST = 0.25


@dataclass(frozen=True, eq=False)
class Mixture:
    """A blend and how it was made: the ``shares``, how the clips were aligned, and what of them is in it.

    ``frames`` (N, 2) are the first and the last frame of each clip; what lies outside has no counterpart in
    the others.
    """

    motion: Motion
    shares: Shares
    method: str
    frames: Integers

    def __repr__(self) -> str:
        return f"Mixture({len(self.frames)} clips aligned by {self.method}: {self.motion!r})"


def blend(
    motions: Sequence[Motion],
    weights: Sequence[float] | None,
    *,
    bands: Mapping[str, Sequence[float]] | None = None,
    align: Method = "auto",
) -> Motion:
    """Return the blend ``sum_i w_i x_i`` of aligned clips of one skeleton.

    ``weights`` hold one number for each clip, -1 to 2 with the sum 1: beyond 0 to 1 differences are
    exaggerated. ``bands`` may give weights of their own to ``low`` (below 1 Hz: posture), ``mid`` (1 to
    12.5 Hz: movement) and ``high``; ``weights`` then say how time runs, and stand for bands that are not
    named (None: those of mid, else equal). ``align`` is ``auto``, ``steps``, ``dtw`` or ``none``, as in
    ``kinematics.alignment.align``.

    The result lasts as long as the blend of what the clips have in common, ``sum_i w_i T_i``, at the
    frame rate, and on the skeleton, of the first. Rotations are blended as direction vectors; turns, and
    steps over the ground as seen in the heading, with the weights of mid; planted feet do not slide.
    Weights of 1 and 0 give one clip back, as far as all have it in common. A still such as a T-pose at
    the start is left out; the history is empty. Raises ``MienError`` where skeletons, weights or
    alignment do not fit, and ``BodyError`` where no body is found.

    >>> half = mien.blend([neutral, sad], [0.5, 0.5])
    >>> slumped = mien.blend([neutral, sad], None, bands={"low": [0, 1], "mid": [1, 0], "high": [1, 0]})
    """
    return mix(motions, weights, bands=bands, align=align).motion


def mix(
    motions: Sequence[Motion],
    weights: Sequence[float] | None,
    *,
    bands: Mapping[str, Sequence[float]] | None = None,
    align: Method = "auto",
) -> Mixture:
    """Return the ``blend`` of clips and how it was made."""
    clips = on_one_skeleton(motions)
    parts = shares(len(clips), weights, bands)
    bodies = _bodies(clips)
    found = alignment.align(clips, method=align)
    shown = _together(clips, found, parts)
    spots = [world(motion) for motion in shown]
    routes = [route_of(positions, bodies[0]) for _, positions in spots]
    feet = [feet_of(*each) for each in zip(shown, spots, routes, bodies, strict=True)]
    way = blended(routes, parts, bodies[0], shown[0].fps)
    made = _posed(shown, way, parts, bodies[0])
    standing = with_feet(made, feet, routes, way, parts, bodies[0])
    planted = foot_plant(made, original=standing, travel=False)
    left_out = [len(motion) - len(clip) for motion, clip in zip(motions, clips, strict=True)]
    frames = np.rint(found.knots[[0, -1]].T).astype(np.int64) + np.array(left_out)[:, None]
    return Mixture(planted.with_(history=(), reference=None), parts, found.method, frames)


def _bodies(clips: Sequence[Motion]) -> list[Body]:
    """Return the body in each clip; raise ``MienError`` where they do not have the same way up."""
    bodies = [Body.of(clip) for clip in clips]
    for number, body in enumerate(bodies[1:], start=2):
        if not np.allclose(body.up, bodies[0].up, atol=0.01):
            raise MienError(
                f"clip {number} stands along another axis than clip 1: up is {body.up.round(2).tolist()}, "
                f"not {bodies[0].up.round(2).tolist()}; export the clips alike"
            )
    return bodies


def _together(clips: Sequence[Motion], found: Alignment, parts: Shares) -> list[Motion]:
    """Return the clips with common frames, at the frame rate of the first: what is shown at one time."""
    each = found.knots * [clip.frame_time for clip in clips]
    steps = np.diff(each, axis=0)
    pace = np.maximum(steps @ parts.time, SLOWEST * steps.min(axis=1))
    times = np.concatenate([[0.0], np.cumsum(pace)])
    frame_time = clips[0].frame_time
    count = floor(float(times[-1]) / frame_time + 1e-6) + 1
    frames = found.frames(times, np.arange(count) * frame_time)
    return [_shown(clip, at, clips[0]) for clip, at in zip(clips, frames.T, strict=True)]


def _shown(clip: Motion, at: Array, first: Motion) -> Motion:
    rotations = quaternion.normalise(spline(quaternion.continuous(clip.rotations), at))
    translations = np.repeat(clip.translations[:1], len(at), axis=0)
    moving = np.ptp(clip.translations, axis=0).any(axis=-1)
    translations[:, moving] = spline(clip.translations[:, moving], at)
    return Motion(first.skeleton, rotations, translations, first.frame_time, name=clip.name)


def _posed(shown: Sequence[Motion], way: Route, parts: Shares, body: Body) -> Motion:
    """Return the blended poses, carried along the blended way; the feet are not yet looked after."""
    first, hips = shown[0], body.roles["hips"]
    u, v = directions.axes(main_bones(first.skeleton))
    free = [heading_free(motion, body)[0] for motion in shown]
    codes = parts.mixed([directions.encode(q, u, v) for q in free], first.fps)
    rotations = directions.decode(codes, u, v, fallback=free[parts.heaviest])
    translations = _translations(shown, parts)
    turned, places = _above(first.skeleton, hips, rotations, translations)
    facing = quaternion.multiply(quaternion.conjugate(turned), way.turn(body))
    rotations[:, hips] = quaternion.multiply(facing, rotations[:, hips])
    translations[:, hips] = quaternion.rotate(quaternion.conjugate(turned), way.hips(body) - places)
    name = " + ".join(motion.name for motion in shown if motion.name)
    return first.with_(rotations=quaternion.continuous(rotations), translations=translations, name=name)


def _above(skeleton: Skeleton, hips: int, rotations: Array, translations: Array) -> tuple[Array, Array]:
    """Return the world rotations (T, 4) and places (T, 3) of the joint that the hips hang on."""
    parent = int(skeleton.parents[hips])
    if parent < 0:
        return np.zeros((len(rotations), 4)) + quaternion.IDENTITY, np.zeros((len(rotations), 3))
    turned, places = fk(
        rotations[:, : parent + 1], translations[:, : parent + 1], skeleton.parents[: parent + 1]
    )
    return turned[:, parent], places[:, parent]


def _translations(shown: Sequence[Motion], parts: Shares) -> Array:
    """Return the translations (T, J, 3): the first clip's where no clip moves a joint, else blended."""
    first = shown[0]
    out = np.array(first.translations)
    moving = np.any([np.ptp(m.translations, axis=0).any(axis=-1) for m in shown], axis=0)
    out[:, moving] = parts.mixed([m.translations[:, moving] for m in shown], first.fps)
    return out
