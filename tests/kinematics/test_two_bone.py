"""Two-bone IK against geometry: lengths kept, targets hit, no flips, no change where none is asked."""

import numpy as np
import pytest

from mien.kinematics.two_bone import nudge, two_bone
from mien.rotations import quaternion


def leg(flexion, *, thigh=0.45, shank=0.42):
    """Hip at (0, 1, 0), thigh straight down, knee flexed backwards by ``flexion`` radians; hinge axis -x."""
    flexion = np.atleast_1d(flexion)
    hip = np.zeros((len(flexion), 3)) + [0.0, 1.0, 0.0]
    knee = hip + [0.0, -thigh, 0.0]
    shin = np.stack([np.zeros_like(flexion), -np.cos(flexion), -np.sin(flexion)], axis=1)
    return hip, knee, knee + shank * shin


HINGE = np.array([-1.0, 0.0, 0.0])


def solve(hip, knee, ankle, target):
    upper, lower = two_bone(hip, knee, ankle, target, np.broadcast_to(HINGE, hip.shape))
    new_knee = hip + quaternion.rotate(upper, knee - hip)
    return new_knee, new_knee + quaternion.rotate(lower, ankle - knee)


def test_reaches_every_target_within_reach_and_keeps_bone_lengths():
    rng = np.random.default_rng(1)
    hip, knee, ankle = leg(rng.uniform(0.0, 2.2, 500))
    direction = rng.normal(size=(500, 3)) * [0.5, 0.3, 0.5] + [0, -1.0, 0]
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    target = hip + direction * rng.uniform(0.25, 0.869, 500)[:, None]
    new_knee, new_ankle = solve(hip, knee, ankle, target)
    np.testing.assert_allclose(new_ankle, target, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(new_knee - hip, axis=1), 0.45, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(new_ankle - new_knee, axis=1), 0.42, atol=1e-12)


def test_out_of_reach_stretches_towards_the_target():
    hip, knee, ankle = leg(0.4)
    target = hip + [0.0, -2.0, 1.0]
    _, new_ankle = solve(hip, knee, ankle, target)
    line = target - hip
    np.testing.assert_allclose(new_ankle, hip + 0.87 * line / np.linalg.norm(line), atol=1e-4)


@pytest.mark.parametrize("flexion", [0.0, 1e-4, 0.01, 0.3, 1.0, 2.0])
def test_asking_for_where_it_is_changes_nothing(flexion):
    hip, knee, ankle = leg(flexion)
    new_knee, new_ankle = solve(hip, knee, ankle, ankle)
    np.testing.assert_allclose(new_knee, knee, atol=2e-6)
    np.testing.assert_allclose(new_ankle, ankle, atol=1e-9)


def test_knee_bends_backwards_out_of_a_straight_and_an_over_stretched_leg():
    hip, knee, ankle = leg([0.0, -0.05, -0.2])
    new_knee, new_ankle = solve(hip, knee, ankle, hip + [0.0, -0.8, 0.0])
    np.testing.assert_allclose(new_ankle, hip + [0.0, -0.8, 0.0], atol=1e-6)
    assert (new_knee[:, 2] > 0.05).all(), "the knee must point forwards, +z"


def test_a_knee_passing_through_straight_does_not_snap():
    t = np.linspace(-1, 1, 401)
    hip, knee, ankle = leg(0.02 + 0.02 * t)
    reach = 0.87 - 0.02 * t**2
    new_knee, _ = solve(hip, knee, ankle, hip + np.stack([0 * t, -reach, 0.3 * t], axis=1) * 0.95)
    step = np.linalg.norm(np.diff(new_knee, axis=0), axis=1)
    assert step.max() < 5 * np.median(step)


def test_moves_with_the_world():
    rng = np.random.default_rng(2)
    turn = quaternion.normalise(rng.normal(size=4))
    hip, knee, ankle = leg(np.linspace(0, 2, 20))
    target = ankle + rng.normal(size=(20, 3)) * 0.1
    upper, lower = two_bone(hip, knee, ankle, target, np.broadcast_to(HINGE, hip.shape))
    turned = [quaternion.rotate(turn, p) for p in (hip, knee, ankle, target)]
    upper2, lower2 = two_bone(*turned, np.broadcast_to(quaternion.rotate(turn, HINGE), hip.shape))
    for a, b in ((upper, upper2), (lower, lower2)):
        expected = quaternion.multiply(quaternion.multiply(turn, a), quaternion.conjugate(turn))
        np.testing.assert_allclose(np.abs(np.einsum("ti,ti->t", expected, b)), 1.0, atol=1e-12)


def test_a_bone_without_length_gives_no_nonsense():
    hip, knee, ankle = leg(0.5, shank=0.0)
    new_knee, new_ankle = solve(hip, knee, ankle, hip + [0.1, -0.3, 0.0])
    np.testing.assert_allclose(np.linalg.norm(new_knee - hip, axis=1), 0.45, atol=1e-12)
    np.testing.assert_allclose(new_ankle, new_knee, atol=1e-12)


def nudged(hip, knee, ankle, target):
    upper, lower = nudge(hip, knee, ankle, target)
    new_knee = hip + quaternion.rotate(upper, knee - hip)
    return upper, lower, new_knee, new_knee + quaternion.rotate(lower, ankle - knee)


class TestNudge:
    """Small corrections: no jump where they set in, whatever side the joint is on."""

    @pytest.mark.parametrize("side", [1.0, -1.0])  # -1: the knee is bent the wrong way
    def test_no_way_to_go_changes_nothing(self, side):
        hip, knee, ankle = leg(side * np.linspace(0.0, 2.5, 60))
        upper, lower, _, _ = nudged(hip, knee, ankle, ankle)
        for turn in (upper, lower):
            np.testing.assert_allclose(np.abs(turn[:, 3]), 1.0, atol=1e-12)

    @pytest.mark.parametrize("side", [1.0, -1.0])
    def test_a_bent_joint_gets_there_on_its_own_side(self, side):
        rng = np.random.default_rng(3)
        hip, knee, ankle = leg(side * rng.uniform(0.4, 2.2, 200))
        target = ankle + rng.normal(size=(200, 3)) * 0.01
        _, _, new_knee, new_ankle = nudged(hip, knee, ankle, target)
        np.testing.assert_allclose(new_ankle, target, atol=1e-9)
        before = np.cross(hip - knee, ankle - knee)[:, 0]
        after = np.cross(hip - new_knee, new_ankle - new_knee)[:, 0]
        assert (before * after > 0).all()
        np.testing.assert_allclose(np.linalg.norm(new_ankle - new_knee, axis=1), 0.42, atol=1e-12)

    def test_a_straight_joint_turns_as_a_whole(self):
        hip, knee, ankle = leg([0.0, 0.01])
        target = ankle + [0.02, 0.0, 0.03]
        upper, lower, _, new_ankle = nudged(hip, knee, ankle, target)
        np.testing.assert_allclose(upper, lower, atol=1e-12)
        astray = np.cross(new_ankle - hip, target - hip)  # what is left lies along the leg
        np.testing.assert_allclose(astray, 0.0, atol=1e-12)

    def test_there_is_no_jump_near_straight(self):
        flexion = np.linspace(-0.3, 0.3, 2001)
        hip, knee, ankle = leg(flexion)
        _, lower, _, _ = nudged(hip, knee, ankle, ankle + [0.0, 0.002, 0.004])
        turned = 2.0 * np.arccos(np.clip(np.abs((lower[1:] * lower[:-1]).sum(axis=1)), 0.0, 1.0))
        assert turned.max() < 0.01  # a step of flexion is 0.0003
