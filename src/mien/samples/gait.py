"""Walking: feet that stay where they stand, a pelvis carried over them, arms against the legs.

The feet follow from footprints (``strides``). Pelvis, trunk and arms follow low-order Fourier curves
through the peaks of normal gait; hips and knees follow from closed-form two-bone geometry. Peaks and
timing: Murray, Drought & Kory (1964), *Walking patterns of normal men*, JBJS 46A; Murray, Sepic &
Barnard (1967), *Patterns of sagittal rotation of the upper limbs in walking*, Physical Therapy 47;
Winter, *Biomechanics and Motor Control of Human Movement*; Perry & Burnfield, *Gait Analysis*. The
tired walk: Michalak et al. (2009), *Embodiment of sadness and depression*, Psychosomatic Medicine 71:
slow, small arm swing and bob, more sway, slumped.
"""

from dataclasses import replace
from typing import Unpack

import numpy as np

from ..errors import MienError
from ..rotations import quaternion
from ..typing import Array
from .curves import cycle
from .figure import SHANK, SIDES, STANCE, THIGH
from .pose import Arm, Pose, Turn, build, trunk
from .sample import Form, Sample, Truth, sample, times
from .strides import DEGREE, Gait, contacts, foot, way

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
    push_pitch=34.0,
    toe_peak=0.028,
    clearance=0.010,
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


def turn(*, seconds: float = 4.0, rate: float = 0.125 * np.pi, **form: Unpack[Form]) -> Sample:
    """Walk along an arc that turns to the left by ``rate`` radians a second (-1 to 1)."""
    if not -1.0 <= rate <= 1.0:
        raise MienError(f"turn: rate must be -1 to 1 radians a second, got {rate:g}")
    gait = _paced(NORMAL, 1.7, 0.6)
    return _walk("turn", replace(gait, curvature=rate / (gait.cadence * gait.step_length)), seconds, form)


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
    t = times(seconds, form)
    phase = 0.5 * gait.cadence * t
    figure, angles = build(_posed(gait, phase))
    truth = Truth(
        contacts=np.stack([contacts(gait, phase, side) for side in SIDES], axis=1),
        angles=angles,
        phases=phase % 1.0,
        events=_events(gait, seconds),
        facts={"cadence": gait.cadence, "heading_rate": gait.curvature * gait.cadence * gait.step_length},
        lengths={"step_length": gait.step_length, "speed": gait.cadence * gait.step_length},
    )
    return sample(name, figure, truth, **form)


def _events(gait: Gait, seconds: float) -> dict[str, tuple[float, ...]]:
    """Return the times of heel strikes and toe-offs of each foot within the clip."""
    stride = 2.0 / gait.cadence
    found = {}
    for side, late in (("left", 0.5), ("right", 0.0)):
        for event, share in (("heel_strike", 0.0), ("toe_off", gait.toe_off)):
            every = (np.arange(-1, int(seconds / stride) + 2) + late + share) * stride
            found[f"{side}_{event}"] = tuple(every[(every >= 0.0) & (every <= seconds)].tolist())
    return found


def _posed(gait: Gait, phase: Array) -> Pose:
    pose = replace(_upper_body(gait, phase), feet={side: foot(gait, phase, side) for side in SIDES})
    return replace(pose, hips=pose.hips + [0.0, _height(gait), 0.0])


def _carried(gait: Gait, phase: Array) -> Array:
    """Return the hips' way (T, 3), height about its mean."""
    sway = -gait.sway * np.cos(2.0 * np.pi * (phase - 0.30))
    surge = 0.008 * np.sin(4.0 * np.pi * (phase - 0.03))
    place, _ = way(gait, 2.0 * gait.step_length * phase + surge, sway)
    place[:, 1] = -gait.bob * np.cos(4.0 * np.pi * (phase + 0.005))
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
        gap = foot(gait, phase, side).ankle - hip
        room = min(room, float(np.min(gap[:, 1] + np.sqrt(reach**2 - gap[:, 0] ** 2 - gap[:, 2] ** 2))))
    return room


def _upper_body(gait: Gait, phase: Array) -> Pose:
    """Return the pose without feet, the hips at height 0."""
    d = DEGREE
    _, heading = way(gait, 2.0 * gait.step_length * phase, 0.0)
    nod = np.cos(4.0 * np.pi * (phase - 0.05))
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
