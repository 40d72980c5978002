"""The body found in the samples, whose truth is known, and what must not change it."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mien.errors import BodyError
from mien.kinematics.body import LEG, ROLES, SIDES, Body, read_map
from mien.kinematics.fk import fk, world
from mien.kinematics.heading import heading
from mien.kinematics.roles import check, format_map
from mien.kinematics.tree import tree as make_tree
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion as quat
from mien.samples import SAMPLES, SKELETONS, Sample, knock, still, walk

FORMS: list[dict[str, Any]] = [
    {"unit": "cm", "up": "y", "heading": 0.0},
    {"unit": "inch", "up": "z", "heading": 2.0},
]


def anonymous(motion: Motion) -> Motion:
    """The same motion with joint names that say nothing."""
    names = tuple(f"joint_{i}" for i in range(len(motion.skeleton)))
    return motion.with_(skeleton=replace(motion.skeleton, names=names))


def named(body: Body, motion: Motion) -> dict[str, str]:
    return {role: motion.skeleton.names[joint] for role, joint in body.roles.items()}


def turned(motion: Motion, rotation: Rotation, shift: Any = (0.0, 0.0, 0.0)) -> Motion:
    """The whole motion rotated in space and moved: the oracle is SciPy."""
    moved, local = np.array(motion.translations), np.array(motion.rotations)
    for root in np.flatnonzero(motion.skeleton.parents < 0):
        moved[:, root] = rotation.apply(moved[:, root]) + shift
        local[:, root] = (rotation * Rotation.from_quat(local[:, root])).as_quat()
    return motion.with_(rotations=local, translations=moved)


def scaled(motion: Motion, factor: float) -> Motion:
    s = motion.skeleton
    bigger = replace(s, offsets=s.offsets * factor, end_offsets=s.end_offsets * factor)
    return motion.with_(skeleton=bigger, translations=motion.translations * factor)


def without(motion: Motion, gone: str) -> Motion:
    """The motion of the skeleton with a joint and all below it cut off; an end site takes its place."""
    s = motion.skeleton
    cut = set(s.descendants(s.names.index(gone)))
    keep = [j for j in range(len(s)) if j not in cut]
    place = {j: i for i, j in enumerate(keep)} | {-1: -1}
    tips = [e for e, p in enumerate(s.end_parents) if int(p) not in cut]
    stump = s.names.index(gone)
    ends = [place[int(s.end_parents[e])] for e in tips] + [place[int(s.parents[stump])]]
    skeleton = Skeleton(
        tuple(s.names[j] for j in keep),
        np.array([place[int(s.parents[j])] for j in keep]),
        s.offsets[keep],
        np.array(ends),
        np.concatenate([s.end_offsets[tips], s.offsets[stump : stump + 1]]),
    )
    return Motion(skeleton, motion.rotations[:, keep], motion.translations[:, keep], motion.frame_time)


def every_sample() -> Iterator[Any]:
    for name in SAMPLES:
        for rig in SKELETONS:
            for form in FORMS:
                yield pytest.param(name, {"skeleton": rig, **form}, id=f"{name}-{rig}-{form['up']}")


@pytest.mark.parametrize(("name", "form"), list(every_sample()))
def test_finds_the_truth_of_every_sample_with_and_without_names(name: str, form: dict[str, Any]) -> None:
    truth: Sample = SAMPLES[name](**form)
    for motion in (truth.motion, anonymous(truth.motion)):
        body = Body.of(motion)
        assert named(body, truth.motion) == dict(truth.roles)
        np.testing.assert_array_equal(body.up, truth.up)
        assert body.leg_length == pytest.approx(truth.leg_length, rel=1e-3)
        assert body.metres_per_unit == pytest.approx(truth.metres_per_unit, rel=1e-6)
        assert abs(body.floor) < 0.02 * body.leg_length  # samples stand on the plane through the origin
        assert body.height * truth.metres_per_unit == pytest.approx(1.75, abs=0.05)


@pytest.mark.parametrize("rig", SKELETONS)
def test_heading_from_forward_is_the_heading_of_the_sample(rig: str) -> None:
    for angle in (-2.5, 0.0, 1.0):
        truth = still(skeleton=rig, heading=angle, seconds=1.0)
        motion = truth.motion
        body = Body.of(motion)
        assert heading(world(motion)[1], body).mean() == pytest.approx(angle, abs=0.03)


@pytest.mark.parametrize("rig", SKELETONS)
@pytest.mark.parametrize("up", ["y", "z"])
def test_neutral_stands_upright_arms_at_the_sides_facing_forward(rig: str, up: str) -> None:
    motion = knock(skeleton=rig, up=up, heading=1.0).motion
    body = Body.of(motion)
    points = fk(body.neutral[None], np.median(motion.translations, axis=0)[None], motion.skeleton.parents)[1][
        0
    ]

    def bone(a: str, b: str) -> np.ndarray:
        line = points[body.roles[b]] - points[body.roles[a]]
        return line / np.linalg.norm(line)

    for side, sign in zip(SIDES, (1, -1), strict=True):
        for a, b in pairwise(LEG[:3]):
            assert bone(f"{side}_{a}", f"{side}_{b}") @ -body.up > 0.9999
        assert bone(f"{side}_shoulder", f"{side}_elbow") @ -body.up > np.cos(np.radians(10))
        assert bone(f"{side}_shoulder", f"{side}_elbow") @ (sign * body.left) > 0  # clear of the thigh
        assert bone(f"{side}_elbow", f"{side}_wrist") @ -body.up > np.cos(np.radians(20))
        assert bone(f"{side}_ankle", f"{side}_toe") @ body.forward > 0.5
    assert bone("hips", "head") @ body.up > np.cos(np.radians(10))
    assert heading(points[None], body)[0] == pytest.approx(0.0, abs=1e-9)
    assert bone("right_hip", "left_hip") @ body.left > 0.99
    np.testing.assert_allclose(np.linalg.norm(body.neutral, axis=-1), 1.0, atol=1e-12)


@pytest.mark.parametrize("rig", SKELETONS)
def test_two_clips_of_one_actor_have_nearly_the_same_neutral_stance(rig: str) -> None:
    bodies = [Body.of(SAMPLES[name](skeleton=rig).motion) for name in ("walk", "knock", "jump", "still")]
    for other in bodies[1:]:
        apart = quat.log(quat.multiply(quat.conjugate(bodies[0].neutral), other.neutral))
        main = [j for r, j in other.roles.items() if not r.endswith(("wrist", "ankle", "toe", "head"))]
        assert np.degrees(np.linalg.norm(apart[main], axis=-1)).max() < 12.0
        np.testing.assert_array_equal(other.forward, bodies[0].forward)


@pytest.mark.parametrize("rig", SKELETONS)
@pytest.mark.parametrize("hide", [False, True], ids=["named", "anonymous"])
def test_does_not_depend_on_unit_place_or_heading(rig: str, hide: bool) -> None:
    motion = walk(skeleton=rig).motion
    motion = anonymous(motion) if hide else motion
    body = Body.of(motion)
    yaw = Rotation.from_rotvec(1.1 * body.up)
    side = np.cross(body.up, [0.3, 0.4, 0.5])
    for changed, factor, lift in (
        (scaled(motion, 37.0), 37.0, 0.0),
        (turned(motion, yaw, 90.0 * side), 1.0, 0.0),
        (turned(motion, yaw, 55.0 * body.up), 1.0, 55.0),
    ):
        other = Body.of(changed)
        assert other.roles == body.roles
        assert other.parts_of == body.parts_of
        np.testing.assert_array_equal(other.up, body.up)
        np.testing.assert_allclose(other.forward, body.forward, atol=1e-9)
        assert other.leg_length == pytest.approx(factor * body.leg_length, rel=1e-9)
        assert other.height == pytest.approx(factor * body.height, rel=1e-6)
        assert other.floor == pytest.approx(factor * body.floor + lift, abs=1e-6 * factor)
        same = np.abs(np.einsum("ji,ji->j", other.neutral, body.neutral))
        np.testing.assert_allclose(same, 1.0, atol=1e-9)


@pytest.mark.parametrize("rig", SKELETONS)
def test_nearly_does_not_depend_on_the_frame_rate(rig: str) -> None:
    slow, fast = (Body.of(walk(skeleton=rig, fps=fps).motion) for fps in (24.0, 120.0))
    assert slow.roles == fast.roles
    assert slow.leg_length == pytest.approx(fast.leg_length, rel=1e-6)
    assert slow.floor == pytest.approx(fast.floor, abs=0.01 * fast.leg_length)


@pytest.mark.parametrize("rig", SKELETONS)
def test_a_mirrored_clip_has_its_sides_where_the_names_say_else_where_it_faces(rig: str) -> None:
    motion = walk(skeleton=rig).motion
    s = motion.skeleton
    flip = np.array([-1.0, 1.0, 1.0])
    mirrored = motion.with_(  # reflected in the plane x = 0, every joint in its place in the file
        skeleton=replace(s, offsets=s.offsets * flip, end_offsets=s.end_offsets * flip),
        translations=motion.translations * flip,
        rotations=motion.rotations * np.array([1.0, -1.0, -1.0, 1.0]),
    )
    body = Body.of(motion)
    swap = {r: r.replace("left", "*").replace("right", "left").replace("*", "right") for r in body.roles}
    seen = Body.of(anonymous(mirrored))
    assert seen.roles == {swap[r]: j for r, j in body.roles.items()}
    assert Body.of(mirrored).roles == body.roles  # names are believed


@pytest.mark.parametrize("frames", [1, 2, 3])
@pytest.mark.parametrize("rig", SKELETONS)
def test_short_clips(rig: str, frames: int) -> None:
    truth = walk(skeleton=rig)
    body = Body.of(truth.motion[:frames])
    assert named(body, truth.motion) == dict(truth.roles)
    assert np.isfinite([body.leg_length, body.height, body.floor, *body.neutral.ravel()]).all()


@pytest.mark.parametrize("rig", ["standard22", "capture31", "poser43"])
def test_a_clip_that_lies_down_all_the_time_keeps_the_up_axis_of_its_rest_pose(rig: str) -> None:
    motion = still(skeleton=rig, seconds=1.0).motion
    lying = turned(motion, Rotation.from_rotvec([0.0, 0.0, 0.5 * np.pi]))
    np.testing.assert_array_equal(Body.of(lying).up, Body.of(motion).up)
    assert Body.of(lying).roles == Body.of(motion).roles


@pytest.mark.parametrize("hide", [False, True], ids=["named", "anonymous"])
@pytest.mark.parametrize(
    ("gone", "roles"),
    [
        (["LeftToeBase"], {"left_toe"}),
        (["LeftToeBase", "RightToeBase"], {"left_toe", "right_toe"}),
        (["LeftHand", "RightHand"], {"left_wrist", "right_wrist"}),
        (["Neck"], {"neck", "head"}),
        (["Head"], {"neck"}),
    ],
    ids=["one toe", "toes", "hands", "neck", "head"],
)
def test_what_may_be_missing(gone: list[str], roles: set[str], hide: bool) -> None:
    truth = walk(skeleton="standard22")
    motion = truth.motion
    for joint in gone:
        motion = without(motion, joint)
    body = Body.of(anonymous(motion) if hide else motion)
    expected = {r: n for r, n in truth.roles.items() if r not in roles}
    if gone == ["Head"]:  # what is left of neck and head is the head
        expected["head"] = "Neck"
    assert named(body, motion) == expected


def test_one_hand_is_found_by_its_name() -> None:
    motion = without(walk(skeleton="standard22").motion, "LeftHand")
    body = Body.of(motion)
    assert "left_wrist" not in body.roles
    assert motion.skeleton.names[body.roles["right_wrist"]] == "RightHand"


def test_limbs_spine_neck_and_parts_hang_together() -> None:
    for rig in SKELETONS:
        motion = walk(skeleton=rig).motion
        body = Body.of(motion)
        for limb, joints in body.limbs.items():
            assert joints == tuple(sorted(joints, key=lambda j: len(_line(motion, j))))
            assert {body.parts_of[j] for j in joints} == {limb}
        assert body.spine[-1] == body.roles["chest"]
        assert body.neck[0] == body.roles["neck"]
        assert {body.parts_of[j] for j in (body.roles["hips"], *body.spine)} == {"torso"}
        for joint, parent in enumerate(motion.skeleton.parents):  # a part never ends and starts again
            if parent >= 0 and body.parts_of[parent] not in ("", "torso"):
                assert body.parts_of[joint] == body.parts_of[parent]
        assert body.joints(()) == list(range(len(motion.skeleton)))
        assert body.joints(("upper",)) == sorted(
            set(body.joints(())) - set(body.joints(("legs",))) - _above(body)
        )
        assert body.joints(("left_elbow",)) == [body.roles["left_elbow"]]


def _line(motion: Motion, joint: int) -> list[int]:
    line = [joint]
    while motion.skeleton.parents[line[-1]] >= 0:
        line.append(int(motion.skeleton.parents[line[-1]]))
    return line


def _above(body: Body) -> set[int]:
    return {j for j, part in enumerate(body.parts_of) if part == ""}


def test_file_axes_above_the_hips_stay_in_the_neutral_stance() -> None:
    motion = still(skeleton="standard22", seconds=1.0).motion
    s = motion.skeleton
    tilt = Rotation.from_rotvec([-0.5 * np.pi, 0.0, 0.0])  # a Z-up scene under a node that makes it Y-up
    down = turned(motion, tilt.inv())
    skeleton = Skeleton(
        ("Scene", *s.names),
        np.concatenate([[-1], np.where(s.parents < 0, 0, s.parents + 1)]),
        np.concatenate([np.zeros((1, 3)), s.offsets]),
        s.end_parents + 1,
        s.end_offsets,
    )
    local = np.concatenate([np.tile(tilt.as_quat(), (len(motion), 1, 1)), down.rotations], axis=1)
    moved = np.concatenate([np.zeros((len(motion), 1, 3)), down.translations], axis=1)
    body = Body.of(Motion(skeleton, local, moved, motion.frame_time))
    np.testing.assert_array_equal(body.up, [0, 1, 0])
    np.testing.assert_allclose(body.neutral[0], tilt.as_quat(), atol=1e-12)
    assert body.parts_of[0] == ""


def test_same_motion_same_body_and_nothing_writable() -> None:
    motion = still(seconds=0.5).motion
    body = Body.of(motion)
    assert Body.of(motion) is body
    with pytest.raises(ValueError, match="read-only"):
        body.neutral[0] = 1.0


# ---- the user's map ---------------------------------------------------------------------------


def test_map_overrides_what_would_be_found() -> None:
    motion = walk(skeleton="poser43").motion
    found = Body.of(motion)
    body = Body.of(motion, map={"left_hip": "lButtock", "right_hip": "rButtock"})
    assert named(body, motion)["left_hip"] == "lButtock"
    assert {r: j for r, j in body.roles.items() if "hip" not in r} == {
        r: j for r, j in found.roles.items() if "hip" not in r
    }
    assert body.leg_length > found.leg_length


def test_map_alone_suffices() -> None:
    truth = walk(skeleton="capture31")
    motion = anonymous(truth.motion)
    place = {n: motion.skeleton.names[i] for i, n in enumerate(truth.motion.skeleton.names)}
    body = Body.of(motion, map={r: place[n] for r, n in truth.roles.items()})
    assert named(body, truth.motion) == dict(truth.roles)


def test_a_map_can_say_that_there_is_no_such_joint() -> None:
    motion = walk(skeleton="standard22").motion
    body = Body.of(motion, map={"chest": "", "left_toe": ""})
    assert set(Body.of(motion).roles) - set(body.roles) == {"chest", "left_toe"}
    with pytest.raises(BodyError, match="left_knee"):
        Body.of(motion, map={"left_knee": ""})


def test_a_map_is_written_as_it_is_read(tmp_path: Any) -> None:
    given = {"hips": 'the "root" \\ of it', "chest": "", "left_hip": "Oberschenkel ß"}
    path = tmp_path / "body.toml"
    path.write_text(format_map(given), encoding="utf-8")
    assert read_map(path) == given


def test_read_map(tmp_path: Any) -> None:
    path = tmp_path / "body.toml"
    path.write_text('[roles]\nhips = "pelvis"\nleft_hip = "thigh l"\n', encoding="utf-8")
    assert read_map(path) == {"hips": "pelvis", "left_hip": "thigh l"}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[roles\n", "not valid TOML"),
        ("hips = 'x'\n", r"\[roles\]"),
        ("[joints]\nhips = 'x'\n", r"\[roles\]"),
        ("[roles]\nhip = 'x'\n", "did you mean 'hips'"),
        ("[roles]\nhips = 3\n", "joint name in quotes"),
    ],
)
def test_a_bad_map_file_says_what_is_wrong(tmp_path: Any, text: str, message: str) -> None:
    path = tmp_path / "body.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(BodyError, match=message):
        read_map(path)


def test_a_map_file_that_is_not_there() -> None:
    with pytest.raises(BodyError, match="there is no such file"):
        read_map("no/such/body.toml")


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"hips": "Hipz"}, "did you mean 'Hips'"),
        ({"hip": "Hips"}, "did you mean 'hips'"),
        ({"left_knee": "RightLeg"}, "both the joint 'RightLeg'"),
        (
            {"left_toe": "RightToeBase", "right_toe": "LeftToeBase"},
            r"left_toe \('RightToeBase'\) does not hang below left_ankle",
        ),
    ],
)
def test_a_map_that_does_not_fit_says_why(given: dict[str, str], message: str) -> None:
    motion = walk(skeleton="standard22").motion
    with pytest.raises(BodyError, match=message):
        Body.of(motion, map=given)


def test_one_side_cannot_hang_below_the_other() -> None:
    motion = walk(skeleton="standard22").motion
    names = motion.skeleton.names
    roles = {role: j for role, j in Body.of(motion).roles.items() if role != "left_collar"}
    tree = make_tree(motion.skeleton, motion.rotations[:1], motion.translations[:1])
    with pytest.raises(BodyError, match=r"right_shoulder \('RightArm'\) hangs below left_shoulder"):
        check(tree, roles | {"left_shoulder": names.index("Spine1")})


def test_the_error_lists_the_joints_and_shows_the_lines_to_add() -> None:
    motion = without(walk(skeleton="standard22").motion, "RightArm")
    with pytest.raises(BodyError) as error:
        Body.of(motion)
    text = str(error.value)
    assert all(name in text for name in motion.skeleton.names)
    lines = text.split("[roles]\n")[1].splitlines()
    assert lines == ['right_shoulder = "..."', 'right_elbow = "..."']
    assert all(line.split(" = ")[0] in ROLES for line in lines)


def test_too_few_joints_are_no_body() -> None:
    stick = Skeleton(("a", "b"), [-1, 0], [[0, 0, 0], [0, 1, 0]])
    motion = Motion(stick, np.tile(quat.IDENTITY, (2, 2, 1)), np.tile(stick.offsets, (2, 1, 1)), 0.1)
    with pytest.raises(BodyError, match="skeleton of 2 joints"):
        Body.of(motion)


def test_a_second_root_is_no_part_of_the_body() -> None:
    motion = walk(skeleton="standard22").motion
    s = motion.skeleton
    skeleton = Skeleton(
        ("Camera", *s.names, "Prop"),
        np.concatenate([[-1], np.where(s.parents < 0, -1, s.parents + 1), [-1]]),
        np.concatenate([np.zeros((1, 3)), s.offsets, np.ones((1, 3))]),
        s.end_parents + 1,
        s.end_offsets,
    )
    local = np.concatenate([motion.rotations[:, :1], motion.rotations, motion.rotations[:, :1]], axis=1)
    moved = np.concatenate(
        [np.full((len(motion), 1, 3), 500.0), motion.translations, np.full((len(motion), 1, 3), 1.0)], axis=1
    )
    body, alone = Body.of(Motion(skeleton, local, moved, motion.frame_time)), Body.of(motion)
    assert body.roles == {role: joint + 1 for role, joint in alone.roles.items()}
    assert body.parts_of == ("", *alone.parts_of, "")
    assert body.floor == pytest.approx(alone.floor)


def test_legs_without_a_length_are_refused() -> None:
    motion = still(skeleton="standard22", seconds=0.05).motion
    flat = replace(motion.skeleton, offsets=np.zeros((len(motion.skeleton), 3)))
    with pytest.raises(BodyError, match="no length"):
        Body.of(motion.with_(skeleton=flat, translations=np.zeros_like(motion.translations)))


def test_a_role_that_a_body_lacks_has_no_joints() -> None:
    """Presets may name a part of the spine; a trunk of one joint has none, and that is no error."""
    body = Body.of(walk(seconds=0.5).motion)
    lacking = replace(body, roles={role: j for role, j in body.roles.items() if role != "spine"})
    assert lacking.joints(("spine",)) == []
    assert lacking.joints(("spine", "head")) == body.joints(("head",))
    with pytest.raises(BodyError, match="spoon"):
        lacking.joints(("spoon",))
