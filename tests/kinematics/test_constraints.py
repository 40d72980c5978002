"""The seven constraints: the error that each means, and its Jacobian against finite differences."""

import numpy as np
import pytest

from mien.kinematics.constraints import (
    AtDistance,
    AtPosition,
    Constraint,
    InRegion,
    OnPath,
    Orientation,
    ParameterRange,
    Point,
    SamePosition,
)

A, B, C = Point(0), Point(1), Point(2)
X = np.array([[1.0, 2.0, 3.0]])
UNIT = np.array([[0.6, 0.0, 0.8]])

ALL = {
    "at position": AtPosition(A, X),
    "in region": InRegion(A, np.array([0.0, 1.0, 0.0]), np.array([9.0])),
    "same position": SamePosition(A, ((0, 40),)),
    "on path": OnPath(A, B, X),
    "at distance": AtDistance(A, B, np.array([0.5])),
    "at least": AtDistance(A, B, np.array([9.0]), "least"),
    "at most": AtDistance(A, B, np.array([0.1]), "most"),
    "orientation": Orientation(A, B, UNIT, 0.7),
    "angle above": ParameterRange(A, B, C, 0.0, 0.3, 0.7),
    "angle below": ParameterRange(A, B, C, 3.0, 3.1, 0.7),
}


def places(constraint: Constraint, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(20, len(constraint.points), 3))


@pytest.mark.parametrize("name", ALL)
def test_jacobian_is_the_derivative_of_the_error(name: str) -> None:
    c = ALL[name]
    x, frames, step = places(c), np.arange(20), 1e-6
    found = c.jacobian(x, frames)
    assert found.shape == (20, c.error(x, frames).shape[1], len(c.points), 3)
    for k in range(len(c.points)):
        for i in range(3):
            if isinstance(c, SamePosition):  # the mean is taken as fixed
                continue
            up, down = x.copy(), x.copy()
            up[:, k, i] += step
            down[:, k, i] -= step
            slope = (c.error(up, frames) - c.error(down, frames)) / (2.0 * step)
            np.testing.assert_allclose(found[:, :, k, i], slope, atol=1e-5, err_msg=f"point {k}, axis {i}")


def test_same_position_moves_with_its_point() -> None:
    c = SamePosition(A, ((5, 15),))
    found = c.jacobian(places(c), np.arange(20))
    np.testing.assert_array_equal(found[5:15, :, 0], np.tile(np.eye(3), (10, 1, 1)))
    assert not found[:5].any()
    assert not found[15:].any()


def test_nothing_is_wrong_where_everything_is_as_asked() -> None:
    frames = np.arange(1)
    u = np.array([[[1.0, 2.0, 3.0]]])
    assert not ALL["at position"].error(u, frames).any()
    assert not InRegion(A, np.array([0.0, 1.0, 0.0]), np.array([2.0])).error(u, frames).any()
    still = np.repeat(u, 20, axis=0)
    assert not ALL["same position"].error(still, np.arange(20)).any()
    pair = np.array([[[1.5, 2.0, 3.0], [0.5, 0.0, 0.0]]])
    assert not OnPath(A, B, np.array([[1.0, 2.0, 3.0]])).error(pair, frames).any()
    apart = np.array([[[3.0, 4.0, 0.0], [0.0, 0.0, 0.0]]])
    for how in ("equal", "least", "most"):
        np.testing.assert_allclose(AtDistance(A, B, np.array([5.0]), how).error(apart, frames), 0.0)
    assert AtDistance(A, B, np.array([6.0]), "least").error(apart, frames)[0, 0] == -1.0
    assert AtDistance(A, B, np.array([6.0]), "most").error(apart, frames)[0, 0] == 0.0
    assert AtDistance(A, B, np.array([4.0]), "most").error(apart, frames)[0, 0] == 1.0
    along = np.array([[[0.6, 0.0, 0.8], [0.0, 0.0, 0.0]]]) * 3.0
    np.testing.assert_allclose(ALL["orientation"].error(along, frames), 0.0, atol=1e-15)


@pytest.mark.parametrize(
    ("angle", "error"), [(10.0, -20.0), (30.0, 0.0), (90.0, 0.0), (150.0, 0.0), (170.0, 20.0)]
)
def test_an_angle_is_measured_at_its_middle_point(angle: float, error: float) -> None:
    low, high = np.radians([30.0, 150.0])
    c = ParameterRange(A, B, C, low, high, 2.0)
    a = np.radians(angle)
    x = np.array([[[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [3 * np.cos(a), 3 * np.sin(a), 0.0]]])
    assert c.error(x, np.arange(1))[0, 0] == pytest.approx(2.0 * np.radians(error), abs=1e-12)


def test_what_is_asked_may_change_from_frame_to_frame() -> None:
    targets = np.arange(60.0).reshape(20, 3)
    c = AtPosition(A, targets)
    np.testing.assert_array_equal(c.error(np.zeros((2, 1, 3)), np.array([4, 7])), -targets[[4, 7]])
