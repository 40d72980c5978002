"""Inverse kinematics of whole clips."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.constraints import AtDistance, AtPosition, InRegion, OnPath, Point, SamePosition
from mien.kinematics.fk import fk, world
from mien.kinematics.solver import Solved, solve
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion as quat
from mien.signal.bridging import smooth

ROLES = ("head", "left_wrist", "right_wrist", "left_ankle", "right_ankle", "left_knee", "right_knee", "chest")


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=3.0, fps=60.0).motion


def everything(motion: Motion) -> dict[int, float]:
    return dict.fromkeys(range(len(motion.skeleton)), 1.0)


def other_pose(motion: Motion, amount: float = 0.15) -> np.ndarray:
    """Where the joints are (T, J, 3) in a motion that wanders slowly away from this one."""
    noise = smooth(np.random.default_rng(1).normal(size=(len(motion), len(motion.skeleton), 3)), sigma=10)
    turned = quat.multiply(motion.rotations, quat.exp(noise * amount / noise.std()))
    return fk(turned, motion.translations, motion.skeleton.parents)[1]


def reach(motion: Motion, goals: np.ndarray, **options) -> Solved:
    body = Body.of(motion)
    asked = [AtPosition(Point(body.roles[r]), goals[:, body.roles[r]]) for r in ROLES]
    options = {"size": body.leg_length, "ease": everything(motion), "travel": 1.0} | options
    return solve(motion, asked, **options)


def test_targets_that_can_be_reached_are_met_to_a_millimetre(walk: Motion) -> None:
    body, goals = Body.of(walk), other_pose(walk)
    before = np.linalg.norm(world(walk)[1] - goals, axis=-1)[:, [body.roles[r] for r in ROLES]]
    assert before.max() > 10.0  # centimetres
    done = reach(walk, goals)
    left = np.linalg.norm(world(done.motion)[1] - goals, axis=-1)[:, [body.roles[r] for r in ROLES]]
    assert left.max() <= 0.1
    np.testing.assert_allclose(done.residual, left.max(axis=1), atol=1e-9)


def test_what_is_met_already_is_not_touched(walk: Motion) -> None:
    goals = world(walk)[1].copy()
    goals[60:90] = other_pose(walk)[60:90]
    done = reach(walk, goals).motion
    same = [*range(60), *range(90, len(walk))]
    np.testing.assert_allclose(np.abs(done.rotations[same]), np.abs(walk.rotations[same]), atol=1e-15)
    assert np.abs(done.rotations[60:90] - walk.rotations[60:90]).max() > 1e-3


def test_bones_keep_their_lengths_and_only_joints_with_ease_turn(walk: Motion) -> None:
    body = Body.of(walk)
    shoulder, elbow, wrist = (body.roles[f"left_{r}"] for r in ("shoulder", "elbow", "wrist"))
    target = world(walk)[1][:, wrist] + [0.0, 6.0, 6.0]
    asked = [AtPosition(Point(wrist), target)]
    done = solve(walk, asked, size=body.leg_length, ease={shoulder: 1.0, elbow: 1.0}).motion
    still = [j for j in range(len(walk.skeleton)) if j not in (shoulder, elbow)]
    np.testing.assert_allclose(done.rotations[:, still], walk.rotations[:, still], atol=1e-12)
    np.testing.assert_array_equal(done.translations, walk.translations)
    np.testing.assert_allclose(world(done)[1][:, wrist], target, atol=0.1)


def test_out_of_reach_it_stays_near_and_does_not_fly_apart(walk: Motion) -> None:
    body = Body.of(walk)
    hips = world(walk)[1][:, body.roles["hips"]]
    goals = hips[:, None] + 1.5 * (other_pose(walk) - hips[:, None])
    joints = [body.roles[r] for r in ROLES]
    before = np.linalg.norm(world(walk)[1] - goals, axis=-1)[:, joints].max(axis=1)
    done = reach(walk, goals)
    after = np.linalg.norm(world(done.motion)[1] - goals, axis=-1)[:, joints].max(axis=1)
    assert (after <= before + 1e-6).all()
    assert after.mean() < 0.95 * before.mean()


def test_an_arm_stretched_out_points_at_what_it_cannot_reach(walk: Motion) -> None:
    body = Body.of(walk)
    shoulder, elbow, wrist = (body.roles[f"left_{r}"] for r in ("shoulder", "elbow", "wrist"))
    places = world(walk)[1]
    far = places[:, shoulder] + 200.0 * body.left
    done = solve(
        walk, [AtPosition(Point(wrist), far)], size=body.leg_length, ease={shoulder: 1.0, elbow: 1.0}
    )
    reached = world(done.motion)[1]
    length = np.linalg.norm(places[:, wrist] - places[:, elbow], axis=1) + np.linalg.norm(
        places[:, elbow] - places[:, shoulder], axis=1
    )
    np.testing.assert_allclose(done.residual, 200.0 - length, atol=4.0)
    line = reached[:, wrist] - reached[:, shoulder]
    assert (line @ body.left / np.linalg.norm(line, axis=1)).min() > 0.95


def chain() -> Motion:
    """Four bones of length 1 along x; all may turn."""
    skeleton = Skeleton(tuple("abcde"), [-1, 0, 1, 2, 3], [[0, 0, 0], *[[1, 0, 0]] * 4])
    return Motion(
        skeleton, np.tile(quat.IDENTITY, (3, 5, 1)), np.tile(skeleton.offsets, (3, 1, 1)), frame_time=0.1
    )


def test_the_change_is_about_the_smallest_that_does_it() -> None:
    """A chain against SciPy: the least turns that reach the target, within a tenth."""
    motion = chain()
    target = np.array([[2.5, 1.0, 0.5]])
    ease = dict.fromkeys(range(4), 1.0)
    done = solve(motion, [AtPosition(Point(4), target)], size=1.0, ease=ease, tolerance=1e-4)

    def places(x: np.ndarray) -> np.ndarray:
        turned = np.tile(quat.IDENTITY, (1, 5, 1))
        turned[0, :4] = quat.exp(x.reshape(4, 3))
        return fk(turned, motion.translations[:1], motion.skeleton.parents)[1][0, 4]

    best = least_squares(
        lambda x: np.concatenate([300.0 * (places(x) - target[0]), x]), np.full(12, 0.1), xtol=1e-14
    ).x
    found = quat.log(done.motion.rotations[0, :4]).ravel()
    assert np.linalg.norm(places(found) - target[0]) < 1e-4
    assert np.linalg.norm(found) < 1.1 * np.linalg.norm(best)


def test_all_seven_kinds_together(walk: Motion) -> None:
    """A hand held to the other, a foot that stays, a hand above a height, knees apart: all at once."""
    body = Body.of(walk)
    r = body.roles
    rising = InRegion(Point(r["left_wrist"]), body.up, np.array([105.0]))
    asked = [
        rising,
        OnPath(Point(r["right_wrist"]), Point(r["left_wrist"]), np.array([[-10.0, 0.0, 0.0]])),
        SamePosition(Point(r["head"]), ((0, 30),)),
        AtDistance(Point(r["left_knee"]), Point(r["right_knee"]), np.array([16.0]), "least"),
    ]
    done = solve(walk, asked, size=body.leg_length, ease=everything(walk), travel=0.2)
    at = world(done.motion)[1]
    assert done.residual.max() < 0.1
    assert (at[:, r["left_wrist"]] @ body.up).min() > 104.8
    np.testing.assert_allclose(
        at[:, r["right_wrist"]] - at[:, r["left_wrist"]], [[-10.0, 0.0, 0.0]] * len(walk), atol=0.1
    )
    assert np.linalg.norm(at[:30, r["head"]] - at[:30, r["head"]].mean(axis=0), axis=1).max() < 0.1
    assert np.linalg.norm(at[:, r["left_knee"]] - at[:, r["right_knee"]], axis=1).min() > 15.9


def test_a_share_of_the_error_may_stay(walk: Motion) -> None:
    body = Body.of(walk)
    wrist = body.roles["left_wrist"]
    start = world(walk)[1][:, wrist]
    share = np.clip((walk.times - 0.5) / 0.5, 0.0, 1.0)
    asked = [AtPosition(Point(wrist), start + [0.0, 8.0, 0.0], share)]
    ease = {body.roles["left_shoulder"]: 1.0, body.roles["left_elbow"]: 1.0}
    done = solve(walk, asked, size=body.leg_length, ease=ease, tolerance=1e-4).motion
    moved = world(done)[1][:, wrist] - start
    np.testing.assert_allclose(moved, share[:, None] * [[0.0, 8.0, 0.0]], atol=0.02)
    np.testing.assert_allclose(done.rotations[:30], walk.rotations[:30], atol=1e-15)


def test_smoothing_takes_the_roughness_out_of_the_change(walk: Motion) -> None:
    body = Body.of(walk)
    wrist = body.roles["left_wrist"]
    start = world(walk)[1][:, wrist]
    level = np.full(len(walk), -1e9)
    level[80:100] = (start @ body.up)[80:100] + 6.0  # asked for all at once
    ease = {body.roles["left_shoulder"]: 1.0, body.roles["left_elbow"]: 1.0}
    jumps = []
    for seconds in (0.0, 0.08):
        done = solve(
            walk, [InRegion(Point(wrist), body.up, level)], size=body.leg_length, ease=ease, smoothing=seconds
        )
        assert done.residual.max() < 0.1
        moved = world(done.motion)[1][:, wrist] - start
        jumps.append(np.linalg.norm(np.diff(moved, axis=0), axis=1).max())
    assert jumps[1] < 0.7 * jumps[0]


def test_the_root_may_travel(walk: Motion) -> None:
    body = Body.of(walk)
    hips = body.roles["hips"]
    lower = world(walk)[1][:, hips] - [0.0, 5.0, 0.0]
    done = solve(walk, [AtPosition(Point(hips), lower)], size=body.leg_length, ease={}, travel=1.0)
    np.testing.assert_allclose(world(done.motion)[1][:, hips], lower, atol=0.1)
    np.testing.assert_allclose(done.motion.rotations, walk.rotations, atol=1e-12)


def test_a_body_below_another_root_travels_in_the_world() -> None:
    """The root joint of the skeleton stands still and is turned; the hips below it move in its axes."""
    motion = samples.walk(seconds=1.0, skeleton="engine23").motion
    body = Body.of(motion)
    hips = body.roles["hips"]
    lower = world(motion)[1][:, hips] - 5.0 * body.up
    ease = {hips: 1.0}
    done = solve(motion, [AtPosition(Point(hips), lower)], size=body.leg_length, ease=ease, travel=1.0)
    np.testing.assert_allclose(world(done.motion)[1][:, hips], lower, atol=0.1)


def test_limits_are_respected(walk: Motion) -> None:
    """An elbow that may bend no further than 40 degrees from straight leaves the rest to the shoulder."""
    body = Body.of(walk)
    shoulder, elbow, wrist = (body.roles[f"left_{r}"] for r in ("shoulder", "elbow", "wrist"))
    target = world(walk)[1][:, shoulder] + [0.0, -20.0, 25.0]

    def limit(local: np.ndarray, frames: np.ndarray) -> np.ndarray:
        out = local.copy()
        turn = quat.log(out[elbow].T)
        angle = np.linalg.norm(turn, axis=1, keepdims=True)
        out[elbow] = quat.exp(turn * np.minimum(1.0, np.radians(40.0) / np.maximum(angle, 1e-9))).T
        return out

    done = solve(
        walk,
        [AtPosition(Point(wrist), target)],
        size=body.leg_length,
        ease={shoulder: 1.0, elbow: 1.0},
        limit=limit,
    )
    turned = np.degrees(np.linalg.norm(quat.log(done.motion.rotations[:, elbow]), axis=-1))
    assert turned.max() < 40.01


def test_the_same_again_gives_the_same_bytes(walk: Motion) -> None:
    goals = other_pose(walk)
    assert reach(walk, goals).motion.rotations.tobytes() == reach(walk, goals).motion.rotations.tobytes()


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_very_short_clips(walk: Motion, frames: int) -> None:
    done = reach(walk[:frames], other_pose(walk)[:frames], smoothing=0.1)
    assert done.residual.max() < 0.1
