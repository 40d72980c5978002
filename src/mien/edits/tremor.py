"""Make hands, head and trunk shake: an experiment, which the thesis tried and gave up.

To the motion: noise of 4 to 10 Hz turns wrists and elbows, and shoulders, neck and spine a little. To the
viewer: somebody who is cold, has a tremor, or shakes with rage; hardly somebody nervous. Förger (2011,
section 3.4.4) found added shaking unnatural: parent bones carried their shaking on to all below them, and
feet slid. Here the size asked for is that of hand and head, shared out along the chain, and from the hips
down nothing is touched; what stays unnatural is that nothing causes it.
"""

from collections.abc import Mapping
from typing import Annotated

import numpy as np

from ..errors import RecipeError
from ..kinematics.body import SIDES, Body
from ..kinematics.poses import segment_joints
from ..kinematics.posing import add_turns
from ..motion import Motion
from ..signal.noise import noise
from ..typing import Array
from .registry import Param, edit

# What each segment adds to the shaking of the chain's end, in proportion: most of a tremor is far out.
TRUNK = 0.2
CHAINS: Mapping[str, Mapping[str, float]] = {
    "head": {"neck": 0.6, "head": 0.8},
    **{side: {f"{side}_shoulder": 0.3, f"{side}_elbow": 0.5, f"{side}_wrist": 0.8} for side in SIDES},
}
# About the body's left, up and forward: an elbow bends and twists, but does not go sideways.
ELBOW = np.array([1.0, 1.0, 0.0])


@edit(
    kind="pose",
    paper="Förger 2011, section 3.4.4 (tried and given up there)",
    equation="R_j' = R_j exp(a w_j n_j(t)),  n_j = band-limited noise,  sum of w_j^2 = 1 from the spine to "
    "each hand and to the head",
    deviations="the thesis published no numbers; the bands, the sharing out and the legs left alone are ours",
)
def tremor(
    motion: Motion,
    *,
    amount: Annotated[
        float, Param("how far hands and head turn, root mean square", 0.0, 15.0, "degrees", neutral=0.0)
    ] = 0.0,
    low: Annotated[float, Param("slowest shaking", 0.1, 30.0, unit="Hz")] = 4.0,
    high: Annotated[float, Param("fastest shaking", 0.2, 60.0, unit="Hz")] = 10.0,
    seed: Annotated[int, Param("which shaking: another number, another one", 0)] = 0,
) -> Motion:
    """Make hands, head and trunk shake by ``amount`` degrees, and leave hips and legs alone.

    Hands and head turn in the world by ``amount`` (root mean square, over long times) beside what they do;
    of that the trunk does a fifth, and what is left is shared along arm and neck so that squares add up.
    The noise is a function of time, so that the frame rate does not matter, and of ``seed``. Raises
    ``RecipeError`` where ``low`` is not below ``high``, and ``BodyError`` where no body is found.
    """
    if not low < high:
        raise RecipeError(f"tremor: low ({low:g} Hz) must be below high ({high:g} Hz)")
    if amount == 0.0:
        return motion
    body = Body.of(motion)
    turns = {
        segment: amount * share * _shaking(segment, motion.times, low, high, seed)
        for segment, share in _shares(body).items()
    }
    return motion.with_(rotations=add_turns(motion, body, turns, weights={}, method="body_fixed"))


def _shares(body: Body) -> dict[str, float]:
    """Return segment -> its part ``w``: along each chain, with the trunk, the squares add up to 1."""
    there = segment_joints(body)
    trunk = TRUNK if "trunk" in there else 0.0
    out = {"trunk": trunk} if trunk else {}
    for chain in CHAINS.values():
        parts = {segment: part for segment, part in chain.items() if segment in there}
        whole = np.sqrt(sum(part * part for part in parts.values()))
        out |= {segment: float(np.sqrt(1.0 - trunk**2) * part / whole) for segment, part in parts.items()}
    return out


def _shaking(segment: str, at: Array, low: float, high: float, seed: int) -> Array:
    """Return the noise of a segment about each of its axes (T, 3); its mean square is 1 in all."""
    axes = ELBOW if segment.endswith("_elbow") else np.ones(3)
    streams = [noise(at, low=low, high=high, seed=seed, stream=f"{segment} {axis}") for axis in "xyz"]
    return np.stack(streams, axis=1) * axes / np.sqrt(axes.sum())
