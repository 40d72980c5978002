"""The way over the ground: taken apart and put together again, and blended on cases worked out by hand."""

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.styles.route import Route, blended, route_of
from mien.styles.shares import shares


@pytest.fixture(scope="module")
def body() -> Body:
    return Body.of(samples.walk(seconds=1.0).motion)


def straight(angle: float, speed: float, *, frames: int = 50, start: tuple = (0, 0, 0)) -> Route:
    """A walker who faces ``angle`` to the left of +z and goes ``speed`` a frame that way; up is +y."""
    way = np.arange(frames)[:, None] * speed * np.array([np.sin(angle), 0, np.cos(angle)])
    return Route(way + start, np.full(frames, angle), np.full(frames, 90.0))


def circle(rate: float, speed: float, *, frames: int = 200) -> Route:
    """A walker on an arc, turning by ``rate`` and going ``speed`` in each frame."""
    angle = rate * np.arange(frames)
    half = 0.5 * (angle[1:] + angle[:-1])
    steps = speed * np.stack([np.sin(half), np.zeros(frames - 1), np.cos(half)], axis=1)
    return Route(np.concatenate([np.zeros((1, 3)), steps.cumsum(axis=0)]), angle, np.full(frames, 90.0))


@pytest.mark.parametrize("name", ["walk", "turn", "spin", "jump"])
def test_apart_and_together_is_the_same(name):
    motion = samples.SAMPLES[name](heading=2.9).motion
    body, positions = Body.of(motion), world(motion)[1]
    route = route_of(positions, body)
    made = blended([route, route], shares(2, [0.3, 0.7], None), body, 60.0)
    np.testing.assert_allclose(made.hips(body), positions[:, body.roles["hips"]], atol=1e-9)
    np.testing.assert_allclose(made.heading, route.heading, atol=1e-12)


def test_speeds_add_up_whichever_way_the_walkers_face(body):
    for angle in (0.0, 0.7, 2.0, -3.0):
        made = blended([straight(0.0, 1.0), straight(angle, 3.0)], shares(2, [0.5, 0.5], None), body, 60.0)
        np.testing.assert_allclose(np.linalg.norm(np.diff(made.ground, axis=0), axis=1), 2.0)
        np.testing.assert_allclose(made.heading, 0.5 * angle, atol=1e-12)
        went = made.ground[-1] / np.linalg.norm(made.ground[-1])
        np.testing.assert_allclose(went, [np.sin(0.5 * angle), 0, np.cos(0.5 * angle)], atol=1e-12)


def test_two_arcs_make_an_arc_between_them(body):
    made = blended([circle(0.01, 1.0), circle(0.03, 2.0)], shares(2, [0.5, 0.5], None), body, 60.0)
    np.testing.assert_allclose(made.ground, circle(0.02, 1.5).ground, atol=1e-9)


def test_it_starts_at_the_mean_place(body):
    clips = [straight(0, 1, start=(10, 0, 0)), straight(0, 1, start=(0, 0, 30))]
    np.testing.assert_allclose(
        blended(clips, shares(2, [0.8, 0.2], None), body, 60.0).ground[0], [8, 0, 6], atol=1e-12
    )


@pytest.mark.parametrize("turns", [-2, 1, 3])
def test_whole_turns_at_the_start_do_not_count(body, turns):
    a, b = straight(0.2, 1.0), straight(0.4, 1.0)
    wound = Route(b.ground, b.heading + 2 * np.pi * turns, b.height)
    made = blended([a, wound], shares(2, [0.5, 0.5], None), body, 60.0)
    np.testing.assert_allclose(made.heading % (2 * np.pi), 0.3, atol=1e-12)


def test_facing_backwards_the_short_way_is_taken(body):
    """Headings of 170 and -170 degrees have 180 between them, not 0."""
    made = blended(
        [straight(np.radians(170), 1), straight(np.radians(-170), 1)], shares(2, [0.5, 0.5], None), body, 60.0
    )
    assert np.cos(made.heading[0]) == pytest.approx(-1.0)


def test_height_follows_its_bands(body):
    """The slow mean from one, the bobbing at 4 Hz from the other."""
    t = np.arange(600) / 60
    low = Route(np.zeros((600, 3)), np.zeros(600), np.full(600, 80.0))
    bobbing = Route(np.zeros((600, 3)), np.zeros(600), 90.0 + np.sin(2 * np.pi * 4 * t))
    parts = shares(2, None, {"low": [1, 0], "mid": [0, 1], "high": [0, 1]})
    height = blended([low, bobbing], parts, body, 60.0).height[120:-120]
    assert height.mean() == pytest.approx(80.0, abs=0.05)
    assert height.std() == pytest.approx(np.sqrt(0.5), abs=0.02)
