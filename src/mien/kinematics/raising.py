"""Lift what has sunk into the floor: arms by themselves, anything else with the hips, feet from the knee."""

import numpy as np

from ..motion import Motion
from ..signal.bridging import envelope
from ..typing import Array
from .body import SIDES, Body
from .constraints import Constraint, InRegion, Point
from .contacts import Contacts
from .fk import world
from .gentle import gently
from .legs import Placed, over_feet

CALM = 0.08  # seconds over which turns are smoothed
AROUND = 0.2  # seconds before and after that a part is on its way up and down
EASE = {"shoulder": 1.0, "elbow": 0.6, "wrist": 0.3}


def lowest(motion: Motion, body: Body, positions: Array) -> Array:
    """Return the height (T,) of the lowest joint from the hips down that is not of the feet."""
    feet = set(_below(motion, body, "ankle"))
    others = [j for j in motion.skeleton.descendants(body.roles["hips"]) if j not in feet]
    return np.asarray((positions[:, others] @ body.up).min(axis=1))


def raised(motion: Motion, body: Body, contacts: Contacts, allowed: Array) -> Motion:
    """Return the motion with no joint but those of the feet more than ``allowed`` (T,) below the floor.

    Arms are lifted at shoulder, elbow and wrist; the rest with the hips, while the legs keep the feet where
    they are. ``contacts`` say when those stand.
    """
    motion = _hips_raised(motion, body, contacts, allowed)
    return _arms_raised(motion, body, allowed)


def _hips_raised(motion: Motion, body: Body, contacts: Contacts, allowed: Array) -> Motion:
    pose = Placed.of(motion, body)
    skeleton = motion.skeleton
    apart = {j for role in ("ankle", "shoulder") for j in _below(motion, body, role)}
    rest = [j for j in skeleton.descendants(body.roles["hips"]) if j not in apart]
    need = np.maximum(body.floor - allowed - (pose.positions[:, rest] @ body.up).min(axis=1), 0.0)
    if not need.any():
        return motion
    lift = envelope(need, reach=round(AROUND / motion.frame_time))
    return over_feet(pose, lift[:, None] * body.up, contacts.feet, body)


def _arms_raised(motion: Motion, body: Body, allowed: Array) -> Motion:
    ease = {
        body.roles[f"{side}_{role}"]: easy
        for side in SIDES
        for role, easy in EASE.items()
        if f"{side}_{role}" in body.roles
    }

    def ask(now: Motion) -> list[Constraint]:
        return _above_floor(now, body, allowed)

    return gently(motion, ask, size=body.leg_length, ease=ease, calm=CALM)


def _above_floor(motion: Motion, body: Body, allowed: Array) -> list[Constraint]:
    """Return what lifts the lowest joint of each forearm and hand where it is too low.

    Of several at once, each would turn the arm its own way.
    """
    places, out = world(motion)[1], []
    for side in SIDES:
        joints = motion.skeleton.descendants(body.roles[f"{side}_elbow"])
        height = places[:, joints] @ body.up
        low = height.min(axis=1) < body.floor - allowed - 1e-4 * body.leg_length
        lowest = height.argmin(axis=1)
        for place in np.unique(lowest[low]):
            # Where nothing is needed, any height will do.
            level = np.where(low & (lowest == place), body.floor - allowed, height.min() - body.leg_length)
            out.append(InRegion(Point(int(joints[place])), body.up, level))
    return list[Constraint](out)


def _below(motion: Motion, body: Body, role: str) -> list[int]:
    """Return the joints of both sides from a role on."""
    return [j for side in SIDES for j in motion.skeleton.descendants(body.roles[f"{side}_{role}"])]
