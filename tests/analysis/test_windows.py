"""Windows of 1.17 s at any frame rate."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.analysis.windows import STRIDE, WINDOW, around, window_frames, window_starts, windowed


@pytest.mark.parametrize(("fps", "frames"), [(30, 35), (120, 140), (60, 70), (24, 28), (480, 560), (1, 1)])
def test_a_window_is_as_long_at_any_rate(fps: int, frames: int) -> None:
    assert window_frames(10_000, 1.0 / fps) == frames


@given(st.integers(1, 400), st.floats(1.0, 240.0), st.floats(0.01, 3.0))
def test_windows_cover_the_clip(frames: int, fps: float, stride: float) -> None:
    length = window_frames(frames, 1.0 / fps)
    starts = window_starts(frames, length, 1.0 / fps, stride=stride)
    assert 1 <= length <= frames
    assert starts[0] == 0
    assert (np.diff(starts) > 0).all()
    assert starts[-1] + length <= frames
    if len(starts) > 1:
        assert starts[-1] + length == frames
        gaps = np.diff(starts) / fps
        assert gaps.mean() <= 2.0 * max(stride, 1.0 / fps)


def test_a_seventh_of_a_window_apart() -> None:
    seventh = WINDOW / 7.0
    assert pytest.approx(seventh) == STRIDE
    assert window_starts(600, 35, 1.0 / 30.0).tolist() == list(range(0, 566, 5))


def test_every_window_is_the_one_around_its_middle() -> None:
    values = np.arange(50.0)[:, None] * [1.0, -1.0]
    starts = window_starts(50, 35, 1.0 / 30.0)
    found = windowed(values, starts, 35)
    assert found.shape == (len(starts), 2, 35)
    for window, start in zip(found, starts, strict=True):
        np.testing.assert_array_equal(window, values[start : start + 35].T)
    np.testing.assert_array_equal(around(50, 35)[starts + 17], starts)
    assert around(3, 3).tolist() == [0, 0, 0]
