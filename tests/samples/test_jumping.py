from collections.abc import Callable

import numpy as np
import pytest

from mien.errors import MienError
from mien.samples import Sample, jump

Places = Callable[[Sample], dict[str, np.ndarray]]


@pytest.mark.parametrize("fps", [30.0, 60.0, 120.0])
@pytest.mark.parametrize("height", [0.1, 0.28, 0.5])
def test_the_flight_falls_as_things_fall(fps: float, height: float, places: Places) -> None:
    sample = jump(fps=fps, height=height, unit="m", skeleton="engine23", up="z")
    hips, times = places(sample)["hips"], sample.motion.times
    take_off, landing = sample.facts["take_off"], sample.facts["landing"]
    air = (times >= take_off) & (times <= landing)
    flight = hips[air]
    fall = np.diff(flight, 2, axis=0) * fps**2
    np.testing.assert_allclose(fall, np.broadcast_to([0.0, 0.0, -9.81], fall.shape), atol=1e-6)
    # Rise h takes sqrt(2 h / g), and so does the fall.
    assert landing - take_off == pytest.approx(2.0 * np.sqrt(2.0 * height / 9.81))


def test_the_hips_rise_by_the_height_asked_for(places: Places) -> None:
    sample = jump(height=0.3, fps=1000.0, unit="cm")
    hips = places(sample)["hips"][:, 1]
    assert sample.facts["jump_height"] == pytest.approx(30.0)
    assert sample.facts["gravity"] == pytest.approx(981.0)
    assert hips.max() - hips[round(1000 * sample.facts["take_off"])] == pytest.approx(30.0, abs=1e-3)


def test_the_ground_joins_the_flight_in_speed_and_acceleration(places: Places) -> None:
    sample = jump(fps=4000.0, unit="m", seconds=2.6)
    hips = places(sample)["hips"]
    for event in ("take_off", "landing"):
        frame = round(4000 * sample.facts[event])
        bend = np.diff(hips[frame - 12 : frame + 12, 1], 2) * 4000.0**2
        np.testing.assert_allclose(bend, -9.81, atol=3.0)  # jerk of some hundred m/s^3 over 3 ms


def test_in_the_air_both_feet_are_off_and_together(places: Places) -> None:
    sample = jump(fps=240.0, unit="m")
    times, at = sample.motion.times, places(sample)
    air = (times > sample.facts["take_off"]) & (times < sample.facts["landing"])
    assert (sample.contacts.any(axis=(1, 2)) == ~air).all()
    np.testing.assert_allclose(at["left_toe"] * [-1, 1, 1], at["right_toe"], atol=1e-12)
    assert at["left_toe"][air, 1].max() > 0.2
    for still in (slice(0, 80), slice(-40, None)):
        assert sample.contacts[still].all()


@pytest.mark.parametrize("height", np.linspace(0.1, 0.5, 9))
def test_the_legs_reach_at_every_height(height: float) -> None:
    assert np.degrees(jump(height=height, fps=480.0, seconds=3.0).angles["left_knee"].min()) > 5.0


@pytest.mark.parametrize("height", [0.0, 1.0, float("nan")])
def test_a_height_no_one_jumps_is_refused(height: float) -> None:
    with pytest.raises(MienError, match="height must be"):
        jump(height=height)
