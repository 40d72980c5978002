"""The way of a body: straight ways stay, a stride's sway goes, and the equation holds."""

import numpy as np
import pytest

from mien.kinematics.travel import CUTOFF, slow_path

UP = np.array([0.0, 1.0, 0.0])


def test_a_straight_way_is_its_own_path() -> None:
    way = np.linspace(0.0, 4000.0, 90)[:, None] * [1.0, 0.0, 0.5]
    np.testing.assert_allclose(slow_path(way, UP, 30.0), way, atol=1e-9)


def test_height_is_no_part_of_it() -> None:
    up = np.array([0.0, 0.6, 0.8])
    places = np.random.default_rng(2).normal(size=(50, 3))
    np.testing.assert_allclose(slow_path(places, up, 30.0) @ up, 0.0, atol=1e-9)
    np.testing.assert_allclose(slow_path(places + up, up, 30.0), slow_path(places, up, 30.0), atol=1e-9)


def test_sway_and_bounce_of_the_stride_stay() -> None:
    """Of a sway of f Hz the share 1 - 1 / (1 + (f / 0.5)^4) stays: 91 % at 0.9 Hz."""
    t = np.arange(0, 20, 1 / 60)
    for f in (0.9, 1.8):
        sway = np.stack([np.sin(2 * np.pi * f * t), 0 * t, 1.3 * t], axis=1)
        rest = (sway - slow_path(sway, UP, 60.0))[300:900]
        share = np.ptp(rest[:, 0]) / 2.0
        assert share == pytest.approx(1.0 - 1.0 / (1.0 + (f / CUTOFF) ** 4), abs=0.005)
        np.testing.assert_allclose(rest[:, 2], 0.0, atol=1e-9)


def test_the_path_solves_the_equation_it_says() -> None:
    """Oracle: the same least squares as a dense matrix."""
    x = np.random.default_rng(1).normal(size=(40, 3)).cumsum(axis=0)
    second = np.diff(np.eye(40), n=2, axis=0)
    stiffness = (30.0 / (2 * np.pi * CUTOFF)) ** 4
    expected = np.linalg.solve(np.eye(40) + stiffness * second.T @ second, x)
    np.testing.assert_allclose(slow_path(x, UP, 30.0), expected * (1.0 - UP), atol=1e-8)
