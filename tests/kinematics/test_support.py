"""The polygon that a body stands on."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.support import HALF_WIDTH, TOES, outside, way_in


def distance(point: np.ndarray, corners: np.ndarray) -> float:
    """How far a point of the plane is outside the hull of some corners, by every edge; 0 inside."""
    hull = ConvexHull(corners)
    if (hull.equations[:, :2] @ point + hull.equations[:, 2] <= 0).all():
        return 0.0
    best = np.inf
    for a, b in corners[hull.simplices]:
        share = np.clip((point - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
        best = min(best, float(np.linalg.norm(point - a - share * (b - a))))
    return best


def stand() -> tuple[Body, np.ndarray]:
    body = Body.of(samples.still(seconds=0.1).motion)
    feet = np.zeros((1, 2, 2, 3))
    for foot, aside in enumerate((12.0, -12.0)):
        feet[0, foot, 0] = aside * body.left - 5.0 * body.forward
        feet[0, foot, 1] = aside * 1.3 * body.left + 14.0 * body.forward
    return body, feet


def corners_of(body: Body, feet: np.ndarray, standing: tuple[bool, bool]) -> np.ndarray:
    """The corners, in the plane of forward and left, of feet with rounded edges and toes."""
    seen = feet @ np.stack([body.forward, body.left], axis=1)  # in the plane
    width, toes = HALF_WIDTH * body.leg_length, TOES * body.leg_length
    round_foot = width * np.stack([np.cos(a := np.linspace(0, 2 * np.pi, 200)), np.sin(a)], axis=1)
    corners = []
    for foot in np.flatnonzero(standing):
        line = seen[0, foot, 1] - seen[0, foot, 0]
        tip = seen[0, foot, 1] + toes * line / np.linalg.norm(line)
        corners += [seen[0, foot, 0] + round_foot, seen[0, foot, 1] + round_foot, tip + round_foot]
    return np.concatenate(corners)


@pytest.mark.parametrize("standing", [(True, True), (True, False), (False, True)])
def test_against_the_hull_of_scipy(standing: tuple[bool, bool]) -> None:
    body, feet = stand()
    planted = np.zeros((1, 2, 2), bool)
    planted[0, np.array(standing)] = True
    corners = corners_of(body, feet, standing)
    random = np.random.default_rng(3)
    for _ in range(60):
        at = random.uniform(-60, 60, 2)
        point = at[0] * body.forward + at[1] * body.left + 30.0 * body.up
        found = outside(point[None], feet, planted, body)[0]
        wanted = distance(at, corners)
        if wanted > 0.0:
            assert found == pytest.approx(wanted, rel=0.01, abs=0.25)
        else:
            assert found <= 0.1


def test_one_planted_point_stands_for_its_whole_foot_and_nothing_for_nothing() -> None:
    body, feet = stand()
    heel = np.zeros((1, 2, 2), bool)
    heel[0, 0, 0] = True
    whole = heel.copy()
    whole[0, 0, 1] = True
    point = np.array([[3.0, 0.0, 4.0]])
    assert outside(point, feet, heel, body) == outside(point, feet, whole, body)
    assert np.isnan(outside(point, feet, np.zeros((1, 2, 2), bool), body)[0])


@pytest.mark.parametrize("standing", [(True, True), (True, False)])
def test_the_way_in_ends_on_the_edge(standing: tuple[bool, bool]) -> None:
    """Against the hull of SciPy: as long as the point is outside, and from there it is no more."""
    body, feet = stand()
    planted = np.zeros((1, 2, 2), bool)
    planted[0, np.array(standing)] = True
    corners, random = corners_of(body, feet, standing), np.random.default_rng(4)
    for _ in range(60):
        at = random.uniform(-60, 60, 2)
        point = (at[0] * body.forward + at[1] * body.left + 30.0 * body.up)[None]
        way = way_in(point, feet, planted, body)[0]
        assert abs(float(way @ body.up)) < 1e-9
        assert np.linalg.norm(way) == pytest.approx(distance(at, corners), abs=0.01)
        there = at + [way @ body.forward, way @ body.left]
        assert distance(there, corners) < 0.01


def test_without_support_there_is_no_way() -> None:
    body, feet = stand()
    assert not way_in(np.ones((1, 3)), feet, np.zeros((1, 2, 2), bool), body).any()
