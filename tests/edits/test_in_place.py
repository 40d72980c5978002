"""In place: the travel goes, sway, bounce and heading stay."""

import numpy as np
import pytest

from mien import samples
from mien.edits.in_place import CUTOFF, in_place, slow_path
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.motion import Motion


def hips(motion: Motion) -> np.ndarray:
    return world(motion)[1][:, Body.of(motion).roles["hips"]] / Body.of(motion).leg_length


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_a_walk_stays_where_it_starts(skeleton: str) -> None:
    walk = samples.walk(seconds=5.0, skeleton=skeleton).motion
    body = Body.of(walk)
    before, after = hips(walk), hips(in_place(walk))
    assert np.ptp(before @ body.forward) > 3.0
    assert np.ptp(after @ body.forward) < 0.1
    np.testing.assert_allclose(after[0], before[0], atol=1e-9)


def test_height_and_rotations_stay() -> None:
    walk = samples.walk(seconds=3.0).motion
    after = in_place(walk)
    up = Body.of(walk).up
    np.testing.assert_allclose(hips(after) @ up, hips(walk) @ up, atol=1e-12)
    np.testing.assert_array_equal(after.rotations, walk.rotations)


def test_sway_and_bounce_of_the_stride_stay() -> None:
    """Of a sway of f Hz the share 1 - 1 / (1 + (f / 0.5)^4) stays: 91 % at 0.9 Hz."""
    t = np.arange(0, 20, 1 / 60)
    for f in (0.9, 1.8):
        sway = np.stack([np.sin(2 * np.pi * f * t), 0 * t, 1.3 * t], axis=1)
        rest = (sway - slow_path(sway, 60.0))[300:900]
        share = np.ptp(rest[:, 0]) / 2.0
        assert share == pytest.approx(1.0 - 1.0 / (1.0 + (f / CUTOFF) ** 4), abs=0.005)
        np.testing.assert_allclose(rest[:, 2], 0.0, atol=1e-9)


def test_the_path_solves_the_equation_it_says() -> None:
    """Oracle: the same least squares as a dense matrix."""
    x = np.random.default_rng(1).normal(size=(40, 3)).cumsum(axis=0)
    second = np.diff(np.eye(40), n=2, axis=0)
    stiffness = (30.0 / (2 * np.pi * CUTOFF)) ** 4
    expected = np.linalg.solve(np.eye(40) + stiffness * second.T @ second, x)
    np.testing.assert_allclose(slow_path(x, 30.0), expected, atol=1e-8)


def test_half_takes_half() -> None:
    walk = samples.walk(seconds=3.0).motion
    whole, half = hips(in_place(walk)), hips(in_place(walk, amount=0.5))
    np.testing.assert_allclose(half, 0.5 * (hips(walk) + whole), atol=1e-9)


def test_standing_hardly_changes() -> None:
    still = samples.still(seconds=3.0).motion
    assert np.abs(hips(in_place(still)) - hips(still)).max() < 0.02


def test_a_turning_walk_keeps_its_heading_and_stays() -> None:
    turn = samples.turn(seconds=4.0).motion
    after = in_place(turn)
    np.testing.assert_array_equal(after.rotations, turn.rotations)
    assert np.ptp(hips(turn), axis=0).max() > 1.5
    assert np.ptp(hips(after), axis=0).max() < 0.25
