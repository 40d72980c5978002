from collections.abc import Callable

import numpy as np
import pytest

from mien.errors import MienError
from mien.samples import Sample, knock, punch, still, wave

Places = Callable[[Sample], dict[str, np.ndarray]]


def test_a_knock_moves_and_rests_when_it_says(places: Places) -> None:
    sample = knock(strokes=4, seconds=5.0, fps=200.0, sway=0.0, unit="m")
    wrist, times = places(sample)["right_wrist"], sample.motion.times
    speed = np.linalg.norm(np.gradient(wrist, times, axis=0), axis=1)
    for stroke, rest in zip(sample.events["stroke"], sample.events["rest"], strict=True):
        assert rest - stroke == pytest.approx(0.4)
        inside = (times > stroke + 0.02) & (times < rest - 0.02)
        hit = np.abs(times - (stroke + 0.2)) < 0.015
        assert speed[inside & ~hit].max() > 0.8
        assert speed[(times > rest + 0.006) & (times < rest + 0.294)].max() < 1e-12
    np.testing.assert_allclose(np.diff(sample.events["stroke"]), 0.7)


def test_a_knock_goes_forward(places: Places) -> None:
    sample = knock(fps=100.0, sway=0.0, unit="m")
    wrist = places(sample)["right_wrist"]
    first = round(sample.events["stroke"][0] * 100)
    assert wrist[first + 20, 2] - wrist[first, 2] > 0.08
    np.testing.assert_allclose(wrist[first + 40], wrist[first], atol=1e-12)


def test_a_wave_has_its_rate_beside_the_head(places: Places) -> None:
    sample = wave(waves=6, rate=2.0, seconds=5.0, fps=100.0, sway=0.0, unit="m")
    at = places(sample)
    start, end = sample.events["wave"][0], sample.events["end"][0]
    assert end - start == pytest.approx(3.0)
    frames = slice(round(100 * start), round(100 * end))
    aside = at["right_wrist"][frames, 0]
    power = np.abs(np.fft.rfft(aside - aside.mean()))
    assert power.argmax() == 6
    middle = slice(round(100 * start) + 50, round(100 * end) - 50)
    assert (at["right_wrist"][middle, 1] > at["right_shoulder"][middle, 1] + 0.1).all()
    assert (aside < at["head"][frames, 0] - 0.2).all()


def test_a_punch_reaches_far_and_fast(places: Places) -> None:
    sample = punch(fps=240.0, unit="m")
    at, times = places(sample), sample.motion.times
    speed = np.linalg.norm(np.gradient(at["right_wrist"], times, axis=0), axis=1)
    assert 4.0 < speed.max() < 12.0  # a trained cross: 6 to 10 m/s
    for hit in sample.events["hit"]:
        frame = round(hit * 240)
        reach = at["right_wrist"][frame] - at["right_shoulder"][frame]
        assert reach[2] > 0.95 * np.linalg.norm(reach)
        assert np.linalg.norm(reach) > 0.98 * 0.332 * 1.75
    assert sample.contacts[:, 0].all()
    assert not sample.contacts[:, 1, 0].any()
    assert sample.contacts[:, 1, 1].all()


def test_quiet_standing_sways_a_little_and_a_statue_does_not(places: Places) -> None:
    hips = places(still(seconds=60.0, fps=30.0, unit="m"))["hips"]
    assert 0.005 < np.ptp(hips[:, 0]) < 0.03
    assert 0.005 < np.ptp(hips[:, 2]) < 0.03
    statue = still(sway=0.0)
    assert (statue.motion.rotations == statue.motion.rotations[0]).all()
    assert still().contacts.all()


@pytest.mark.parametrize(
    "make", [lambda: knock(strokes=0), lambda: wave(waves=0), lambda: punch(punches=1000)]
)
def test_a_count_out_of_range_is_refused(make: Callable[[], Sample]) -> None:
    with pytest.raises(MienError, match="must be 1 to 100"):
        make()


def test_a_wave_too_fast_is_refused() -> None:
    with pytest.raises(MienError, match="rate must be"):
        wave(rate=20.0)
