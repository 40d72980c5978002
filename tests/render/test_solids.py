"""Bounds against dense points on the surfaces; cameras against what the views are named for."""

import numpy as np
import pytest

from mien.errors import MienError
from mien.render.solids import VIEWS, Camera, Solids, view_axes

UP, FORWARD = np.array([0.0, 0.0, 1.0]), np.array([0.0, -1.0, 0.0])


def test_bounds_hold_every_surface_point_and_no_more():
    rng = np.random.default_rng(3)
    axes, centre = rng.normal(size=(3, 3)), rng.normal(size=3)
    a, b = rng.normal(size=3), rng.normal(size=3)
    solids = Solids(
        a[None, None],
        b[None, None],
        np.array([0.3]),
        np.array([0.1]),
        centre[None, None],
        axes[None, None],
        np.zeros(2, int),
    )
    ball = rng.normal(size=(200_000, 3))
    ball /= np.linalg.norm(ball, axis=1, keepdims=True)
    points = np.concatenate([a + 0.3 * ball, b + 0.1 * ball, centre + ball @ axes.T])
    low, high = solids.bounds(0, np.eye(3))
    np.testing.assert_allclose(low, points.min(axis=0), atol=1e-3)
    np.testing.assert_allclose(high, points.max(axis=0), atol=1e-3)


@pytest.mark.parametrize("view", VIEWS)
def test_a_view_is_a_right_handed_frame(view):
    axes = view_axes(view, UP, FORWARD)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.cross(axes[0], axes[1]), axes[2], atol=1e-12)


def test_from_the_side_the_body_faces_right_and_from_the_left_it_faces_left():
    np.testing.assert_allclose(view_axes("side", UP, FORWARD) @ FORWARD, [1, 0, 0], atol=1e-12)
    np.testing.assert_allclose(view_axes("left", UP, FORWARD) @ FORWARD, [-1, 0, 0], atol=1e-12)


def test_from_the_front_the_body_looks_at_us_and_its_left_is_on_our_right():
    axes = view_axes("front", UP, FORWARD)
    np.testing.assert_allclose(axes @ FORWARD, [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(axes @ np.cross(UP, FORWARD), [1, 0, 0], atol=1e-12)


def test_from_the_top_up_comes_towards_us():
    np.testing.assert_allclose(view_axes("top", UP, FORWARD) @ UP, [0, 0, 1], atol=1e-12)


def test_an_unknown_view_names_the_nearest():
    with pytest.raises(MienError, match="did you mean 'front'"):
        view_axes("frnt", UP, FORWARD)


def test_a_camera_puts_its_centre_at_its_pixel_and_up_is_up():
    camera = Camera(view_axes("side", UP, FORWARD), np.array([1.0, 2.0, 3.0]), 50.0, 40.0, 10.0)
    np.testing.assert_allclose(camera.project(np.array([1.0, 2.0, 3.0])), [50, 40, 0])
    np.testing.assert_allclose(camera.project(np.array([1.0, 2.0, 4.0])), [50, 30, 0], atol=1e-12)
    moved = np.array([[0.2], [-0.3], [0.5]])
    by = camera.project(camera.centre + moved[:, 0]) - camera.project(camera.centre)
    np.testing.assert_allclose(camera.turn(moved)[:, 0], by, atol=1e-12)
