"""Values between frames: SciPy's spline, exact at frames; maps of time that rise and keep their knots."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import CubicSpline

from mien.signal.sampling import monotone, spline

steps = arrays(float, st.integers(1, 20), elements=st.floats(0.01, 10))


def test_between_frames_it_is_scipys_spline():
    values = np.random.default_rng(0).normal(size=(20, 3, 2))
    at = np.array([0.25, 3.5, 18.99])
    np.testing.assert_allclose(spline(values, at), CubicSpline(np.arange(20), values)(at))


def test_whole_frames_are_the_frames_to_the_bit():
    values = np.random.default_rng(0).normal(size=(20, 3))
    np.testing.assert_array_equal(spline(values, np.array([4.0, 7.0 + 1e-12, 19.0])), values[[4, 7, 19]])


def test_beyond_the_ends_it_holds():
    values = np.arange(5.0) ** 2
    np.testing.assert_allclose(spline(values, np.array([-3.0, 0.0, 9.5])), [0, 0, 16])


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_few_frames(frames):
    out = spline(np.arange(float(frames)), np.array([0.0, 0.5 * (frames - 1)]))
    np.testing.assert_allclose(out, [0, 0.5 * (frames - 1)], atol=1e-12)


@given(steps, st.data())
def test_monotone_keeps_its_knots_and_rises(dx, data):
    dy = data.draw(arrays(float, len(dx), elements=st.floats(0.01, 10)))
    x, y = np.r_[0, np.cumsum(dx)], np.r_[3.0, 3 + np.cumsum(dy)]
    np.testing.assert_allclose(monotone(x, y, x), y, atol=1e-9)
    at = np.linspace(0, x[-1], 400)
    slope = np.diff(monotone(x, y, at)) / np.diff(at)
    flattest = min(0.25 * (y[-1] - y[0]) / x[-1], (dy / dx).min())
    assert slope.min() >= flattest * (1 - 1e-6) - 1e-9


def test_monotone_of_a_line_is_the_line():
    x = np.array([0.0, 1.0, 1.3, 4.0])
    at = np.linspace(0, 4, 33)
    y = np.stack([2 * x + 1, 0.5 * x], axis=1)
    np.testing.assert_allclose(monotone(x, y, at), np.stack([2 * at + 1, 0.5 * at], axis=1), atol=1e-12)


def test_monotone_through_one_knot_stays_there():
    np.testing.assert_array_equal(monotone(np.zeros(1), np.array([[2.0, 5.0]]), np.zeros(3)), [[2, 5]] * 3)
