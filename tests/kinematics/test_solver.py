"""Inverse kinematics of whole clips."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from mien import samples
from mien.errors import MienError
from mien.kinematics import solver
from mien.kinematics.body import Body
from mien.kinematics.constraints import (
    AtDistance,
    AtPosition,
    InRegion,
    OnPath,
    Orientation,
    ParameterRange,
    Point,
    SamePosition,
)
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


def test_targets_far_away_and_sudden_are_met_too(walk: Motion) -> None:
    """Every frame another pose, joints turned by half a radian: reachable, and nothing is near."""
    body, noise = Body.of(walk), np.random.default_rng(4).normal(size=(len(walk), len(walk.skeleton), 3))
    turned = quat.multiply(walk.rotations, quat.exp(0.5 * noise))
    done = reach(walk, fk(turned, walk.translations, walk.skeleton.parents)[1])
    assert done.residual.max() <= 1e-3 * body.leg_length


@pytest.mark.parametrize("stretch", [1.1, 1.5])
def test_out_of_reach_the_pose_is_about_the_nearest(walk: Motion, stretch: float) -> None:
    """The sum of squared errors against SciPy, which is given the time it wants, in a few frames."""
    body = Body.of(walk)
    clip = walk[60:140:16]
    hips, parents = body.roles["hips"], walk.skeleton.parents
    middle = world(clip)[1][:, [hips]]
    goals = middle + stretch * (other_pose(clip) - middle)
    joints = [body.roles[r] for r in ROLES]
    done = world(reach(clip, goals).motion)[1]
    for f, goal in enumerate(goals):

        def errors(x: np.ndarray, f: int = f, goal: np.ndarray = goal) -> np.ndarray:
            """Errors (N, 24) of poses (N, 69): the hips move by leg lengths, joints turn."""
            turned = quat.multiply(quat.exp(x[:, 3:].reshape(len(x), -1, 3)), clip.rotations[f])
            moved = np.repeat(clip.translations[f : f + 1], len(x), axis=0)
            moved[:, hips] += x[:, :3] * body.leg_length
            return (fk(turned, moved, parents)[1] - goal)[:, joints].reshape(len(x), -1)

        best = least_squares(
            lambda x, e=errors: e(x[None])[0],
            np.zeros(3 + 3 * len(walk.skeleton)),
            jac=lambda x, e=errors: (e(x + 1e-6 * np.eye(len(x))) - e(x[None])).T / 1e-6,
        )
        assert np.sum((done[f] - goal)[joints] ** 2) < 1.05 * 2.0 * best.cost


@pytest.mark.parametrize("away", [20.0, 100.0, 1000.0])
def test_one_hand_out_of_reach_does_not_hold_back_the_rest(walk: Motion, away: float) -> None:
    body = Body.of(walk)
    start, r = world(walk)[1], body.roles
    others = {r["left_wrist"]: 5.0, r["left_ankle"]: 2.0, r["right_ankle"]: 0.0}
    asked = [AtPosition(Point(j), start[:, j] + rise * body.up) for j, rise in others.items()]
    high = start[:, r["right_shoulder"]] + (60.0 + away) * body.up
    limbs = [r[f"{side}_{j}"] for side in ("left", "right") for j in ("shoulder", "elbow", "hip", "knee")]
    done = solve(
        walk,
        [*asked, AtPosition(Point(r["right_wrist"]), high)],
        size=body.leg_length,
        ease=dict.fromkeys(limbs, 1.0),
    )
    at = world(done.motion)[1]
    left = [np.linalg.norm(at[:, c.point.joint] - c.target, axis=1) for c in asked]
    assert np.max(left, axis=0).mean() < 0.2  # centimetres
    assert ((at[:, r["right_wrist"]] - at[:, r["right_shoulder"]]) @ body.up).min() > 40.0  # stretched out


def test_an_arm_that_alone_has_ease_takes_the_body_along_in_one_piece(walk: Motion) -> None:
    """What travels is the body: moving the shoulder in place would stretch the bone above it."""
    body = Body.of(walk)
    shoulder, elbow, wrist = (body.roles[f"left_{r}"] for r in ("shoulder", "elbow", "wrist"))
    target = world(walk)[1][:, wrist] + 70.0 * body.up
    asked = [AtPosition(Point(wrist), target)]
    done = solve(walk, asked, size=body.leg_length, ease={shoulder: 1.0, elbow: 1.0}, travel=1.0)
    assert done.residual.max() < 0.1
    moved = np.abs(done.motion.translations - walk.translations).max(axis=(0, 2)) > 1e-9
    assert np.flatnonzero(moved).tolist() == [body.roles["hips"]]


def two_chains() -> Motion:
    """Two chains of three bones side by side in one clip, each with a root of its own."""
    offsets = [[0, 0, 0], *[[1, 0, 0]] * 3, [0, 9, 0], *[[1, 0, 0]] * 3]
    skeleton = Skeleton(tuple("abcdefgh"), [-1, 0, 1, 2, -1, 4, 5, 6], offsets)
    rotations = quat.exp(np.random.default_rng(0).normal(size=(20, 8, 3)) * 0.2)
    return Motion(skeleton, rotations, np.tile(skeleton.offsets, (20, 1, 1)), frame_time=0.1)


def test_each_of_several_roots_travels_on_its_own() -> None:
    motion = two_chains()
    at = world(motion)[1]
    asked = [
        AtPosition(Point(3), at[:, 3] + [8.0, 0.0, 0.0]),
        AtPosition(Point(7), at[:, 7] - [0.0, 0.0, 8.0]),
    ]
    done = solve(motion, asked, size=1.0, ease=dict.fromkeys(range(8), 0.2), travel=1.0)
    assert done.residual.max() < 1e-3
    went = (done.motion.translations - motion.translations)[:, [0, 4]]
    assert (went[:, 0, 0] > 4.0).all()
    assert (went[:, 1, 2] < -4.0).all()


def test_points_of_two_bodies_meet_half_way() -> None:
    motion = two_chains()
    meet = OnPath(Point(3), Point(7), np.zeros((1, 3)))
    done = solve(motion, [meet], size=1.0, ease=dict.fromkeys(range(8), 0.2), travel=1.0)
    at = world(done.motion)[1]
    assert np.linalg.norm(at[:, 3] - at[:, 7], axis=1).max() < 1e-3
    went = (done.motion.translations - motion.translations)[:, [0, 4], 1]
    assert (went[:, 0] > 1.0).all()
    assert (went[:, 1] < -1.0).all()


@pytest.mark.parametrize("scale", [1e-6, 10.0, 1e6])
def test_the_unit_does_not_matter(walk: Motion, scale: float) -> None:
    clip, goals, body = walk[:40], other_pose(walk)[:40], Body.of(walk)
    skeleton = replace(clip.skeleton, offsets=scale * clip.skeleton.offsets)
    other = Motion(skeleton, clip.rotations, scale * clip.translations, clip.frame_time)
    size, joints = body.leg_length, [body.roles[r] for r in ROLES]
    one, same = (
        solve(
            motion,
            [AtPosition(Point(j), unit * goals[:, j]) for j in joints],
            size=unit * size,
            ease=everything(clip),
            travel=1.0,
        )
        for motion, unit in ((clip, 1.0), (other, scale))
    )
    np.testing.assert_allclose(same.motion.rotations, one.motion.rotations, atol=1e-9)
    np.testing.assert_allclose(same.residual / scale, one.residual, atol=1e-9 * size)


def test_a_clip_far_from_the_origin_is_solved_the_same(walk: Motion) -> None:
    hips = Body.of(walk).roles["hips"]
    clip, away = walk[:40], np.array([1e5, 0.0, -1e5])  # a kilometre
    moved = np.array(clip.translations)
    moved[:, hips] += away
    one = reach(clip, other_pose(clip)).motion
    far = reach(clip.with_(translations=moved), other_pose(clip) + away).motion
    np.testing.assert_allclose(far.rotations, one.rotations, atol=1e-6)


def test_joints_above_none_of_the_points_do_not_count(walk: Motion) -> None:
    body = Body.of(walk)
    arm = [body.roles[f"left_{r}"] for r in ("shoulder", "elbow")]
    asked = [AtPosition(Point(body.roles["left_wrist"]), world(walk)[1][:, body.roles["left_wrist"]] + 6.0)]
    few = solve(walk, asked, size=body.leg_length, ease=dict.fromkeys(arm, 1.0)).motion
    others = {body.roles[f"right_{r}"]: 1.0 for r in ("shoulder", "elbow", "hip", "knee")}
    many = solve(walk, asked, size=body.leg_length, ease=others | dict.fromkeys(arm, 1.0)).motion
    assert few.rotations.tobytes() == many.rotations.tobytes()


def test_the_same_asked_twice_is_met_once(walk: Motion) -> None:
    clip, goals = walk[:30], other_pose(walk)[:30]
    body = Body.of(walk)
    joint = body.roles["left_wrist"]
    twice = [AtPosition(Point(joint), goals[:, joint])] * 2
    done = solve(clip, twice, size=body.leg_length, ease=everything(clip), travel=1.0)
    np.testing.assert_allclose(world(done.motion)[1][:, joint], goals[:, joint], atol=0.1)


def test_contradictions_end_in_the_middle(walk: Motion) -> None:
    body = Body.of(walk)
    wrist = body.roles["left_wrist"]
    at = world(walk)[1][:, wrist]
    asked = [AtPosition(Point(wrist), at + side * body.up) for side in (2.0, -8.0)]
    done = solve(walk, asked, size=body.leg_length, ease=everything(walk))
    np.testing.assert_allclose(world(done.motion)[1][:, wrist], at - 3.0 * body.up, atol=0.2)
    np.testing.assert_allclose(done.residual, 5.0, atol=0.2)


def test_bones_without_length_do_no_harm() -> None:
    skeleton = Skeleton(
        tuple("abcdef"), [-1, 0, 1, 2, 3, 4], [[0, 0, 0], [1, 0, 0], [0, 0, 0], *[[1, 0, 0]] * 3]
    )
    rotations = np.tile(quat.IDENTITY, (4, 6, 1))
    motion = Motion(skeleton, rotations, np.tile(skeleton.offsets, (4, 1, 1)), frame_time=0.1)
    asked = [
        AtPosition(Point(5), np.array([[2.0, 2.0, 1.0]])),
        Orientation(Point(2), Point(1), np.array([[0.0, 1.0, 0.0]]), 1.0),  # a line without direction
    ]
    done = solve(motion, asked, size=1.0, ease=dict.fromkeys(range(6), 1.0))
    assert np.isfinite(done.motion.rotations).all()
    np.testing.assert_allclose(world(done.motion)[1][:, 5], [[2.0, 2.0, 1.0]] * 4, atol=0.05)


def test_a_limb_exactly_straight_can_be_bent() -> None:
    motion = chain()
    bent = ParameterRange(Point(0), Point(2), Point(4), 0.0, np.radians(150.0), 1.0)
    done = solve(motion, [bent], size=1.0, ease=dict.fromkeys(range(4), 1.0))
    assert done.residual.max() < 1e-3


def test_what_stays_does_so_over_the_whole_span_whatever_else_is_asked(walk: Motion) -> None:
    """A hand stays for a second of walking, another later; for some frames something else is asked too."""
    body = Body.of(walk)
    left, right = body.roles["left_wrist"], body.roles["right_wrist"]
    start = world(walk)[1]
    level = np.full(len(walk), -np.inf)
    level[40:60] = (start[:, left] @ body.up)[40:60].max() + 5.0
    asked = [
        SamePosition(Point(left), ((10, 70),)),
        SamePosition(Point(right), ((30, 50), (90, 150))),
        InRegion(Point(left), body.up, level),
    ]
    done = solve(walk, asked, size=body.leg_length, ease=everything(walk), travel=0.5)
    at = world(done.motion)[1]
    assert done.residual.max() < 0.1
    for joint, a, b in ((left, 10, 70), (right, 30, 50), (right, 90, 150)):
        assert np.linalg.norm(at[a:b, joint] - at[a:b, joint].mean(axis=0), axis=1).max() < 0.15
    assert (at[40:60, left] @ body.up - level[40:60]).min() > -0.1
    rest = np.r_[0:10, 70:90, 150 : len(walk)]
    np.testing.assert_array_equal(done.motion.rotations[rest], walk.rotations[rest])


def test_a_share_of_what_stays(walk: Motion) -> None:
    """The share grows over the span: the point comes to rest where it then stays."""
    body = Body.of(walk)
    wrist = body.roles["left_wrist"]
    share = np.clip((np.arange(len(walk)) - 20.0) / 20.0, 0.0, 1.0)
    asked = [SamePosition(Point(wrist), ((20, 60),), share)]
    done = solve(walk, asked, size=body.leg_length, ease=everything(walk), travel=0.5)
    assert done.residual.max() < 0.1
    at = world(done.motion)[1][:, wrist]
    assert np.linalg.norm(at[40:60] - at[50], axis=1).max() < 0.2
    np.testing.assert_allclose(at[20], world(walk)[1][20, wrist], atol=0.2)


def wide(local: np.ndarray, frames: np.ndarray) -> np.ndarray:
    """No joint turns further than half a radian from straight."""
    turn = quat.log(np.moveaxis(local, -1, 0))
    angle = np.linalg.norm(turn, axis=-1, keepdims=True)
    out = quat.exp(turn * np.minimum(1.0, 0.5 / np.maximum(angle, 1e-9)))
    return np.moveaxis(out, 0, -1)


@pytest.mark.parametrize("smoothing", [0.0, 0.08])
def test_limits_hold_in_every_frame_that_is_changed_and_in_no_other(walk: Motion, smoothing: float) -> None:
    body = Body.of(walk)
    wrist = body.roles["left_wrist"]
    arm = [body.roles[f"left_{r}"] for r in ("shoulder", "elbow")]
    assert np.linalg.norm(quat.log(walk.rotations[:, arm[0]]), axis=-1).min() > 0.5  # the clip is beyond
    target = world(walk)[1][:, wrist].copy()
    target[60:120] += 10.0 * body.forward
    done = solve(
        walk,
        [AtPosition(Point(wrist), target)],
        size=body.leg_length,
        ease=dict.fromkeys(arm, 1.0),
        limit=wide,
        smoothing=smoothing,
    ).motion
    changed = np.abs(done.rotations - walk.rotations).max(axis=(1, 2)) > 1e-9
    assert changed[60:120].all()
    assert not changed[:20].any()
    assert not changed[-20:].any()
    assert np.linalg.norm(quat.log(done.rotations[changed][:, arm]), axis=-1).max() < 0.5 + 1e-9
    still = [j for j in range(len(walk.skeleton)) if j not in arm]
    np.testing.assert_array_equal(done.rotations[:, still], walk.rotations[:, still])


def test_limits_leave_targets_within_them_reachable(walk: Motion) -> None:
    """Targets from poses of which every joint goes to the end of its limit at some time."""
    goals = other_pose(walk)
    noise = smooth(np.random.default_rng(1).normal(size=(len(walk), len(walk.skeleton), 3)), sigma=10)
    turned = quat.multiply(walk.rotations, quat.exp(noise * 0.15 / noise.std()))
    angles = [np.linalg.norm(quat.log(q), axis=-1).max(axis=0) for q in (turned, walk.rotations)]
    most = np.max(angles, axis=0)[:, None, None]

    def limit(local: np.ndarray, frames: np.ndarray) -> np.ndarray:
        turn = quat.log(np.moveaxis(local, 1, -1))
        angle = np.linalg.norm(turn, axis=-1, keepdims=True)
        return np.moveaxis(quat.exp(turn * np.minimum(1.0, most / np.maximum(angle, 1e-9))), -1, 1)

    assert np.mean(reach(walk, goals, limit=limit).residual < 0.1) > 0.99


def test_nothing_asked_changes_nothing(walk: Motion) -> None:
    done = solve(walk, [], size=1.0, ease=everything(walk), travel=1.0)
    assert done.motion is walk
    np.testing.assert_array_equal(done.residual, np.zeros(len(walk)))


@pytest.mark.parametrize("bad", [np.nan, np.inf])
@pytest.mark.parametrize("kind", ["AtPosition", "OnPath", "AtDistance", "Orientation", "Point"])
def test_what_is_not_a_number_is_refused_with_its_place(walk: Motion, kind: str, bad: float) -> None:
    rows = np.zeros((len(walk), 3))
    rows[:, 0] = 1.0
    rows[[7, 9]] = bad
    asked = {
        "AtPosition": AtPosition(Point(3), rows),
        "OnPath": OnPath(Point(3), Point(5), rows),
        "AtDistance": AtDistance(Point(3), Point(5), rows[:, 0]),
        "Orientation": Orientation(Point(3), Point(5), rows, 1.0),
        "Point": AtPosition(Point(3, rows), np.zeros((1, 3))),
    }[kind]
    with pytest.raises(MienError, match=r"constraint 1 .*2 of .* frames.* 7"):
        solve(walk, [AtPosition(Point(1), np.zeros((1, 3))), asked], size=1.0, ease=everything(walk))


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"size": 0.0}, "size must be above 0"),
        ({"size": np.nan}, "size"),
        ({"tolerance": 0.0}, "tolerance must be above 0"),
        ({"travel": -1.0}, "travel must be 0 or more"),
        ({"smoothing": -0.1}, "smoothing"),
        ({"ease": {99: 1.0}}, "joint 99"),
        ({"ease": {-1: 1.0}}, "joint -1"),
        ({"ease": {0: -1.0}}, "Hips"),
    ],
)
def test_options_that_mean_nothing_are_refused(walk: Motion, options: dict, said: str) -> None:
    asked = [AtPosition(Point(3), np.zeros((1, 3)))]
    with pytest.raises(MienError, match=said):
        solve(walk, asked, **({"size": 1.0, "ease": {0: 1.0}} | options))


def test_long_clips_are_solved_like_their_parts(walk: Motion, monkeypatch) -> None:
    """Chunks, of frames or of memory, are nobody's business."""
    goals = other_pose(walk)
    one = reach(walk, goals).motion
    monkeypatch.setattr("mien.kinematics.solver.LARGEST", 7 * 24**2)
    assert reach(walk, goals).motion.rotations.tobytes() == one.rotations.tobytes()


def test_no_place_to_stay_is_looked_for_if_another_thing_is_out_of_reach(walk: Motion, monkeypatch) -> None:
    body, rounds, met = Body.of(walk), [], solver._met
    monkeypatch.setattr(solver, "_met", lambda *args: rounds.append(1) or met(*args))
    left, right = (body.roles[f"{side}_wrist"] for side in ("left", "right"))
    far = AtPosition(Point(right), world(walk)[1][:, right] + 500.0 * body.up)
    arms = [body.roles[f"{side}_{r}"] for side in ("left", "right") for r in ("shoulder", "elbow")]
    asked = [SamePosition(Point(left), ((20, 26),)), far]
    solve(walk, asked, size=body.leg_length, ease=dict.fromkeys(arms, 1.0))
    assert len(rounds) == 1
