"""Lengths and heights of a body: leg, height, floor, unit."""

from collections.abc import Mapping

import numpy as np

from ..motion import Motion, Skeleton
from ..rotations import quaternion
from ..typing import Array
from .fk import end_positions, fk, world

Roles = Mapping[str, int]
SIDES = ("left", "right")

HUMAN_LEG = 0.87  # metres from hip over knee to ankle: 0.49 of a height of 1.77 (Winter 2009)
UNITS = (1.0, 0.3048, 0.1, 0.0254 / 0.45, 0.0254, 0.01, 0.001)  # m, foot, dm, CMU's, inch, cm, mm
_FRAMES = 500


def leg_length(points: Array, roles: Roles) -> float:
    """Return hip to knee to ankle: the median over frames of ``points`` (F, J, 3), mean of the sides."""
    total = 0.0
    for side in SIDES:
        hip, knee, ankle = (points[:, roles[f"{side}_{r}"]] for r in ("hip", "knee", "ankle"))
        bones = np.linalg.norm(hip - knee, axis=-1) + np.linalg.norm(knee - ankle, axis=-1)
        total += 0.5 * float(np.median(bones))
    return total


def metres_per_unit(leg: float) -> float:
    """Estimate the length unit in metres from a leg length: a usual unit if the leg is then human.

    Human is 0.65 to 1.1 m; else the unit that makes the leg 0.87 m.
    """
    usual = [u for u in UNITS if 0.65 <= u * leg <= 1.1]
    return min(usual, key=lambda u: abs(np.log(u * leg / HUMAN_LEG)), default=HUMAN_LEG / leg)


def soles(skeleton: Skeleton, neutral: Array, offsets: Array, roles: Roles, up: Array, leg: float) -> float:
    """Return how far the ankles stand above the sole in the neutral stance.

    The lowest joint or tip of the feet is the sole; where a foot has none the human 0.08 leg
    lengths are taken, and never more than twice that (feet that hang down in the rest pose).
    """
    heights, ankles, feet = _heights(skeleton, neutral, offsets, roles, up)
    depth = float(np.mean(heights[ankles]) - heights[feet].min())
    return min(depth, 0.16 * leg) if depth > 0.02 * leg else 0.08 * leg


def height(
    skeleton: Skeleton, neutral: Array, offsets: Array, roles: Roles, up: Array, leg: float, sole: float
) -> float:
    """Return sole to top of the head in the neutral stance.

    Where the head has no tip well above its joint, the human 0.2 leg lengths are added.
    """
    heights, ankles, _ = _heights(skeleton, neutral, offsets, roles, up)
    ground = float(np.mean(heights[ankles])) - sole
    if "head" not in roles:
        return float(heights.max()) - ground
    joint = heights[roles["head"]]
    tips = [*skeleton.descendants(roles["head"]), *_ends_below(skeleton, roles["head"])]
    top = float(heights[tips].max())
    return (top if top > joint + 0.1 * leg else joint + 0.2 * leg) - ground


def _heights(
    skeleton: Skeleton, neutral: Array, offsets: Array, roles: Roles, up: Array
) -> tuple[Array, list[int], list[int]]:
    """Return the heights of all joints and end sites in the neutral stance, the ankles, all foot points."""
    turned, points = fk(neutral[None], offsets[None], skeleton.parents)
    ends = points[0, skeleton.end_parents] + quaternion.rotate(
        turned[0, skeleton.end_parents], skeleton.end_offsets
    )
    ankles = [roles[f"{side}_ankle"] for side in SIDES]
    feet = [n for a in ankles for n in (*skeleton.descendants(a), *_ends_below(skeleton, a))]
    return np.concatenate([points[0], ends]) @ up, ankles, feet


def _ends_below(skeleton: Skeleton, joint: int) -> list[int]:
    """Return the nodes (joints first, then end sites) that are end sites below a joint."""
    below = set(skeleton.descendants(joint))
    return [len(skeleton) + e for e, p in enumerate(skeleton.end_parents.tolist()) if p in below]


def floor(motion: Motion, roles: Roles, up: Array, sole: float) -> float:
    """Return the height of the ground along ``up``: the 5th percentile of the lowest foot point.

    Foot points are the joints and tips of the feet and the heels, taken ``sole`` below the ankles.
    """
    pick = np.unique(np.linspace(0, len(motion) - 1, min(len(motion), _FRAMES)).round().astype(int))
    sample = motion.with_(rotations=motion.rotations[pick], translations=motion.translations[pick])
    rotations, points = world(sample)
    skeleton = motion.skeleton
    nodes = np.concatenate([points, end_positions(sample, rotations, points)], axis=1) @ up
    ankles = [roles[f"{side}_ankle"] for side in SIDES]
    feet = [n for a in ankles for n in (*skeleton.descendants(a), *_ends_below(skeleton, a))]
    lowest = np.minimum(nodes[:, feet].min(axis=1), nodes[:, ankles].min(axis=1) - sole)
    return float(np.percentile(lowest, 5.0))
