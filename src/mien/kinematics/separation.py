"""Push arms out of the body, and the two apart, where they are inside each other."""

import numpy as np

from ..motion import Motion
from ..signal.bridging import envelope, smooth
from ..typing import Array
from .body import SIDES, Body
from .capsules import Capsules, capsules
from .constraints import AtDistance, Constraint, Point
from .fk import world
from .smoothing import calm_change
from .solver import solve

ROUNDS = 6
AROUND = 0.3  # seconds before and after that an arm is on its way out and back
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
    arms = np.array([any(part in shape.names[a] for part in ARM) for a, _ in shape.pairs.tolist()])
    ease = {
        body.roles[f"{side}_{role}"]: easy
        for side in SIDES
        for role, easy in EASE.items()
        if f"{side}_{role}" in body.roles
    }
    turned, sigma = list(ease), CALM / motion.frame_time
    reach, out = shape.radii[shape.pairs].sum(axis=1), motion
    for _ in range(ROUNDS):
        constraints = _apart(out, shape, np.minimum(allowed, 0.9 * reach), arms)
        if not constraints:
            break
        found = solve(out, constraints, size=body.leg_length, ease=ease).motion
        rotations = np.array(motion.rotations)
        rotations[:, turned] = calm_change(rotations[:, turned], found.rotations[:, turned], sigma=sigma)
        out = motion.with_(rotations=rotations)
    return out


def _apart(motion: Motion, shape: Capsules, allowed: Array, arms: Array) -> list[Constraint]:
    """Return what keeps apart the pairs that are too deep at some time."""
    rotations, positions = world(motion)
    contact = shape.contacts(rotations, positions)
    over = np.where(arms, np.maximum(contact.depth - allowed, 0.0), 0.0)
    out: list[Constraint] = []
    for p in np.flatnonzero((over > 1e-3 * shape.radii.min()).any(axis=0)):
        a, b = shape.pairs[p]
        at = smooth(contact.at[:, p], sigma=CALM / motion.frame_time)
        points = []
        for rod, share in zip((a, b), at.T, strict=True):
            start, end = shape.ends[rod]
            points.append(Point(int(shape.joints[rod]), start + share[:, None] * (end - start)))
        need = envelope(over[:, p], reach=round(AROUND / motion.frame_time))
        # Where nothing is needed, any distance is enough.
        distance = np.where(need > 0.0, contact.apart[:, p] + need, 0.0)
        out.append(AtDistance(points[0], points[1], distance, how="least"))
    return out
