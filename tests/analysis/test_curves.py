"""Curves over time: a body that is carried along tells its own speed, and hands that hang do not move."""

import numpy as np
import pytest

from mien import samples
from mien.analysis.curves import CURVES, curve
from mien.errors import MienError
from mien.kinematics.body import Body
from mien.kinematics.fk import fk
from mien.motion import Motion

UNITS = {"m": 1.0, "cm": 100.0, "inch": 1 / 0.0254}


def carried(unit: str, *, speed: float, up: str = "y") -> Motion:
    """Return a body that stands and is carried along at a speed in metres a second."""
    still = samples.still(seconds=2.0, unit=unit, up=up).motion
    pose = np.repeat(still.rotations[:1], len(still), axis=0)
    moved = np.repeat(still.translations[:1], len(still), axis=0)
    moved[:, 0, 0] += speed * UNITS[unit] * still.times
    return still.with_(rotations=pose, translations=moved)


@pytest.mark.parametrize("unit", UNITS)
def test_speeds_of_a_body_that_is_carried(unit: str) -> None:
    motion = carried(unit, speed=1.3)
    for name in ("hips speed", "foot speed", "joint:Head"):
        kind, values = curve(motion, name)
        assert kind == "m/s"
        assert values == pytest.approx(1.3, rel=0.02), name
    assert curve(motion, "hand speed")[1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("up", ["y", "z"])
def test_height_of_the_hips_is_theirs_above_the_floor(up: str) -> None:
    motion = samples.walk(seconds=2.0, unit="cm", up=up).motion
    body = Body.of(motion)
    axis = {"y": 1, "z": 2}[up]
    at = fk(motion.rotations, motion.translations, motion.skeleton.parents)[1][:, body.roles["hips"], axis]
    unit, values = curve(motion, "hips height")
    assert unit == "cm"
    assert values == pytest.approx((at - body.floor) * 100 * body.metres_per_unit, rel=1e-9)


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("frames", [1, 2, 3])
def test_short_clips(name: str, frames: int) -> None:
    unit, values = curve(samples.walk(seconds=1.0).motion[:frames], name)
    assert values.shape == (frames,)
    assert np.isfinite(values).all()
    assert unit in ("cm", "m/s")


def test_names_that_are_not_known() -> None:
    motion = samples.still(seconds=0.5).motion
    with pytest.raises(MienError, match="hips height"):
        curve(motion, "hip height")
    with pytest.raises(MienError, match="Head"):
        curve(motion, "joint:Haed")
