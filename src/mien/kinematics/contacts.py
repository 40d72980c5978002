"""Foot contacts: when which foot stands on the floor, and how far it slides while it stands.

A point of a foot is planted while it is low and slow, with hysteresis so that noise does not make it
flicker (Förger 2011, section 3.5). Heel and toe are judged apart, as a step rolls from one to the
other.
"""

from dataclasses import dataclass

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array, Mask
from .body import Body
from .fk import end_positions, world
from .poses import neutral_world

HEIGHT, SPEED = 0.057, 0.35  # leg lengths, leg lengths a second: 5 cm and 0.30 m/s on a 0.87 m leg
SOLE, BEHIND = 0.08, 0.05  # leg lengths: the heel under and behind the ankle (Winter 2009)
RELEASE = 1.5  # a planted point is let go at this multiple of the thresholds
SHORTEST, GAP = 0.08, 0.05  # seconds: a shorter contact is dropped, a shorter gap filled


@dataclass(frozen=True, eq=False)
class Contacts:
    """``points`` (T, 2, 2): left and right foot, heel and toe, planted or not."""

    points: Mask

    def __repr__(self) -> str:
        left, right = (len(self.spans(foot)) for foot in range(2))
        return f"Contacts({len(self.points)} frames: {left} of the left foot, {right} of the right)"

    @property
    def feet(self) -> Mask:
        """Whether each foot stands on anything (T, 2)."""
        return np.asarray(self.points.any(axis=2))

    def spans(self, foot: int) -> list[tuple[int, int]]:
        """Return the contacts of a foot (0 left, 1 right) as ``(first frame, frame after the last)``."""
        return spans(self.feet[:, foot])


def spans(mask: Mask) -> list[tuple[int, int]]:
    """Return the runs of True in ``mask`` (T,) as ``(start, stop)`` with ``stop`` exclusive."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
    return [(int(a), int(b)) for a, b in edges.reshape(-1, 2)]


def detect(motion: Motion, *, body: Body | None = None) -> Contacts:
    """Return the contacts of both feet with the floor.

    A contact starts where the point is less than 0.057 leg lengths (5 cm) above its own lowest level
    and slower over the ground than 0.35 leg lengths a second (0.30 m/s; more in clips with very fast
    feet) and no longer falling. It ends at 1.5 times that height or speed, lasts at least 0.08 s, and
    bridges gaps up to 0.05 s. A foot without a toe, and without an end site on its ankle, has only a
    heel.
    """
    body = body or Body.of(motion)
    rotations, positions = world(motion)
    return detect_points(foot_points(motion, body, rotations, positions), body, motion.frame_time)


def foot_points(motion: Motion, body: Body, rotations: Array, positions: Array) -> Array:
    """Return the heel and toe of both feet (T, 2, 2, 3) in world axes; without a toe it is the heel.

    Skeletons have no heel: it is taken below and behind the ankle, where the sole is in the neutral
    stance, and moves with the foot. So a foot that rolls over its heel has a point that stands. The
    toe is the toe joint, or the end site of the ankle.
    """
    ends = end_positions(motion, rotations, positions)
    stance = neutral_world(motion, body)[0]
    out = np.empty((len(motion), 2, 2, 3))
    for foot, side in enumerate(("left", "right")):
        ankle, toe = body.roles[f"{side}_ankle"], body.roles.get(f"{side}_toe")
        tips = np.flatnonzero(motion.skeleton.end_parents == ankle)
        heel = -SOLE * body.leg_length * body.up - BEHIND * body.leg_length * body.forward
        arm = quaternion.rotate(quaternion.conjugate(stance[ankle]), heel)
        out[:, foot, 0] = positions[:, ankle] + quaternion.rotate(rotations[:, ankle], arm)
        if toe is not None:
            out[:, foot, 1] = positions[:, toe]
        else:
            out[:, foot, 1] = ends[:, tips[0]] if len(tips) else positions[:, ankle]
    return out


def detect_points(points: Array, body: Body, frame_time: float) -> Contacts:
    """Return the contacts of foot points (T, 2, 2, 3): see ``detect``."""
    leg = body.leg_length
    height = points @ body.up
    level = standing_level(height, leg)
    step, seconds = _step(points, frame_time)
    speed = _length(step - (step @ body.up)[..., None] * body.up) / seconds
    fast = max(SPEED * leg, 0.06 * float(np.percentile(speed, 95)))
    # What still falls is not down yet; what rolls off the heel rises and still stands.
    down = _length(step) / seconds < RELEASE * fast
    on = (height - level < HEIGHT * leg) & (speed < fast) & down
    hold = (height - level < RELEASE * HEIGHT * leg) & (speed < RELEASE * fast)
    planted = _hysteresis(on, hold)
    planted = _runs(planted, False, int(np.ceil(GAP / frame_time - 1e-9)))
    shortest = min(int(np.ceil(SHORTEST / frame_time - 1e-9)), len(points))
    return Contacts(_runs(planted, True, max(shortest - 1, 0)))


def standing_level(height: Array, leg: float) -> Array:
    """Return the standing height (2, 2) of each point from its heights (T, 2, 2): its own 5th percentile.

    A foot that never comes near the floor that the other stands on is judged by the other's level.
    """
    own = np.percentile(height, 5, axis=0)
    common = own.min(axis=0)
    return np.where(own - common < HEIGHT * leg, own, common)


def _step(points: Array, frame_time: float) -> tuple[Array, Array]:
    """Return how far each point goes (T, 2, 2, 3) in about a thirtieth of a second around each frame.

    Also returns how long that takes, in seconds (T, 1, 1).
    """
    reach = max(1, round(1.0 / (60.0 * frame_time)))
    frames = np.arange(len(points))
    later, earlier = np.minimum(frames + reach, len(points) - 1), np.maximum(frames - reach, 0)
    return points[later] - points[earlier], np.maximum(later - earlier, 1)[:, None, None] * frame_time


def _length(v: Array) -> Array:
    return np.sqrt(np.einsum("...i,...i->...", v, v))


def _hysteresis(on: Mask, hold: Mask) -> Mask:
    """Return a Schmitt trigger over axis 0: from every True of ``on`` for as long as ``hold`` lasts."""
    frames = np.arange(len(on)).reshape(-1, *[1] * (on.ndim - 1))
    started = np.maximum.accumulate(np.where(on & hold, frames, -1), axis=0)
    stopped = np.maximum.accumulate(np.where(hold, -1, frames), axis=0)
    return started > stopped


def _runs(mask: Mask, value: bool, longest: int) -> Mask:
    """Turn over runs of ``value`` of at most ``longest`` frames; a gap at either end of the clip stays."""
    out = mask.copy()
    for index in np.ndindex(mask.shape[1:]):
        column = (slice(None), *index)
        for start, stop in spans(mask[column] == value):
            inside = start > 0 and stop < len(mask)
            if stop - start <= longest and (inside or value):
                out[(slice(start, stop), *index)] = not value
    return out


def slides(motion: Motion, contacts: Contacts, body: Body) -> Array:
    """Return how far the planted point moves over the ground in each contact (N,), in the clip's unit.

    For every run in which a heel or toe is planted: the largest horizontal distance from where it
    stands on average. Zero for a foot that does not slide.
    """
    points = foot_points(motion, body, *world(motion))
    points = points - (points @ body.up)[..., None] * body.up
    found = []
    for foot in range(2):
        for point in range(2):
            for start, stop in spans(contacts.points[:, foot, point]):
                run = points[start:stop, foot, point]
                found.append(float(np.linalg.norm(run - run.mean(axis=0), axis=1).max()))
    return np.array(found)
