"""The feet of a blend: the clips' own where all are one clip, planted while all stand, never in the floor."""

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.contacts import spans
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.styles.footing import feet_of, with_feet
from mien.styles.route import Route, blended, route_of
from mien.styles.shares import Shares, shares

SIDES = ("left", "right")


@pytest.fixture(scope="module")
def strides() -> list[Motion]:
    """Two walks in step, one with long steps and straight on, one with short steps to the side."""
    form = {"seconds": 3.0, "fps": 60.0}
    return [samples.walk(**form).motion, samples.walk(step_length=0.45, heading=0.8, **form).motion]


def put(clips: list[Motion], made: Motion, parts: Shares) -> tuple[Motion, Route, list[Route]]:
    body = Body.of(clips[0])
    spots = [world(clip) for clip in clips]
    routes = [route_of(positions, body) for _, positions in spots]
    feet = [feet_of(c, s, r, Body.of(c)) for c, s, r in zip(clips, spots, routes, strict=True)]
    way = blended(routes, parts, body, made.fps)
    return with_feet(made, feet, routes, way, parts, body), way, routes


def ankles(motion: Motion, body: Body) -> np.ndarray:
    return world(motion)[1][:, [body.roles[f"{side}_ankle"] for side in SIDES]]


def test_of_one_clip_the_feet_are_where_they_are(strides):
    body = Body.of(strides[0])
    for motion in strides:
        found, _, _ = put([motion, motion], motion, shares(2, [0.3, 0.7], None))
        np.testing.assert_allclose(ankles(found, body), ankles(motion, body), atol=1e-9)
        np.testing.assert_allclose(found.rotations, motion.rotations, atol=1e-9)


@pytest.mark.parametrize("bands", [None, {"low": [0, 1]}])
def test_a_foot_that_stands_in_both_stands(strides, bands):
    """Put on the body of the first clip, feet go where they must, off their legs."""
    body = Body.of(strides[0])
    truth = [samples.walk(seconds=3.0, fps=60.0, step_length=step).contacts for step in (0.7, 0.45)]
    flat = np.all([contacts.all(axis=2) for contacts in truth], axis=0)  # heel and toe down in both
    found, _, _ = put(strides, strides[0], shares(2, [0.5, 0.5], bands))
    seen = ankles(found, body)
    stood = 0
    for foot in range(2):
        for start, stop in spans(flat[:, foot]):
            stood += 1
            assert np.ptp(seen[start:stop, foot], axis=0).max() < 0.005 * body.leg_length
    assert stood > 3


def test_a_step_is_half_way_between_the_steps(strides):
    body = Body.of(strides[0])
    found, way, routes = put(strides, strides[0], shares(2, [0.5, 0.5], None))

    def reach(motion: Motion, route: Route) -> float:
        seen = ankles(motion, body) - route.ground[:, None]
        facing = np.stack([np.sin(route.heading), np.zeros(len(motion)), np.cos(route.heading)], axis=1)
        return float(np.ptp(np.einsum("tfi,ti->tf", seen, facing), axis=0).mean())

    one, other = (reach(clip, route) for clip, route in zip(strides, routes, strict=True))
    assert reach(found, way) == pytest.approx(0.5 * (one + other), rel=0.02)


@pytest.mark.parametrize("w", [-0.6, 1.6])
def test_no_foot_is_in_the_floor_however_much_is_exaggerated(strides, w):
    """The samples' floor is at 0; toes and end sites are the lowest points of their feet."""
    body = Body.of(strides[0])
    found, _, _ = put(strides, strides[0], shares(2, [1 - w, w], None))
    joints = [body.roles[f"{side}_{role}"] for side in SIDES for role in ("ankle", "toe")]
    lowest = min(world(clip)[1][:, joints, 1].min() for clip in strides)
    assert world(found)[1][:, joints, 1].min() > lowest - 0.003 * body.leg_length
