"""The feet of a walk: footprints along the way, and how each foot rolls over them and swings between.

Heel strike, rolling over the heel to flat, heel rise rolling over the toe joint, toe-off, swing. What
touches the floor does not move. The numbers were fitted once so that the angles of knee, hip and ankle
follow the normal curves named in ``gait``.
"""

from dataclasses import dataclass

import numpy as np

from ..rotations import quaternion
from ..typing import Array, Integers, Mask
from .curves import keyed, quintic
from .figure import ANKLE, SIDES, TOE
from .pose import Foot, about, rolled, turned

DEGREE = np.pi / 180.0


@dataclass(frozen=True)
class Gait:
    """A style of walking. Lengths in metres, angles in degrees, times as shares of the stride."""

    cadence: float = 1.8  # steps a second
    step_length: float = 0.7
    step_width: float = 0.09
    curvature: float = 0.0  # 1 / metres, to the left
    toe_out: float = 6.0
    foot_flat: float = 0.09
    heel_off: float = 0.33
    toe_off: float = 0.59
    strike_pitch: float = 16.4
    push_pitch: float = 59.5
    toe_peak: float = 0.052
    clearance: float = 0.014
    straightest_knee: float = 4.6
    bob: float = 0.014
    sway: float = 0.020
    pelvis_yaw: float = 5.0
    pelvis_list: float = 4.0
    pelvis_tilt: float = 3.0
    lean: float = 4.0
    thorax_yaw: float = 4.5
    head_lean: float = 1.0
    shoulder_mean: float = -3.0
    shoulder_swing: float = 17.0
    elbow_mean: float = 20.0
    elbow_swing: float = 11.0
    shrug: float = 0.0
    slump: float = 0.0


def way(gait: Gait, distance: Array, aside: Array | float) -> tuple[Array, Array]:
    """Return the place (N, 3) and heading (N,) at a distance along the arc, ``aside`` metres to its left."""
    turn = gait.curvature * distance
    half = 0.5 * turn
    chord = distance * np.sinc(half / np.pi)
    place = np.stack([chord * np.sin(half), np.zeros_like(turn), chord * np.cos(half)], axis=-1)
    left = np.stack([np.cos(turn), np.zeros_like(turn), -np.sin(turn)], axis=-1)
    return place + np.asarray(aside)[..., None] * left, turn


def stride(phase: Array, side: str) -> tuple[Array, Integers]:
    """Return how far a foot is in its stride (heel strike 0), and which stride it is."""
    own = phase + (0.5 if side == "left" else 0.0)
    # A frame that should fall on a heel strike must not slip to the stride before by rounding.
    count = np.floor(own + 1e-9)
    return np.maximum(own - count, 0.0), count.astype(np.int64)


def contacts(gait: Gait, phase: Array, side: str) -> Mask:
    """Return which of heel and toe stand on the floor (T, 2)."""
    u, _ = stride(phase, side)
    # A frame that falls on an event belongs to the contact, whatever the rounding.
    early, late = u - 1e-9, u + 1e-9
    heel, toe = early <= gait.heel_off, (late >= gait.foot_flat) & (early <= gait.toe_off)
    return np.stack([heel, toe], axis=-1)


def foot(gait: Gait, phase: Array, side: str) -> Foot:
    """Return one foot of a walk; ``phase`` (T,) in strides."""
    u, count = stride(phase, side)
    pitch = _pitch(gait, u)
    here, facing = _footprint(gait, count, side)
    there, facing_next = _footprint(gait, count + 1, side)
    share = np.clip((u - gait.toe_off) / (1.0 - gait.toe_off), 0.0, 1.0)
    swing = share > 0.0
    yaw = facing + (facing_next - facing) * share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
    toe = here + _rotate(facing, rolled(TOE, pitch))
    flown = _swing(gait, share, here + _rotate(facing, TOE), there, facing_next)
    toe = np.where(swing[:, None], flown, toe)
    rotation = turned(yaw, -pitch, 0.0)
    toes = turned(yaw, _toe_pitch(gait, u), 0.0)
    return Foot(toe + quaternion.rotate(rotation, ANKLE - TOE), rotation, toes)


def _footprint(gait: Gait, count: Integers, side: str) -> tuple[Array, Array]:
    """Return where the flat foot of stride ``count`` stands (floor under the ankle) and its heading."""
    sign = SIDES[side]
    # The hips pass over the ankle 22% of a stride after heel strike.
    lead = 0.22 * 2.0 * gait.step_length
    strides = count - (0.5 if side == "left" else 0.0)
    place, heading = way(gait, 2.0 * gait.step_length * strides + lead, 0.5 * sign * gait.step_width)
    return place, heading + sign * gait.toe_out * DEGREE


def _pitch(gait: Gait, u: Array) -> Array:
    """Return the pitch of the sole (T,) in radians, toes up positive, through the stride."""
    strike, push = gait.strike_pitch, gait.push_pitch
    slope = -1.57 * strike / gait.foot_flat
    keys = [
        (0.0, strike, slope),
        (gait.foot_flat, 0.0),
        (gait.heel_off, 0.0),
        (gait.toe_off - 0.088, -0.31 * push, -4.1 * push),
        (gait.toe_off, -push, -11.1 * push),
        (gait.toe_off + 0.06, -1.14 * push),
        (0.93, 1.47 * strike, 0.0, -280.0 * strike),
        (1.0, strike, slope),
    ]
    return keyed(u, keys) * DEGREE


def _toe_pitch(gait: Gait, u: Array) -> Array:
    """Return how far the toes point down (T,): flat on the floor to toe-off, then as the foot."""
    pitch = _pitch(gait, u)
    planted = (u >= gait.foot_flat) & (u <= gait.toe_off)
    share = np.clip((u - gait.toe_off) / (0.95 - gait.toe_off), 0.0, 1.0)
    return np.where(planted, 0.0, -pitch * share**3 * (10.0 - 15.0 * share + 6.0 * share**2))


def _swing(gait: Gait, share: Array, start: Array, there: Array, facing: Array) -> Array:
    """Return the toe joint's flight (T, 3) from rest at toe-off to where it is at the next heel strike.

    Along the way it gathers speed at once; in height it has the two humps of Winter's toe trajectory
    (1992, *Foot trajectory in human gait*, Physical Therapy 72) with the clearance between them.
    """
    landing, speed, rush = _landing(gait)
    stop = there + _rotate(facing, landing)
    way = stop - start
    zero = np.zeros_like(start)
    begin = np.stack([start, zero, 9.0 * way], axis=-1)
    end = np.stack([stop, _rotate(facing, speed), 8.0 * way], axis=-1)
    flown = quintic(share[:, None], begin, end) - 0.206 * 64.0 * (share * (1.0 - share))[:, None] ** 3 * way
    peak, low = gait.toe_peak, gait.clearance
    fall = peak - low
    keys = [
        (0.0, 0.0, 0.0, 207.0 * peak),
        (0.194, peak, 0.0, -43.0 * fall),
        (0.475, low, 0.0, 82.0 * fall),
        (1.0, landing[1] - TOE[1], speed[1], rush[1] + 5.7),
    ]
    flown[:, 1] = TOE[1] + keyed(share, keys)
    return flown


def _landing(gait: Gait) -> Array:
    """Return place, speed and acceleration (3, 3) of the toe joint at heel strike, per share of swing."""
    step = 1e-4
    place = rolled(TOE, _pitch(gait, np.array([0.0, step, 2.0 * step])))
    length = 1.0 - gait.toe_off
    speed = (-3.0 * place[0] + 4.0 * place[1] - place[2]) / (2.0 * step) * length
    rush = (place[0] - 2.0 * place[1] + place[2]) / step**2 * length**2
    return np.stack([place[0], speed, rush])


def _rotate(yaw: Array, v: Array) -> Array:
    return quaternion.rotate(about(1, yaw), v)
