"""Weights: what is taken, what is refused, and bands against the frequency responses they are made of."""

import numpy as np
import pytest

from mien.errors import MienError
from mien.signal.multiresolution import reference_response, three_bands
from mien.styles.shares import shares


def test_weights_stand_for_every_band_that_is_not_named():
    parts = shares(2, [0.25, 0.75], {"low": [1, 0]})
    for band, want in {
        "time": [0.25, 0.75],
        "low": [1, 0],
        "mid": [0.25, 0.75],
        "high": [0.25, 0.75],
    }.items():
        np.testing.assert_array_equal(getattr(parts, band), want)
    assert parts.of(1) == (0.75, 0.0, 0.75, 0.75)
    assert parts.heaviest == 1


def test_without_weights_time_is_that_of_the_movement_else_equal():
    np.testing.assert_array_equal(shares(2, None, {"mid": [0, 1]}).time, [0, 1])
    np.testing.assert_array_equal(shares(2, None, {"low": [0, 1]}).time, [0.5, 0.5])
    np.testing.assert_array_equal(shares(2, None, {"low": [0, 1]}).mid, [0.5, 0.5])


def test_a_sum_off_by_rounding_is_made_one():
    parts = shares(3, [0.33, 0.33, 0.33], None)
    np.testing.assert_allclose(parts.mid, 1 / 3)
    assert parts.mid.sum() == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize(
    ("weights", "bands", "words"),
    [
        ([0.5, 0.4], None, "weights must sum to 1, but 0.5,0.4 sum to 0.9; in the same proportion: 0.5556"),
        ([2, 1], None, "in the same proportion: 0.6667,0.3333"),
        ([1, -1], None, "sum to 0$"),
        ([1], None, "1 for 2 clips"),
        ([0.5, 0.25, 0.25], None, "3 for 2 clips"),
        ([2.5, -1.5], None, "from -1 to 2, got 2.5"),
        ([float("nan"), 1], None, "must be numbers, got nan"),
        ([True, 0], None, "must be numbers, got True"),
        (["1", 0], None, "must be numbers, got '1'"),
        ("10", None, "list of numbers"),
        (0.5, None, "list of numbers"),
        ([0.5, 0.5], {"middle": [1, 0]}, "no band 'middle'"),
        ([0.5, 0.5], {"mid": [1, 1]}, "weights of mid must sum to 1"),
    ],
)
def test_what_does_not_fit_is_said(weights, bands, words):
    with pytest.raises(MienError, match=words):
        shares(2, weights, bands)


def test_without_bands_it_is_the_plain_weighted_sum():
    random = np.random.default_rng(0)
    a, b, c = random.normal(size=(3, 50, 4, 6))
    parts = shares(3, [0.2, 1.1, -0.3], None)
    np.testing.assert_allclose(parts.mixed([a, b, c], 30.0), 0.2 * a + 1.1 * b - 0.3 * c, atol=1e-12)


@pytest.mark.parametrize("hertz", [0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 14.0])
@pytest.mark.parametrize("fps", [60.0, 120.0])
def test_a_sine_gets_the_weight_of_its_band(hertz, fps):
    """The first clip passes as the response of its weights says, the second as what is left of 1."""
    t = np.arange(int(30 * fps)) / fps
    a, b = np.sin(2 * np.pi * hertz * t), np.cos(2 * np.pi * hertz * t)
    parts = shares(2, None, {"low": [0.9, 0.1], "mid": [0.3, 0.7], "high": [-0.2, 1.2]})
    gain = float(reference_response(np.array([hertz]), three_bands(0.9, 0.3, -0.2))[0])
    inside = slice(int(3 * fps), -int(3 * fps))
    np.testing.assert_allclose(
        parts.mixed([a, b], fps)[inside], (gain * a + (1 - gain) * b)[inside], atol=2e-3
    )


def test_equal_signals_come_through_any_bands():
    x = np.random.default_rng(0).normal(size=(80, 5)).cumsum(axis=0)
    parts = shares(3, None, {"low": [1, 0, 0], "mid": [-0.5, 0.5, 1], "high": [0.2, 0.3, 0.5]})
    np.testing.assert_allclose(parts.mixed([x, x, x], 48.0), x, atol=1e-12)


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_very_short_signals(frames):
    x = np.arange(float(frames))
    parts = shares(2, None, {"low": [1, 0], "mid": [0, 1], "high": [0, 1]})
    assert np.isfinite(parts.mixed([x, x + 1], 30.0)).all()
