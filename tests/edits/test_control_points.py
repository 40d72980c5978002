"""The edit control_points: what each number does to a walk, and what it leaves alone."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits.control_points import control_points
from mien.kinematics.body import SIDES, Body
from mien.kinematics.control_points import NAMES
from mien.kinematics.landmarks import Landmarks, landmarks
from mien.motion import Motion
from mien.recipe import Step


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=3.0).motion


def places(motion: Motion) -> Landmarks:
    return landmarks(motion, Body.of(motion))


def test_it_lists_the_ten_numbers_in_the_order_of_the_rules() -> None:
    assert tuple(mien.edits.registry.EDITS["control_points"].parameters) == NAMES


def test_nothing_asked_nothing_done(walk: Motion) -> None:
    after = control_points(walk)
    assert after.rotations.tobytes() == walk.rotations.tobytes()
    assert [step.edit for step in after.history] == ["control_points"]


def test_pelvis_and_torso_lower_the_head(walk: Motion) -> None:
    up = Body.of(walk).up
    before = places(walk)["head"] @ up
    for numbers in ({"pelvis": 0.9}, {"torso": 0.4}):
        assert (places(control_points(walk, **numbers))["head"] @ up).mean() < before.mean() - 1e-3


@pytest.mark.parametrize("side", SIDES)
def test_the_ground_is_about_height_alone(walk: Motion, side: str) -> None:
    body = Body.of(walk)
    before, after = places(walk), places(control_points(walk, **{f"{side}_ground": 1.2}))
    moved = after[f"{side}_hand"] - before[f"{side}_hand"]
    assert (moved @ body.up > 0.0).all()
    across = moved - (moved @ body.up)[:, None] * body.up
    assert np.abs(across).max() < 0.02 * body.leg_length
    other = "right" if side == "left" else "left"
    np.testing.assert_array_equal(after[f"{other}_hand"], before[f"{other}_hand"])


def test_feet_stand_and_no_check_fails(walk: Motion) -> None:
    numbers = {"pelvis": 0.93, "torso": 0.5, **{f"{s}_{p}": 1.25 for s in SIDES for p in ("head", "chest")}}
    after = mien.apply(walk, [Step("control_points", numbers), Step("foot_plant")])
    report = mien.check(after)
    assert report.passed, report.failed


def test_head_and_arms_alone(walk: Motion) -> None:
    after = mien.apply(walk, Step("control_points", {"pelvis": 0.9, "left_head": 1.3}), parts="left_arm")
    same = np.abs(after.rotations - walk.rotations).max(axis=(0, 2)) < 1e-12
    body = Body.of(walk)
    assert set(np.flatnonzero(~same)) == {body.roles["left_shoulder"], body.roles["left_elbow"]}
