"""Be uneven: paths now long and now short, a pace now quick and now slow.

To the motion: for a second or so each limb moves a little further, then a little less far than it did, each
at its own times, and the whole body hurries and hesitates. Mean path and length of the clip stay. To the
viewer: somebody nervous or ill at ease. Förger (2011, sections 3.4.4 and 5.2) found that added shaking does
not show that (see ``tremor``), and proposed uneven paths and an uneven rhythm instead.
"""

from collections.abc import Mapping
from typing import Annotated

import numpy as np

from ..errors import RecipeError
from ..kinematics.blending import blend
from ..kinematics.body import Body
from ..kinematics.lead_in import lead_in
from ..kinematics.resampling import sampled
from ..kinematics.retiming import frames_at, free_flight, of_length
from ..motion import Motion
from ..recipe import Step
from ..signal.noise import wander
from ..typing import Array
from . import pipeline
from .registry import Param, edit

# Parts that wander together: legs, so that steps stay even from left to right, and what they carry.
TOGETHER: Mapping[str, tuple[str, ...]] = {
    "body": ("torso", "legs"),
    "head": ("head",),
    "left arm": ("left_arm",),
    "right arm": ("right_arm",),
}
SHORT, LONG = 0.6, 1.5  # gains of path_length that the paths wander between


@edit(
    kind="rhythm",
    paper="Förger 2011, sections 3.4.4 and 5.2",
    equation="g(t) = 1 + paths (0.5 n(t) where n > 0, else 0.4 n(t)); u'(t) = 1 + rhythm m(t), over the mean "
    "of its inverse; n, m = tanh of noise of low to high Hz, less the mean",
    deviations="proposed in words there; sizes and frequencies are ours",
)
def nervous(
    motion: Motion,
    *,
    original: Motion | None = None,
    only_time: bool = False,
    paths: Annotated[
        float | Array,
        Param("how far path lengths wander; 1: 0.6 to 1.5 times", 0.0, 1.0, neutral=0.0),
    ] = 0.0,
    rhythm: Annotated[
        float | Array,
        Param("how far the pace wanders; 0.2: 20 % either way", 0.0, 0.5, neutral=0.0),
    ] = 0.0,
    low: Annotated[float, Param("slowest wandering", 0.05, 5.0, unit="Hz")] = 0.3,
    high: Annotated[float, Param("fastest wandering", 0.1, 5.0, unit="Hz")] = 1.0,
    seed: Annotated[int, Param("which wandering: another number, another one", 0)] = 0,
) -> Motion:
    """Let path lengths and pace wander slowly, and keep the length of the clip.

    ``paths`` and ``rhythm`` may be numbers for each frame (T,). Flights fall by gravity as in ``tempo``.
    ``original``, the motion before all edits, says when the body flies; with ``only_time`` paths are left as
    they are. Raises ``RecipeError`` where ``low`` is not below ``high`` and ``BodyError`` where no body is
    found.
    """
    if not low < high:
        raise RecipeError(f"nervous: low ({low:g} Hz) must be below high ({high:g} Hz)")
    original = original or motion

    def curve(stream: str) -> Array:
        """Return the curve (T,) between about -1 and 1 that a stream of the seed gives."""
        return wander(motion.times, low=low, high=high, seed=seed, stream=stream)

    moves = np.arange(len(motion)) >= lead_in(original)
    if np.any(paths) and not only_time:
        motion = _wandering(motion, {part: paths * curve(part) * moves for part in TOGETHER})
    if not np.any(rhythm) or len(motion) < 2:
        return motion
    rates = 1.0 + rhythm * curve("rhythm") * moves
    motion, rates = free_flight(motion, original, Body.of(original), rates)
    return sampled(motion, frames_at(of_length(rates)), frame_time=motion.frame_time)


def _wandering(motion: Motion, shares: Mapping[str, Array]) -> Motion:
    """Return the motion with the paths of parts longer where their share (T,) is above 0, shorter below."""
    body = Body.of(motion)
    weights = np.zeros((len(motion), len(motion.skeleton)))
    for part, share in shares.items():
        weights[:, list(body.joints(TOGETHER[part]))] = share[:, None]
    for sign, gain in ((-1.0, SHORT), (1.0, LONG)):
        there = pipeline.apply(motion, [Step("path_length", {"mid": gain})])
        motion = blend(motion, there.with_(history=motion.history), np.clip(sign * weights, 0.0, 1.0))
    return motion
