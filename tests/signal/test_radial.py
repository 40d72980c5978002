"""Radial basis functions against SciPy, linear functions and the normal equations."""

import numpy as np
import pytest
from scipy.interpolate import RBFInterpolator

from mien.errors import MienError
from mien.signal.radial import mean_distance, near, through


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(7)


def circle(count: int) -> np.ndarray:
    angles = 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def test_the_mean_distance_of_a_dozen_on_a_circle() -> None:
    assert mean_distance(circle(12)) == pytest.approx(1.381, abs=5e-4)
    assert mean_distance(np.zeros((3, 2))) == 1.0


def test_through_agrees_with_scipy(rng: np.random.Generator) -> None:
    points, values = circle(12), rng.normal(size=(12, 3))
    mine = through(points, values)
    # SciPy's multiquadric is -sqrt(1 + (epsilon r)^2), with the same linear part.
    theirs = RBFInterpolator(points, values, kernel="multiquadric", epsilon=1 / mine.sigma, degree=1)
    asked = rng.uniform(-1, 1, (50, 2))
    np.testing.assert_allclose(mine(asked), theirs(asked), atol=1e-9)
    np.testing.assert_allclose(mine(points), values, atol=1e-9)


def test_through_repeats_linear_functions(rng: np.random.Generator) -> None:
    points, slope = circle(7), rng.normal(size=(2, 4))
    found = through(points, 2.0 + points @ slope)
    np.testing.assert_allclose(found.radial, 0.0, atol=1e-9)
    asked = rng.uniform(-3, 3, (20, 2))
    np.testing.assert_allclose(found(asked), 2.0 + asked @ slope, atol=1e-8)
    constant = through(points, np.full((7, 1), 5.0))
    np.testing.assert_allclose(constant(asked), 5.0, atol=1e-9)


@pytest.mark.parametrize("points", [[[0, 0], [1, 1], [2, 2], [3, 3]], [[0, 0], [1, 0], [0, 1], [0, 1]]])
def test_through_says_when_nothing_is_determined(points: list[list[float]]) -> None:
    with pytest.raises(MienError, match="determine"):
        through(np.array(points), np.zeros((4, 1)))


def test_near_solves_its_normal_equations(rng: np.random.Generator) -> None:
    """Oracle: the penalised least squares written out, with the constant free."""
    points, values, centres = rng.normal(size=(40, 3)), rng.normal(size=(40, 2)), rng.normal(size=(5, 3))
    found = near(points, values, centres, ridge=0.3)
    gauss = np.exp(-((points[:, None] - centres) ** 2).sum(-1) / (2 * found.sigma**2))
    design = np.column_stack([np.ones(40), points, gauss])
    penalty = 0.3 * np.diag([0.0] + [1.0] * 8)
    weights = np.linalg.solve(design.T @ design + penalty, design.T @ values)
    np.testing.assert_allclose(found.constant, weights[0], atol=1e-9)
    np.testing.assert_allclose(found.linear, weights[1:4], atol=1e-9)
    np.testing.assert_allclose(found.radial, weights[4:], atol=1e-9)


def test_near_goes_through_as_many_points_as_weights_without_a_ridge(rng: np.random.Generator) -> None:
    points, values = rng.normal(size=(8, 2)), rng.normal(size=(8, 1))
    found = near(points, values, points[:6], ridge=0.0)
    np.testing.assert_allclose(found(points), values, atol=1e-6)


def test_near_finds_linear_functions_and_the_ridge_by_itself(rng: np.random.Generator) -> None:
    points = rng.normal(size=(200, 4))
    slope = np.array([1.0, -2.0, 0.5, 0.0])
    noisy = (points @ slope + rng.normal(scale=0.1, size=200))[:, None]
    found = near(points, noisy, points[:3])
    fresh = rng.normal(size=(100, 4))
    assert np.abs(found(fresh)[:, 0] - fresh @ slope).mean() < 0.1
    pure_noise = near(points, rng.normal(size=(200, 1)), points[:3])
    assert pure_noise.ridge > found.ridge


def test_near_without_a_linear_part(rng: np.random.Generator) -> None:
    points = rng.normal(size=(30, 2))
    found = near(points, rng.normal(size=(30, 1)), points[:4], linear=False)
    assert not found.linear.any()
    far = found(np.array([[1e6, 0.0]]))
    np.testing.assert_allclose(far[0], found.constant)
