"""to_and_fro: gains of sines in closed form, lines and their ends, rounds of a loop."""

import numpy as np
import pytest

from mien.signal.to_and_fro import to_and_fro

DT = 0.01


@pytest.mark.parametrize("frequency", [0.1, 0.5, 1.0, 3.0, 8.0, 20.0])
def test_a_sine_is_kept_by_its_frequency(frequency: float) -> None:
    """Oracle: a Gaussian of half amplitude at f keeps 2^-(x/f)^2 of x Hz."""
    t = DT * np.arange(4000)
    kept = 2.0 ** -((frequency / 8.0) ** 2) - 2.0 ** -((frequency / 0.5) ** 2)
    found = to_and_fro(np.sin(2 * np.pi * frequency * t), DT)[1000:3000]
    np.testing.assert_allclose(found, kept * np.sin(2 * np.pi * frequency * t[1000:3000]), atol=0.01)


def test_a_line_has_none_to_its_very_ends() -> None:
    line = 3.0 - 2.0 * DT * np.arange(500)
    np.testing.assert_allclose(to_and_fro(np.stack([line, -line], axis=1), DT), 0.0, atol=1e-9)


@pytest.mark.parametrize("repeats", [0, 1])
def test_a_loop_is_as_one_of_many_rounds(repeats: int) -> None:
    """Also where each round goes on from the one before; its last frame may repeat its first."""
    t = DT * np.arange(1000)
    course = np.sin(2 * np.pi * 1.5 * t) + 0.3 * t
    frames = 200
    many = to_and_fro(course, DT)[400 : 400 + frames + repeats]
    one = to_and_fro(course[400 : 400 + frames + repeats], DT, frames=frames)
    np.testing.assert_allclose(one, many, atol=0.01)


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_short_ones_are_finite(frames: int) -> None:
    assert np.isfinite(to_and_fro(np.arange(frames, dtype=float), DT)).all()
