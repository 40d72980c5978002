"""In place: the travel goes, sway, bounce and heading stay."""

import numpy as np
import pytest

from mien import samples
from mien.edits.in_place import in_place
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
