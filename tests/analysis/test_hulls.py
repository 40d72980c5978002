"""Hulls of every frame at once, against Qhull frame by frame and against solids of known volume."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull, QhullError

from mien.analysis.hulls import faces_volumes, hull_faces, hull_size, hull_volumes

CUBE = np.array(list(product((0.0, 1.0), repeat=3)))


def slow_twin(points: np.ndarray, group: list[int]) -> float:
    try:
        return float(ConvexHull(points[group]).volume) if len(group) > 3 else 0.0
    except QhullError:
        return 0.0


@pytest.mark.parametrize(
    "extra", [[], [[0.5, 0.5, 0.5]], [[0.5, 0.5, 1.0], [0.0, 0.5, 0.0], [1.0, 1.0, 1.0]]]
)
def test_a_unit_cube_whatever_lies_inside_it_or_on_it(extra: list[list[float]]) -> None:
    points = np.concatenate([CUBE, np.array(extra).reshape(-1, 3)])
    found = hull_volumes(points[None], [range(len(points))])
    assert found[0, 0] == pytest.approx(1.0, abs=1e-6)


def test_five_points_two_tetrahedra() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.3, 0.3, 2], [0.3, 0.3, -1]], float)
    assert hull_volumes(points[None], [range(5)])[0, 0] == pytest.approx(0.5 * (2 + 1) / 3, rel=1e-5)


def test_flat_thin_and_empty_hulls_are_nothing() -> None:
    plane = np.array([[x, y, 0.0] for x in range(3) for y in range(3)])
    line = np.outer(np.arange(5.0), [1.0, 2.0, 3.0])
    point = np.ones((6, 3))
    for points in (plane, line, point):
        assert hull_volumes(points[None], [range(len(points))])[0, 0] == 0.0
        assert hull_size(points) == 0.0
    assert hull_volumes(CUBE[None], [[0, 1, 2], [], [5]]).tolist() == [[0.0, 0.0, 0.0]]
    assert hull_volumes(CUBE[None], []).shape == (1, 0)
    assert hull_volumes(CUBE[None, :3], [[0, 1, 2]]).tolist() == [[0.0]]
    assert hull_size(np.zeros((0, 3))) == 0.0


def test_groups_share_points_and_frames_differ() -> None:
    rng = np.random.default_rng(3)
    points = rng.normal(size=(90, 19, 3)) * rng.uniform(0.1, 5.0, (90, 1, 1)) + 100.0
    groups = [[0, 4, 9, 12, 18], list(range(19)), list(range(3, 13)), [18, 1, 7, 3], [2, 5]]
    found = hull_volumes(points, groups)
    expected = np.array([[slow_twin(p, g) for g in groups] for p in points])
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-9)


def test_the_number_of_frames_does_not_matter() -> None:
    points = np.random.default_rng(5).normal(size=(150, 19, 3))
    whole = hull_volumes(points, [range(19), range(8)])
    np.testing.assert_allclose(hull_volumes(points[40:77], [range(19), range(8)]), whole[40:77], rtol=1e-12)


@given(st.lists(st.tuples(*[st.integers(-2, 2)] * 3), min_size=4, max_size=9))
def test_points_on_a_grid_where_ties_are_the_rule(corners: list[tuple[int, int, int]]) -> None:
    points = np.array(corners, float)
    found = hull_volumes(points[None], [range(len(points))])[0, 0]
    assert found == pytest.approx(slow_twin(points, list(range(len(points)))), abs=1e-7)


@given(st.integers(0, 10_000), st.floats(1e-3, 1e3))
def test_scale_turn_and_shift(seed: int, scale: float) -> None:
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(1, 9, 3))
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    moved = scale * (points @ turn.T + rng.normal(size=3))
    one, other = (hull_volumes(p, [range(9)])[0, 0] for p in (points, moved))
    assert other == pytest.approx(scale**3 * one, rel=1e-6)


def test_the_area_of_a_path() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 1000)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    assert hull_size(circle) == pytest.approx(np.pi, rel=1e-4)
    assert hull_size(np.stack([angle, 2.0 * angle], axis=1)) == 0.0


@pytest.mark.parametrize("count", [4, 7, 19])
def test_the_faces_of_a_hull_hold_its_volume_and_look_outwards(count: int) -> None:
    points = np.random.default_rng(count).normal(size=(9, count, 3))
    groups = [range(count), range(4), range(count)[-5:]]
    found = hull_faces(points, groups)
    np.testing.assert_allclose(faces_volumes(points, found), hull_volumes(points, groups), rtol=1e-6)
    for frame, faces in zip(points, found[0], strict=True):
        a, b, c = (frame[faces[:, i]] for i in range(3))
        outwards = np.einsum("fi,fi->f", np.cross(b - a, c - a), a - frame.mean(axis=0))
        real = faces.any(axis=1)
        assert (outwards[real] > 0.0).all()
        assert set(faces[real].ravel()) == set(ConvexHull(frame).vertices)


def test_faces_are_good_for_points_nearby() -> None:
    random = np.random.default_rng(3)
    points = random.normal(size=(20, 19, 3))
    near = points + 0.01 * random.normal(size=points.shape)
    old, true = faces_volumes(near, hull_faces(points, [range(19)])), hull_volumes(near, [range(19)])
    assert np.abs(old / true - 1.0).max() < 0.005
    assert np.abs(hull_volumes(points, [range(19)]) / true - 1.0).max() > 0.01, "or this shows nothing"


def test_faces_of_too_few_points_are_none() -> None:
    assert [f.shape for f in hull_faces(np.zeros((2, 3, 3)), [range(3)])] == [(2, 0, 3)]
    assert faces_volumes(np.zeros((2, 3, 3)), hull_faces(np.zeros((2, 3, 3)), [range(3)])).tolist() == [
        [0],
        [0],
    ]
