"""Legs that must reach: hips lowered and legs bent so that every ankle is where it should be.

Bones keep their lengths. A target out of a leg's reach lowers the hips; what a swinging leg cannot reach
softly is approached.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import envelope
from ..typing import Array, Mask
from .body import SIDES, Body
from .contacts import foot_points
from .fk import world
from .poses import neutral_world
from .two_bone import mean_hinge, softened, two_bone

UNTOUCHED = 0.003  # leg lengths: a swinging foot nearer than this to its goal is moved only in part


@dataclass(frozen=True, eq=False)
class Placed:
    """A motion with its world rotations (T, J, 4), positions (T, J, 3) and foot points (T, 2, 2, 3)."""

    motion: Motion
    rotations: Array
    positions: Array
    feet: Array

    @classmethod
    def of(cls, motion: Motion, body: Body) -> Self:
        """Return a motion with where it is."""
        rotations, positions = world(motion)
        return cls(motion, rotations, positions, foot_points(motion, body, rotations, positions))


@dataclass(frozen=True, eq=False)
class Goal:
    """Where an ankle must be (T, 3), how its foot must be turned (T, 4), and how much it stands (T,).

    ``met`` says that the edited leg is there already.
    """

    ankle: Array
    turn: Array
    stands: Array
    met: bool


def shifted(pose: Placed, shift: Array, body: Body) -> Placed:
    """Return the pose with the hips, and with them the body, moved by ``shift`` (T, 3) in world axes."""
    if not shift.any():
        return pose
    hips = body.roles["hips"]
    parent = int(pose.motion.skeleton.parents[hips])
    turned = (
        quaternion.rotate(quaternion.conjugate(pose.rotations[:, parent]), shift) if parent >= 0 else shift
    )
    translations = np.array(pose.motion.translations)
    translations[:, hips] += turned
    positions = np.array(pose.positions)
    positions[:, pose.motion.skeleton.descendants(hips)] += shift[:, None]
    return Placed(
        pose.motion.with_(translations=translations),
        pose.rotations,
        positions,
        pose.feet + shift[:, None, None],
    )


def put_feet(before: Placed, after: Placed, goals: Sequence[Goal], planted: Mask, body: Body) -> Motion:
    """Return the motion of ``after`` with both ankles at their goals, the left one's first.

    ``before`` is the motion it was made from: its knees say how knees bend, its toes how toes of standing
    feet lie, and no planted leg needs to be straighter than there. ``planted`` (T, 2).
    """
    drop = _drop(before, after, goals, planted, body)
    after = shifted(after, -drop[:, None] * body.up, body)
    rotations = np.array(after.motion.rotations)
    for foot, goal in enumerate(goals):
        if not goal.met or drop.any():
            _bend_leg(rotations, before, after, goal, planted[:, foot], body, foot)
    return after.motion.with_(rotations=quaternion.continuous(rotations))


def over_feet(pose: Placed, shift: Array, planted: Mask, body: Body) -> Motion:
    """Return the motion with the hips moved by ``shift`` (T, 3) and both feet where they are.

    The hips come down by so much that no planted leg gets straighter than it is: a knee that is nearly
    straight would bend a lot for little.
    """
    goals, lower = [], np.zeros(len(shift))
    for foot, side in enumerate(SIDES):
        ankle = body.roles[f"{side}_ankle"]
        stands = planted[:, foot].astype(float)
        goals.append(Goal(pose.positions[:, ankle], pose.rotations[:, ankle], stands, met=False))
        leg = pose.positions[:, body.roles[f"{side}_hip"]] - pose.positions[:, ankle]
        height = (leg + shift) @ body.up
        across = (leg + shift) - height[:, None] * body.up
        room = (leg * leg).sum(axis=1) - (across * across).sum(axis=1)
        lower = np.maximum(lower, np.where(planted[:, foot], height - np.sqrt(np.maximum(room, 0.0)), 0.0))
    down = envelope(lower, reach=round(0.12 / pose.motion.frame_time))
    return put_feet(pose, shifted(pose, shift - down[:, None] * body.up, body), goals, planted, body)


def clear_of(planted: Mask, frame_time: float, seconds: float) -> Array:
    """Return 0 while planted, growing to 1 within some seconds of swing (T,)."""
    from scipy.ndimage import distance_transform_edt

    if not planted.any():
        return np.ones(len(planted))
    share = np.clip(distance_transform_edt(~planted) * frame_time / seconds, 0, 1)
    return np.asarray(share * share * (3 - 2 * share))


def _drop(before: Placed, after: Placed, goals: Sequence[Goal], planted: Mask, body: Body) -> Array:
    """Return how far the hips must come down (T,) for the planted feet to be within reach."""
    dt = after.motion.frame_time
    need = np.zeros(len(after.motion))
    for foot, goal in enumerate(goals):
        hip, knee, ankle = (body.roles[f"{SIDES[foot]}_{r}"] for r in ("hip", "knee", "ankle"))
        length = _bones(after, hip, knee) + _bones(after, knee, ankle)
        line = after.positions[:, hip] - goal.ankle
        source = before.positions[:, hip] - before.positions[:, ankle]
        # A leg that the edit hardly moves may be as straight as it was; the others keep a little bend.
        moved = np.linalg.norm(line - source, axis=1) / (0.02 * body.leg_length)
        straight = np.clip(np.linalg.norm(source, axis=1) / length, 0.995, 1.0)
        reach = length * (0.995 + (straight - 0.995) * np.exp(-(moved**2)))
        up = line @ body.up
        across = np.linalg.norm(line - up[:, None] * body.up, axis=1)
        standing = np.sqrt(np.maximum(reach**2 - across**2, (0.3 * reach) ** 2))
        need = np.maximum(need, np.where(planted[:, foot], up - standing, 0.0))
    if not (need > 1e-9 * body.leg_length).any():
        return np.zeros_like(need)
    return envelope(need, reach=round(0.12 / dt))


def _bones(pose: Placed, a: int, b: int) -> Array:
    return np.linalg.norm(pose.positions[:, b] - pose.positions[:, a], axis=1)


def _reachable(after: Placed, goal: Goal, planted: Mask, body: Body, foot: int) -> Array:
    """Return the ankle's goal (T, 3), drawn in softly where a swinging leg would have to over-stretch.

    Up to a stretch of 0.97 (or the edited pose's own) nothing changes; from there it tends to 0.995
    without reaching it. At a contact the softness is gone: planted feet are met exactly.
    """
    hip, knee, ankle = (body.roles[f"{SIDES[foot]}_{r}"] for r in ("hip", "knee", "ankle"))
    length = _bones(after, hip, knee) + _bones(after, knee, ankle)
    own = _bones(after, hip, ankle) / length
    limit = np.clip(own, 0.995, 1.0)
    soft = np.maximum(0.025 * clear_of(planted, after.motion.frame_time, 0.1), 1e-9)
    line = goal.ankle - after.positions[:, hip]
    stretch = np.linalg.norm(line, axis=1) / length
    drawn = softened(stretch, np.maximum(limit - soft, np.minimum(own, limit - 1e-9)), limit)
    return after.positions[:, hip] + line * np.where(planted, 1.0, drawn / stretch)[:, None]


def _bend_leg(
    rotations: Array, before: Placed, after: Placed, goal: Goal, planted: Mask, body: Body, foot: int
) -> None:
    """In place: bend one leg so that its ankle and foot reach the goal; the toes stand as in the original."""
    hip, knee, ankle = (body.roles[f"{SIDES[foot]}_{r}"] for r in ("hip", "knee", "ankle"))
    world, parents = after.rotations, after.motion.skeleton.parents
    target = _reachable(after, goal, planted, body, foot)
    upper, lower = two_bone(
        after.positions[:, hip],
        after.positions[:, knee],
        after.positions[:, ankle],
        target,
        quaternion.rotate(world[:, hip], _hinge(before, body, foot)),
    )
    # A swinging leg that is where it should be is not touched: an over-stretched knee stays as it was.
    away = np.linalg.norm(target - after.positions[:, ankle], axis=1) / (UNTOUCHED * body.leg_length)
    share = np.where(planted, 1.0, np.clip(away, 0.0, 1.0))
    upper, lower = quaternion.power(upper, share), quaternion.power(lower, share)
    turn = quaternion.slerp(world[:, ankle], goal.turn, share)

    def local(parent: int, above: Array, turned: Array) -> Array:
        outer = quaternion.multiply(above, world[:, parent]) if parent >= 0 else above
        return quaternion.multiply(quaternion.conjugate(outer), turned)

    rotations[:, hip] = local(
        int(parents[hip]), quaternion.IDENTITY, quaternion.multiply(upper, world[:, hip])
    )
    rotations[:, knee] = local(int(parents[knee]), upper, quaternion.multiply(lower, world[:, knee]))
    rotations[:, ankle] = local(int(parents[ankle]), lower, turn)
    stands = np.clip(goal.stands, 0.0, 1.0)
    for joint in after.motion.skeleton.descendants(ankle)[1:]:
        rotations[:, joint] = quaternion.slerp(rotations[:, joint], before.motion.rotations[:, joint], stands)


def _hinge(before: Placed, body: Body, foot: int) -> Array:
    """Return the axis (3,) about which the knee bends, in the thigh's own axes.

    It comes from the frames of the original in which the knee is clearly bent; a leg that never bends
    has the hinge of the neutral stance, square to the walking direction.
    """
    hip, knee, ankle = (body.roles[f"{SIDES[foot]}_{r}"] for r in ("hip", "knee", "ankle"))
    thigh = before.positions[:, hip] - before.positions[:, knee]
    shank = before.positions[:, ankle] - before.positions[:, knee]
    standing = quaternion.conjugate(neutral_world(before.motion, body)[0][hip])
    usual = 0.01 * body.leg_length**2 * quaternion.rotate(standing, -body.left)
    return mean_hinge(thigh, shank, before.rotations[:, hip], usual)
