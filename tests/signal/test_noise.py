"""Noise as a function of time: what its numbers are like, and that only its seed and stream matter."""

import numpy as np
import pytest
from scipy.signal import welch

from mien.signal.noise import noise

BANDS = [(4.0, 10.0), (0.3, 1.0)]


def many(at: np.ndarray, band: tuple[float, float], count: int = 400) -> np.ndarray:
    return np.array([noise(at, low=band[0], high=band[1], seed=s, stream="many") for s in range(count)])


@pytest.mark.parametrize("band", BANDS)
def test_mean_variance_and_tails_are_as_documented(band: tuple[float, float]) -> None:
    x = many(np.linspace(0.0, 50.0, 501), band)
    assert abs(x.mean()) < 0.01
    assert x.var() == pytest.approx(1.0, abs=0.02)
    assert (np.abs(x) > 2).mean() == pytest.approx(0.045, abs=0.004)
    assert (np.abs(x) > 3).mean() == pytest.approx(0.0023, abs=0.0008)
    assert np.abs(x).max() < 8.0


@pytest.mark.parametrize("band", BANDS)
def test_one_seed_keeps_to_them_within_what_is_documented(band: tuple[float, float]) -> None:
    seconds = 20.0
    x = many(np.arange(0.0, seconds, 1 / 120), band)
    assert np.sqrt((x.mean(axis=1) ** 2).mean()) < 1 / (4 * band[0] * seconds)
    assert np.sqrt(((x.var(axis=1) - 1) ** 2).mean()) < 1 / np.sqrt((band[1] - band[0]) * seconds)


def test_all_of_it_lies_in_the_band() -> None:
    """Oracle: SciPy's spectrum."""
    at = np.arange(0.0, 60.0, 1 / 120)
    frequency, power = welch(noise(at, low=4.0, high=10.0, seed=3, stream="a"), 120.0, nperseg=1024)
    inside = (frequency > 3.7) & (frequency < 10.3)
    assert power[inside].sum() > 0.999 * power.sum()
    thirds = [power[(frequency > f) & (frequency < f + 2)].sum() for f in (4.0, 6.0, 8.0)]
    assert min(thirds) > 0.25 * sum(thirds)


def test_it_is_a_function_of_time() -> None:
    fast, slow = np.arange(0.0, 5.0, 1 / 240), np.arange(0.0, 5.0, 1 / 24)
    form = {"low": 4.0, "high": 10.0, "seed": 1, "stream": "a"}
    np.testing.assert_allclose(noise(fast, **form)[::10], noise(slow, **form), atol=1e-12)
    np.testing.assert_allclose(noise(slow[::-1], **form)[::-1], noise(slow, **form), atol=1e-12)


def test_it_does_not_repeat() -> None:
    at = np.arange(0.0, 200.0, 0.05)
    x = noise(at, low=0.3, high=1.0, seed=0, stream="a")
    half = len(x) // 2
    alike = [np.corrcoef(x[:half], x[lag : lag + half])[0, 1] for lag in range(200, half)]
    assert max(alike) < 0.6


def test_seeds_and_streams_know_nothing_of_each_other() -> None:
    at = np.arange(0.0, 200.0, 0.02)
    names = [(0, "left_wrist x"), (0, "left_wrist y"), (0, "right_wrist x"), (1, "left_wrist x"), (2**40, "")]
    streams = [noise(at, low=4.0, high=10.0, seed=seed, stream=name) for seed, name in names]
    assert np.abs(np.corrcoef(streams) - np.eye(len(names))).max() < 0.2


def test_the_numbers_are_these_on_every_machine() -> None:
    """Worked out apart, from the bits of PCG64 that NumPy promises to keep."""
    bits = np.random.PCG64(np.random.SeedSequence(5, spawn_key=tuple(b"head x"))).random_raw(64) >> 11
    u, phase = (bits * 2.0**-53).reshape(2, 32)
    wanted = [
        sum(np.cos(2 * np.pi * ((4 + 6 * (i + u[i]) / 32) * t + phase[i])) for i in range(32)) / 4
        for t in (0.0, 1.25)
    ]
    found = noise(np.array([0.0, 1.25]), low=4.0, high=10.0, seed=5, stream="head x")
    np.testing.assert_allclose(found, wanted, atol=1e-12)
    np.testing.assert_allclose(found, [-1.215478241395, 1.282692265222], atol=1e-9)
