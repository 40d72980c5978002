"""The body as round rods, and how deep they are inside each other."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.capsules import capsules, nearest
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.samples import SKELETONS

place = st.tuples(*[st.floats(-2, 2)] * 3)
segment = st.tuples(place, place)


def apart(one: np.ndarray, other: np.ndarray, s: float, t: float) -> float:
    return float(np.linalg.norm(one[0] + s * (one[1] - one[0]) - other[0] - t * (other[1] - other[0])))


@given(segment, segment)
def test_nearest_points_against_an_optimiser(a: tuple, b: tuple) -> None:
    one, other = np.array(a), np.array(b)
    s, t = (float(x) for x in nearest(one, other))
    assert 0.0 <= s <= 1.0
    assert 0.0 <= t <= 1.0
    found = apart(one, other, s, t)
    best = min(
        minimize(
            lambda x: apart(one, other, *x) ** 2, start, bounds=[(0, 1), (0, 1)], options={"ftol": 1e-15}
        ).fun
        for start in ((0.5, 0.5), (0.0, 1.0), (1.0, 0.0))
    )
    assert found <= np.sqrt(max(best, 0.0)) + 1e-4


@pytest.mark.parametrize(
    ("one", "other", "distance"),
    [
        ([[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0]], 1.0),  # parallel
        ([[0, 0, 0], [1, 0, 0]], [[2, 0, 0], [3, 0, 0]], 1.0),  # one after the other
        ([[0, 0, 0], [1, 0, 0]], [[0.5, 1, -1], [0.5, 1, 1]], 1.0),  # crossing
        ([[0, 0, 0], [0, 0, 0]], [[0, 3, 4], [0, 3, 4]], 5.0),  # points
        ([[0, 0, 0], [0, 0, 0]], [[-1, 2, 0], [1, 2, 0]], 2.0),
    ],
)
def test_nearest_points_of_plain_cases(one: list, other: list, distance: float) -> None:
    a, b = np.array(one, float), np.array(other, float)
    assert apart(a, b, *(float(x) for x in nearest(a, b))) == pytest.approx(distance)


def depths(motion: Motion) -> dict[str, np.ndarray]:
    """Depth (T,) of each pair, in centimetres."""
    body = Body.of(motion)
    shape = capsules(motion, body)
    found = shape.contacts(*world(motion)).depth * 100.0 * body.metres_per_unit
    return dict(zip(shape.pair_names(), found.T, strict=True))


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_a_body_at_rest_does_not_touch_itself(skeleton: str) -> None:
    found = depths(samples.still(seconds=0.5, skeleton=skeleton).motion)
    assert max(d.max() for d in found.values()) < 1.0


def test_the_same_whatever_unit_and_axes() -> None:
    one = depths(samples.walk(seconds=1.0, unit="cm").motion)
    other = depths(samples.walk(seconds=1.0, unit="inch", up="z", heading=1.0).motion)
    for name, found in one.items():
        np.testing.assert_allclose(found, other[name], atol=0.05)


def test_a_straight_arm_swung_down_through_the_thigh_is_as_deep_as_geometry_says() -> None:
    """Turn the arm in until the hand is inside the thigh, and check one frame by hand."""
    motion = samples.still(seconds=0.2, sway=0.0).motion
    body = Body.of(motion)
    shape = capsules(motion, body)
    rotations, positions = world(motion)
    lines = shape.lines(rotations, positions)[0]
    hand, thigh = shape.names.index("left_hand"), shape.names.index("left_thigh")
    grid = np.linspace(0.0, 1.0, 401)
    a = lines[hand, 0] + grid[:, None] * (lines[hand, 1] - lines[hand, 0])
    b = lines[thigh, 0] + grid[:, None] * (lines[thigh, 1] - lines[thigh, 0])
    distance = np.linalg.norm(a[:, None] - b[None], axis=-1).min()
    wanted = shape.radii[hand] + shape.radii[thigh] - distance
    pair = shape.pair_names().index("left_hand-left_thigh")
    assert shape.contacts(rotations, positions).depth[0, pair] == pytest.approx(wanted, abs=1e-3)


def test_parts_that_join_are_not_paired() -> None:
    names = capsules(
        samples.still(seconds=0.1).motion, Body.of(samples.still(seconds=0.1).motion)
    ).pair_names()
    for joined in ("left_hand-left_forearm", "left_forearm-left_upper_arm", "left_shank-left_thigh"):
        assert joined not in names
        assert "-".join(joined.split("-")[::-1]) not in names
    assert {"left_hand-right_hand", "left_hand-head", "right_shank-left_shank"} & {
        *names,
        *("-".join(n.split("-")[::-1]) for n in names),
    }
