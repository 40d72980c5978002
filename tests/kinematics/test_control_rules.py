"""The four rules of table 2: identity and continuity at 1, monotone, and cases worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.kinematics.control_rules import BOUNDS, hand_position, paced, pelvis_height, torso_vector

HEIGHTS = np.array([0.2, 0.7, 0.95, 1.0, 1.1, 1.6])  # of a calm stance of 1: crouched to jumping
TORSO, UPRIGHT = np.array([[0.1, 0.8, 0.3]]), np.array([[0.0, 1.0, 0.02]])
HAND = np.array([[0.3, 0.9, 0.2]])
SPOTS = np.array([[[0.0, 1.6, 0.0], [0.0, 1.3, 0.0], [0.0, 0.9, 0.0], [0.3, 0.0, 0.2]]])
ONE = 1e-9


def test_at_one_nothing_changes() -> None:
    assert pelvis_height(HEIGHTS, 1.0, 1.0).tolist() == HEIGHTS.tolist()
    np.testing.assert_allclose(torso_vector(TORSO, UPRIGHT, 1.0), TORSO, atol=1e-15)
    assert hand_position(HAND, SPOTS, np.ones(4)).tolist() == HAND.tolist()
    assert paced(HEIGHTS, 1.0, order=3).tolist() == HEIGHTS.tolist()


@pytest.mark.parametrize("c", [1.0 - ONE, 1.0 + ONE])
def test_there_is_no_jump_at_one(c: float) -> None:
    """As it is printed, g1 jumps by how much higher than the calm stance the pelvis is."""
    np.testing.assert_allclose(pelvis_height(HEIGHTS, 1.0, c), HEIGHTS, atol=1e-8)
    np.testing.assert_allclose(torso_vector(TORSO, UPRIGHT, c), TORSO, atol=1e-8)
    np.testing.assert_allclose(hand_position(HAND, SPOTS, np.full(4, c)), HAND, atol=1e-8)


@pytest.mark.parametrize("height", HEIGHTS.tolist())
def test_the_pelvis_rises_with_its_coefficient(height: float) -> None:
    c = np.linspace(*BOUNDS["pelvis"], 81)
    found = np.concatenate([pelvis_height(np.array([height]), 1.0, one) for one in c])
    steps = np.diff(found)
    assert (steps >= 0.0).all()
    assert (steps[:40] > 0.0).all()
    if height < 1.0:
        assert found.max() < 1.0, "it never passes the calm stance"


def test_a_coefficient_for_each_frame_is_as_one_for_all() -> None:
    c = np.array([0.8, 0.9, 1.0, 1.1, 1.2, 1.3])
    each = [float(pelvis_height(HEIGHTS[i : i + 1], 1.0, c[i])[0]) for i in range(6)]
    np.testing.assert_allclose(pelvis_height(HEIGHTS, 1.0, c), each)
    many = np.repeat(TORSO, 6, axis=0)
    np.testing.assert_allclose(torso_vector(many, UPRIGHT, c)[2], TORSO[0])


def test_the_torso_goes_from_bent_to_upright() -> None:
    far = torso_vector(TORSO, UPRIGHT, 1e9)
    np.testing.assert_allclose(far, UPRIGHT, atol=1e-8)
    away = [
        float(np.linalg.norm(torso_vector(TORSO, UPRIGHT, c) - UPRIGHT)) for c in (0.3, 0.6, 1.0, 2.0, 5.0)
    ]
    assert away == sorted(away, reverse=True)
    np.testing.assert_allclose(torso_vector(UPRIGHT, UPRIGHT, 0.3), UPRIGHT)


@given(st.floats(0.5, 2.0))
def test_a_common_factor_scales_the_way_from_a_common_place(c: float) -> None:
    spots = np.repeat(np.array([[[0.1, 1.2, -0.1]]]), 4, axis=1)
    moved = hand_position(HAND, spots, np.full(4, c))
    np.testing.assert_allclose(moved - spots[:, 0], c * (HAND - spots[:, 0]), atol=1e-12)


def test_each_place_pulls_for_a_quarter() -> None:
    for place, way in enumerate(([0.3, -0.7, 0.2], [0.3, -0.4, 0.2], [0.3, 0.0, 0.2], [0.0, 0.9, 0.0])):
        c = np.ones(4)
        c[place] = 1.4
        np.testing.assert_allclose(hand_position(HAND, SPOTS, c) - HAND, [0.1 * np.array(way)], atol=1e-12)


def test_the_pace_of_derivatives() -> None:
    assert paced(np.array([2.0]), 1.5).tolist() == [3.0]
    assert paced(np.array([2.0, 2.0, 2.0]), 2.0, order=np.array([1, 2, 3])).tolist() == [4.0, 8.0, 16.0]
