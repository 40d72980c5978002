"""Push arms out of the body, and the two apart, where they are inside each other."""

import numpy as np

from ..motion import Motion
from ..signal.bridging import smooth
from ..typing import Array, Mask
from .body import SIDES, Body
from .capsules import Capsules, capsules
from .constraints import AtDistance, Constraint, Point
from .fk import world
from .gentle import gently

CALM = 0.1  # seconds over which turns, and the places that touch, are smoothed
# How easily the joints of an arm turn to make room.
EASE = {"clavicle": 0.1, "shoulder": 1.0, "elbow": 0.6}
ARM = ("upper_arm", "forearm", "hand")


def separated(motion: Motion, body: Body, allowed: Array) -> Motion:
    """Return the motion with the arms no deeper than ``allowed`` inside other parts and each other.

    ``allowed`` (T, P), in the clip's unit, for the pairs of ``capsules``. Only shoulders and elbows are
    turned; legs are left alone. What cannot be reached is approached.
    """
    shape = capsules(motion, body)
    arms = np.array([[_is_arm(shape, pair, side) for pair in shape.pairs.tolist()] for side in SIDES])
    ease = {
        body.roles[f"{side}_{role}"]: easy
        for side in SIDES
        for role, easy in EASE.items()
        if f"{side}_{role}" in body.roles
    }
    most = 0.9 * shape.radii[shape.pairs].sum(axis=1)

    def ask(now: Motion) -> list[Constraint]:
        """Return the constraints that hold apart what is too deep in ``now``."""
        return _apart(now, shape, np.minimum(allowed, most), arms)

    return gently(motion, ask, size=body.leg_length, ease=ease, calm=CALM)


def _apart(motion: Motion, shape: Capsules, allowed: Array, arms: Mask) -> list[Constraint]:
    """Return what keeps apart the pairs that are too deep at some time."""
    rotations, positions = world(motion)
    contact = shape.contacts(rotations, positions)
    over = _worst(np.maximum(contact.depth - allowed, 0.0), arms)
    out: list[Constraint] = []
    for p in np.flatnonzero((over > 1e-3 * shape.radii.min()).any(axis=0)):
        a, b = shape.pairs[p]
        at = smooth(contact.at[:, p], sigma=CALM / motion.frame_time)
        points = []
        for rod, share in zip((a, b), at.T, strict=True):
            start, end = shape.ends[rod]
            points.append(Point(int(shape.joints[rod]), start + share[:, None] * (end - start)))
        may = contact.apart[:, p] + contact.depth[:, p] - allowed[:, p]  # the radii less what is allowed
        distance = np.where(over[:, p] > 0.0, may, 0.0)
        out.append(AtDistance(points[0], points[1], distance, how="least"))
    return out


def _worst(over: Array, arms: Mask) -> Array:
    """Return ``over`` (T, P) of the pair that is too deep by most of each arm's, and 0 of all others.

    Several at once pull an arm nearly the same way by different amounts, which turns it somewhere else.
    ``arms`` (2, P) says which pairs are of which arm.
    """
    keep = np.zeros(over.shape, bool)
    for mine in arms:
        of_arm = np.where(mine, over, 0.0)
        most = of_arm.max(axis=1, keepdims=True)
        keep |= (of_arm == most) & (most > 0.0)
    return np.where(keep, over, 0.0)


def _is_arm(shape: Capsules, pair: list[int], side: str) -> bool:
    return any(shape.names[rod] == f"{side}_{part}" for rod in pair for part in ARM)
