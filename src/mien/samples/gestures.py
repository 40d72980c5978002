"""Standing, and what one does standing: knock, wave, punch. The feet stay where they are.

Every move of an arm runs from rest to rest with least jerk (Flash & Hogan 1985, *The coordination of
arm movements*, J. Neurosci. 5), so the pauses between moves are true pauses of the joint angles. Quiet
standing sways by a few millimetres below 0.5 Hz (Winter 1995, *Human balance and posture control*,
Gait & Posture 3) and breathes 15 times a minute; all of it sines, nothing random.
"""

from collections.abc import Sequence
from typing import Unpack

import numpy as np

from ..errors import MienError
from ..typing import Array, Mask
from .curves import keyed
from .figure import HIP_HEIGHT, SIDES
from .pose import Arm, Foot, Pose, Turn, build, planted, standing
from .sample import Form, Sample, Truth, sample, times

DEGREE = np.pi / 180.0
REST = Arm(
    flexion=-2.0 * DEGREE,
    abduction=8.0 * DEGREE,
    rotation=-12.0 * DEGREE,
    elbow=14.0 * DEGREE,
    pronation=15.0 * DEGREE,
    wrist=6.0 * DEGREE,
)
STRIKE, HOLD = 0.4, 0.3  # seconds of a knock: there and back, then rest


def still(*, seconds: float = 4.0, sway: float = 1.0, **form: Unpack[Form]) -> Sample:
    """Stand quietly; ``sway`` scales sway and breathing (0: a statue)."""
    t = times(seconds, form)
    pose, contacts = _stance(t, sway)
    figure, angles = build(pose)
    return sample("still", figure, Truth(contacts, angles), **form)


def knock(*, seconds: float = 4.4, strokes: int = 3, sway: float = 1.0, **form: Unpack[Form]) -> Sample:
    """Raise the right hand and knock: each stroke moves 0.4 s (there and back) and rests 0.3 s.

    The events ``stroke`` and ``rest`` are when each move begins and ends.
    """
    t = times(seconds, form)
    starts = [1.3 + (STRIKE + HOLD) * i for i in range(_count("knock", "strokes", strokes))]
    raised = [(0.3, 0.0), (1.0, 1.0), (starts[-1] + STRIKE + HOLD, 1.0), (starts[-1] + 1.4, 0.0)]
    up, hit = keyed(t, raised), _pulses(t, starts, 0.5 * STRIKE, 0.0, 0.5 * STRIKE)
    right = Arm(
        flexion=_blend(up, -2.0, 36.0) + 10.0 * DEGREE * hit,
        abduction=_blend(up, 8.0, 10.0),
        rotation=_blend(up, -12.0, 8.0),
        elbow=_blend(up, 14.0, 116.0) - 34.0 * DEGREE * hit,
        pronation=_blend(up, 15.0, 40.0),
        wrist=_blend(up, 6.0, -14.0) + 20.0 * DEGREE * hit,
        reach=_blend(up, 0.0, 5.0),
    )
    lean, look = 2.0 * DEGREE * up, 4.0 * DEGREE * up
    pose, contacts = _stance(
        t, sway, right=right, thorax=Turn(-3.0 * DEGREE * up, lean), head=Turn(0.0, look)
    )
    figure, angles = build(pose)
    events = {"stroke": tuple(starts), "rest": tuple(s + STRIKE for s in starts)}
    return sample("knock", figure, Truth(contacts, angles, events=events), **form)


def wave(
    *, seconds: float = 4.0, waves: int = 4, rate: float = 1.6, sway: float = 1.0, **form: Unpack[Form]
) -> Sample:
    """Raise the right hand and wave it ``waves`` times, ``rate`` a second (0.5 to 3)."""
    if not 0.5 <= rate <= 3.0:
        raise MienError(f"wave: rate must be 0.5 to 3 waves a second, got {rate:g}")
    t = times(seconds, form)
    start, length = 0.9, _count("wave", "waves", waves) / rate
    up = keyed(t, [(0.2, 0.0), (1.0, 1.0), (start + length, 1.0), (start + length + 0.8, 0.0)])
    ease = 0.3 / rate
    shown = keyed(t, [(start, 0.0), (start + ease, 1.0), (start + length - ease, 1.0), (start + length, 0.0)])
    swing = shown * np.sin(2.0 * np.pi * rate * (t - start))
    right = Arm(
        flexion=_blend(up, -2.0, 12.0),
        abduction=_blend(up, 8.0, 70.0) + 3.0 * DEGREE * swing,
        rotation=_blend(up, -12.0, 80.0),
        elbow=_blend(up, 14.0, 116.0) + 23.0 * DEGREE * swing,
        pronation=_blend(up, 15.0, 60.0),
        wrist=_blend(up, 6.0, 0.0),
        shrug=_blend(up, 0.0, 8.0),
    )
    tip = -2.0 * DEGREE * up
    pose, contacts = _stance(
        t, sway, right=right, thorax=Turn(0.0, 0.0, tip), head=Turn(0.0, 0.0, -2.0 * tip)
    )
    figure, angles = build(pose)
    events = {"wave": tuple(start + i / rate for i in range(waves)), "end": (start + length,)}
    return sample("wave", figure, Truth(contacts, angles, events=events, facts={"rate": rate}), **form)


def punch(*, seconds: float = 2.4, punches: int = 2, sway: float = 1.0, **form: Unpack[Form]) -> Sample:
    """From a guard, strike straight ahead with the right fist: 0.22 s out, 0.05 s there, 0.4 s back."""
    t = times(seconds, form)
    starts = [0.4 + 1.0 * i for i in range(_count("punch", "punches", punches))]
    # The hips lead and the elbow follows: the blow travels from the ground up.
    hip, chest, hit = (
        _pulses(t, [s + late for s in starts], 0.22, 0.05, 0.4) for late in (-0.06, -0.03, 0.0)
    )
    rise, flat = -_blend(hip, 12.0, 38.0), np.zeros_like(t)
    hips = np.stack([0.02 * hip, HIP_HEIGHT - 0.075 - 0.015 * hip, 0.09 * hip - 0.01], axis=-1)
    pose = Pose(
        hips=hips + _sway(t, sway)[0],
        pelvis=Turn(_blend(hip, -30.0, 14.0), 6.0 * DEGREE),
        thorax=Turn(_blend(chest, -38.0, 32.0), _blend(chest, 9.0, 13.0)),
        head=Turn(_blend(chest, -6.0, 6.0), 9.0 * DEGREE),
        arms=_boxing(hit),
        feet={
            "left": planted(np.array([0.10, 0.0, 0.20]), -8.0 * DEGREE, flat),
            "right": planted(np.array([-0.13, 0.0, -0.24]), -38.0 * DEGREE, rise),
        },
    )
    figure, angles = build(pose)
    contacts = np.stack([standing(flat), standing(rise)], axis=1)
    events = {"strike": tuple(starts), "hit": tuple(s + 0.22 for s in starts)}
    return sample("punch", figure, Truth(contacts, angles, events=events), **form)


def _boxing(hit: Array) -> dict[str, Arm]:
    """Return the arms from the guard (0) to the right arm at full stretch (1)."""
    right = Arm(
        flexion=_blend(hit, 38.0, 95.0),
        abduction=_blend(hit, 12.0, 30.0),
        rotation=_blend(hit, -18.0, -40.0),
        elbow=_blend(hit, 132.0, 10.0),
        pronation=_blend(hit, 20.0, 80.0),
        reach=_blend(hit, 2.0, 14.0),
    )
    left = Arm(
        flexion=_blend(hit, 58.0, 48.0),
        abduction=12.0 * DEGREE,
        rotation=-22.0 * DEGREE,
        elbow=_blend(hit, 108.0, 124.0),
        pronation=30.0 * DEGREE,
        reach=6.0 * DEGREE,
    )
    return {"left": left, "right": right}


def _count(owner: str, name: str, value: int) -> int:
    if not 1 <= value <= 100:
        raise MienError(f"{owner}: {name} must be 1 to 100, got {value}")
    return value


def _blend(share: Array, before: float, after: float) -> Array:
    """Return angles in radians that go from ``before`` to ``after`` degrees with ``share``."""
    return (before + (after - before) * share) * DEGREE


def _pulses(t: Array, starts: Sequence[float], out: float, there: float, back: float) -> Array:
    """Return 0 at rest and 1 at full stretch, for moves out and back that begin at ``starts``."""
    keys: list[tuple[float, float]] = []
    for s in starts:
        keys += [(s, 0.0), (s + out, 1.0), (s + out + there, 1.0), (s + out + there + back, 0.0)]
    return keyed(t, keys)


def statue(t: Array) -> tuple[Pose, Mask]:
    """Return the quiet stance without any sway, and its contacts."""
    return _stance(t, 0.0)


def _stance(
    t: Array, sway: float, *, right: Arm = REST, thorax: Turn | None = None, head: Turn | None = None
) -> tuple[Pose, Mask]:
    """Return a quiet upright stance with one arm and the upper trunk given, and its contacts."""
    moved, breath = _sway(t, sway)
    flat = np.zeros_like(t)
    feet: dict[str, Foot] = {
        side: planted(np.array([0.105 * sign, 0.0, 0.0]), 9.0 * DEGREE * sign, flat)
        for side, sign in SIDES.items()
    }
    up, top = thorax or Turn(), head or Turn()
    pose = Pose(
        hips=moved + np.array([0.0, HIP_HEIGHT - 0.004, 0.018]),
        pelvis=Turn(0.0, 2.0 * DEGREE),
        thorax=Turn(up.yaw, up.lean - 1.0 * DEGREE - breath, up.tip),
        head=Turn(top.yaw, top.lean + 1.0 * DEGREE, top.tip),
        arms={"left": REST, "right": right},
        feet=feet,
    )
    return pose, np.stack([standing(flat)] * 2, axis=1)


def _sway(t: Array, size: float) -> tuple[Array, Array]:
    """Return how far the hips sway (T, 3) in metres, and how the chest rises with the breath (T,)."""
    turn = 2.0 * np.pi * t
    aside = 0.006 * np.sin(0.19 * turn + 0.4) + 0.002 * np.sin(0.43 * turn + 2.0)
    ahead = 0.005 * np.sin(0.23 * turn + 1.1) + 0.002 * np.sin(0.47 * turn)
    breath = 0.9 * DEGREE * np.sin(0.25 * turn)
    return size * np.stack([aside, np.zeros_like(t), ahead], axis=-1), size * breath
