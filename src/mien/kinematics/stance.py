"""Up, forward and the neutral stance of a body whose roles are known.

The neutral stance is the rest pose (all local rotations zero) stood upright with straight legs and
the arms at the sides, where the rest pose is a body at all; else the straightest frames of the clip
give what it starts from. So two clips of one actor have the same stance, and posture transfers.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..motion import Skeleton
from ..rotations import quaternion
from ..typing import Array
from .fk import fk, to_local
from .tree import Tree, unit

Roles = Mapping[str, int]
SIDES = ("left", "right")

ARM_OUT = np.radians(8.0)  # upper arms off the vertical, so that hands pass the thighs
ELBOW_BEND = np.radians(10.0)  # relaxed elbows are never quite straight
NECK = np.radians(10.0)  # a neck taken from the clip is set to lean this far to the front
STILL = 0.01  # radians: a joint that turns less in a whole clip is part of the file's axes
LEAN = np.radians(5.0)  # an upright trunk, hip joints to shoulder joints, leans no more than this
LOW = 0.02  # legs: an ankle no higher than this above its lowest belongs to a foot that is flat
NEAR_AXIS = np.radians(15.0)  # rest poses this near to a world axis mean that axis


@dataclass(frozen=True, eq=False)
class Stance:
    """``up`` and ``forward`` (3,), ``rotations`` (J, 4) local, ``heights`` (N,) of joints and end sites."""

    up: Array
    forward: Array
    rotations: Array
    heights: Array


def neutral(skeleton: Skeleton, body: Tree, local: Array, offsets: Array, roles: Roles) -> Stance:
    """Return the neutral stance.

    ``local`` (F, J, 4) are the rotations of the frames that ``body`` was made of, ``offsets`` (J, 3)
    the typical translations.
    """
    above = body.ancestors(roles["hips"])[1:]
    start = _rest(body, local, above)
    rest = fk(start[None], offsets[None], skeleton.parents)[1][0]
    points = np.moveaxis(body.points[: len(skeleton)], 0, 1)
    standing = is_body(rest, roles)
    up = up_axis(points, rest if standing else None, roles)
    if above:  # a still root may also turn the whole clip about up: that is heading and no file axis
        yaw = quaternion.conjugate(quaternion.twist(start[above[-1]], up))
        start[above[-1]], rest = quaternion.multiply(yaw, start[above[-1]]), quaternion.rotate(yaw, rest)
    forward = _near_axis(_facing(rest, roles, up)) if standing else usual_front(up)
    if not standing:
        axes, start = start[above], calm_pose(local, points, roles, up)
        start[above] = axes
    pose = _Pose(start, offsets, skeleton)
    own_up = _near_axis(body_up(rest, roles)) if standing else _trunk(pose.points, roles)
    feet = {} if standing else flat_feet(points, body.world, roles, up, forward)
    stand(pose, roles, own_up, up, forward, feet)
    if not standing and {"neck", "head"} <= roles.keys():
        pose.aim(roles["neck"], roles["head"], np.cos(NECK) * up + np.sin(NECK) * forward)
    return Stance(up, forward, pose.local(), pose.heights(up))


def _rest(body: Tree, local: Array, above: list[int]) -> Array:
    """Return zero rotations (J, 4), but those above the hips that stand still as they are: file axes."""
    start = np.tile(quaternion.IDENTITY, (len(body.names), 1))
    still = [j for j in above if body.turning[j] < STILL]
    start[still] = local[0, still]
    return start


def body_up(points: Array, roles: Roles) -> Array:
    """Return the unit direction (..., 3) from the ankles over the hips to the shoulders."""
    ankles, hips, shoulders = (_middle(points, roles, r) for r in ("ankle", "hip", "shoulder"))
    return unit(unit(hips - ankles) + unit(shoulders - hips))


def up_axis(points: Array, rest: Array | None, roles: Roles) -> Array:
    """Return the world axis (unit, one of +-X, +-Y, +-Z) that the body in ``points`` (F, J, 3) stands along.

    The mean direction of the body over the clip decides; where it lies or turns over, the rest pose
    (J, 3; None if it is no body) and the habit of files (Y, then Z, hardly ever X or down) do.
    """
    mean = body_up(points, roles).mean(axis=0)
    score = np.stack([mean, -mean], axis=1)  # (axis, sign)
    if rest is not None:
        standing = body_up(rest, roles)
        score += 0.5 * np.stack([standing, -standing], axis=1)
    score += np.array([[-0.3, -0.4], [0.3, -0.3], [0.2, -0.3]])
    axis, sign = np.unravel_index(int(np.argmax(score)), score.shape)
    up = np.zeros(3)
    up[axis] = 1.0 if sign == 0 else -1.0
    return up


def is_body(points: Array, roles: Roles) -> bool:
    """Say whether a pose (J, 3) is a standing body: legs along the trunk, sides apart, arms not overhead.

    Rest poses that lay every bone along one axis are no body.
    """
    up, trunk = body_up(points, roles), _trunk(points, roles)
    across = [unit(points[roles[f"left_{r}"]] - points[roles[f"right_{r}"]]) for r in ("hip", "shoulder")]
    bones = [
        unit(points[roles[f"{side}_{a}"]] - points[roles[f"{side}_{b}"]])
        for side in SIDES
        for a, b in (*pairwise(("hip", "knee", "ankle")), ("shoulder", "elbow"))
    ]
    steep = [float(up @ b) for b in bones]
    legs, arms = steep[0:2] + steep[3:5], [steep[2], steep[5]]
    upright = min(float(up @ trunk), *legs) > 0.8 and min(arms) > -0.5
    return upright and max(abs(float(up @ d)) for d in across) < 0.3 and float(across[0] @ across[1]) > 0.8


def usual_front(up: Array) -> Array:
    """Return where files with this up axis have their figures face: +Z, but -Y where Z is up."""
    return np.array([0.0, -1.0, 0.0]) if abs(up[2]) > 0.5 else np.array([0.0, 0.0, 1.0])


def _facing(points: Array, roles: Roles, up: Array) -> Array:
    """Return the horizontal unit direction (..., 3) of the hips: right to left, a quarter turn about up."""
    return unit(np.cross(points[..., roles["left_hip"], :] - points[..., roles["right_hip"], :], up))


def _near_axis(direction: Array) -> Array:
    """Return the world axis if a direction is within 15 degrees of one, else the direction itself."""
    axis = np.zeros(3)
    biggest = int(np.argmax(np.abs(direction)))
    axis[biggest] = np.sign(direction[biggest])
    return axis if float(direction @ axis) > np.cos(NEAR_AXIS) else direction


def _trunk(points: Array, roles: Roles) -> Array:
    return unit(_middle(points, roles, "shoulder") - _middle(points, roles, "hip"))


def _middle(points: Array, roles: Roles, role: str) -> Array:
    return 0.5 * (points[..., roles[f"left_{role}"], :] + points[..., roles[f"right_{role}"], :])


def calm_pose(local: Array, points: Array, roles: Roles, up: Array) -> Array:
    """Return the mean local rotations (J, 4) of the quarter of the frames that stand straightest.

    Local rotations (F, J, 4), positions (F, J, 3). The hips are of no use: they hold the heading.
    """
    score = _trunk(points, roles) @ up
    for side in SIDES:
        for a, b, weight in (("hip", "knee", 1.0), ("knee", "ankle", 1.0), ("shoulder", "elbow", 0.5)):
            bone = points[:, roles[f"{side}_{a}"]] - points[:, roles[f"{side}_{b}"]]
            score = score + weight * (unit(bone) @ up)
    chosen = local[np.sort(np.argsort(-score, kind="stable")[: max(1, len(points) // 4)])]
    sign = np.where(np.einsum("fji,ji->fj", chosen, chosen[0]) < 0, -1.0, 1.0)
    return quaternion.normalise((chosen * sign[..., None]).sum(axis=0))


def flat_feet(points: Array, world: Array, roles: Roles, up: Array, forward: Array) -> dict[str, Array]:
    """Return side -> the world rotation (4,) of the ankle of a foot that stands flat, facing ``forward``.

    From positions (F, J, 3) and world rotations (F, J, 4): a foot is flat where its ankle is lowest, as it
    rises when the foot rolls over heel or toe. The mean, weighed by how near to the lowest the ankle is. A
    foot that is never down beside the other is left out.
    """
    facing = _facing(points, roles, up)
    yaw = np.arctan2(np.cross(facing, forward) @ up, facing @ forward)
    ankles = [roles[f"{side}_ankle"] for side in SIDES]
    reach = np.linalg.norm(points[:, roles["left_hip"]] - points[:, ankles[0]], axis=-1).max()
    heights = points[:, ankles] @ up / reach
    out = {}
    for side, ankle, height in zip(SIDES, ankles, heights.T, strict=True):
        if height.min() - heights.min() > LOW:
            continue  # never down where the other foot stands
        weight = np.exp(-0.5 * ((height - height.min()) / LOW) ** 2)
        seen = quaternion.multiply(quaternion.exp(yaw[:, None] * up), world[:, ankle])
        sign = np.where(seen @ seen[np.argmax(weight)] < 0, -1.0, 1.0)
        out[side] = quaternion.normalise((seen * (sign * weight)[:, None]).sum(axis=0))
    return out


class _Pose:
    """One pose in world axes; turning a joint takes along what hangs on it."""

    def __init__(self, local: Array, offsets: Array, skeleton: Skeleton) -> None:
        world, points = fk(local[None], offsets[None], skeleton.parents)
        self.world, self.points, self.skeleton = world[0], points[0], skeleton

    def turn(self, joint: int, rotation: Array) -> None:
        """Turn a joint by a rotation in world axes."""
        below, pivot = self.skeleton.descendants(joint), self.points[joint].copy()
        self.world[below] = quaternion.multiply(rotation, self.world[below])
        self.points[below] = pivot + quaternion.rotate(rotation, self.points[below] - pivot)

    def aim(self, joint: int, target: int, direction: Array) -> None:
        """Turn ``joint`` by the smallest rotation that brings ``target`` into ``direction`` from it."""
        self.turn(joint, quaternion.between(self.points[target] - self.points[joint], direction))

    def local(self) -> Array:
        """Return the local rotations (J, 4)."""
        return to_local(self.world[None], self.points[None], self.skeleton.parents)[0][0]

    def heights(self, up: Array) -> Array:
        """Return the heights (J + E,) of joints and end sites along ``up``."""
        parents = self.skeleton.end_parents
        ends = self.points[parents] + quaternion.rotate(self.world[parents], self.skeleton.end_offsets)
        return np.concatenate([self.points, ends]) @ up


def stand(
    pose: _Pose, roles: Roles, own_up: Array, up: Array, forward: Array, feet: Mapping[str, Array]
) -> None:
    """Stand a pose upright: ``own_up`` along ``up``, facing ``forward``, legs straight down, arms down.

    ``feet`` side -> how the ankle is turned then, in world axes; a foot that it lacks keeps the way it stood.
    """
    pose.turn(roles["hips"], quaternion.between(own_up, up))
    upright = quaternion.log(quaternion.between(_trunk(pose.points, roles), up))
    angle = float(np.linalg.norm(upright))
    pose.turn(roles["hips"], quaternion.exp(upright * max(0.0, 1.0 - LEAN / max(angle, 1e-12))))
    facing = _facing(pose.points, roles, up)
    yaw = np.arctan2(np.cross(facing, forward) @ up, facing @ forward)
    pose.turn(roles["hips"], quaternion.exp(yaw * up))
    for side, outward in zip(SIDES, (1.0, -1.0), strict=True):
        _leg_down(pose, roles, side, up, feet.get(side))
        _arm_down(pose, roles, side, up, forward, outward * np.cross(up, forward))


def _leg_down(pose: _Pose, roles: Roles, side: str, up: Array, flat: Array | None) -> None:
    """Straighten a leg; the foot is set flat, or keeps the way it stood."""
    hip, knee, ankle = (roles[f"{side}_{r}"] for r in ("hip", "knee", "ankle"))
    foot = pose.world[ankle].copy() if flat is None else flat
    pose.aim(hip, knee, -up)
    pose.aim(knee, ankle, -up)
    pose.turn(ankle, quaternion.multiply(foot, quaternion.conjugate(pose.world[ankle])))


def _arm_down(pose: _Pose, roles: Roles, side: str, up: Array, forward: Array, outward: Array) -> None:
    """Lower an arm to the side, the forearm a little to the front."""
    shoulder, elbow, wrist = (roles.get(f"{side}_{r}", -1) for r in ("shoulder", "elbow", "wrist"))
    down = np.sin(ARM_OUT) * outward - np.cos(ARM_OUT) * up
    pose.aim(shoulder, elbow, down)
    if wrist >= 0:
        pose.aim(elbow, wrist, np.cos(ELBOW_BEND) * down + np.sin(ELBOW_BEND) * forward)
