"""The still that many captures start with: a T-pose, and the few frames that rush from it to the action.

Such frames are no movement. Filtered or retimed with the rest they would smear into it, so edits leave
them out, and so do readings, features and curves, whose speeds the jump would spoil. A T-pose that somebody
leaves by moving, without a jump, is movement and stays.
"""

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array

LONGEST = 0.25  # seconds of the rush
HELD = 3.0  # seconds that the pose may be held before it
UNMOVED = 1e-4  # radians from frame to frame, on average over the joints: the same pose again, written anew
ALONE = 5.0  # times what follows: a jump that is no part of a fast movement
JUMP = 0.026  # radians, on average over the joints: one and a half degrees from one frame to the next
RUSH = 5.24  # radians a second, on average over the joints: 300 degrees, faster than bodies move
NEARER = 0.75  # the first pose turns joints by less than this share of what any later pose does


def lead_in(motion: Motion) -> int:
    """Return how many frames at the start belong to a still such as a T-pose, 0 where there is none.

    The pose may be held, quite unmoved, for up to three seconds. It is left by a jump of more than one and a
    half degrees on average over the joints, by turns more than twice as fast as nine in ten later frames, or
    five times as fast as all in the quarter second that follows; they lie within a quarter second. A clip
    cut out of a fast movement starts like that too, so the jump must be faster than bodies move, or start
    from a pose much nearer to the rest pose than all that follows.
    """
    held = _held(motion)
    if not held:
        return _rush(motion)
    # At another frame rate a frame may have a little of the jump already.
    return next((first + rush for first in (held, held + 1) if (rush := _rush(motion[first:]))), 0)


def still_before(motion: Motion) -> int:
    """Return how many frames at the start are no movement, for an edited motion those of its original.

    Edits keep such frames where they are, and may make the jump that tells them harder to tell.
    """
    return lead_in(motion if motion.reference is None else motion.reference)


def _held(motion: Motion) -> int:
    """Return how many frames stand before the last one of the first pose; 0 where nothing follows it."""
    if len(motion) < 2 or _turns(motion.rotations[:2])[0] > UNMOVED:
        return 0
    moved = _turns(motion.rotations[: int(HELD / motion.frame_time) + 2]) > UNMOVED
    return int(moved.argmax())


def _rush(motion: Motion) -> int:
    """Return how many frames at the start rush from a still to the action, the still among them."""
    within = int(LONGEST / motion.frame_time) + 1
    if len(motion) < within + 4:
        return 0
    if _turns(motion.rotations[:2])[0] <= JUMP:
        return 0
    turn = _turns(motion.rotations)
    rushed = turn[:within] > max(2.0 * float(np.percentile(turn[within:], 90)), 0.25 * JUMP)
    rushed[0] |= turn[0] > ALONE * turn[1 : within + 1].max()
    if not rushed[0]:
        return 0
    mostly = np.cumsum(rushed) >= 0.75 * np.arange(1, within + 1)
    frames = int(np.flatnonzero(rushed & mostly)[-1]) + 1
    return frames if turn[0] > RUSH * motion.frame_time or _starts_at_rest(motion, frames) else 0


def _turns(rotations: Array) -> Array:
    """Return how far the joints turn from frame to frame (T - 1,), on average, in radians.

    The joint that turns most is left out: one that flips over for a frame is no change of pose.
    """
    same = np.abs(np.einsum("tji,tji->tj", rotations[1:], rotations[:-1]))
    turn = 2.0 * np.arccos(np.minimum(same, 1.0))
    return (turn.sum(axis=1) - turn.max(axis=1)) / max(turn.shape[1] - 1, 1)


def _starts_at_rest(motion: Motion, frames: int) -> bool:
    """Say whether the first pose is much nearer to the rest pose than all from ``frames`` on; roots aside."""
    below = motion.skeleton.parents >= 0
    away = np.arccos(np.minimum(np.abs(motion.rotations[:, below, 3]), 1.0)).sum(axis=1)
    return bool(away[0] < NEARER * away[frames:].min())


def without_lead_in(motion: Motion, frames: int) -> Motion:
    """Return the motion with its first ``frames`` standing still in the pose that follows them."""
    if not frames:
        return motion
    rotations, translations = np.array(motion.rotations), np.array(motion.translations)
    rotations[:frames], translations[:frames] = rotations[frames], translations[frames]
    return motion.with_(rotations=rotations, translations=translations)


def with_lead_in(motion: Motion, source: Motion, frames: int) -> Motion:
    """Return the motion with the still of ``source`` in its first ``frames``.

    The very first frame is the source's own; over the others what was changed right after the still
    grows in, so that nothing jumps that did not jump before.
    """
    if not frames:
        return motion
    rotations, translations = np.array(motion.rotations), np.array(motion.translations)
    share = np.arange(frames)[:, None] / frames
    change = quaternion.multiply(quaternion.conjugate(source.rotations[frames]), motion.rotations[frames])
    rotations[:frames] = quaternion.multiply(source.rotations[:frames], quaternion.power(change, share))
    moved = motion.translations[frames] - source.translations[frames]
    translations[:frames] = source.translations[:frames] + share[..., None] * moved
    rotations[0] = source.rotations[0]
    return motion.with_(rotations=quaternion.continuous(rotations), translations=translations)
