"""Which moments of several motions belong together, so that they can be blended.

Walks are matched step by step: where the same foot comes down. Anything else by dynamic time warping of
where the ends of the limbs are and how fast they move, seen from the body, posture and size of the
movement aside.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..errors import MienError, unknown
from ..motion import Motion
from ..rotations import quaternion
from ..signal import dtw
from ..signal.bridging import smooth
from ..signal.sampling import monotone, spline
from ..typing import Array
from .body import Body
from .fk import world
from .heading import heading_rotation
from .steps import is_gait, match, steps, with_ends

Method = Literal["auto", "dtw", "steps", "none"]
METHODS = ("auto", "dtw", "steps", "none")
RATE, MOST = 30.0, 1200  # samples a second, and at most, that poses are compared at
BAND = 0.3
SMOOTH, SPACING = 0.15, 0.2  # seconds: how far a time warp is averaged, and between its knots
STILL = 0.03  # leg lengths: who moves less than this on average is at rest
PACE = 0.1  # speeds are told as the way that they lead in this share of the clip


@dataclass(frozen=True, eq=False)
class Alignment:
    """Moments of several motions that belong together.

    ``knots`` (K, N): in every row the frames, in fractions, of the N motions; they rise in each column from
    the start to the end of the common stretch. ``method`` says how they were found.
    """

    knots: Array
    method: str

    def __repr__(self) -> str:
        return f"Alignment({self.knots.shape[1]} motions by {self.method}, {len(self.knots)} knots)"

    def frames(self, common: Array, at: Array) -> Array:
        """Return the frames (M, N) of each motion at the moments ``at`` of a time with knots at ``common``.

        ``common`` (K,) rises from knot to knot; with the column of a motion it is that motion's own time.
        """
        return monotone(common, self.knots, at)


def align(motions: Sequence[Motion], *, method: Method = "auto", to: int | None = None) -> Alignment:
    """Find the moments of motions of one skeleton that belong together.

    ``steps`` matches steps, ``dtw`` the movement of the limbs from start to end, ``none`` the same shares
    of each clip's length; ``auto`` takes steps where all step left and right in turn, else dtw. With dtw
    all are matched to motion ``to``, or to the one that is most like the others. The order of the motions
    does not matter, nor do place, heading, size or frame rate.
    Raises ``MienError`` where there is nothing to match.
    """
    if method not in METHODS:
        raise MienError(unknown("alignment", method, METHODS))
    single = [len(m) == 1 for m in motions]
    if any(single) and not all(single):
        raise MienError(f"clip {single.index(True) + 1} has a single frame: a still has no time to align")
    if to is not None and not 0 <= to < len(motions):
        raise MienError(f"to must be the number of one of the {len(motions)} clips, from 0, got {to}")
    # Sorted by what they hold, so that no tie is broken by the order in which they are given.
    order = sorted(range(len(motions)), key=lambda i: (len(motions[i]), motions[i].rotations.tobytes()))
    place = [order.index(i) for i in range(len(motions))]
    found = _align([motions[i] for i in order], method, None if to is None else place[to])
    return Alignment(found.knots[:, place], found.method)


def _align(motions: Sequence[Motion], method: str, to: int | None) -> Alignment:
    ends = np.array([[0.0] * len(motions), [len(m) - 1.0 for m in motions]])
    if len(motions[0]) == 1:
        return Alignment(ends[:1], "none")
    if method == "none":
        return Alignment(ends, method)
    if method != "dtw":
        knots = by_steps(motions)
        if knots is not None:
            return Alignment(knots, "steps")
        if method == "steps":
            raise MienError(
                "the clips have no two steps in common, left and right in turn; align them by dtw"
            )
    return Alignment(by_movement(motions, to=to), "dtw")


def by_steps(motions: Sequence[Motion]) -> Array | None:
    """Return the knots (K, N) at the steps that walks have in common, or None where not all are walks."""
    walks = [steps(motion) for motion in motions]
    if not all(is_gait(found, motion.frame_time) for found, motion in zip(walks, motions, strict=True)):
        return None
    matched = match(walks, [limbs(motion) for motion in motions])
    return None if matched is None else with_ends(matched, [len(motion) for motion in motions])


def by_movement(motions: Sequence[Motion], *, to: int | None = None) -> Array:
    """Return the knots (K, N) of dynamic time warping, start with start and end with end."""
    longest = max(motion.duration for motion in motions)
    count = min(max(round(longest * RATE), 8) + 1, MOST)
    shown = [features(motion, count) for motion in motions]
    to = _most_alike(shown) if to is None else to
    second = (count - 1) / longest
    grid = np.linspace(0.0, count - 1.0, max(round(longest / SPACING), 1) + 1)
    columns = []
    for seen, motion in zip(shown, motions, strict=True):
        path = dtw.path(shown[to], seen, band=BAND)
        pairs = dtw.knots(path, sigma=SMOOTH * second, spacing=SPACING * second)
        columns.append(monotone(pairs[:, 0], pairs[:, 1], grid) * (len(motion) - 1) / (count - 1))
    return np.stack(columns, axis=1)


def _most_alike(shown: Sequence[Array]) -> int:
    """Return which sequence is, warped, nearest to all the others; of two the first."""
    if len(shown) < 3:
        return 0
    costs = np.zeros((len(shown), len(shown)))
    for i in range(len(shown)):
        for j in range(i):
            costs[i, j] = costs[j, i] = dtw.path(shown[i], shown[j], band=BAND).cost
    return int(np.argmin(costs.sum(axis=1)))


def limbs(motion: Motion) -> Array:
    """Return where the two last joints of every limb are (T, 3 L), seen from the hips, in leg lengths.

    Seen in the frame that turns with the heading, from the place on the ground below the hips, so that
    how far the hips sink shows too.
    """
    body = Body.of(motion)
    positions = world(motion)[1]
    hips = positions[:, body.roles["hips"]]
    ground = hips - (hips @ body.up)[:, None] * body.up
    joints = sorted({joint for chain in body.limbs.values() for joint in chain[-2:]})
    back = quaternion.conjugate(heading_rotation(positions, body))
    seen = quaternion.rotate(back[:, None], positions[:, joints] - ground[:, None]) / body.leg_length
    return seen.reshape(len(motion), -1)


def features(motion: Motion, count: int) -> Array:
    """Return what a movement is compared by: places and speeds of the limbs (count, D), evenly over its time.

    Both are taken without their mean over the clip and in units of their own spread, so that a slumped
    or small movement is like an upright or large one.
    """
    seen = smooth(limbs(motion), sigma=0.05 / motion.frame_time)
    speed = np.gradient(seen, axis=0) * PACE * (len(motion) - 1)
    at = np.linspace(0.0, len(motion) - 1.0, count)
    return np.concatenate([spline(_spread_out(x), at) for x in (seen, speed)], axis=1)


def _spread_out(x: Array) -> Array:
    x = x - x.mean(axis=0)
    points = 3.0 / x.shape[1]
    return x / max(float(np.sqrt(points * np.einsum("td,td->t", x, x).mean())), STILL)
