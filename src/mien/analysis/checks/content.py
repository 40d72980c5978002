"""Whether it is still the same action.

How differently joints are turned, on average, in degrees. Beside it how far hands, feet and head are from
where they were, as seen from the hips, and whether the feet come down in the same order. An emotion changes
how something is done, but three in four readings of one action by one actor (78 of 15 styles, Bandai Namco's
data) differ by less than 75 degrees even in the joint that differs most.
"""

import numpy as np

from ...kinematics.contacts import Contacts, detect_points
from ...rotations import quaternion
from .check import Check, Measured
from .scene import Scene


def measure(scene: Scene) -> Measured:
    """Return how differently each joint is turned than in the source (T, R), in degrees."""
    roles = {name: joint for name, joint in scene.body.roles.items() if name != "hips"}
    source = scene.source
    if source is None:
        return Measured(np.zeros((len(scene.motion), len(roles))), tuple(roles))
    joints = list(roles.values())
    turn = quaternion.multiply(
        quaternion.conjugate(source.motion.rotations[:, joints]), scene.motion.rotations[:, joints]
    )
    angle = np.degrees(2.0 * np.arccos(np.minimum(np.abs(turn[..., 3]), 1.0)))
    own = detect_points(scene.feet, scene.body, scene.motion.frame_time)
    facts = {
        "ends of limbs elsewhere, mean cm": _ends_moved(scene, source),
        "steps out of order": float(order_changes(source.contacts, own)),
    }
    return Measured(angle, tuple(roles), facts)


def _ends_moved(scene: Scene, source: Scene) -> float:
    here, there = (s.tips[1] - s.tips[1][:, :1] for s in (scene, source))
    return float(np.linalg.norm(here - there, axis=-1)[:, 1:].mean()) * scene.centimetres


def order_changes(one: Contacts, other: Contacts) -> int:
    """Return how many steps must be put in or left out to make one order of footfalls the other."""
    first, second = (_footfalls(c) for c in (one, other))
    row = list(range(len(second) + 1))
    for i, foot in enumerate(first, start=1):
        before, row = row, [i]
        for j, step in enumerate(second, start=1):
            row.append(min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (foot != step) * 2))
    return row[-1]


def _footfalls(contacts: Contacts) -> str:
    starts = sorted((start, "LR"[foot]) for foot in range(2) for start, _ in contacts.spans(foot))
    return "".join(foot for _, foot in starts)


CHECK = Check(
    "content",
    "joints turned away from the source",
    "degrees",
    1,
    limit=0.0,
    tolerance=75.0,
    factor=0.0,
    overall=True,
    needs_source=True,
    measure=measure,
)
