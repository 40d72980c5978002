"""How a pose is added to a moving joint: sums of directions, hinges, and stops, against slow twins."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.poses import Pose
from mien.kinematics.posing import MOST_BEND, add_pose, add_turns, soft_stop
from mien.motion import Motion
from mien.rotations import quaternion as quat


def rotvec(q: np.ndarray) -> np.ndarray:
    return Rotation.from_quat(q).as_rotvec(degrees=True)


def unit(v: np.ndarray) -> np.ndarray:
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def directions(motion: Motion, start: str, end: str) -> np.ndarray:
    """Unit directions (T, 3) between two roles in the world."""
    body, positions = Body.of(motion), world(motion)[1]
    return unit(positions[:, body.roles[end]] - positions[:, body.roles[start]])


def elbow(motion: Motion, side: str) -> np.ndarray:
    """Bend of an elbow (T,) in degrees."""
    upper = directions(motion, f"{side}_shoulder", f"{side}_elbow")
    fore = directions(motion, f"{side}_elbow", f"{side}_wrist")
    return np.degrees(np.arccos(np.clip(np.sum(upper * fore, axis=-1), -1, 1)))


def posed(motion: Motion, pose: Pose, method: str, weights: dict[str, np.ndarray] | None = None) -> Motion:
    body = Body.of(motion)
    return motion.with_(rotations=add_pose(motion, body, pose, weights=weights or {}, method=method))


def test_additive_is_the_sum_of_direction_vectors() -> None:
    """Slow twin with SciPy, frame by frame: code along the bone and across it, add, Gram-Schmidt."""
    motion = samples.walk(seconds=1.0, skeleton="capture31").motion
    body = Body.of(motion)
    shoulder, elbow = body.roles["left_shoulder"], body.roles["left_elbow"]
    turn = np.array([-12.0, 9.0, 25.0])
    weight = np.linspace(0, 1, len(motion))
    after = posed(motion, Pose({"left_shoulder": tuple(turn)}), "additive", {"left_arm": weight})

    parent = int(motion.skeleton.parents[shoulder])
    neutral = motion[:1].with_(rotations=body.neutral[None])
    stance = Rotation.from_quat(world(neutral)[0][0])
    along = unit(world(neutral)[1][0, elbow] - world(neutral)[1][0, shoulder])
    across = unit(body.forward - (body.forward @ along) * along)
    third = np.cross(along, across)
    change = Rotation.from_rotvec(np.radians(turn) @ [body.left, body.up, body.forward])
    for frame, (before, w) in enumerate(zip(motion.rotations[:, shoulder], weight, strict=True)):
        seen = stance[parent] * Rotation.from_quat(before) * stance[shoulder].inv()
        d = seen.apply(along) + w * (change.apply(along) - along)
        n = seen.apply(across) + w * (change.apply(across) - across)
        d = unit(d)
        n = unit(n - (n @ d) * d)
        frame_after = np.stack([d, n, np.cross(d, n)], axis=1) @ np.stack([along, across, third])
        expected = stance[parent].inv() * Rotation.from_matrix(frame_after) * stance[shoulder]
        found = Rotation.from_quat(after.rotations[frame, shoulder])
        assert (expected.inv() * found).magnitude() < 1e-9


def test_body_fixed_turns_about_the_joints_own_axes() -> None:
    motion = samples.walk(seconds=1.0).motion
    body = Body.of(motion)
    head = body.roles["head"]
    after = posed(motion, Pose({"head": (20.0, 0.0, 0.0)}), "body_fixed")
    own = Rotation.from_quat(motion.rotations[:, head]).inv() * Rotation.from_quat(after.rotations[:, head])
    np.testing.assert_allclose(own.magnitude(), np.radians(20.0), atol=1e-9)
    np.testing.assert_allclose(own.as_rotvec(), np.tile(own[0].as_rotvec(), (len(motion), 1)), atol=1e-9)


@pytest.mark.parametrize("clip", ["walk", "punch", "knock", "wave"])
@pytest.mark.parametrize("side", ["left", "right"])
def test_elbows_bend_by_what_is_asked_in_their_own_plane(clip: str, side: str) -> None:
    motion = getattr(samples, clip)().motion
    after = posed(motion, Pose({f"{side}_elbow": (-25.0, 0.0, 0.0)}), "anatomical")
    before = elbow(motion, side)
    free = before < np.degrees(MOST_BEND) - 50.0
    np.testing.assert_allclose((elbow(after, side) - before)[free], 25.0, atol=1.0)
    assert (elbow(after, side) <= np.maximum(before, np.degrees(MOST_BEND)) + 0.1).all()
    plane = [
        unit(
            np.cross(
                directions(m, f"{side}_shoulder", f"{side}_elbow"),
                directions(m, f"{side}_elbow", f"{side}_wrist"),
            )
        )
        for m in (motion, after)
    ]
    clear = before > 40.0
    assert (np.sum(plane[0] * plane[1], axis=-1)[clear] > np.cos(np.radians(5.0))).all()


@pytest.mark.parametrize("clip", ["walk", "punch", "wave"])
def test_elbows_are_never_bent_backwards(clip: str) -> None:
    motion = getattr(samples, clip)().motion
    for side in ("left", "right"):
        after = posed(motion, Pose({f"{side}_elbow": (90.0, 0.0, 0.0)}), "anatomical")
        upper = directions(after, f"{side}_shoulder", f"{side}_elbow")
        bend = np.cross(upper, directions(after, f"{side}_elbow", f"{side}_wrist"))
        was = np.cross(
            directions(motion, f"{side}_shoulder", f"{side}_elbow"),
            directions(motion, f"{side}_elbow", f"{side}_wrist"),
        )
        assert (np.sum(bend * was, axis=-1) > -1e-6).all()
        assert (elbow(after, side) < elbow(motion, side) + 1e-6).all()


def test_raised_arms_are_not_twisted_when_moved_out() -> None:
    """The upper arm goes the shortest way: it turns about no axis along itself."""
    motion = samples.wave().motion
    body = Body.of(motion)
    after = posed(motion, Pose({"right_shoulder": (0.0, 0.0, -20.0)}), "anatomical")
    shoulder = body.roles["right_shoulder"]
    turned = quat.multiply(world(after)[0][:, shoulder], quat.conjugate(world(motion)[0][:, shoulder]))
    before = directions(motion, "right_shoulder", "right_elbow")
    now = directions(after, "right_shoulder", "right_elbow")
    shortest = np.arccos(np.clip(np.sum(before * now, axis=-1), -1, 1))
    np.testing.assert_allclose(np.linalg.norm(quat.log(turned), axis=-1), shortest, atol=1e-6)


def test_collars_and_neck_that_are_missing_hand_their_turn_on() -> None:
    motion = samples.still(seconds=0.2).motion
    body = Body.of(motion)
    without = {r: j for r, j in body.roles.items() if r not in ("left_collar", "neck")}
    lacking = type(body)(**{**vars(body), "roles": without, "neck": ()})
    pose = Pose({"left_collar": (0.0, 0.0, 20.0), "neck": (15.0, 0.0, 0.0)})
    after = add_pose(motion, lacking, pose, weights={}, method="body_fixed")
    heir = Pose({"left_shoulder": (0.0, 0.0, 20.0), "head": (15.0, 0.0, 0.0)})
    np.testing.assert_allclose(
        after, add_pose(motion, body, heir, weights={}, method="body_fixed"), atol=1e-12
    )


@given(st.floats(0, 100), st.floats(0.01, 50))
def test_soft_stop_keeps_what_has_room_and_never_goes_beyond(wanted: float, room: float) -> None:
    got = float(soft_stop(np.array(wanted), np.array(room)))
    assert 0.0 <= got <= min(wanted, room) + 1e-12
    if wanted <= 0.5 * room:
        assert got == wanted
    more = float(soft_stop(np.array(wanted * 1.01), np.array(room)))
    assert got <= more + 1e-12


def test_soft_stop_without_room_is_a_stop() -> None:
    np.testing.assert_array_equal(soft_stop(np.array([0.0, 1.0, 50.0]), np.zeros(3)), 0.0)


def test_soft_stop_has_no_kink() -> None:
    x = np.linspace(0, 3, 30001)
    slope = np.gradient(soft_stop(x, np.full_like(x, 1.0)), x)
    assert np.abs(np.diff(slope)).max() < 1e-3


@pytest.mark.parametrize("method", ["anatomical", "additive", "body_fixed"])
def test_turns_that_change_over_time_are_the_pose_of_each_frame(method: str) -> None:
    """Slow twin: at every tenth frame, the whole clip with that frame's pose."""
    motion = samples.walk(seconds=1.0).motion
    body = Body.of(motion)
    rng = np.random.default_rng(4)
    turns = {
        segment: rng.uniform(-40, 40, (len(motion), 3))
        for segment in ("hips", "trunk", "neck", "left_collar", "left_shoulder", "left_elbow", "right_knee")
    }
    found = add_turns(motion, body, turns, weights={}, method=method)
    for frame in range(0, len(motion), 10):
        pose = Pose({segment: tuple(turn[frame].tolist()) for segment, turn in turns.items()})
        alone = posed(motion, pose, method).rotations[frame]
        same = np.abs(np.einsum("ji,ji->j", found[frame], alone))
        np.testing.assert_allclose(same, 1.0, atol=1e-12)
