"""Ankles: where they are, halfway between two, and legs that follow them."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from mien.kinematics.ankles import Ankles, move_ankles
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.rotations import quaternion
from mien.samples import SKELETONS, walk


def clip(skeleton="standard22"):
    return walk(seconds=1.0, fps=30.0, skeleton=skeleton).motion


def test_they_are_where_forward_kinematics_has_them():
    motion = clip()
    body = Body.of(motion)
    rotations, positions = world(motion)
    joints = [body.roles["left_ankle"], body.roles["right_ankle"]]
    found = Ankles.of(motion, body)
    np.testing.assert_allclose(found.positions, positions[:, joints], atol=1e-9)
    np.testing.assert_allclose(found.rotations, rotations[:, joints], atol=1e-12)


def test_halfway_is_halfway_whatever_the_sign_of_the_quaternions():
    one = Ankles(np.zeros((1, 2, 3)), np.array([[[0.0, 0.0, 0.0, 1.0]] * 2]))
    turned = quaternion.exp(np.array([[[0.4, 0.0, 0.0], [0.0, -0.2, 0.0]]]))
    other = Ankles(np.ones((1, 2, 3)), np.array([[[-1.0], [1.0]]]) * turned)
    half = one.towards(other, 0.5)
    np.testing.assert_allclose(half.positions, 0.5)
    for foot in range(2):
        both = Rotation.from_quat([one.rotations[0, foot], other.rotations[0, foot]])
        apart = Slerp([0, 1], both)(0.5).inv() * Rotation.from_quat(half.rotations[0, foot])
        assert apart.magnitude() < 1e-9
    each = one.towards(other, np.array([[0.0, 1.0]]))
    np.testing.assert_allclose(each.positions[0], [[0, 0, 0], [1, 1, 1]])


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_legs_follow_and_the_rest_stays(skeleton):
    motion = clip(skeleton)
    body = Body.of(motion)
    leg = body.leg_length
    before = Ankles.of(motion, body)
    # Up and sideways by about a centimetre on a leg of 0.87 m.
    wanted = Ankles(
        before.positions + 0.012 * leg * body.up + 0.008 * leg * body.left,
        quaternion.multiply(quaternion.exp(0.1 * body.up), before.rotations),
    )
    after = move_ankles(motion, body, wanted)
    found = Ankles.of(after, body)
    # A knee that is nearly straight bends in part: what is missing then lies along the leg.
    places = world(motion)[1]
    hip, knee = (places[:, [body.roles[f"{s}_{r}"] for s in ("left", "right")]] for r in ("hip", "knee"))
    missing, line = wanted.positions - found.positions, found.positions - hip
    np.testing.assert_allclose(np.cross(missing, line) / leg**2, 0.0, atol=1e-9)
    folded = np.linalg.norm(np.cross(hip - knee, before.positions - knee), axis=-1)
    bent = folded > 0.3 * np.linalg.norm(hip - knee, axis=-1) * np.linalg.norm(
        before.positions - knee, axis=-1
    )
    assert 0.3 < bent.mean() < 1.0
    np.testing.assert_allclose(missing[bent], 0.0, atol=1e-9 * leg)
    assert np.abs(missing).max() < 0.015 * leg
    same = np.abs(np.einsum("tfi,tfi->tf", found.rotations, wanted.rotations))
    np.testing.assert_allclose(same, 1.0, atol=1e-9)
    moved = [body.roles[f"{s}_{r}"] for s in ("left", "right") for r in ("hip", "knee", "ankle")]
    others = [j for j in range(len(motion.skeleton)) if j not in moved]
    np.testing.assert_array_equal(after.rotations[:, others], motion.rotations[:, others])
    np.testing.assert_array_equal(after.translations, motion.translations)


def test_no_share_is_no_change_and_no_leg_waits_for_the_other():
    motion = clip()
    body = Body.of(motion)
    before = Ankles.of(motion, body)
    wanted = Ankles(before.positions + 0.01 * body.leg_length * body.up, before.rotations)
    none = move_ankles(motion, body, wanted, share=0.0)
    np.testing.assert_allclose(none.rotations, motion.rotations, atol=1e-9)
    left = move_ankles(motion, body, wanted, share=np.array([[1.0, 0.0]] * len(motion)))
    found = Ankles.of(left, body).positions
    assert np.abs(found[:, 0] - before.positions[:, 0]).max() > 0.005 * body.leg_length
    np.testing.assert_allclose(found[:, 1], before.positions[:, 1], atol=1e-9 * body.leg_length)
