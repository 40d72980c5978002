"""Let the body bounce with its steps, more or less, or as it stands.

To the motion: the hips, and the body with them, rise and fall further than they did, at the same moments.
The highest points stay about where they were, as straight legs cannot get longer; between them the knees
give. To the viewer: a spring in the step, which observers name as the mark of a happy walk (Halovic & Kroos
2018) and children have; without it a glide, smooth or stealthy. Who stands may be given a beat to bounce to.

The feet sink with the hips: let ``foot_plant`` follow, which puts them back and bends the knees.
"""

from typing import Annotated

import numpy as np

from ..kinematics.body import Body
from ..kinematics.contacts import detect_points, foot_points
from ..kinematics.fk import world
from ..kinematics.flights import airborne
from ..kinematics.heading import heading_free, hips_frame
from ..kinematics.loops import period
from ..kinematics.standing import standing
from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import envelope, hold_gaps, smooth
from ..signal.noise import wander
from ..signal.to_and_fro import to_and_fro
from ..signal.waveshaping import soft_limit
from ..typing import Array, Mask
from .registry import Param, edit

REACH = 0.5  # seconds around each moment whose highest rise is taken down to where it was
DEEPEST, FREE = 0.2, 0.1  # leg lengths that are gone down at most, and from where on ever less
UNEVEN = 1.0 / 3.0
JOIN = 0.04  # seconds: the Gaussian that joins flights to what is before and after


@edit(
    kind="pose",
    paper="Halovic & Kroos 2018",
    equation="y' = y + d - envelope(max(d, 0)),  d = (gain - 1) (y between 0.5 and 8 Hz),  y = height of the "
    "hips; in flight d goes on straight; standing y' = y - beat (1 + n / 3) sin(pi f t)^2, n slow noise",
    deviations="the paper reports that observers see a bounce in happy walks; how to make one is ours",
)
def bounce(
    motion: Motion,
    *,
    gain: Annotated[
        float, Param("how far the body rises and falls, as a factor; 0 glides", 0.0, 4.0, neutral=1.0)
    ] = 1.0,
    beat: Annotated[
        float, Param("how deep a standing body bounces by itself", 0.0, 0.08, "leg lengths", neutral=0.0)
    ] = 0.0,
    rate: Annotated[float, Param("how often it does", 0.3, 4.0, unit="Hz")] = 1.6,
    seed: Annotated[int, Param("which unevenness of it: another number, another one", 0)] = 0,
) -> Motion:
    """Make the rise and fall of the body larger or smaller than it is, without lifting it higher.

    What is slower than 0.5 Hz, such as a bow or sitting down, stays. With ``gain`` nothing is made up: who
    stands still goes on standing still, unless ``beat`` gives him a bounce of his own, now deeper and now
    less deep, which ends as soon as he steps. While the body is in the air it falls as it did, so a jump gets
    no higher. ``gain`` takes the hips down by at most a fifth of a leg. Raises ``BodyError`` where no body is
    found.
    """
    if gain == 1.0 and beat == 0.0:
        return motion
    body = Body.of(motion)
    rotations, positions = world(motion)
    frames = period(heading_free(motion, body, steady=True)[0], "auto")
    height = positions[:, body.roles["hips"]] @ body.up / body.leg_length
    change = (gain - 1.0) * to_and_fro(height, motion.frame_time, frames=frames)
    down = envelope(np.maximum(change, 0.0), reach=round(REACH / motion.frame_time)) - change
    down = soft_limit(np.maximum(down, 0.0), DEEPEST, DEEPEST - FREE)
    points = foot_points(motion, body, rotations, positions)
    planted = detect_points(points, body, motion.frame_time).feet
    if beat:
        down += beat * _knees(motion.times, rate, seed) * standing(planted, motion.frame_time)
    air = _air(points @ body.up, planted, body, motion.frame_time)
    if air.any():
        down = np.maximum(smooth(hold_gaps(down, ~air), sigma=JOIN / motion.frame_time), 0.0)
    translations = np.array(motion.translations)
    shift = -body.leg_length * down[:, None] * body.up
    translations[:, body.roles["hips"]] += quaternion.rotate(hips_frame(motion, body, steady=True), shift)
    return motion.with_(translations=translations)


def _knees(times: Array, rate: float, seed: int) -> Array:
    """Return how far (T,) the knees give: to and fro ``rate`` times a second, never twice alike."""
    uneven = 1.0 + UNEVEN * wander(times, low=0.1, high=0.5, seed=seed, stream="bounce")
    return np.asarray(uneven * np.sin(np.pi * rate * times) ** 2)


def _air(height: Array, planted: Mask, body: Body, frame_time: float) -> Mask:
    """Say when (T,) the body flies, from the height of the points of its feet (T, 2, 2)."""
    lowest = (height - np.percentile(height, 5, axis=0)).min(axis=(1, 2))
    air = np.zeros(len(height), dtype=bool)
    for start, stop in airborne(lowest, planted, body.leg_length, frame_time, runs=True):
        air[start:stop] = True
    return air
