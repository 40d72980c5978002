from collections.abc import Callable

import numpy as np
import pytest

from mien.errors import MienError
from mien.samples import Sample, dance

Places = Callable[[Sample], dict[str, np.ndarray]]


@pytest.mark.parametrize("tempo", [80.0, 120.0])
def test_the_hips_are_lowest_on_the_beat(places: Places, tempo: float) -> None:
    sample = dance(tempo=tempo, fps=240.0, unit="m")
    height, times = places(sample)["hips"][:, 1], sample.motion.times
    lows = 1 + np.flatnonzero((height[1:-1] < height[:-2]) & (height[1:-1] <= height[2:]))
    assert times[lows] == pytest.approx(sample.events["beat"][1 : len(lows) + 1], abs=0.005)
    assert np.diff(sample.events["beat"]) == pytest.approx(60.0 / tempo)


def test_toes_stay_and_the_free_heel_is_lifted(places: Places) -> None:
    sample = dance(fps=120.0, unit="m")
    at = places(sample)
    for foot, side in enumerate(("left", "right")):
        toe, ankle = at[f"{side}_toe"], at[f"{side}_ankle"]
        assert np.ptp(toe[~sample.contacts[:, foot, 0]], axis=0).max() < 0.03, "it rolls, it does not slide"
        free = ~sample.contacts[:, foot, 0]
        sign = 1.0 if side == "left" else -1.0
        assert (sign * at["hips"][free, 0] < 1e-9).all(), "the weight is on the other foot"
        assert ankle[free, 1].max() > ankle[~free, 1].max() + 0.03
        assert sample.contacts[:, foot, 1].all()


def test_it_is_the_same_on_both_sides_a_beat_later(places: Places) -> None:
    sample = dance(tempo=120.0, fps=60.0, unit="m")
    at = places(sample)
    later = 30  # frames of a beat
    mirror = np.array([-1.0, 1.0, 1.0])
    np.testing.assert_allclose(at["left_wrist"][:-later] * mirror, at["right_wrist"][later:], atol=1e-9)


@pytest.mark.parametrize("tempo", [0.0, 300.0])
def test_a_tempo_that_nobody_dances_to(tempo: float) -> None:
    with pytest.raises(MienError, match="60 to 180"):
        dance(tempo=tempo)
