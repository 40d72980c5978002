"""Accents: maps of time that hurry at the end of a stretch and are the time itself outside."""

import numpy as np
import pytest
from scipy.integrate import quad

from mien.signal.accents import accented

PACES = [0.4, 0.71, 0.99, 1.01, 1.41, 2.5]


def slopes(u, t):
    return np.diff(u) / np.diff(t)


@pytest.mark.parametrize("pace", PACES)
def test_outside_of_accents_the_very_times_come_back(pace):
    t = np.arange(300) / 7.0
    u = accented(t, np.array([[3.0, 7.0], [7.0, 9.5], [20.0, 31.3]]), pace=pace, length=1.5)
    inside = ((t > 3.0) & (t < 9.5)) | ((t > 20.0) & (t < 31.3))
    np.testing.assert_array_equal(u[~inside], t[~inside])
    assert np.abs(u - t)[inside].max() > 1e-4


@pytest.mark.parametrize("pace", PACES)
@pytest.mark.parametrize("span", [0.3, 1.0, 4.0, 30.0])
def test_time_runs_forward_at_no_more_than_the_pace_and_without_corners(pace, span):
    t = np.linspace(-1.0, span + 1.0, 200001)
    u = accented(t, np.array([[0.0, span]]), pace=pace, length=1.5)
    slope = slopes(u, t)
    bounds = sorted([pace, 1.0 / pace])
    assert slope.min() > bounds[0] - 1e-6
    assert slope.max() < bounds[1] + 1e-6
    assert np.abs(np.diff(slope)).max() < 100.0 * (t[1] - t[0]) * abs(pace - 1.0) / min(span, 1.0)


def test_the_slope_is_what_is_written_down():
    """The map is the integral of 1 - Q sin^2 and then 1 + P sin^2, done here by quadrature."""
    start, end, length, pace = 2.0, 7.0, 1.5, 2.0
    gain = pace - 1.0
    hurried = length / (1.0 + gain / 2.0)
    turn = end - hurried
    paid = gain * hurried / (turn - start)

    def slope(t):
        if t > turn:
            return 1.0 + gain * np.sin(np.pi * (t - turn) / hurried) ** 2
        return 1.0 - paid * np.sin(np.pi * (t - start) / (turn - start)) ** 2

    at = np.array([2.5, 4.0, turn, 6.5, 6.99])
    expected = [start + quad(slope, start, t, points=[min(t, turn)])[0] for t in at]
    np.testing.assert_allclose(accented(at, np.array([[start, end]]), pace=pace, length=length), expected)


@pytest.mark.parametrize("pace", PACES)
def test_the_last_stretch_of_the_source_is_hurried(pace):
    t = np.linspace(0.0, 10.0, 100001)
    u = accented(t, np.array([[1.0, 9.0]]), pace=pace, length=1.5)
    fast = np.abs(slopes(u, t)[u[:-1] > 7.5])
    slow = np.abs(slopes(u, t)[(u[:-1] > 1.0) & (u[:-1] < 7.499)])
    assert (np.sign(fast - 1.0 + 1e-9 * np.sign(pace - 1.0)) == np.sign(pace - 1.0)).mean() > 0.4
    assert ((slow - 1.0) * np.sign(pace - 1.0) < 1e-9).all()


def test_pace_1_changes_nothing_and_short_accents_change_little():
    t = np.linspace(0.0, 10.0, 10001)
    np.testing.assert_allclose(accented(t, np.array([[1.0, 9.0]]), pace=1.0, length=1.5), t, atol=1e-12)
    tops = [
        slopes(accented(t, np.array([[1.0, 1.0 + span]]), pace=2.0, length=1.5), t).max()
        for span in (0.3, 1.0, 2.0, 3.0, 8.0)
    ]
    assert (np.diff(tops[:4]) > 0.0).all()
    np.testing.assert_allclose(tops[3:], 2.0, atol=1e-3)  # half of 3 is the whole length
