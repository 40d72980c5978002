"""Control points on a body: they get where the rules want them, with bones whole and feet where they were."""

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import SIDES, Body
from mien.kinematics.contacts import detect
from mien.kinematics.control_points import NAMES, moved, rest_height, rest_torso
from mien.kinematics.control_rules import hand_position, pelvis_height, torso_vector
from mien.kinematics.landmarks import Landmarks, landmarks
from mien.motion import Motion

CLIPS = ("walk", "wave", "jump", "punch")


def done(name: str, **given: float) -> tuple[Motion, Body, Landmarks, Landmarks]:
    motion = samples.SAMPLES[name]().motion
    body = Body.of(motion)
    values = np.array([given.get(n, 1.0) for n in NAMES])
    after = moved(motion, body, values, detect(motion).feet)
    return motion, body, landmarks(motion, body), landmarks(after, body)


@pytest.mark.parametrize("name", CLIPS)
def test_the_pelvis_gets_down_and_the_feet_stay(name: str) -> None:
    motion, body, before, after = done(name, pelvis=0.9)
    height = before["pelvis"] @ body.up - body.floor
    wanted = pelvis_height(height, rest_height(motion, body), 0.9)
    slack = 0.01 * body.leg_length
    np.testing.assert_allclose(after["pelvis"] @ body.up - body.floor, wanted, atol=slack)
    for side in SIDES:
        np.testing.assert_allclose(after[f"{side}_foot"], before[f"{side}_foot"], atol=slack)


@pytest.mark.parametrize("c", [0.3, 0.6, 5.0])
@pytest.mark.parametrize("name", CLIPS)
def test_the_head_lies_where_the_rule_wants_it(name: str, c: float) -> None:
    motion, body, before, after = done(name, torso=c)
    rest = rest_torso(motion, body, before.positions)
    wanted = torso_vector(before["head"] - before["pelvis"], rest, c)
    found = after["head"] - after["pelvis"]
    cosine = (
        np.einsum("ti,ti->t", wanted, found) / np.linalg.norm(wanted, axis=1) / np.linalg.norm(found, axis=1)
    )
    assert np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))).max() < 0.05
    for side in SIDES:  # arms go on hanging
        arm = [now[f"{side}_elbow"] - now[f"{side}_shoulder"] for now in (before, after)]
        np.testing.assert_allclose(*arm, atol=1e-6 * body.leg_length)


@pytest.mark.parametrize("name", CLIPS)
def test_hands_get_where_they_should_within_reach(name: str) -> None:
    _, body, before, after = done(name, left_head=0.9, left_pelvis=0.8, right_chest=0.8)
    for side, c in (("left", [0.9, 1.0, 0.8, 1.0]), ("right", [1.0, 0.8, 1.0, 1.0])):
        hand = before[f"{side}_hand"]
        ground = hand - (hand @ body.up - body.floor)[:, None] * body.up
        spots = np.stack([before["head"], before["chest"], before["pelvis"], ground], axis=1)
        wanted = hand_position(hand, spots, np.array(c))
        length = sum(
            np.linalg.norm(before[f"{side}_{a}"] - before[f"{side}_{b}"], axis=1)
            for a, b in (("shoulder", "elbow"), ("elbow", "hand"))
        )
        near = np.linalg.norm(wanted - before[f"{side}_shoulder"], axis=1) < 0.96 * length
        assert near.mean() > 0.3, "or this test shows little"
        away = np.linalg.norm(after[f"{side}_hand"] - wanted, axis=1)
        assert away[near].max() < 1e-6 * body.leg_length
        assert away.max() < 0.05 * length.max()


def test_a_hand_out_of_reach_is_approached_and_the_arm_never_stretched() -> None:
    _, _, before, after = done("wave", **dict.fromkeys(NAMES[2:], 2.0))
    for side in SIDES:
        for a, b in (("shoulder", "elbow"), ("elbow", "hand")):
            bones = [np.linalg.norm(x[f"{side}_{a}"] - x[f"{side}_{b}"], axis=1) for x in (before, after)]
            np.testing.assert_allclose(*bones, rtol=1e-9)


def test_coefficients_of_each_frame_are_as_those_of_a_clip() -> None:
    motion = samples.walk(seconds=1.0).motion
    body, planted = Body.of(motion), detect(motion).feet
    values = np.array([0.95, 0.7, *[1.1] * 8])
    one = moved(motion, body, values, planted)
    other = moved(motion, body, np.repeat(values[None], len(motion), axis=0), planted)
    np.testing.assert_array_equal(one.rotations, other.rotations)
    assert moved(motion, body, np.ones(10), planted) is motion


def test_a_pelvis_that_should_rise_never_comes_down() -> None:
    """Legs that are straight while they stand have no room to rise, and lose none; soft knees have some."""
    for name in ("wave", "walk", "tired_walk"):
        _, body, before, after = done(name, pelvis=1.3)
        risen = (after["pelvis"] - before["pelvis"]) @ body.up / body.leg_length
        assert risen.min() > -0.001
        assert bool(risen.max() > 0.003) is (name == "tired_walk")
        for side in SIDES:
            np.testing.assert_allclose(
                after[f"{side}_foot"], before[f"{side}_foot"], atol=0.01 * body.leg_length
            )
