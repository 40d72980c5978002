"""Lengths and heights of a body: leg, height, floor, unit."""

from collections.abc import Mapping

import numpy as np

from ..errors import BodyError
from ..motion import Motion, Skeleton
from ..rotations import quaternion
from ..typing import Array, Integers
from .fk import fk
from .tree import Tree

Roles = Mapping[str, int]
SIDES = ("left", "right")

HUMAN_LEG = 0.87  # metres from hip over knee to ankle: 0.49 of a height of 1.77 (Winter 2009)
UNITS = (1.0, 0.3048, 0.1, 0.0254 / 0.45, 0.0254, 0.01, 0.001)  # m, foot, dm, CMU's, inch, cm, mm
_FRAMES = 400  # evenly spaced frames that the floor is read from


def leg_length(body: Tree, roles: Roles) -> float:
    """Return hip to knee to ankle: the median over frames, mean of the two sides.

    Raises ``BodyError`` where a thigh or shank has no length.
    """
    bones = [(f"{s}_{a}", f"{s}_{b}") for s in SIDES for a, b in (("hip", "knee"), ("knee", "ankle"))]
    lengths = [body.distance(roles[a], roles[b]) for a, b in bones]
    if min(lengths) <= 1e-6 * max(lengths):
        a, b = bones[int(np.argmin(lengths))]
        raise BodyError(
            f"{a} ({body.names[roles[a]]!r}) and {b} ({body.names[roles[b]]!r}) are at one place: a leg with "
            "no length; name the right joints in a map file"
        )
    return 0.5 * sum(lengths)


def metres_per_unit(leg: float) -> float:
    """Estimate the length unit in metres from a leg length: a usual unit if the leg is then human.

    Human is 0.6 to 1.1 m; else the unit that makes the leg 0.87 m.
    """
    usual = [u for u in UNITS if 0.6 <= u * leg <= 1.1]
    return min(usual, key=lambda u: abs(np.log(u * leg / HUMAN_LEG)), default=HUMAN_LEG / leg)


def soles(skeleton: Skeleton, heights: Array, roles: Roles, leg: float) -> float:
    """Return how far the ankles stand above the sole in the neutral stance, given its heights (J + E,).

    The lowest joint or tip of the feet is the sole; where a foot has none the human 0.08 leg
    lengths are taken, and never more than twice that (feet that hang down in the rest pose).
    """
    ankles = [roles[f"{side}_ankle"] for side in SIDES]
    depth = float(heights[ankles].mean() - heights[_below(skeleton, ankles)].min())
    return min(depth, 0.16 * leg) if depth > 0.02 * leg else 0.08 * leg


def height(skeleton: Skeleton, heights: Array, roles: Roles, leg: float, sole: float) -> float:
    """Return sole to top of the head in the neutral stance, given its heights (J + E,).

    Where the head has no tip well above its joint, the human 0.2 leg lengths are added.
    """
    ground = float(heights[[roles[f"{side}_ankle"] for side in SIDES]].mean()) - sole
    if "head" not in roles:
        return float(heights.max()) - ground
    joint, top = heights[roles["head"]], heights[_below(skeleton, [roles["head"]])].max()
    return float(top if top > joint + 0.1 * leg else joint + 0.2 * leg) - ground


def floor(motion: Motion, roles: Roles, up: Array, sole: float) -> float:
    """Return the height of the ground along ``up``: the 5th percentile of the lowest foot point.

    Foot points are the joints and tips of the feet and the heels, taken ``sole`` below the ankles.
    """
    pick = evenly(len(motion), _FRAMES)
    skeleton, ankles = motion.skeleton, [roles[f"{side}_ankle"] for side in SIDES]
    joints = sorted({*_above(skeleton, ankles), *(j for a in ankles for j in skeleton.descendants(a))})
    place = {j: i for i, j in enumerate(joints)}  # only the legs are put through forward kinematics
    parents = np.array([place.get(int(skeleton.parents[j]), -1) for j in joints])
    world, points = fk(motion.rotations[pick][:, joints], motion.translations[pick][:, joints], parents)
    tips = [e for e, p in enumerate(skeleton.end_parents.tolist()) if p in place]
    at = [place[int(skeleton.end_parents[e])] for e in tips]
    ends = points[:, at] + quaternion.rotate(world[:, at], skeleton.end_offsets[tips])
    feet = [place[j] for a in ankles for j in skeleton.descendants(a)]
    low = np.concatenate([points[:, feet], ends], axis=1) @ up
    heels = points[:, [place[a] for a in ankles]] @ up - sole
    return float(np.percentile(np.minimum(low.min(axis=1), heels.min(axis=1)), 5.0))


def evenly(frames: int, count: int) -> Integers:
    """Return the indices of at most ``count`` evenly spaced frames, with the first and the last."""
    return np.unique(np.linspace(0, frames - 1, min(frames, count)).round().astype(np.int64))


def _above(skeleton: Skeleton, joints: list[int]) -> set[int]:
    line: set[int] = set()
    for joint in joints:
        while joint >= 0:
            line.add(joint)
            joint = int(skeleton.parents[joint])
    return line


def _below(skeleton: Skeleton, joints: list[int]) -> list[int]:
    """Return the joints at and below some joints, and their end sites numbered after all joints."""
    below = {j for joint in joints for j in skeleton.descendants(joint)}
    tips = (len(skeleton) + e for e, p in enumerate(skeleton.end_parents.tolist()) if p in below)
    return [*sorted(below), *tips]
