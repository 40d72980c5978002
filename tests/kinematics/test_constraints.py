"""The seven constraints: the error that each means, and its Jacobian against finite differences."""

import numpy as np
import pytest

from mien.errors import MienError
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
    check,
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


def test_a_place_may_be_given_where_a_point_stays() -> None:
    given = SamePosition(A, ((5, 15),), place=X)
    x = places(given)
    found = given.error(x, np.arange(20))
    np.testing.assert_allclose(found[5:15], (x[:, 0] - X)[5:15])
    assert not found[:5].any()
    assert not found[15:].any()
    assert given.held(x[:, 0]) is given


def test_without_spans_nothing_has_to_stay() -> None:
    nothing = SamePosition(A, ())
    assert not nothing.error(places(nothing), np.arange(20)).any()
    assert not nothing.jacobian(places(nothing), np.arange(20)).any()


def test_bounds_are_known_as_such() -> None:
    bounds = [name for name, c in ALL.items() if c.bound]
    assert bounds == ["in region", "at least", "at most", "angle above", "angle below"]


def test_where_there_is_no_direction_there_is_no_slope() -> None:
    """Points at one place: one over their distance would be infinite."""
    c = Orientation(A, B, UNIT, 0.7)
    same = np.ones((4, 2, 3))
    same[1:, 0] += np.array([1e-15, 1e-12, 1e-3])[:, None]
    found = c.jacobian(same, np.arange(4))
    assert not found[:3].any()
    assert np.abs(found[3]).max() > 100.0


def test_three_points_in_line_can_be_bent_either_way() -> None:
    """The angle is at its largest, so any way across is a way down: at the rate that bending has."""
    c = ParameterRange(A, B, C, 0.0, 2.0, 1.0)
    line = np.array([[[-1.0, -2.0, -2.0], [0.0, 0.0, 0.0], [2.0, 4.0, 4.0]]])
    slope = c.jacobian(line, np.arange(1))[0, 0]
    np.testing.assert_allclose(np.linalg.norm(slope, axis=1), [1 / 3, 1 / 3 + 1 / 6, 1 / 6], rtol=1e-12)
    np.testing.assert_allclose(slope @ [1.0, 2.0, 2.0], 0.0, atol=1e-12)
    moved = line - 0.3 * slope
    assert c.error(moved, np.arange(1))[0, 0] < c.error(line, np.arange(1))[0, 0]


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (AtPosition(A, np.zeros((7, 3))), r"target must have the shape \(1, 3\), or \(20, 3\).*\(7, 3\)"),
        (AtPosition(A, np.zeros(3)), "target"),
        (AtPosition(A, np.zeros((1, 3)), np.ones(3)), "share must have the shape"),
        (AtPosition(A, np.zeros((1, 3)), np.array([1.5])), "share must be from 0 to 1"),
        (AtPosition(A, np.zeros((1, 3)), np.array([np.nan])), "share must be from 0 to 1"),
        (InRegion(A, UNIT[0], np.zeros((1, 1))), "level"),
        (AtDistance(A, B, np.zeros(21)), "distance"),
        (Orientation(A, B, np.zeros((20, 2)), 1.0), "direction"),
        (OnPath(A, B, np.zeros((19, 3))), "offset"),
        (SamePosition(A, (), place=np.zeros((19, 3))), "place"),
        (AtPosition(Point(5), X), r"no joint 5.*0 to 4"),
        (AtPosition(Point(-1), X), "no joint -1"),
        (AtPosition(Point(0, np.zeros((7, 3))), X), "offset of a point"),
    ],
)
def test_what_does_not_fit_the_clip_is_refused(made: Constraint, said: str) -> None:
    with pytest.raises(MienError, match="^wrist .*" + said):
        check(made, "wrist", frames=20, joints=5)


@pytest.mark.parametrize("name", ALL)
def test_what_fits_is_let_through(name: str) -> None:
    check(ALL[name], name, frames=20, joints=3)


def test_there_are_three_ways_to_ask_for_a_distance() -> None:
    with pytest.raises(MienError, match="did you mean 'least'"):
        AtDistance(A, B, np.ones(1), "leest")
