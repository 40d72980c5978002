"""Rotations smoothed: against SciPy's filters on each number, on whole turns and round loops."""

import numpy as np
import pytest
from scipy.signal import convolve

from mien.kinematics.smoothing import slow_mean, without_fine
from mien.rotations import quaternion as quat

FPS = 100.0


def swaying(frames: int = 400) -> np.ndarray:
    """Two joints (T, 2, 4) that turn to and fro, slowly and fast, about axes of their own."""
    t = np.arange(frames) / FPS
    slow, fast = np.sin(2 * np.pi * 0.2 * t), np.sin(2 * np.pi * 7.0 * t)
    one = np.stack([0.8 * slow, 0.1 * fast, 0.3 * slow], axis=-1)
    other = np.stack([0.2 * fast, 0.5 * slow + 1.0, 0.2 * np.cos(2 * np.pi * 2.0 * t)], axis=-1)
    return quat.continuous(quat.exp(np.stack([one, other], axis=1)))


def cascade(x: np.ndarray, levels: int) -> np.ndarray:
    """The thesis's low-pass: one kernel after another, ends held so far that they are constant."""
    pad = 400
    wide = np.pad(x, [(pad, pad), *[(0, 0)] * (x.ndim - 1)], mode="edge")
    for level in range(levels):
        kernel = np.zeros(4 * 2**level + 1)
        kernel[:: 2**level] = np.array([1, 4, 6, 4, 1]) / 16
        wide = convolve(wide, kernel.reshape(-1, *[1] * (x.ndim - 1)), mode="same", method="direct")
    return wide[pad:-pad]


@pytest.mark.parametrize(("function", "levels"), [("slow", 6), ("fine", 2)])
def test_at_100_frames_a_second_they_are_the_bands_of_the_thesis(function: str, levels: int) -> None:
    q = swaying()
    wanted = cascade(q, levels)
    size = np.linalg.norm(wanted, axis=-1)
    found = slow_mean(q, FPS, frames=0)[0] if function == "slow" else without_fine(q, FPS)
    np.testing.assert_allclose(found, wanted / size[..., None], atol=1e-10)
    if function == "slow":
        np.testing.assert_allclose(slow_mean(q, FPS, frames=0)[1], size, atol=1e-10)


def test_a_joint_at_rest_has_a_clear_mean_and_one_that_spins_has_none() -> None:
    t = np.arange(400) / FPS
    still, spin = np.zeros((400, 3)), np.outer(2 * np.pi * 3.0 * t, [0, 1, 0])
    clear = slow_mean(quat.continuous(quat.exp(np.stack([still, spin], 1))), FPS, frames=0)[1]
    np.testing.assert_allclose(clear[:, 0], 1.0, atol=1e-12)
    assert clear[150:250, 1].max() < 0.1


def test_a_loop_is_smoothed_round_and_its_repeated_end_is_its_start() -> None:
    t = np.arange(80) / 80
    v = np.stack([0.5 * np.sin(2 * np.pi * t), 0.2 * np.cos(4 * np.pi * t), 0 * t], axis=-1)
    q = quat.exp(v)[:, None]
    mean = slow_mean(q, FPS, frames=80)[0]
    rolled = slow_mean(np.roll(q, 17, axis=0), FPS, frames=80)[0]
    np.testing.assert_allclose(np.roll(mean, 17, axis=0), rolled, atol=1e-12)
    closed = slow_mean(np.concatenate([q, q[:1]]), FPS, frames=80)[0]
    np.testing.assert_allclose(closed, np.concatenate([mean, mean[:1]]), atol=1e-12)
