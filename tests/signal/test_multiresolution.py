"""Bands: exact shares of sinusoids, a slow twin of the cascade, SciPy's frequency responses."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.signal import freqz

from mien.signal import multiresolution as mr

GAINS = (1.0, 1.5, 0.5)
KERNEL = np.array([1.0, 4.0, 6.0, 4.0, 1.0]) / 16.0
signals = arrays(np.float64, st.integers(1, 70), elements=st.floats(-100.0, 100.0, allow_subnormal=False))


def hz(x, fps, gains=GAINS, wrap=False):
    """The default of path_length on a plain signal."""
    values = mr.three_bands(*gains)
    return mr.regain(
        x, fps, lambda f: mr.reference_response(f, values), support=mr.REFERENCE_SUPPORT, wrap=wrap
    )


def edges(x, fps, gains=GAINS, at=(1.0, 12.5)):
    return mr.regain(x, fps, lambda f: mr.edge_response(f, gains, at), support=1.3)


def spread(level):
    """The kernel w_level with its zeros."""
    out = np.zeros(4 * 2 ** (level - 1) + 1)
    out[:: 2 ** (level - 1)] = KERNEL
    return out


def slow_bands(x, wrap):
    """Every step as the thesis words it, on a signal continued far beyond both ends."""
    count = int(np.floor(np.log2(len(x))))
    pad = 4 * 2 ** (count + 1)
    g = np.pad(x, pad, mode="wrap" if wrap else "edge")
    kept = [g]
    for level in range(1, count + 1):
        g = np.convolve(g, spread(level), mode="same")
        kept.append(g)
    inside = [g[pad : pad + len(x)] for g in kept]
    return [a - b for a, b in pairwise(inside)] + inside[-1:]


def amplitude(y, frequency, fps, start=3.0):
    """The amplitude of a sinusoid in the middle of ``y``, by least squares."""
    t = np.arange(len(y)) / fps
    inside = (t > start) & (t < t[-1] - start)
    parts = np.stack([np.sin(2 * np.pi * frequency * t), np.cos(2 * np.pi * frequency * t)], -1)
    return np.hypot(*np.linalg.lstsq(parts[inside], y[inside], rcond=None)[0])


def sine(frequency, fps, seconds=20.0):
    return np.sin(2 * np.pi * frequency * np.arange(int(seconds * fps)) / fps + 0.3)


@pytest.fixture
def walk():
    """A random walk: something of every frequency, and ends that do not meet."""
    return np.cumsum(np.random.default_rng(1).normal(size=(1000, 2)), axis=0)


@pytest.mark.parametrize(
    ("frames", "count"), [(1, 0), (2, 1), (3, 1), (4, 2), (255, 7), (256, 8), (257, 8), (10_000, 13)]
)
def test_band_count(frames, count):
    assert mr.band_count(frames) == count


@given(signals, st.booleans())
@settings(max_examples=60, deadline=None)
def test_the_cascade_is_its_slow_twin(x, wrap):
    fast = mr.bands(x, wrap=wrap)
    slow = slow_bands(x, wrap)
    assert len(fast) == len(slow) == mr.band_count(len(x)) + 1
    for a, b in zip(fast, slow, strict=True):
        np.testing.assert_allclose(a, b, atol=1e-11)


@given(signals, st.booleans())
@settings(max_examples=40, deadline=None)
def test_bands_sum_to_the_signal(x, wrap):
    np.testing.assert_allclose(sum(mr.bands(x, wrap=wrap)), x, atol=1e-12 * max(1.0, np.abs(x).max()))


@pytest.mark.parametrize(
    ("period", "shares"),
    [
        (2, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (4, [0.75, 0.25, 0.0, 0.0, 0.0, 0.0]),
        (8, [0.271447, 0.546415, 0.182138, 0.0, 0.0, 0.0]),
        (16, [0.074672, 0.251177, 0.505613, 0.168538, 0.0, 0.0]),
        (32, [0.019122, 0.073244, 0.246374, 0.495945, 0.165315, 0.0]),
    ],
)
def test_shares_of_a_sinusoid(period, shares):
    x = np.cos(2 * np.pi * np.arange(4096) / period)
    split = mr.bands(x)
    split = [*split[:5], sum(split[5:])]
    inside = slice(1024, 3072)
    for band, share in zip(split, shares, strict=True):
        np.testing.assert_allclose(band[inside], share * x[inside], atol=1e-6)


@pytest.mark.parametrize(
    ("level", "peak", "height"),
    [(1, 0.2810, 0.5596), (2, 0.2673, 0.5098), (3, 0.2643, 0.4988), (4, 0.2635, 0.4961)],
)
def test_where_the_bands_of_the_reference_peak(level, peak, height):
    frequency = np.linspace(0.01, 49.99, 200_000)
    gains = [0.0] * 7
    gains[level] = 1.0
    response = mr.reference_response(frequency, gains)
    assert frequency[response.argmax()] * 2**level / 100.0 == pytest.approx(peak, abs=1e-4)
    assert response.max() == pytest.approx(height, abs=1e-4)


@pytest.mark.parametrize(("level", "half"), [(1, 0.364), (2, 0.329), (3, 0.321), (4, 0.3195)])
def test_half_amplitudes_of_the_low_passes(level, half):
    gains = [0.0] * level + [1.0]
    at = half * 100.0 / 2**level
    assert mr.reference_response(np.array([at]), gains)[0] == pytest.approx(0.5, abs=2e-3)


def test_the_reference_response_is_the_frequency_response_of_the_kernels():
    frequency = np.linspace(0.0, 50.0, 501)
    kernel, passed = np.ones(1), []
    for level in range(7):
        if level:
            kernel = np.convolve(kernel, spread(level))
        middle = len(kernel) // 2
        _, response = freqz(kernel, worN=frequency, fs=100.0)
        passed.append((response * np.exp(2j * np.pi * frequency / 100.0 * middle)).real)
    gains = [0.3, 0.9, 1.7, 0.2, 2.5, 1.1, 0.6]
    wanted = (
        sum(g * (a - b) for g, (a, b) in zip(gains, pairwise(passed), strict=False)) + gains[-1] * passed[-1]
    )
    np.testing.assert_allclose(mr.reference_response(frequency, gains), wanted, atol=1e-12)
    assert (mr.reference_response(np.array([50.0, 60.0, 1000.0]), gains) == gains[0]).all()


@pytest.mark.parametrize("fps", [24, 30, 60, 100, 120])
def test_golden_gains_at_every_frame_rate(fps):
    golden = {0.5: 1.2487, 1: 1.4697, 2: 1.4605, 4: 1.3526, 6: 1.1958, 8: 1.0190, 10: 0.8505}
    for frequency, gain in golden.items():
        y = hz(sine(frequency, fps), fps)
        assert amplitude(y, frequency, fps) == pytest.approx(gain, abs=1e-4)


def test_half_amplitude_points_of_the_three_bands():
    low, high = np.array([0.50]), np.array([8.2])
    assert mr.reference_response(low, mr.three_bands(0, 1, 1))[0] == pytest.approx(0.5, abs=0.01)
    assert mr.reference_response(high, mr.three_bands(1, 1, 0))[0] == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize("at", [(1.0, 12.5), (0.4, 6.0)])
def test_edges_have_half_amplitude_where_they_are_said_to_be(at):
    assert mr.edge_response(np.array([at[0]]), (1, 0, 0), at)[0] == pytest.approx(0.5, abs=1e-12)
    assert mr.edge_response(np.array([at[1]]), (0, 0, 1), at)[0] == pytest.approx(0.5, abs=1e-12)


def test_at_100_fps_hz_and_whole_bands_are_the_same(walk):
    x = walk / np.abs(walk).max()
    np.testing.assert_allclose(hz(x, 100.0), mr.regain_bands(x, 100.0, GAINS), atol=3e-15)


def test_the_low_passed_signal_is_the_sum_of_its_slow_bands(walk):
    np.testing.assert_allclose(mr.smooth(walk, 2), sum(mr.bands(walk)[2:]), atol=1e-11)


@pytest.mark.parametrize(
    ("fps", "high", "mid"),
    [
        (24, [], [0, 1, 2, 3]),
        (25, [], [0, 1, 2, 3]),
        (30, [], [0, 1, 2, 3]),
        (50, [0], [1, 2, 3, 4]),
        (60, [0], [1, 2, 3, 4]),
        (100, [0, 1], [2, 3, 4, 5]),
        (120, [0, 1], [2, 3, 4, 5]),
        (240, [0, 1, 2], [3, 4, 5, 6]),
    ],
)
def test_which_bands_count_as_what(fps, high, mid):
    above, below = mr.band_levels(fps)
    assert list(range(above)) == high
    assert list(range(above, below)) == mid


@pytest.mark.parametrize(
    ("fps", "six", "half"), [(24, 1.500, 1.265), (30, 1.500, 1.190), (60, 1.318, 1.189), (100, 1.196, 1.249)]
)
def test_whole_bands_do_depend_on_the_frame_rate(fps, six, half):
    for frequency, gain in ((6.0, six), (0.5, half)):
        y = mr.regain_bands(sine(frequency, fps, 40.0), fps, GAINS)
        assert amplitude(y, frequency, fps, start=12.0) == pytest.approx(gain, abs=2e-3)


@pytest.mark.parametrize("change", [hz, edges, lambda x, fps, gains=GAINS: mr.regain_bands(x, fps, gains)])
class TestLaws:
    fps = 30.0

    def test_gains_of_one_are_the_identity(self, change, walk):
        np.testing.assert_allclose(change(walk, self.fps, (1, 1, 1)), walk, atol=1e-12)

    def test_a_constant_keeps_its_value(self, change, walk):
        still = np.full((40, 2), 3.7)
        np.testing.assert_allclose(change(still, self.fps, (1, 3, 0)), still, atol=1e-12)
        np.testing.assert_allclose(change(still, self.fps, (0.4, 3, 0)), 0.4 * still, atol=1e-12)

    def test_a_ramp_is_unchanged_inside(self, change, walk):
        ramp = np.linspace(-2.0, 5.0, 600)
        np.testing.assert_allclose(change(ramp, self.fps)[250:350], ramp[250:350], atol=1e-5)

    def test_linear_in_the_signal(self, change, walk):
        a, b = walk[:, 0], walk[:, 1]
        mixed = change(2.0 * a - 3.0 * b, self.fps)
        np.testing.assert_allclose(mixed, 2.0 * change(a, self.fps) - 3.0 * change(b, self.fps), atol=1e-10)

    def test_affine_in_each_gain(self, change, walk):
        short, long = change(walk, self.fps, (1, 0.4, 1)), change(walk, self.fps, (1, 1.6, 1))
        middle = change(walk, self.fps, (1, 1.3, 1))
        np.testing.assert_allclose(middle, 0.25 * short + 0.75 * long, atol=1e-10)

    def test_time_reversal_commutes(self, change, walk):
        np.testing.assert_allclose(change(walk[::-1], self.fps), change(walk, self.fps)[::-1], atol=1e-9)

    @pytest.mark.parametrize("frames", [1, 2, 3, 7])
    def test_a_few_frames(self, change, walk, frames):
        y = change(walk[:frames], self.fps)
        assert y.shape == (frames, 2)
        assert np.isfinite(y).all()


@pytest.mark.parametrize("frames", [11, 64, 97])
@pytest.mark.parametrize("change", [hz, lambda x, fps, wrap: mr.regain_bands(x, fps, GAINS, wrap=wrap)])
def test_a_loop_stays_a_loop(change, frames):
    x = np.random.default_rng(2).normal(size=frames)
    there = change(x, 30.0, wrap=True)
    np.testing.assert_allclose(change(np.roll(x, 5), 30.0, wrap=True), np.roll(there, 5), atol=1e-12)
    twice = change(np.tile(x, 16), 30.0, wrap=True)
    if change is hz:
        np.testing.assert_allclose(twice, np.tile(there, 16), atol=1e-12)


def test_the_ends_do_not_sag():
    x = np.full(50, 9.0) + np.linspace(0.0, 1e-3, 50)
    for change in (hz, edges):
        np.testing.assert_allclose(change(x, 30.0, (1, 3, 1)), 9.0, atol=2e-3)


def test_the_input_is_left_alone(walk):
    before = walk.copy()
    mr.bands(walk)
    hz(walk, 30.0)
    mr.regain_bands(walk, 30.0, GAINS, wrap=True)
    np.testing.assert_array_equal(walk, before)
