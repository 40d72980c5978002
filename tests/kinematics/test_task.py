"""What the solver works on: which joint the body moves at, what may stay, where points stay."""

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.constraints import AtPosition, InRegion, Point, SamePosition
from mien.kinematics.descent import look
from mien.kinematics.fk import world
from mien.kinematics.task import errors, held, holds, task, travellers, with_goals
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion as quat

OPTIONS = {"size": 1.0, "travel": 1.0, "limit": None, "tolerance": 1e-3}


def moving(parents: list[int], loose: list[int], frames: int = 4) -> Motion:
    """Bones along x; joints that are ``loose`` go along y over time."""
    skeleton = Skeleton(
        tuple(f"j{j}" for j in range(len(parents))), parents, [[1.0, 0.0, 0.0]] * len(parents)
    )
    translations = np.tile(skeleton.offsets, (frames, 1, 1))
    translations[:, loose, 1] += np.arange(frames)[:, None]
    return Motion(skeleton, np.tile(quat.IDENTITY, (frames, len(parents), 1)), translations, 0.1)


@pytest.mark.parametrize(
    ("loose", "ease", "holders", "found"),
    [
        ([0], range(5), [4], [0]),
        ([0], [3, 4], [4], [0]),  # an arm alone has ease: the body moves, no bone is stretched
        ([1], range(1, 5), [4], [1]),  # hips below a root that stands still
        ([1], range(5), [4], [0]),
        ([], [1, 2], [4, 2], [0]),
        ([1], [1], [1, 3], [1]),
        ([2], [2, 3], [4, 5], [0]),  # what moves is not above both points
    ],
)
def test_the_body_moves_where_no_bone_is_stretched(loose, ease, holders, found) -> None:
    motion = moving([-1, 0, 1, 2, 3, 1], loose)
    assert travellers(motion, holders, dict.fromkeys(ease, 1.0), 1.0) == found


def test_rounding_of_a_file_is_no_movement() -> None:
    motion = moving([-1, 0, 1], [])
    shaken = motion.with_(translations=motion.translations + 1e-6)
    assert travellers(shaken, [2], {1: 1.0}, 1.0) == [0]


def test_every_tree_has_its_own_place_to_move() -> None:
    motion = moving([-1, 0, -1, 2, 3], [0, 2])
    assert travellers(motion, [1, 4, 3], dict.fromkeys(range(5), 1.0), 1.0) == [0, 2]


def test_how_easily_all_move_together_says_nothing() -> None:
    motion = moving([-1, 0, 1], [])
    asked = [AtPosition(Point(2), np.zeros((1, 3)))]
    one, _ = task(motion, asked, ease={0: 0.2, 1: 0.1}, **{**OPTIONS, "travel": 0.4})
    other, _ = task(motion, asked, ease={0: 2.0, 1: 1.0}, **{**OPTIONS, "travel": 4.0})
    np.testing.assert_allclose(one.link.ease, other.link.ease)
    np.testing.assert_allclose(one.link.travel, other.link.travel)


def test_points_are_seen_where_forward_kinematics_has_them() -> None:
    motion = samples.walk(seconds=0.5, skeleton="poser43").motion
    wrist, head = (Body.of(motion).roles[r] for r in ("left_wrist", "head"))
    rng = np.random.default_rng(0)
    fixed, changing = rng.normal(size=3), rng.normal(size=(len(motion), 3))
    targets = rng.normal(size=(len(motion), 3))
    asked, state = task(
        motion,
        [AtPosition(Point(wrist, fixed), targets), AtPosition(Point(head, changing), targets[:1])],
        ease={wrist: 1.0},
        **OPTIONS,
    )
    frames = np.array([3, 9, 20])
    seen = look(asked, (state[0][..., frames], state[1][..., frames]), frames)
    rotations, at = world(motion)
    expected = [
        (at[:, wrist] + quat.rotate(rotations[:, wrist], fixed))[frames],
        (at[:, head] + quat.rotate(rotations[:, head], changing))[frames],
    ]
    np.testing.assert_allclose(np.moveaxis(seen.places, -1, 1), expected, atol=1e-12)
    wrong = np.concatenate([expected[0] - targets[frames], expected[1] - targets[:1]], axis=1)
    np.testing.assert_allclose(seen.errors.T, wrong, atol=1e-12)
    np.testing.assert_allclose(seen.cost, (wrong**2).sum(axis=1))
    apart = np.linalg.norm(wrong.reshape(3, 2, 3), axis=-1)
    np.testing.assert_allclose(seen.worst, apart.max(axis=1))


@pytest.mark.parametrize(
    ("height", "left"), [(-12.0, 2.0), (-10.0, 0.0), (-4.0, 0.0), (0.0, 0.0), (7.0, 0.0)]
)
def test_of_a_bound_what_may_stay_need_not(height: float, left: float) -> None:
    """A point 20 too low, half of which may stay: 10 too low and anything above is right."""
    motion = moving([-1], [])
    level = np.array([0.0])
    asked, start = task(
        motion, [InRegion(Point(0), np.eye(3)[1], level, np.array([0.5]))], ease={}, **OPTIONS
    )
    at = np.zeros((1, 3, len(motion)))
    at[:, 1] = -20.0
    asked = with_goals(asked, at)
    start[1][:, 1] = height
    np.testing.assert_allclose(look(asked, start, np.arange(len(motion))).worst, left)


def test_points_that_stay_do_so_in_the_middle_of_where_they_are() -> None:
    motion = moving([-1], [0], frames=6)
    asked, _ = task(motion, [SamePosition(Point(0), ((0, 3), (4, 6)))], ease={}, **OPTIONS)
    assert holds(asked)
    at = np.moveaxis(world(motion)[1], 0, -1)
    found = errors(held(asked, at), at, np.arange(6))[0]
    np.testing.assert_allclose(found[:, 1], [-1.0, 0.0, 1.0, 0.0, -0.5, 0.5], atol=1e-12)
    some = np.array([2, 5])  # whichever frames are looked at, the middle is that of the span
    np.testing.assert_allclose(errors(held(asked, at), at[..., some], some)[0][:, 1], [1.0, 0.5], atol=1e-12)
