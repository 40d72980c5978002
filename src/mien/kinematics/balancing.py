"""Move the pelvis so that a body does not fall over, its feet where they are."""

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..typing import Array
from .body import SIDES, Body
from .contacts import Contacts
from .dynamics import dynamics
from .fk import world
from .heading import heading_rotation
from .legs import Placed, over_feet
from .mass import mass_model
from .support import way_in

CALM = 0.3  # seconds: a pelvis that is moved faster pushes the zero-moment point out again
MOST = 0.12  # leg lengths
ROUNDS = 3


def balanced(motion: Motion, body: Body, contacts: Contacts, allowed: Array) -> Motion:
    """Return the motion with its pelvis moved so that the zero-moment point comes nearer to the support.

    ``allowed`` (T,), in the clip's unit, may it be outside; ``contacts`` say where feet stand. What moves is
    all that hangs on the hips but the legs, slowly, by at most 0.12 leg lengths.
    """
    shift, out = np.zeros((len(motion), 3)), motion
    start = Placed.of(motion, body)
    for _ in range(ROUNDS):
        way = _too_far(Placed.of(out, body), body, contacts, allowed)
        if not way.any():
            break
        shift = shift + smooth(way, sigma=CALM / motion.frame_time)
        length = np.linalg.norm(shift, axis=1, keepdims=True)
        shift *= np.minimum(1.0, MOST * body.leg_length / np.maximum(length, 1e-12))
        out = over_feet(start, shift, contacts.feet, body)
    return out


def weight_ahead(motion: Motion, body: Body) -> float:
    """Return how far the centre of mass is usually ahead of the middle of the ankles, in leg lengths."""
    rotations, positions = world(motion)
    centre = mass_model(motion, body).centre_of_mass(rotations, positions)
    ankles = positions[:, [body.roles[f"{side}_ankle"] for side in SIDES]].mean(axis=1)
    ahead = quaternion.rotate(heading_rotation(positions, body), body.forward)
    return float(np.einsum("ti,ti->t", centre - ankles, ahead).mean() / body.leg_length)


def astray(pose: Placed, body: Body, contacts: Contacts) -> Array:
    """Return the way over the ground (T, 3) from the zero-moment point to the support; 0 inside."""
    middle = pose.feet.mean(axis=2)
    forces = dynamics(pose.motion, body, pose.rotations, pose.positions, middle, contacts.feet)
    return way_in(forces.zero_moment / body.metres_per_unit, pose.feet, contacts.points, body)


def _too_far(pose: Placed, body: Body, contacts: Contacts, allowed: Array) -> Array:
    """Return the way (T, 3) from the zero-moment point to where it may be."""
    way = astray(pose, body, contacts)
    length = np.linalg.norm(way, axis=1)
    return np.asarray(way * (np.maximum(length - allowed, 0.0) / np.maximum(length, 1e-12))[:, None])
