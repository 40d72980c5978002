"""Strokes of a hand that end in something: a knock, a punch, a clap, a slam, a gesture that hits its point.

Nothing in a capture says what was touched, but a hand that meets something, or stops as if it did, shows it:
it is fast, stands within a tenth of a second, and comes from rest, stays there, or stops harder than it set
off. The turns of a waving or swinging arm have none of this: they come from one turn and go to the next, as
hard one way as the other.
"""

from dataclasses import dataclass

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..typing import Array
from .body import SIDES, Body
from .contacts import spans

# Seconds: the Gaussian that takes noise off a hand's path, and the steps in which it is looked at.
SMOOTHING, STEP = 0.02, 0.0025
# A stroke is faster than this in leg lengths a second (1 m/s), and than this share of the arm's fast speed.
FAST, OWN = 1.1, 0.3
# Shares of a stroke's greatest speed: still going, over, at rest, and stopped.
GOING, OVER, STILL, STOPPED = 0.9, 0.25, 0.12, 0.05
SHARP = 0.105  # seconds from going to over; a smooth reach of 0.45 s takes that
REST = 0.15  # seconds at rest before or after: longer than an arm that swings so fast takes to turn
OUT = 0.1  # leg lengths: without a rest after it, it must reach out by that much
# Without any rest it must be a blow: fast, and stopping that much harder than it sets off.
BLOW, HARDER = 2.0, 1.25
BACK = 0.05  # leg lengths: a hand that comes back to the shoulder by more meets nothing
# Hands that come this near to each other, from that much further apart, meet (leg lengths).
TOGETHER, CLOSING = 0.25, 0.1
AROUND = 2.0  # seconds around a peak of speed in which its stroke is looked for


@dataclass(frozen=True, eq=False)
class Hand:
    """Where a hand goes, in leg lengths, frame by frame.

    ``path`` (T, 3) as seen by what the arm hangs on, so that it is the arm alone that moves it; ``reach``
    (T,) from the shoulder; ``apart`` (T,) from the other hand.
    """

    path: Array
    reach: Array
    apart: Array

    @classmethod
    def of(cls, body: Body, motion: Motion, side: str, rotations: Array, positions: Array) -> "Hand":
        """Return the hand of a side, left or right, from the world transforms of the motion."""
        tips = [body.limbs[f"{s}_arm"][-1] for s in SIDES]
        arm = body.limbs[f"{side}_arm"]
        tip, hangs_on = positions[:, arm[-1]], int(motion.skeleton.parents[arm[0]])
        path = quaternion.rotate(quaternion.conjugate(rotations[:, hangs_on]), tip - positions[:, hangs_on])
        reach = np.linalg.norm(tip - positions[:, body.roles[f"{side}_shoulder"]], axis=1)
        apart = np.linalg.norm(positions[:, tips[0]] - positions[:, tips[1]], axis=1)
        return cls(path / body.leg_length, reach / body.leg_length, apart / body.leg_length)

    def rounds(self, frames: int, count: int) -> "Hand":
        """Return the first ``frames`` so many times over."""
        return Hand(*(np.concatenate([x[:frames]] * count) for x in (self.path, self.reach, self.apart)))


def strokes(hand: Hand, frame_time: float) -> Array:
    """Return when each stroke of a hand is wound up for, and when it ends, in seconds (N, 2).

    A stroke is a stretch in which the hand is faster than a quarter of the stroke's greatest speed. It is
    taken for one that meets something if

    - that speed is above 1.1 leg lengths a second, and 0.3 times the fast speed of the arm (95th percentile),
    - it falls from 0.9 of it to a quarter within 0.1 s,
    - the hand does not come back to the shoulder, unless to meet the other hand,
    - and it rests (below 0.12 of the speed, for 0.15 s) after the stroke; or before it, and reaches out; or
      it never rests, but stops harder than it sets off, and meets the other hand, or reaches out very fast.

    It ends where the hand stands (0.05 of the speed) or turns, and is wound up for since the hand last was
    as fast as a quarter of it. What an end of the clip cuts off is left out.
    """
    if len(hand.path) < 4:
        return np.zeros((0, 2))
    from scipy.interpolate import CubicSpline
    from scipy.signal import find_peaks

    times = np.arange(len(hand.path)) * frame_time
    at = np.arange(int(times[-1] / STEP) + 1) * STEP
    curves = np.column_stack([hand.path, hand.reach, hand.apart])
    curve = CubicSpline(times, smooth(curves, sigma=SMOOTHING / frame_time))
    speed = np.linalg.norm(curve(at, 1)[:, :3], axis=1)
    reach, apart = curve(at)[:, 3:].T
    least = max(FAST, OWN * float(np.percentile(speed, 95)))
    found = (_stroke(speed, reach, apart, int(peak)) for peak in find_peaks(speed, height=least)[0])
    return np.array([stroke for stroke in found if stroke is not None]).reshape(-1, 2) * STEP


def _stroke(speed: Array, reach: Array, apart: Array, peak: int) -> tuple[int, int] | None:
    """Return the steps at which the stroke around a peak of speed is wound up for and ends, if it is one."""
    top, far = float(speed[peak]), round(AROUND / STEP)
    first = max(peak - far, 0)
    slow = np.flatnonzero(speed[first:peak] < OVER * top)
    over = np.flatnonzero(speed[peak : peak + far] < OVER * top)
    if not len(slow) or not len(over):
        return None
    begin, end = first + int(slow[-1]) + 1, peak + int(over[0])
    going = peak + int(np.flatnonzero(speed[peak:end] >= GOING * top)[-1])
    if speed[begin:end].max() > top or (end - going) * STEP > SHARP:
        return None
    meets = apart[end] < TOGETHER and apart[begin] - apart[end] > CLOSING
    out = float(reach[end] - reach[begin])
    if out < -BACK and not meets:
        return None
    gain = np.diff(speed[begin - 1 : end + 1])
    harder = -gain[peak - begin :].min() >= HARDER * gain[: peak - begin + 1].max()
    blow = harder and (meets or (top >= BLOW and out >= OUT))
    single = _rests(speed[:begin][::-1], top) and _rests(_next(speed[end:], top), top)
    if not (blow or (single and out >= OUT) or _rests(speed[end:], top)):
        return None
    fast = np.flatnonzero(speed[:begin] >= OVER * top)
    return int(fast[-1]) + 1 if len(fast) else 0, end + _stop(speed[end:], top, end - peak)


def _rests(speed: Array, top: float) -> bool:
    """Return whether the hand rests, once its speed (N,) is down, before it is fast again."""
    fast = np.flatnonzero(speed >= OVER * top)
    slow = speed[: fast[0]] if len(fast) else speed
    return any(stop - start >= REST / STEP for start, stop in spans(np.asarray(slow < STILL * top)))


def _next(speed: Array, top: float) -> Array:
    """Return what is left of a speed (N,) once it was high and is down again: the way back is over."""
    fast = np.flatnonzero(speed >= OVER * top)
    slow = np.flatnonzero(speed[fast[0] :] < OVER * top) if len(fast) else fast
    return speed[fast[0] + slow[0] :] if len(slow) else speed[:0]


def _stop(speed: Array, top: float, within: int) -> int:
    """Return after how many steps a hand that has slowed down stands, or turns."""
    slow = speed[: within + 1]
    stopped = np.flatnonzero(slow <= STOPPED * top)
    return int(stopped[0]) if len(stopped) else int(np.argmin(slow))
