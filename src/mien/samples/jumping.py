"""A jump on the spot, with a flight that falls exactly as things fall.

From take-off to landing the hips follow ``y = y0 + v t - g t^2 / 2`` with g = 9.81 m/s^2. On the ground
they follow curves that join the flight in place, speed and acceleration: dip, push-off, and landing
with bent knees (phases and joint ranges: Linthorne 2001, *Analysis of standing vertical jumps using a
force platform*, Am. J. Phys. 69). In the air the feet trail, as the ankles and knees stretch on.
"""

from typing import Unpack

import numpy as np

from ..errors import MienError
from ..typing import Array
from .curves import keyed
from .figure import HIP_HEIGHT, SIDES
from .pose import Arm, Foot, Pose, Turn, build, planted, turned
from .sample import Form, Sample, Truth, sample, times

DEGREE = np.pi / 180.0
GRAVITY = 9.81
DIP, PUSH, LAND, SETTLE = (
    0.4,
    0.9,
    0.28,
    0.85,
)  # when the dip starts, when the feet leave; lengths after landing


def jump(*, seconds: float = 2.6, height: float = 0.28, **form: Unpack[Form]) -> Sample:
    """Jump straight up so that the hips rise by ``height`` metres (0.1 to 0.5) in the air.

    Facts: ``take_off`` and ``landing`` in seconds, ``jump_height`` and ``gravity`` in the clip's unit.
    """
    if not 0.1 <= height <= 0.5:
        raise MienError(f"jump: height must be 0.1 to 0.5 metres, got {height:g}")
    t = times(seconds, form)
    speed = np.sqrt(2.0 * GRAVITY * height)
    landing = PUSH + 2.0 * speed / GRAVITY
    pose = _pose(t, speed, landing)
    figure, angles = build(pose)
    air = (t > PUSH) & (t < landing)
    heel = _pitch(t, landing) >= 0.0
    contacts = np.repeat(np.stack([heel & ~air, ~air], axis=-1)[:, None], 2, axis=1)
    truth = Truth(
        contacts,
        angles,
        events={"take_off": (PUSH,), "landing": (landing,)},
        facts={"take_off": PUSH, "landing": landing},
        lengths={"jump_height": height, "gravity": GRAVITY},
    )
    return sample("jump", figure, truth, **form)


def _pitch(t: Array, landing: float) -> Array:
    """Return the pitch of both soles (T,): flat, rolling over the toes at push-off, toes first at landing."""
    keys = [
        (PUSH - 0.19, 0.0),
        (PUSH, -36.0, -420.0),
        (PUSH + 0.09, -58.0),
        (landing - 0.12, -52.0),
        (landing, -34.0, 340.0),
        (landing + 0.11, 0.0),
    ]
    return keyed(t, keys) * DEGREE


def _height(t: Array, speed: float, landing: float) -> Array:
    """Return the height of the hips (T,): down, up, the flight, down, up."""
    rest, left = HIP_HEIGHT - 0.004, HIP_HEIGHT + 0.035
    ground = keyed(
        t,
        [
            (DIP, rest),
            (PUSH - 0.26, HIP_HEIGHT - 0.27, 0.0, 14.0),
            (PUSH, left, speed, -GRAVITY),
            (landing, left, -speed, -GRAVITY),
            (landing + LAND, HIP_HEIGHT - 0.24, 0.0, 9.0),
            (landing + SETTLE, rest),
        ],
    )
    since = t - PUSH
    flight = left + speed * since - 0.5 * GRAVITY * since * since
    return np.where((t > PUSH) & (t < landing), flight, ground)


def _feet(t: Array, speed: float, landing: float) -> dict[str, Foot]:
    pitch, rise = _pitch(t, landing), _rise(t, speed, landing)
    air = (t > PUSH) & (t < landing)
    feet = {}
    for side, sign in SIDES.items():
        place, yaw = np.array([0.105 * sign, 0.0, 0.0]), 7.0 * DEGREE * sign
        foot = planted(place, yaw, pitch)
        lifted = foot.ankle + np.stack([np.zeros_like(t), rise, np.zeros_like(t)], axis=-1)
        # Off the floor the toes fall in line with the foot, and spread again before they meet it.
        line = keyed(t, [(PUSH, 0.0), (PUSH + 0.12, 1.0), (landing - 0.12, 1.0), (landing, 0.0)])
        toes = turned(np.full_like(t, yaw), -line * pitch, 0.0)
        feet[side] = Foot(np.where(air[:, None], lifted, foot.ankle), foot.rotation, toes)
    return feet


def _rise(t: Array, speed: float, landing: float) -> Array:
    """Return the height of the toe joints off the floor (T,): the hips' rise less what the legs stretch.

    The stretch begins as fast as the hips leave, so that the toes part from the floor at rest.
    """
    stretch = keyed(
        t,
        [
            (PUSH, 0.0, speed, -10.0 * speed * speed),
            (PUSH + 0.12 / speed, 0.04),
            (landing - 0.1 / speed, 0.025),
            (landing, 0.0, -0.6 * speed),
        ],
    )
    since = t - PUSH
    return speed * since - 0.5 * GRAVITY * since * since - stretch


def _pose(t: Array, speed: float, landing: float) -> Pose:
    d, low, down, end = DEGREE, PUSH - 0.24, landing + LAND, landing + SETTLE
    lean = keyed(
        t, [(DIP, 0.0), (low, 42.0), (PUSH + 0.04, 2.0), (landing - 0.05, 6.0), (down, 36.0), (end, 0.0)]
    )
    ahead = keyed(t, [(DIP, 0.018), (low, -0.10), (PUSH, 0.05), (landing, 0.05), (down, -0.07), (end, 0.018)])
    reach = keyed(
        t,
        [
            (DIP, -2.0),
            (low - 0.04, -48.0),
            (PUSH + 0.08, 128.0),
            (landing, 92.0),
            (down + 0.1, 24.0),
            (end, -2.0),
        ],
    )
    bend = keyed(t, [(DIP, 14.0), (low, 24.0), (PUSH, 22.0), (landing, 34.0), (down, 48.0), (end, 14.0)])
    tilt = 0.55 * lean + 2.0
    arm = Arm(
        flexion=reach * d,
        abduction=10.0 * d,
        rotation=-8.0 * d,
        elbow=bend * d,
        pronation=15.0 * d,
        wrist=6.0 * d,
    )
    return Pose(
        hips=np.stack([np.zeros_like(t), _height(t, speed, landing), ahead], axis=-1),
        pelvis=Turn(0.0, tilt * d),
        thorax=Turn(0.0, (lean - 1.0) * d),
        head=Turn(0.0, (0.25 * lean + 1.0) * d),
        arms={"left": arm, "right": arm},
        feet=_feet(t, speed, landing),
    )
