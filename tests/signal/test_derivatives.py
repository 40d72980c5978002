"""Derivatives: against calculus, against a sum of sines written out, and from one frame on."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.signal.derivatives import CUTOFF, derivatives


def gain(frequency: float) -> float:
    return 0.5 ** ((frequency / CUTOFF) ** 2)


@pytest.mark.parametrize("fps", [24.0, 30.0, 60.0, 120.0])
@pytest.mark.parametrize("frequency", [0.5, 2.0, 4.0])
def test_a_sine_and_its_derivatives(fps: float, frequency: float) -> None:
    t = np.arange(int(10 * fps) + 1) / fps
    w = 2.0 * np.pi * frequency
    smooth, first, second, third = derivatives(np.sin(w * t), 1.0 / fps, orders=(0, 1, 2, 3))
    at = slice(round(fps), -round(fps))
    wave, turned = gain(frequency) * np.sin(w * t), gain(frequency) * np.cos(w * t)
    for found, expected in ((smooth, wave), (first, w * turned), (second, -w * w * wave)):
        assert np.abs(found - expected)[at].max() < 0.005 * np.abs(expected).max()
    assert np.abs(third + w**3 * turned)[at].max() < 0.02 * w**3


def test_what_is_at_the_cut_off_is_halved() -> None:
    t = np.arange(1201) / 120.0
    (smooth,) = derivatives(np.sin(2.0 * np.pi * CUTOFF * t), 1.0 / 120.0, orders=(0,))
    assert np.abs(smooth).max() == pytest.approx(0.5, abs=1e-3)


def test_a_straight_line_has_its_slope_and_nothing_else() -> None:
    t = np.arange(50) / 30.0
    line = np.stack([3.0 * t + 1.0, -2.0 * t], axis=1)
    smooth, first, second, third = derivatives(line, 1.0 / 30.0, orders=(0, 1, 2, 3))
    np.testing.assert_allclose(smooth, line, atol=1e-12)
    np.testing.assert_allclose(first, np.broadcast_to([3.0, -2.0], (50, 2)), atol=1e-11)
    assert max(np.abs(second).max(), np.abs(third).max()) < 1e-9


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_few_frames(count: int) -> None:
    values = np.arange(count, dtype=float)[:, None, None] * np.ones((1, 2, 3))
    for found in derivatives(values, 0.1, orders=(0, 1, 2, 3)):
        assert found.shape == (count, 2, 3)
        assert np.isfinite(found).all()
    assert np.allclose(derivatives(values, 0.1, orders=(1,))[0], 10.0 if count > 1 else 0.0)


def slow_twin(values: np.ndarray, frame_time: float, order: int) -> np.ndarray:
    """The sum of sines, term by term."""
    n = len(values) - 1
    k, frames = np.arange(1, n), np.arange(n + 1)
    rest = values - (values[0] + frames / n * (values[-1] - values[0]))
    waves = [2.0 / n * sum(rest[j] * np.sin(np.pi * i * j / n) for j in range(1, n)) for i in k]
    out = np.zeros(n + 1)
    for i, wave in zip(k, waves, strict=True):
        w = np.pi * i / (n * frame_time)
        smoothed = wave * gain(w / (2.0 * np.pi))
        phase = np.pi * i * frames / n
        turn = [np.sin(phase), np.cos(phase), -np.sin(phase), -np.cos(phase)][order]
        out += smoothed * w**order * turn
    straight = values[0] + frames / n * (values[-1] - values[0])
    return out + (straight, (values[-1] - values[0]) / (n * frame_time), 0.0, 0.0)[order]


@given(
    st.lists(st.floats(-10.0, 10.0), min_size=3, max_size=12),
    st.sampled_from([1.0 / 24.0, 1.0 / 120.0]),
    st.integers(0, 3),
)
def test_against_the_sum_written_out(values: list[float], frame_time: float, order: int) -> None:
    x = np.array(values)
    (found,) = derivatives(x, frame_time, orders=(order,))
    expected = slow_twin(x, frame_time, order)
    np.testing.assert_allclose(found, expected, atol=1e-9 * max(1.0, np.abs(expected).max()))


def test_slow_curves_agree_with_differences() -> None:
    t = np.arange(600) / 120.0
    x = np.exp(-((t - 2.5) ** 2))
    (first,) = derivatives(x, 1.0 / 120.0, orders=(1,))
    np.testing.assert_allclose(first, np.gradient(x, 1.0 / 120.0), atol=0.01)
