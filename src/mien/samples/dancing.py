"""A dance on the spot: the weight goes from side to side, the knees give on every beat, the arms swing wide.

The toes stay where they are and the free heel is lifted, so contacts are known exactly. All are sines of the
beat and their powers; the figure stands in its dance from the first frame to the last.
"""

from typing import Unpack

import numpy as np

from ..errors import MienError
from ..typing import Array
from .figure import HIP_HEIGHT, SIDES
from .pose import Arm, Pose, Turn, build, planted, standing
from .sample import Form, Sample, Truth, sample, times

DEGREE = np.pi / 180.0
HEEL = 26.0  # degrees that the free heel is lifted
BOUNCE, SHIFT = 0.028, 0.075  # metres that the hips go down on each beat, and to each side


def dance(*, seconds: float = 6.0, tempo: float = 108.0, **form: Unpack[Form]) -> Sample:
    """Dance on the spot at ``tempo`` beats a minute (60 to 180); a beat to the left, a beat to the right.

    The events ``beat`` are when the hips are lowest.
    """
    if not 60.0 <= tempo <= 180.0:
        raise MienError(f"dance: tempo must be 60 to 180 beats a minute, got {tempo:g}")
    t = times(seconds, form)
    beat = t * tempo / 60.0
    side, bounce = np.sin(np.pi * beat), np.cos(2.0 * np.pi * beat)
    rises = {name: -HEEL * DEGREE * np.maximum(-sign * side, 0.0) ** 3 for name, sign in SIDES.items()}
    place = {name: np.array([0.14 * sign, 0.0, 0.0]) for name, sign in SIDES.items()}
    down = HIP_HEIGHT - 0.045 - BOUNCE * 0.5 * (1.0 + bounce)
    pose = Pose(
        hips=np.stack([SHIFT * side, down, 0.012 * bounce], axis=-1),
        pelvis=Turn(-12.0 * DEGREE * side, 4.0 * DEGREE, -5.0 * DEGREE * side),
        thorax=Turn(14.0 * DEGREE * side, (3.0 + 2.0 * bounce) * DEGREE, 5.0 * DEGREE * side),
        head=Turn(6.0 * DEGREE * side, (3.0 + 5.0 * bounce) * DEGREE, -3.0 * DEGREE * side),
        arms={name: _arm(beat, sign) for name, sign in SIDES.items()},
        feet={name: planted(place[name], 12.0 * DEGREE * sign, rises[name]) for name, sign in SIDES.items()},
    )
    figure, angles = build(pose)
    contacts = np.stack([standing(rises[name]) for name in SIDES], axis=1)
    beats = np.arange(0, int(beat[-1]) + 1) * 60.0 / tempo
    facts = {"tempo": tempo / 60.0}
    truth = Truth(
        contacts, angles, phases=0.5 * beat % 1.0, events={"beat": tuple(beats.tolist())}, facts=facts
    )
    return sample("dance", figure, truth, **form)


def _arm(beat: Array, sign: float) -> Arm:
    """Return an arm that swings up on its own side's beat and is bent before the body on the other's."""
    own = sign * np.sin(np.pi * beat)
    late = sign * np.sin(np.pi * (beat - 0.12))  # the forearm follows the upper arm
    return Arm(
        flexion=(30.0 + 14.0 * own) * DEGREE,
        abduction=(38.0 + 26.0 * own) * DEGREE,
        rotation=(-4.0 + 12.0 * own) * DEGREE,
        elbow=(78.0 - 26.0 * late) * DEGREE,
        pronation=30.0 * DEGREE,
        wrist=(4.0 - 14.0 * late) * DEGREE,
        shrug=2.0 * DEGREE,
    )
