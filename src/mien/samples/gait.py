"""Walking: feet that stay where they stand, a pelvis carried over them, arms against the legs.

The feet follow from footprints: heel strike, rolling over the heel to flat, heel rise rolling over the
toe joint, toe-off, swing. Pelvis, trunk and arms follow low-order Fourier curves through the peaks of
normal gait; hips and knees follow from closed-form two-bone geometry. Peaks and timing: Murray, Drought
& Kory (1964), *Walking patterns of normal men*, JBJS 46A; Murray, Sepic & Barnard (1967), *Patterns of
sagittal rotation of the upper limbs in walking*, Physical Therapy 47; Winter, *Biomechanics and Motor
Control of Human Movement*; Perry & Burnfield, *Gait Analysis*. The tired walk: Michalak et al. (2009),
*Embodiment of sadness and depression*, Psychosomatic Medicine 71: slow, small arm swing and bob, more
sway, slumped.
"""

from dataclasses import dataclass, replace
from typing import Unpack

import numpy as np

from ..errors import MienError
from ..rotations import quaternion
from ..typing import Array, Integers
from .curves import cycle, keyed, quintic
from .figure import ANKLE, SHANK, SIDES, STANCE, THIGH, TOE
from .pose import Arm, Foot, Pose, Turn, about, build, rolled, trunk, turned
from .sample import Form, Sample, Truth, sample, times

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
    heel_off: float = 0.30
    toe_off: float = 0.59
    strike_pitch: float = 16.5
    push_pitch: float = 58.0
    toe_peak: float = 0.051
    clearance: float = 0.016
    straightest_knee: float = 3.5
    bob: float = 0.0145
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


NORMAL = Gait()
TIRED = Gait(
    cadence=1.35,
    step_length=0.48,
    step_width=0.12,
    toe_out=9.0,
    foot_flat=0.07,
    heel_off=0.38,
    toe_off=0.64,
    strike_pitch=7.0,
    push_pitch=42.0,
    toe_peak=0.035,
    clearance=0.012,
    straightest_knee=14.0,
    bob=0.010,
    sway=0.030,
    pelvis_yaw=3.0,
    pelvis_list=3.0,
    pelvis_tilt=6.0,
    lean=19.0,
    thorax_yaw=2.0,
    head_lean=36.0,
    shoulder_mean=10.0,
    shoulder_swing=6.0,
    elbow_mean=13.0,
    elbow_swing=3.0,
    shrug=-5.0,
    slump=10.0,
)


def walk(
    *, seconds: float = 4.0, cadence: float = 1.8, step_length: float = 0.7, **form: Unpack[Form]
) -> Sample:
    """Walk straight at ``cadence`` (0.5 to 3 steps a second), ``step_length`` (0.2 to 0.9 metres)."""
    return _walk("walk", _paced(NORMAL, cadence, step_length), seconds, form)


def tired_walk(
    *, seconds: float = 5.0, cadence: float = 1.35, step_length: float = 0.48, **form: Unpack[Form]
) -> Sample:
    """Walk slowly, stooped, head down, arms hanging; parameters as in ``walk``."""
    return _walk("tired_walk", _paced(TIRED, cadence, step_length), seconds, form)


def turn(*, seconds: float = 4.0, angle: float = 0.5 * np.pi, **form: Unpack[Form]) -> Sample:
    """Walk along an arc that turns by ``angle`` radians to the left (-3.5 to 3.5) within ``seconds``."""
    gait = _paced(NORMAL, 1.7, 0.6)
    way = gait.cadence * gait.step_length * max(seconds, 1e-9)
    return _walk("turn", replace(gait, curvature=angle / way if seconds else 0.0), seconds, form)


def _paced(gait: Gait, cadence: float, step_length: float) -> Gait:
    """Return the gait at another pace: what belongs to longer steps grows in proportion."""
    ratio = step_length / gait.step_length
    return replace(
        gait,
        cadence=cadence,
        step_length=step_length,
        strike_pitch=gait.strike_pitch * ratio,
        push_pitch=gait.push_pitch * min(ratio, 1.2),
        bob=gait.bob * ratio,
        pelvis_yaw=gait.pelvis_yaw * ratio,
        shoulder_swing=gait.shoulder_swing * ratio,
    )


def _walk(name: str, gait: Gait, seconds: float, form: Form) -> Sample:
    if not (0.5 <= gait.cadence <= 3.0 and 0.2 <= gait.step_length <= 0.9):
        raise MienError(
            f"{name}: cadence must be 0.5 to 3 steps a second and step length 0.2 to 0.9 metres, "
            f"got {gait.cadence:g} and {gait.step_length:g}"
        )
    if abs(gait.curvature) > 1.0:
        raise MienError(f"{name}: the arc is tighter than a radius of 1 metre; give it more seconds")
    t = times(seconds, form)
    phase = 0.5 * gait.cadence * t
    figure, angles = build(_posed(gait, phase))
    truth = Truth(
        contacts=np.stack([_contacts(gait, phase, side) for side in SIDES], axis=1),
        angles=angles,
        phases=phase % 1.0,
        events=_events(gait, seconds),
        facts={"cadence": gait.cadence, "heading_rate": gait.curvature * gait.cadence * gait.step_length},
        lengths={"step_length": gait.step_length, "speed": gait.cadence * gait.step_length},
    )
    return sample(name, figure, truth, **form)


def _contacts(gait: Gait, phase: Array, side: str) -> Array:
    u, _ = _stride(phase, side)
    return np.stack([u <= gait.heel_off, (u >= gait.foot_flat) & (u <= gait.toe_off)], axis=-1)


def _events(gait: Gait, seconds: float) -> dict[str, tuple[float, ...]]:
    """Return the times of heel strikes and toe-offs of each foot within the clip."""
    stride = 2.0 / gait.cadence
    found = {}
    for side, late in (("left", 0.5), ("right", 0.0)):
        for event, share in (("heel_strike", 0.0), ("toe_off", gait.toe_off)):
            every = (np.arange(-1, int(seconds / stride) + 2) + late + share) * stride
            found[f"{side}_{event}"] = tuple(every[(every >= 0.0) & (every <= seconds)].tolist())
    return found


def _stride(phase: Array, side: str) -> tuple[Array, Integers]:
    """Return how far a foot is in its stride (heel strike 0), and which stride it is."""
    own = phase + (0.5 if side == "left" else 0.0)
    # A frame that should fall on a heel strike must not slip to the stride before by rounding.
    count = np.floor(own + 1e-9)
    return np.maximum(own - count, 0.0), count.astype(np.int64)


def _posed(gait: Gait, phase: Array) -> Pose:
    pose = replace(_upper_body(gait, phase), feet={side: _foot(gait, phase, side) for side in SIDES})
    return replace(pose, hips=pose.hips + [0.0, _height(gait), 0.0])


# --- the way


def _way(gait: Gait, distance: Array, aside: Array | float = 0.0) -> tuple[Array, Array]:
    """Return the place (N, 3) and heading (N,) at a distance along the arc, ``aside`` metres to its left."""
    turn = gait.curvature * distance
    half = 0.5 * turn
    chord = distance * np.sinc(half / np.pi)
    place = np.stack([chord * np.sin(half), np.zeros_like(turn), chord * np.cos(half)], axis=-1)
    left = np.stack([np.cos(turn), np.zeros_like(turn), -np.sin(turn)], axis=-1)
    return place + np.asarray(aside)[..., None] * left, turn


# --- the feet


def _foot(gait: Gait, phase: Array, side: str) -> Foot:
    u, count = _stride(phase, side)
    pitch = _pitch(gait, u)
    here, facing = _footprint(gait, count, side)
    there, facing_next = _footprint(gait, count + 1, side)
    share = np.clip((u - gait.toe_off) / (1.0 - gait.toe_off), 0.0, 1.0)
    swing = share > 0.0
    yaw = facing + (facing_next - facing) * share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
    toe = here + _rotate(facing, rolled(TOE, pitch))
    flown = _swing(gait, share, here + _rotate(facing, TOE), there, facing_next)
    toe = np.where(swing[:, None], flown, toe)
    rotation = turned(yaw, -pitch)
    toes = turned(yaw, _toe_pitch(gait, u))
    return Foot(toe + quaternion.rotate(rotation, ANKLE - TOE), rotation, toes)


def _footprint(gait: Gait, count: Integers, side: str) -> tuple[Array, Array]:
    """Return where the flat foot of stride ``count`` stands (floor under the ankle) and its heading."""
    sign = SIDES[side]
    lead = (
        0.225 * 2.0 * gait.step_length
    )  # the hips pass over the ankle so much of a stride after heel strike
    strides = count - (0.5 if side == "left" else 0.0)
    place, heading = _way(gait, 2.0 * gait.step_length * strides + lead, 0.5 * sign * gait.step_width)
    return place, heading + sign * gait.toe_out * DEGREE


def _pitch(gait: Gait, u: Array) -> Array:
    """Return the pitch of the sole (T,) in radians, toes up positive, through the stride."""
    strike, push = gait.strike_pitch, gait.push_pitch
    slope = -1.6 * strike / gait.foot_flat
    keys = [
        (0.0, strike, slope),
        (gait.foot_flat, 0.0),
        (gait.heel_off, 0.0),
        (gait.toe_off - 0.088, -0.31 * push, -4.1 * push),
        (gait.toe_off, -push, -10.4 * push),
        (gait.toe_off + 0.06, -1.16 * push, 0.0, 8.0 * push),
        (0.93, 1.3 * strike, 0.0, -280.0 * strike),
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
    begin = np.stack([start, zero, 10.0 * way], axis=-1)
    end = np.stack([stop, _rotate(facing, speed), 8.2 * way], axis=-1)
    flown = quintic(share[:, None], begin, end) - 0.239 * 64.0 * (share * (1.0 - share))[:, None] ** 3 * way
    peak, low = gait.toe_peak, gait.clearance
    bend = 48.0 * (peak - low)
    keys = [
        (0.0, 0.0, 0.0, 240.0 * peak),
        (0.22, peak, 0.0, -bend),
        (0.49, low, 0.0, bend),
        (1.0, landing[1] - TOE[1], speed[1], rush[1] + 5.0),
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


# --- the body above them


def _carried(gait: Gait, phase: Array) -> Array:
    """Return the hips' way (T, 3), height about its mean."""
    sway = -gait.sway * np.cos(2.0 * np.pi * (phase - 0.30))
    surge = 0.008 * np.sin(4.0 * np.pi * (phase - 0.03))
    place, _ = _way(gait, 2.0 * gait.step_length * phase + surge, sway)
    place[:, 1] = -gait.bob * np.cos(4.0 * np.pi * (phase + 0.003))
    return place


def _height(gait: Gait) -> float:
    """Return the mean height of the hips: as high as the straightest knee of the stride allows."""
    phase = np.linspace(0.0, 1.0, 400, endpoint=False)
    pose = _upper_body(gait, phase)
    pelvis = trunk(pose)["hips"]
    knee = np.pi - gait.straightest_knee * DEGREE
    reach = np.sqrt(THIGH**2 + SHANK**2 - 2.0 * THIGH * SHANK * np.cos(knee))
    room = np.inf
    for side in SIDES:
        hip = pose.hips + quaternion.rotate(pelvis, STANCE[f"{side}_hip"] - STANCE["hips"])
        gap = _foot(gait, phase, side).ankle - hip
        room = min(room, float(np.min(gap[:, 1] + np.sqrt(reach**2 - gap[:, 0] ** 2 - gap[:, 2] ** 2))))
    return room


def _upper_body(gait: Gait, phase: Array) -> Pose:
    """Return the pose without feet, the hips at height 0."""
    d = DEGREE
    _, heading = _way(gait, 2.0 * gait.step_length * phase)
    nod = cycle(phase, 0.0, (0.0, 0.0), (1.0, 0.05))
    yaw = cycle(phase, 0.0, (-gait.thorax_yaw * d, 0.02))
    return Pose(
        hips=_carried(gait, phase),
        pelvis=Turn(
            heading + cycle(phase, 0.0, (gait.pelvis_yaw * d, 0.0)),
            (gait.pelvis_tilt + nod) * d,
            cycle(phase, 0.0, (-gait.pelvis_list * d, 0.17)),
        ),
        thorax=Turn(heading + yaw, (gait.lean + nod) * d, cycle(phase, 0.0, (1.5 * d, 0.2))),
        head=Turn(heading + 0.15 * yaw, (gait.head_lean - 0.6 * nod) * d),
        arms={side: _swinging(gait, phase + (0.5 if side == "left" else 0.0)) for side in SIDES},
        feet={},
    )


def _swinging(gait: Gait, own: Array) -> Arm:
    """Return an arm that swings against the leg of its side; ``own`` is that leg's phase."""
    d = DEGREE
    return Arm(
        flexion=cycle(own, gait.shoulder_mean, (gait.shoulder_swing, 0.52), (1.0, 0.1)) * d,
        abduction=7.0 * d,
        rotation=-12.0 * d,
        elbow=cycle(own, gait.elbow_mean, (gait.elbow_swing, 0.57), (2.0, 0.05)) * d,
        pronation=15.0 * d,
        wrist=6.0 * d,
        shrug=gait.shrug * d,
        reach=(gait.slump + 2.0 * np.cos(2.0 * np.pi * (own - 0.52))) * d,
    )
