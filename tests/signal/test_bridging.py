"""Gap filling and envelopes: exact on lines, above their input, zero far from what is known."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mien.signal.bridging import curve_gaps, envelope, hold_gaps, nearness, smooth

values = arrays(float, st.integers(3, 60), elements=st.floats(-10, 10))


def test_hold_gaps_is_numpy_interp():
    x = np.array([[1.0, 5.0], [9, 9], [9, 9], [4.0, 2.0], [9, 9]])
    known = np.array([True, False, False, True, False])
    out = hold_gaps(x, known)
    np.testing.assert_allclose(out[:, 0], np.interp(range(5), [0, 3], [1, 4]))
    np.testing.assert_allclose(out[:, 1], np.interp(range(5), [0, 3], [5, 2]))


def test_curve_gaps_continues_a_line_exactly():
    line = np.arange(30.0)[:, None] * [1.0, -2.0, 0.5]
    known = np.ones(30, bool)
    known[10:18] = False
    np.testing.assert_allclose(curve_gaps(line, known, reach=20), line, atol=1e-12)


def test_curve_gaps_fades_to_zero_in_a_long_gap_and_keeps_the_known():
    x = np.full(100, 3.0)
    known = np.zeros(100, bool)
    known[:20] = known[80:] = True
    out = curve_gaps(x, known, reach=10)
    np.testing.assert_array_equal(out[known], 3.0)
    np.testing.assert_array_equal(out[30:70], 0.0)
    assert np.abs(np.diff(out)).max() < 0.6, "no jump"


def test_curve_gaps_with_nothing_known_is_zero():
    assert not curve_gaps(np.ones((7, 3)), np.zeros(7, bool), reach=5).any()


@given(values, st.integers(1, 12))
def test_envelope_is_never_below(x, reach):
    assert (envelope(x, reach=reach) >= x - 1e-9).all()


@given(values, st.floats(0.5, 8))
def test_smooth_keeps_ends_and_lines(x, sigma):
    out = smooth(x, sigma=sigma)
    np.testing.assert_allclose(out[[0, -1]], x[[0, -1]], atol=1e-9)
    line = np.linspace(x[0], x[-1], len(x))
    np.testing.assert_allclose(smooth(line, sigma=sigma), line, atol=1e-9)


def test_smooth_lowers_roughness():
    x = np.random.default_rng(0).normal(size=200)
    assert np.abs(np.diff(smooth(x, sigma=3.0), 2)).max() < 0.2 * np.abs(np.diff(x, 2)).max()


def test_nearness_is_1_where_known_and_falls_evenly_on_both_sides():
    known = np.zeros(41, bool)
    known[18:23] = True
    out = nearness(known, reach=10.0)
    assert (out[18:23] == 1.0).all()
    np.testing.assert_allclose(out, out[::-1])
    assert (out[[8, 7, 0]] == 0.0).all()
    assert out[13] == 0.5
    assert np.abs(np.diff(out, n=2)).max() < 0.07  # no corner: a straight ramp would have 0.1


def test_nearness_of_nothing_and_of_everything():
    assert (nearness(np.zeros(5, bool), reach=3.0) == 0.0).all()
    assert (nearness(np.ones(5, bool), reach=3.0) == 1.0).all()
    assert nearness(np.array([True, False]), reach=0.0).tolist() == [1.0, 0.0]


def test_curve_gaps_does_not_jump_where_the_clip_ends_sooner_than_the_curve():
    x = np.full(60, 3.0)
    known = np.ones(60, bool)
    known[:3] = known[-3:] = False
    out = curve_gaps(x, known, reach=20)
    assert np.abs(np.diff(out)).max() < 0.1, "three frames are too few to fade in"
    np.testing.assert_array_equal(out[known], 3.0)
