"""Up, forward and the neutral stance of a body whose roles are known.

The neutral stance is the rest pose (all local rotations zero) stood upright with straight legs and
the arms at the sides, where the rest pose is a body at all; else the calmest upright frames give
what it starts from. So two clips of one actor have the same stance, and posture changes transfer.
"""

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from ..motion import Skeleton
from ..rotations import quaternion
from ..typing import Array
from .fk import fk

Roles = Mapping[str, int]
SIDES = ("left", "right")

ARM_OUT = np.radians(8.0)  # upper arms off the vertical, so that hands pass the thighs
ELBOW_BEND = np.radians(10.0)  # relaxed elbows are never straight


def neutral(
    skeleton: Skeleton, local: Array, world: Array, points: Array, offsets: Array, roles: Roles
) -> tuple[Array, Array, Array]:
    """Return the up axis, the direction the neutral stance faces, and its local rotations (J, 4).

    ``local``, ``world`` (F, J, 4) and ``points`` (F, J, 3) are some frames of the clip, ``offsets``
    (J, 3) the typical translations.
    """
    start = np.tile(quaternion.IDENTITY, (len(skeleton), 1))
    rest = fk(start[None], offsets[None], skeleton.parents)[1][0]
    standing = is_body(rest, roles)
    up = up_axis(points, rest if standing else None, roles)
    if not standing:
        start = calm_pose(local, world, points, roles, up)
        rest = fk(start[None], offsets[None], skeleton.parents)[1][0]
    forward = forward_axis(rest, roles, up) if standing else usual_front(up)
    return up, forward, stand(start, offsets, skeleton.parents, roles, up, forward)


def body_up(points: Array, roles: Roles) -> Array:
    """Return the unit direction (F, 3) from the ankles over the hips to the shoulders in each frame."""
    ankles, hips, shoulders = (_middle(points, roles, r) for r in ("ankle", "hip", "shoulder"))
    return _unit(_unit(hips - ankles) + _unit(shoulders - hips))


def up_axis(points: Array, rest: Array | None, roles: Roles) -> Array:
    """Return the world axis (unit, one of +-X, +-Y, +-Z) that the body in ``points`` (F, J, 3) stands along.

    The mean direction of the body over the clip decides; where it lies or turns over, the rest pose
    (J, 3; None if it is no body) and the habit of files (Y, then Z) do.
    """
    mean = body_up(points, roles).mean(axis=0)
    score = np.stack([mean, -mean], axis=1)  # (axis, sign)
    if rest is not None:
        standing = body_up(rest[None], roles)[0]
        score += 0.5 * np.stack([standing, -standing], axis=1)
    score += np.array([[-0.3, -0.4], [0.3, -0.3], [0.2, -0.3]])
    axis, sign = np.unravel_index(int(np.argmax(score)), score.shape)
    up = np.zeros(3)
    up[axis] = 1.0 if sign == 0 else -1.0
    return up


def is_body(points: Array, roles: Roles) -> bool:
    """Say whether a pose (J, 3) is a standing body: legs along the trunk, sides apart, arms not on the head.

    Rest poses that lay every bone along one axis are no body.
    """
    up = body_up(points[None], roles)[0]
    across = [_unit(points[roles[f"left_{r}"]] - points[roles[f"right_{r}"]]) for r in ("hip", "shoulder")]
    trunk = _unit(_middle(points, roles, "shoulder") - _middle(points, roles, "hip"))
    legs = [
        _unit(points[roles[f"{s}_{a}"]] - points[roles[f"{s}_{b}"]])
        for s in SIDES
        for a, b in pairwise(("hip", "knee", "ankle"))
    ]
    upright = min(float(up @ d) for d in (trunk, *legs)) > 0.8
    sideways = max(abs(float(up @ d)) for d in across) < 0.3 and float(across[0] @ across[1]) > 0.8
    arms = [_unit(points[roles[f"{s}_elbow"]] - points[roles[f"{s}_shoulder"]]) for s in SIDES]
    return upright and sideways and max(float(up @ d) for d in arms) < 0.5


def usual_front(up: Array) -> Array:
    """Return where files with this up axis have their figures face: +Z, with Z up -Y, with X up +Z."""
    return np.array([0.0, 0.0, 1.0]) if abs(up[2]) < 0.5 else np.array([0.0, -1.0, 0.0])


def forward_axis(points: Array, roles: Roles, up: Array) -> Array:
    """Return the horizontal unit direction a pose (J, 3) faces: right to left, a quarter turn about up."""
    across = _middle_side(points, roles)
    return _unit(np.cross(across, up))


def _middle_side(points: Array, roles: Roles) -> Array:
    return sum(
        (
            _unit(points[..., roles[f"left_{r}"], :] - points[..., roles[f"right_{r}"], :])
            for r in ("hip", "shoulder")
        ),
        start=np.zeros(3),
    )


def stand(
    start: Array, offsets: Array, parents: np.ndarray, roles: Roles, up: Array, forward: Array
) -> Array:
    """Return ``start`` (J, 4) stood upright: facing ``forward``, legs straight down, arms at the sides."""
    pose = _Pose(np.array(start), offsets, parents)
    pose.turn_whole(roles["hips"], _to_front(pose.points, roles, up, forward))
    feet = {s: pose.world[roles[f"{s}_ankle"]].copy() for s in SIDES}
    left = np.cross(up, forward)
    for side, sign in zip(SIDES, (1.0, -1.0), strict=True):
        hip, knee, ankle = (roles[f"{side}_{r}"] for r in ("hip", "knee", "ankle"))
        pose.aim(hip, knee, -up)
        pose.aim(knee, ankle, -up)
        pose.set_world(ankle, feet[side])
        shoulder, elbow = roles[f"{side}_shoulder"], roles[f"{side}_elbow"]
        pose.aim(shoulder, elbow, -np.cos(ARM_OUT) * up + sign * np.sin(ARM_OUT) * left)
        if f"{side}_wrist" in roles:
            upper = _unit(pose.points[elbow] - pose.points[shoulder])
            pose.aim(elbow, roles[f"{side}_wrist"], np.cos(ELBOW_BEND) * upper + np.sin(ELBOW_BEND) * forward)
    return pose.local


def _to_front(points: Array, roles: Roles, up: Array, forward: Array) -> Array:
    """Return the rotation that takes the body's own up and left to ``up`` and ``up x forward``."""
    own_up = body_up(points[None], roles)[0]
    tip = quaternion.between(own_up, up)
    across = quaternion.rotate(tip, _middle_side(points, roles))
    facing = np.cross(across, up)
    angle = np.arctan2(np.cross(facing, forward) @ up, facing @ forward)
    return quaternion.multiply(quaternion.exp(angle * up), tip)


class _Pose:
    """One pose whose joints can be turned in world axes; children follow."""

    def __init__(self, local: Array, offsets: Array, parents: np.ndarray) -> None:
        self.local, self.offsets, self.parents = local, offsets, parents
        self.update()

    def update(self) -> None:
        world, points = fk(self.local[None], self.offsets[None], self.parents)
        self.world, self.points = world[0], points[0]

    def set_world(self, joint: int, rotation: Array) -> None:
        parent = int(self.parents[joint])
        above = self.world[parent] if parent >= 0 else quaternion.IDENTITY
        self.local[joint] = quaternion.multiply(quaternion.conjugate(above), rotation)
        self.update()

    def turn_whole(self, joint: int, turn: Array) -> None:
        self.set_world(joint, quaternion.multiply(turn, self.world[joint]))

    def aim(self, joint: int, target: int, direction: Array) -> None:
        """Turn ``joint`` by the smallest rotation that brings ``target`` into ``direction`` from it."""
        here = self.points[target] - self.points[joint]
        self.turn_whole(joint, quaternion.between(here, direction))


def calm_pose(rotations: Array, world: Array, points: Array, roles: Roles, up: Array) -> Array:
    """Return the mean local rotations (J, 4) of the quarter of the frames that stand straightest."""
    trunk = _unit(_middle(points, roles, "shoulder") - _middle(points, roles, "hip"))
    score = trunk @ up
    for side in SIDES:
        hip, knee, ankle = (points[:, roles[f"{side}_{r}"]] for r in ("hip", "knee", "ankle"))
        shoulder, elbow = (points[:, roles[f"{side}_{r}"]] for r in ("shoulder", "elbow"))
        score = (
            score + _unit(hip - knee) @ up + _unit(knee - ankle) @ up + 0.5 * (_unit(shoulder - elbow) @ up)
        )
    count = max(1, len(points) // 4)
    best = np.sort(np.argsort(-score, kind="stable")[:count])
    facing = np.cross(_middle_side(points[best], roles), up)
    yaw = np.arctan2(np.cross(facing[:1], facing) @ up, facing @ facing[0])
    chosen = np.array(rotations[best])
    hips = roles["hips"]
    chosen[:, hips] = quaternion.multiply(quaternion.exp(-yaw[:, None] * up), world[best, hips])
    sign = np.where(np.einsum("fji,ji->fj", chosen, chosen[0]) < 0, -1.0, 1.0)
    return quaternion.normalise((chosen * sign[..., None]).sum(axis=0))


def _middle(points: Array, roles: Roles, role: str) -> Array:
    return 0.5 * (points[..., roles[f"left_{role}"], :] + points[..., roles[f"right_{role}"], :])


def _unit(v: Array) -> Array:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)
