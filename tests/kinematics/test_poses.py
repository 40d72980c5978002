"""Poses as data: one line and one file hold them exactly; what a pose adds can be read off a still again."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mien import samples
from mien.edits.posture import posture
from mien.errors import RecipeError
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.poses import POSES, Pose, named_pose, pose_between, read_pose, write_pose
from mien.motion import Motion
from mien.rotations import quaternion as quat

SAD = Pose(
    {
        "hips": (4.0, 0.0, 0.0),
        "trunk": (18.0, 3.0, -2.0),
        "neck": (9.0, 0.0, 1.0),
        "head": (14.0, -6.0, 0.0),
        "left_shoulder": (-10.0, 5.0, -6.0),
        "right_shoulder": (-8.0, -5.0, 7.0),
        "left_elbow": (-20.0, 0.0, 0.0),
        "right_knee": (12.0, 0.0, 0.0),
    }
)


def still(skeleton: str = "standard22", **form: object) -> Motion:
    """The calm stance itself, one frame."""
    motion = samples.still(seconds=0.5, skeleton=skeleton, **form).motion[:1]
    return motion.with_(rotations=Body.of(motion).neutral[None])


def test_one_line_holds_a_pose_exactly() -> None:
    pose = Pose({"head": (1 / 3, -0.1, 25.0), "left_toe": (0.0, 1e-17, -180.0)})
    assert Pose.parse(str(pose)) == pose
    assert str(Pose({"head": (25, 0, 0)})) == "head 25 0 0"
    assert Pose.parse("") == Pose()


def test_a_file_holds_a_pose_exactly(tmp_path: Path) -> None:
    write_pose(tmp_path / "sad.toml", SAD)
    assert read_pose(tmp_path / "sad.toml") == SAD


def test_poses_add_and_scale() -> None:
    one, two = Pose({"head": (10, 0, 0)}), Pose({"head": (5, 1, 0), "trunk": (2, 0, 0)})
    assert one + two == Pose({"head": (15, 1, 0), "trunk": (2, 0, 0)})
    assert two * -0.5 == Pose({"head": (-2.5, -0.5, 0), "trunk": (-1, 0, 0)})


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("head_dwon", "head_down"),
        ("haed 1 2 3", "head"),
        ("head 1 2", "three numbers"),
        ("head 1 2 x", "three numbers"),
        ("head 1 2 nan", "three numbers"),
        ("sad.toml", "read_pose"),
    ],
)
def test_a_wrong_pose_is_answered_with_what_would_do(text: str, says: str) -> None:
    with pytest.raises(RecipeError, match=says):
        named_pose(text)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("turns = 3", "turns"),
        ("[turns\n", "not a pose file"),
        ("[turns]\nhead = [1, 2]", "three numbers"),
        ("[turns]\nhead = 4", "pose.toml"),
        ("[turns]\nhand = [1, 2, 3]", "segment"),
    ],
)
def test_a_wrong_file_is_named(tmp_path: Path, content: str, says: str) -> None:
    file = tmp_path / "pose.toml"
    file.write_text(content)
    with pytest.raises(RecipeError, match=says) as error:
        read_pose(file)
    assert "pose.toml" in str(error.value)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(RecipeError, match=r"gone\.toml: there is no such file"):
        read_pose(tmp_path / "gone.toml")


def test_named_poses_are_values_that_posture_has() -> None:
    for name, values in POSES.items():
        named, given = posture(still(), pose=name), posture(still(), **values)
        np.testing.assert_array_equal(named.rotations, given.rotations)
        assert np.abs(named.rotations - still().rotations).max() > 0.01


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("method", ["additive", "body_fixed", "anatomical"])
def test_a_pose_put_on_a_still_is_read_off_it_again(skeleton: str, method: str) -> None:
    """Whichever way it is added, at the neutral stance the result is the pose itself."""
    neutral = still(skeleton)
    found = pose_between(neutral, posture(neutral, pose=str(SAD), method=method, fade=False))
    body = Body.of(neutral)
    for segment in {**SAD.turns, "left_hip": 0, "right_ankle": 0}:
        if segment != "neck" or body.neck:
            expected = SAD.turns.get(segment, (0.0, 0.0, 0.0))
            # anatomical: about the elbow's own hinge, which is not quite the plain sideways axis
            close = 0.3 if method == "anatomical" else 1e-6
            np.testing.assert_allclose(found.turns[segment], expected, atol=close, err_msg=segment)


def test_a_pose_of_one_actor_fits_another() -> None:
    """Read off one skeleton and put on another, every role lies where it does with the pose itself."""
    source, target = still("capture31", up="z", unit="inch"), still("poser43")
    captured = pose_between(source, posture(source, pose=str(SAD), fade=False))
    one, other = (posture(target, pose=str(p), fade=False) for p in (SAD, captured))
    np.testing.assert_allclose(world(one)[1], world(other)[1], atol=1e-3 * Body.of(target).leg_length)


def test_where_an_actor_stands_and_faces_does_not_matter() -> None:
    here, there = still(), still(heading=2.5)
    shifted = there.translations + np.where(np.arange(len(there.skeleton)) == 0, 300.0, 0.0)[:, None]
    changed = posture(there.with_(translations=shifted), pose=str(SAD), fade=False, method="body_fixed")
    found = pose_between(here, changed).turns
    assert set(found) >= set(SAD.turns)
    for segment, turn in found.items():
        np.testing.assert_allclose(turn, SAD.turns.get(segment, (0, 0, 0)), atol=1e-6, err_msg=segment)


def test_hips_may_roll_but_their_yaw_is_left_out() -> None:
    neutral = still()
    roll = posture(neutral, pose="hips 3 0 5", fade=False)
    np.testing.assert_allclose(pose_between(neutral, roll).turns["hips"], (3.0, 0.0, 5.0), atol=0.02)


def test_a_clip_counts_as_its_mean_pose() -> None:
    """Oracle: SciPy's mean of rotations that sway about the pose."""
    neutral = still()
    sway = quat.exp(np.radians(np.linspace(-8, 12, 21))[:, None] * [0.3, -0.5, 0.8])
    head = Body.of(neutral).roles["head"]
    rotations = np.repeat(neutral.rotations, 21, axis=0)
    rotations[:, head] = quat.multiply(rotations[:, head], sway)
    clip = neutral.with_(rotations=rotations, translations=np.repeat(neutral.translations, 21, axis=0))
    stance = world(neutral)[0][0, head]
    mean = Rotation.from_quat(sway).mean()
    body = Body.of(neutral)
    turn = Rotation.from_quat(stance).apply(mean.as_rotvec(degrees=True))
    expected = [turn @ axis for axis in (body.left, body.up, body.forward)]
    np.testing.assert_allclose(pose_between(neutral, clip).turns["head"], expected, atol=1e-6)
