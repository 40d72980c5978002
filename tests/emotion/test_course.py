"""A reading that goes along: as many windows as fit, each the reading of that stretch."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.emotion.course import STRIDE, WINDOW, course
from mien.emotion.reading import read


@pytest.mark.parametrize("fps", [30, 60, 120])
def test_windows_are_seconds_whatever_the_rate(fps: int) -> None:
    motion = samples.walk(seconds=5.0, fps=fps).motion
    times, places = course(motion)
    assert len(times) == len(places) == int((5.0 - WINDOW) / STRIDE) + 1
    assert times[0] == pytest.approx(WINDOW / 2, abs=1 / fps)
    assert np.diff(times) == pytest.approx(STRIDE, abs=1 / fps)


def test_each_window_is_the_reading_of_its_stretch() -> None:
    motion = samples.walk(seconds=4.0, fps=30).motion
    _, places = course(motion)
    assert tuple(places[1]) == tuple(read(motion[15 : 15 + 75]).place)


def test_an_edit_that_sets_in_is_seen_to_set_in() -> None:
    motion = samples.walk(seconds=8.0, fps=30).motion
    after = mien.edit(motion, "sad", span=(4.0, 8.0), safe=False)
    times, places = course(after)
    early, late = places[times < 2.5], places[times > 6.0]
    assert np.abs(early).max() < 0.05
    assert (late[:, 0] < -0.2).all()


def test_a_short_clip_is_one_window() -> None:
    times, places = course(samples.walk(seconds=1.0).motion)
    assert times.shape == (1,)
    assert places.shape == (1, 2)
