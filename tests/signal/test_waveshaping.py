"""Curves of size: what they are at known points, and that none falls, jumps or has a kink."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from mien.signal.waveshaping import smooth_step, soft_limit, two_gains

gains = st.floats(0.0, 4.0)
borders = st.floats(0.01, 2.0)


@given(gains, gains, borders, st.floats(0.0, 6.0))
def test_two_gains_is_the_sum_of_its_slope(small: float, large: float, border: float, x: float) -> None:
    """Oracle: the slope said in words, half way between the gains at the border, added up by SciPy."""
    whole = quad(lambda u: large + (small - large) / (1.0 + (u / border) ** 2), 0.0, x, epsabs=1e-11)[0]
    found = two_gains(np.array([x]), small=small, large=large, border=border)
    np.testing.assert_allclose(found, whole, atol=1e-9)


@given(gains, gains, borders)
def test_two_gains_never_falls(small: float, large: float, border: float) -> None:
    x = np.linspace(0.0, 7.0, 5001)
    y = two_gains(x, small=small, large=large, border=border)
    assert y[0] == 0.0
    assert (np.diff(y) >= -1e-12).all()
    slope = np.diff(y) / np.diff(x)
    assert slope.min() >= min(small, large) - 1e-9
    assert slope.max() <= max(small, large) + 1e-9


def test_equal_gains_are_one_gain() -> None:
    x = np.linspace(0.0, 3.0, 7)
    np.testing.assert_array_equal(two_gains(x, small=1.0, large=1.0, border=0.2), x)
    np.testing.assert_array_equal(two_gains(x, small=0.5, large=0.5, border=0.2), 0.5 * x)


@given(st.floats(0.0, 20.0), st.floats(0.1, 5.0), st.floats(0.0, 1.0))
def test_soft_limit_keeps_what_is_well_inside_and_never_goes_beyond(
    x: float, limit: float, share: float
) -> None:
    softness = share * limit
    found = float(soft_limit(np.array(x), limit, softness))
    assert 0.0 <= found <= min(x, limit) * (1.0 + 1e-12)
    if x <= limit - softness:
        assert found == x


def test_soft_limit_has_no_kink_and_never_falls() -> None:
    x = np.linspace(0.0, 4.0, 40001)
    y = soft_limit(x, 1.0, 0.3)
    slope = np.diff(y) / np.diff(x)
    assert slope.min() >= 0.0
    assert slope.max() <= 1.0 + 1e-9
    assert np.abs(np.diff(slope)).max() < 1e-3
    assert y[-1] == pytest.approx(1.0, abs=1e-4)
    assert soft_limit(np.array(1.0), 1.0, 0.3) == pytest.approx(1.0 - 0.3 / np.e)


def test_a_hard_limit_is_a_clamp() -> None:
    x = np.linspace(0.0, 4.0, 401)
    once = soft_limit(x, 1.5, 0.0)
    np.testing.assert_allclose(once, np.minimum(x, 1.5), atol=1e-15)
    np.testing.assert_array_equal(soft_limit(once, 1.5, 0.0), once)


def test_smooth_step_goes_up_and_down() -> None:
    x = np.array([-1.0, 1.0, 1.5, 2.0, 9.0])
    np.testing.assert_allclose(smooth_step(x, 1.0, 2.0), [0, 0, 0.5, 1, 1])
    np.testing.assert_allclose(smooth_step(x, 2.0, 1.0), [1, 1, 0.5, 0, 0])
