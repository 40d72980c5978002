"""What forces a motion would take: the ground's push, the zero-moment point, and torques of the joints.

Inverse dynamics with the mass model of ``mass.py``, as Xiao et al. (2005) used it to find unnatural edits:
the ground must bring up what accelerations and gravity ask for, ``F = M (c'' + g)``, and the joints the rest.
Everything is per kilogram of the body and in metres, so that neither its mass nor the clip's unit matters.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..typing import Array, Mask
from .body import SIDES, Body
from .mass import GRAVITY, MassModel, mass_model

# Gaussian of half amplitude at 6 Hz, the usual cut-off before captured positions are differentiated twice.
SMOOTHING = 0.0312  # seconds

# Strength: the largest torque in body weights times heights. Legs: Anderson, Madigan & Nussbaum (2007), young
# men, the stronger direction. Arms and trunk: athletes of Jackson (2010) and Kentel et al. (2011), taken for
# a man of 75 kg and 1.75 m; the neck: Jordan et al. (1999), 50 Nm.
STRENGTH: Mapping[str, float] = {
    "hip": 0.161,
    "knee": 0.163,
    "ankle": 0.095,
    "shoulder": 0.099,
    "elbow": 0.079,
    "wrist": 0.030,
    "chest": 0.530,
    "head": 0.039,
}
# What hangs below each joint, in segments of the mass model.
BELOW: Mapping[str, tuple[str, ...]] = {
    "shoulder": ("upper_arm", "forearm", "hand"),
    "elbow": ("forearm", "hand"),
    "wrist": ("hand",),
    "hip": ("thigh", "shank", "foot"),
    "knee": ("shank", "foot"),
    "ankle": ("foot",),
}
UPPER = ("head", "upper_trunk", "middle_trunk", *(f"{s}_{p}" for s in SIDES for p in BELOW["shoulder"]))


@dataclass(frozen=True, eq=False)
class Dynamics:
    """Forces over time, per kilogram: metres, metres a second squared, newton metres a kilogram.

    ``centre`` (T, 3) of mass; ``force`` (T, 3) that the ground must give, ``c'' + g up``; ``zero_moment``
    (T, 3) the point on the floor where it must act; ``joints`` (R) and their ``torques`` (T, R, 3).
    """

    centre: Array
    force: Array
    zero_moment: Array
    joints: tuple[str, ...]
    torques: Array

    def effort(self, height: float) -> Array:
        """Return each joint's torque (T, R) as a multiple of its strength; ``height`` in metres."""
        plain = [name.removeprefix("left_").removeprefix("right_") for name in self.joints]
        strength = np.array([STRENGTH[name] for name in plain]) * GRAVITY * height
        return np.linalg.norm(self.torques, axis=-1) / strength


def dynamics(
    motion: Motion, body: Body, rotations: Array, positions: Array, feet: Array, planted: Mask
) -> Dynamics:
    """Return the forces that ``motion`` takes.

    From its world ``rotations`` (T, J, 4) and ``positions`` (T, J, 3), the places of its ``feet`` (T, 2, 3)
    and which of them are ``planted`` (T, 2). The push of the ground acts at the zero-moment point; of two
    planted feet each takes the share that puts it there.
    """
    model, dt, scale = mass_model(motion, body), motion.frame_time, body.metres_per_unit
    sigma = SMOOTHING / dt
    places = smooth(model.centres(rotations, positions) * scale, sigma=sigma)
    push = _twice(places, dt) + GRAVITY * body.up
    loads = model.shares[:, None] * push
    spins = _spin_rates(model, rotations, dt, scale)
    centre = np.einsum("s,tsi->ti", model.shares, places)
    force = loads.sum(axis=1)
    moment = np.cross(places - centre[:, None], loads).sum(axis=1) + spins.sum(axis=1)
    floor = body.floor * scale
    zero_moment = _zero_moment(centre, force, moment, body.up, floor)
    names = tuple(n for n in _joint_names() if n in body.roles)
    pivots = smooth(positions[:, [_pivot(n, body) for n in names]] * scale, sigma=sigma)
    below = np.array([[s in _below(n) for s in model.names] for n in names], float)
    turning = np.cross(places, loads) + spins
    torques = np.einsum("rs,tsi->tri", below, turning)
    torques -= np.cross(pivots, np.einsum("rs,tsi->tri", below, loads))
    torques -= _ground(names, pivots, feet * scale, planted, force, zero_moment)
    return Dynamics(centre, force, zero_moment, names, torques)


def _joint_names() -> list[str]:
    return ["chest", "head", *(f"{side}_{role}" for side in SIDES for role in BELOW)]


def _pivot(name: str, body: Body) -> int:
    """Return the joint whose place the torque is taken about: of the trunk, its lowest."""
    return body.spine[0] if name == "chest" else body.roles[name]


def _below(name: str) -> tuple[str, ...]:
    if name == "chest":
        return UPPER
    if name == "head":
        return ("head",)
    side, role = name.split("_")
    return tuple(f"{side}_{part}" for part in BELOW[role])


def acceleration(places: Array, frame_time: float) -> Array:
    """Return the acceleration (T, ...) of places (T, ...), smoothed: what is faster than 6 Hz fades."""
    return _twice(smooth(places, sigma=SMOOTHING / frame_time), frame_time)


def _twice(places: Array, dt: float) -> Array:
    """Return the second derivative of places (T, ..., 3); at the ends that of the next frame."""
    out = np.zeros_like(places)
    if len(places) > 2:
        out[1:-1] = (places[2:] - 2.0 * places[1:-1] + places[:-2]) / dt**2
        out[0], out[-1] = out[1], out[-2]
    return out


def _spin_rates(model: MassModel, rotations: Array, dt: float, scale: float) -> Array:
    """Return the rate of change (T, S, 3) of each segment's own angular momentum."""
    turned = rotations[:, model.joints]
    if len(turned) < 3:
        return np.zeros((*turned.shape[:2], 3))
    steps = quaternion.log(quaternion.multiply(turned[1:], quaternion.conjugate(turned[:-1]))) / dt
    rate = np.concatenate([steps[:1], 0.5 * (steps[1:] + steps[:-1]), steps[-1:]])
    rate = smooth(rate, sigma=SMOOTHING / dt)
    axis = quaternion.rotate(turned, model.axes)
    along = np.einsum("tsi,tsi->ts", rate, axis)[..., None] * axis
    square = model.shares * scale**2 * np.stack([model.across, model.along]) ** 2
    return np.gradient(square[0][:, None] * (rate - along) + square[1][:, None] * along, dt, axis=0)


def _zero_moment(centre: Array, force: Array, moment: Array, up: Array, floor: float) -> Array:
    """Return the point (T, 3) of the floor about which the ground's push turns nothing over.

    ``z = c - h F / F_up - (up x moment) / F_up`` with ``h`` the height of the centre. Where next to nothing
    pushes it is nowhere: not a number.
    """
    lift = force @ up
    lift = np.where(lift > 0.1 * GRAVITY, lift, np.nan)[:, None]
    height = (centre @ up - floor)[:, None]
    return centre - height * force / lift + np.cross(up, moment) / lift


def _ground(
    names: tuple[str, ...],
    pivots: Array,
    feet: Array,
    planted: Mask,
    force: Array,
    zero_moment: Array,
) -> Array:
    """Return the torque (T, R, 3) of the ground's push on the feet about each joint of the legs."""
    across = feet[:, 1] - feet[:, 0]
    square = np.maximum(np.einsum("ti,ti->t", across, across), 1e-12)
    share = np.clip(np.einsum("ti,ti->t", zero_moment - feet[:, 0], across) / square, 0.0, 1.0)
    share = np.where(np.isfinite(share), share, 0.5)
    both, known = planted.all(axis=1), np.isfinite(zero_moment[:, 0])
    out = np.zeros((len(feet), len(names), 3))
    for foot, side in enumerate(SIDES):
        weight = np.where(both, share if foot else 1.0 - share, planted[:, foot])
        at = np.where((both | ~known)[:, None], feet[:, foot], zero_moment)
        for r, name in enumerate(names):
            if name in (f"{side}_hip", f"{side}_knee", f"{side}_ankle"):
                out[:, r] = weight[:, None] * np.cross(at - pivots[:, r], force)
    return out
