"""BVH files of every shape come in right and go out as they came."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mien.errors import FormatError
from mien.formats import bvh, load, save
from mien.kinematics.fk import world
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion

TWO_JOINTS = """HIERARCHY
ROOT Hips
{
\tOFFSET 0.00 0.00 0.00
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT Chest
\t{
\t\tOFFSET 0.00 5.00 0.00
\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 0.00 2.00 0.00
\t\t}
\t}
}
MOTION
Frames: 2
Frame Time: 0.033333
1.00 2.00 3.00 90.00 0.00 0.00 10.00 20.00 30.00
4.00 5.00 6.00 90.00 0.00 0.00 11.00 21.00 31.00
"""


def read(text: str | bytes, **options: object) -> Motion:
    data = text.encode() if isinstance(text, str) else text
    return bvh.parse(data, "clip.bvh", **options)  # type: ignore[arg-type]


def test_numbers_land_where_they_belong() -> None:
    motion = read(TWO_JOINTS)
    assert motion.name == "clip"
    assert motion.skeleton.names == ("Hips", "Chest")
    assert motion.skeleton.parents.tolist() == [-1, 0]
    assert motion.skeleton.end_parents.tolist() == [1]
    assert motion.frame_time == 0.033333
    np.testing.assert_array_equal(motion.translations[1], [[4, 5, 6], [0, 5, 0]])
    expected = Rotation.from_euler("ZXY", [11, 21, 31], degrees=True).as_quat()
    np.testing.assert_allclose(motion.rotations[1, 1], expected, atol=1e-12)
    # Hips turned 90 degrees about Z take the chest from above to the side of -X.
    np.testing.assert_allclose(world(motion)[1][0, 1], [1 - 5, 2, 3], atol=1e-12)


VARIANTS = {
    "windows line ends": TWO_JOINTS.replace("\n", "\r\n"),
    "old mac line ends": TWO_JOINTS.replace("\n", "\r"),
    "byte order mark": "\ufeff" + TWO_JOINTS,
    "brace on the line of the joint": TWO_JOINTS.replace("Chest\n\t{", "Chest {"),
    "brace and offset on one line": TWO_JOINTS.replace("{\n\t\tOFFSET 0.00 5", "{ OFFSET 0.00 5"),
    "braces glued to numbers": TWO_JOINTS.replace("2.00 0.00\n\t\t}", "2.00 0.00}"),
    "odd case": TWO_JOINTS.replace("JOINT", "Joint")
    .replace("Zrotation", "ZROTATION")
    .replace("Xpos", "xPos"),
    "lower-case keywords": TWO_JOINTS.replace("OFFSET", "offset").replace("MOTION", "motion").lower(),
    "blank lines": TWO_JOINTS.replace("\n", "\n\n"),
    "trailing blanks": TWO_JOINTS.replace("\n", "  \t\n"),
    "tabs between numbers": TWO_JOINTS.replace(" ", "\t").replace("End\tSite", "End Site"),
    "several blanks between numbers": TWO_JOINTS.replace(" 90.00", "    90.00"),
    "leading blanks": TWO_JOINTS.replace("\n1.00", "\n  1.00").replace("\n4.00", "\n  4.00"),
    "no final line end": TWO_JOINTS.rstrip("\n"),
    "scientific notation": TWO_JOINTS.replace("90.00", "9.0e1")
    .replace("10.00", "1E+1")
    .replace("4.00", ".04e2"),
    "integers": TWO_JOINTS.replace(".00", ""),
    "no blank after Frames": TWO_JOINTS.replace("Frames: ", "Frames:").replace("Time: ", "Time:"),
    "tabs after Frames": TWO_JOINTS.replace("Frames: ", "Frames:\t\t").replace("Time: ", "Time:\t"),
    "blank before the colon": TWO_JOINTS.replace("Frames:", "Frames :").replace("Time:", "Time :"),
    "rows wrapped over two lines": TWO_JOINTS.replace(" 90.00", "\n90.00"),
    "all rows on one line": TWO_JOINTS.replace("30.00\n", "30.00 "),
    "plus signs": TWO_JOINTS.replace("\n1.00", "\n+1.00"),
}


@pytest.mark.parametrize("name", VARIANTS)
def test_spelling_makes_no_difference(name: str) -> None:
    plain, motion = read(TWO_JOINTS), read(VARIANTS[name])
    assert [n.lower() for n in motion.skeleton.names] == ["hips", "chest"]
    assert motion.skeleton.end_parents.tolist() == [1]
    np.testing.assert_array_equal(motion.skeleton.offsets, plain.skeleton.offsets)
    np.testing.assert_array_equal(motion.rotations, plain.rotations)
    np.testing.assert_array_equal(motion.translations, plain.translations)


@pytest.mark.parametrize("name", VARIANTS)
def test_saving_gives_back_the_header_and_the_numbers(name: str) -> None:
    text = VARIANTS[name].encode()
    motion = read(text)
    out = bvh.render(motion)
    header = motion.skeleton.layout.header
    assert text.startswith(header)
    assert b"Time" in header or b"time" in header
    assert out.startswith(header)
    np.testing.assert_array_equal(read(out).source.values, motion.source.values)


def test_a_file_as_most_programs_write_it_comes_back_byte_for_byte() -> None:
    assert bvh.render(read(TWO_JOINTS)) == TWO_JOINTS.encode()
    assert bvh.render(read(TWO_JOINTS.replace("\n", "\r\n"))) == TWO_JOINTS.replace("\n", "\r\n").encode()


@pytest.mark.parametrize("encoding", ["utf-8", "cp1252", "latin-1"])
def test_names_with_blanks_and_letters_of_any_kind(encoding: str) -> None:
    name = "Hüfte links" if encoding != "latin-1" else "H\x81fte\x9d links"  # cp1252 has no 0x81, 0x9d
    text = TWO_JOINTS.replace("JOINT Chest", f"JOINT {name}").encode(encoding)
    motion = read(text)
    assert motion.skeleton.names[1] == name
    assert bvh.render(motion) == text


def test_a_changed_skeleton_keeps_channels_line_ends_and_encoding() -> None:
    text = TWO_JOINTS.replace("Chest", "Rücken").replace("\n", "\r\n").encode("cp1252")
    motion = read(text)
    longer = Skeleton(
        names=motion.skeleton.names,
        parents=motion.skeleton.parents,
        offsets=motion.skeleton.offsets * 2,
        end_parents=motion.skeleton.end_parents,
        end_offsets=motion.skeleton.end_offsets * 2,
        layout=motion.skeleton.layout,
    )
    moved = np.array(motion.translations)
    moved[:, 1] *= 2
    out = bvh.render(motion.with_(skeleton=longer, translations=moved))
    assert b"OFFSET 0.000000 10.000000 0.000000\r\n" in out
    assert "JOINT Rücken\r\n".encode("cp1252") in out
    again = read(out)
    assert again.skeleton.layout.channels == motion.skeleton.layout.channels
    np.testing.assert_array_equal(again.source.values, motion.source.values)


def hierarchy(*joints: str) -> str:
    """Return a chain of joints, each given as 'name | channels', with offsets 0 1 0."""
    lines = ["HIERARCHY"]
    for i, joint in enumerate(joints):
        name, _, channels = joint.partition("|")
        lines += [f"{'JOINT' if i else 'ROOT'} {name.strip()}", "{", "OFFSET 0 1 0"]
        lines += [f"CHANNELS {len(channels.split())} {channels.strip()}"]
    return "\n".join([*lines, *"}" * len(joints), "MOTION", ""])


@pytest.mark.parametrize("order", ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"])
def test_every_order_of_axes(order: str) -> None:
    channels = " ".join(f"{axis}rotation" for axis in order)
    text = hierarchy(f"a | {channels} Xposition Yposition Zposition", f"b | {channels}")
    angles = [[30, -50, 110], [-170, 80, 20]]
    motion = read(text + "Frames: 1\nFrame Time: 1\n30 -50 110 7 8 9 -170 80 20\n")
    for joint, degrees in enumerate(angles):
        expected = Rotation.from_euler(order, degrees, degrees=True).as_quat()
        off = min(abs(motion.rotations[0, joint] - s * expected).max() for s in (1, -1))
        assert off < 1e-12
    np.testing.assert_array_equal(motion.translations[0], [[7, 8, 9], [0, 1, 0]])


def test_joints_with_few_channels_and_positions_anywhere() -> None:
    text = hierarchy(
        "root | Yposition Zrotation Xposition",
        "hinge | Xrotation",
        "fixed |",
        "slider | Yposition",
        "both | Xrotation Zrotation",
        "six | Zposition Xrotation Yposition Yrotation Xposition Zrotation",
    )
    row = "2 90 3 45 8 10 20 1 30 2 40 3 50"
    motion = read(f"{text}Frames: 1\nFrame Time: 0.01\n{row}\n")
    np.testing.assert_array_equal(
        motion.translations[0], [[3, 2, 0], [0, 1, 0], [0, 1, 0], [0, 8, 0], [0, 1, 0], [3, 2, 1]]
    )
    turns = [("Z", [90]), ("X", [45]), ("X", [0]), ("X", [0]), ("XZ", [10, 20]), ("XYZ", [30, 40, 50])]
    expected = [Rotation.from_euler(order, angles, degrees=True).as_quat().ravel() for order, angles in turns]
    np.testing.assert_allclose(motion.rotations[0], expected, atol=1e-12)
    assert bvh.render(motion).decode().split("\n")[-2] == row


def test_several_roots_repeated_names_and_no_end_sites() -> None:
    first = hierarchy("a | Zrotation", "twin | Zrotation").replace("MOTION\n", "")
    second = hierarchy("b | Zrotation", "twin | Zrotation").replace("HIERARCHY\n", "")
    text = first + second + "Frames: 2\nFrame Time: 0.01\n1 2 3 4\n5 6 7 8\n"
    motion = read(text)
    assert motion.skeleton.names == ("a", "twin", "b", "twin")
    assert motion.skeleton.parents.tolist() == [-1, 0, -1, 2]
    assert len(motion.skeleton.end_parents) == 0
    assert bvh.render(motion) == text.encode()


@pytest.mark.parametrize("joints", [1, 200, 1000])
def test_from_one_joint_to_many(joints: int) -> None:
    text = hierarchy(*[f"joint {i} | Zrotation Xrotation Yrotation" for i in range(joints)])
    row = " ".join(str(i % 90) for i in range(3 * joints))
    motion = read(f"{text}Frames: 1\nFrame Time: 0.01\n{row}\n")
    assert len(motion.skeleton) == joints
    assert motion.skeleton.names[-1] == f"joint {joints - 1}"
    assert bvh.render(motion).decode().split("\n")[-2] == row


@pytest.mark.parametrize("fps", [1, 23.976, 24, 60, 119.88, 1000])
def test_frame_rates(fps: float) -> None:
    text = TWO_JOINTS.replace("0.033333", repr(1 / fps))
    assert read(text).fps == pytest.approx(fps, rel=1e-12)
    changed = read(TWO_JOINTS, fps=fps)
    assert changed.frame_time == 1 / fps
    assert read(bvh.render(changed)).frame_time == 1 / fps


def test_the_text_of_the_frame_time_is_kept() -> None:
    text = TWO_JOINTS.replace("0.033333", ".0333330")
    assert b"Frame Time: .0333330\n" in bvh.render(read(text))


def test_what_was_not_edited_keeps_its_numbers() -> None:
    text = TWO_JOINTS.replace("10.00 20.00 30.00", "370.0 200.0 -30.12345678901234")
    motion = read(text)
    rotations = np.array(motion.rotations)
    rotations[1, 0] = quaternion.multiply(rotations[1, 0], quaternion.exp(np.array([0.1, 0, 0])))
    again = read(bvh.render(motion.with_(rotations=rotations)))
    np.testing.assert_array_equal(again.source.values[0], motion.source.values[0])
    np.testing.assert_array_equal(again.source.values[1, 6:], motion.source.values[1, 6:])
    np.testing.assert_allclose(again.rotations, rotations, atol=1e-8)


def spin(*, frames: int = 200, offset: float = 0.0) -> Motion:
    """Return a joint that turns three times about Z while it sways, as a file would have it."""
    text = hierarchy("a | Zrotation Xrotation Yrotation")
    turn = np.linspace(0, 3 * 360, frames) + offset
    sway = 60 * np.sin(np.linspace(0, 9, frames))
    rows = "\n".join(f"{a:.6f} {b:.6f} {b / 2:.6f}" for a, b in zip(turn, sway, strict=True))
    return read(f"{text}Frames: {frames}\nFrame Time: 0.01\n{rows}\n")


@pytest.mark.parametrize("offset", [0.0, 720.0, -1080.0])
@pytest.mark.parametrize("part", [slice(None), slice(50, 150), slice(0, 100), slice(120, None)])
def test_edited_curves_stay_on_the_branch_of_the_source(offset: float, part: slice) -> None:
    motion = spin(offset=offset)
    rotations = np.array(motion.rotations)
    nod = quaternion.exp(np.array([0.2, 0.0, 0.0]))
    rotations[part] = quaternion.multiply(rotations[part], nod)
    again = read(bvh.render(motion.with_(rotations=rotations)))
    same = np.abs(np.einsum("tji,tji->tj", again.rotations, rotations))
    assert same.min() > 1 - 1e-12
    # A nod of 11.5 degrees moves no angle by more than a quarter turn, and whole turns not at all.
    assert np.abs(again.source.values - motion.source.values).max() < 45


def test_the_other_triple_is_kept_too() -> None:
    text = hierarchy("a | Zrotation Xrotation Yrotation")
    rows = "\n".join(f"{170 + i} {120 + i} {185 + i}" for i in range(20))  # middle angle beyond 90
    motion = read(f"{text}Frames: 20\nFrame Time: 0.01\n{rows}\n")
    rotations = np.array(quaternion.multiply(motion.rotations, quaternion.exp(np.array([0.02, 0.01, 0.0]))))
    again = read(bvh.render(motion.with_(rotations=rotations)))
    assert np.abs(again.source.values - motion.source.values).max() < 5


def test_a_slice_is_written_from_its_rotations() -> None:
    motion = spin()[20:40]
    assert motion.source is None
    again = read(bvh.render(motion))
    assert len(again) == 20
    assert np.abs(np.einsum("tji,tji->tj", again.rotations, motion.rotations)).min() > 1 - 1e-12


def test_rotation_that_the_channels_cannot_hold_is_refused() -> None:
    text = hierarchy("root | Zrotation", "elbow | Xrotation", "still |")
    motion = read(f"{text}Frames: 2\nFrame Time: 0.01\n1 722\n3 724\n")

    def turned(joint: int, axis: list[float]) -> Motion:
        rotations = np.array(motion.rotations)
        rotations[:, joint] = quaternion.multiply(rotations[:, joint], quaternion.exp(np.array(axis)))
        return motion.with_(rotations=rotations)

    values = read(bvh.render(turned(1, [np.radians(100), 0, 0]))).source.values
    np.testing.assert_allclose(values, [[1, 822], [3, 824]], atol=1e-5)
    with pytest.raises(FormatError, match="'elbow' has only X rotation"):
        bvh.render(turned(1, [0, 0.1, 0]))
    with pytest.raises(FormatError, match="'still' has no rotation"):
        bvh.render(turned(2, [0, 0.1, 0]))


def test_two_axes_hold_any_angles_of_theirs() -> None:
    text = hierarchy("a | Xrotation Zrotation")
    motion = read(f"{text}Frames: 3\nFrame Time: 0.01\n10 100\n20 150\n30 250\n")
    kept = read(bvh.render(motion.with_(source=None)))
    np.testing.assert_allclose(kept.rotations, motion.rotations, atol=1e-7)


def test_movement_without_channels_is_refused_or_carried_by_a_dummy_root() -> None:
    six = "Xposition Yposition Zposition Zrotation Xrotation Yrotation"
    turns = "Zrotation Xrotation Yrotation"
    text = hierarchy(f"dummy | {six}", f"hips | {turns}", f"chest | {turns}")
    row = "1 2 3 40 50 60 1 2 3 4 5 6\n"
    motion = read(f"{text}Frames: 2\nFrame Time: 0.01\n{row}{row}")
    translations = np.array(motion.translations)
    translations[1, 1] += [1.0, 0.5, -2.0]
    moved = motion.with_(translations=translations)
    np.testing.assert_allclose(world(read(bvh.render(moved)))[1][:, 1:], world(moved)[1][:, 1:], atol=1e-5)
    fork = text.replace("MOTION\n", "").rstrip("}\n")
    fork += "\n}\n}\nJOINT leg\n{\nOFFSET 0 1 0\n}\n}\nMOTION\n"
    motion = read(f"{fork}Frames: 1\nFrame Time: 0.01\n{row}")
    translations = np.array(motion.translations)
    translations[0, 1] += 1.0
    with pytest.raises(FormatError, match="'hips' was moved"):
        bvh.render(motion.with_(translations=translations))


def test_a_motion_from_nowhere_gets_a_plain_layout(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    skeleton = Skeleton(
        names=("Hips", "Leg", "Arm"),
        parents=np.array([-1, 0, 0]),
        offsets=np.array([[0, 1, 0], [0, -1, 0], [1 / 3, 0, 0]]),
        end_parents=np.array([2]),
        end_offsets=np.array([[0.5, 0, 0]]),
    )
    translations = np.tile(skeleton.offsets, (5, 1, 1))
    translations[:, [0, 2]] += rng.normal(size=(5, 2, 3))
    rotations = quaternion.normalise(rng.normal(size=(5, 3, 4)))
    motion = Motion(skeleton, rotations, translations, 1 / 30)
    save(motion, tmp_path / "a.bvh")
    again = load(tmp_path / "a.bvh")
    assert [len(c) for c in again.skeleton.layout.channels] == [6, 3, 6]
    assert again.frame_time == 1 / 30
    np.testing.assert_array_equal(again.skeleton.offsets, skeleton.offsets)
    np.testing.assert_array_equal(again.skeleton.end_offsets, skeleton.end_offsets)
    np.testing.assert_allclose(world(again)[1], world(motion)[1], atol=1e-5)


CHANNEL = st.permutations([f"{a}{k}" for a in "XYZ" for k in ("position", "rotation")])
ANGLE = st.floats(-720, 720) | st.sampled_from([0.0, 90.0, -90.0, 180.0, 1e-9])


@st.composite
def files(draw: st.DrawFn) -> str:
    """Return the text of a file: a tree of joints with any channels, any numbers, any line ends."""
    lines, counts, depth = ["HIERARCHY"], [], 0
    for i in range(draw(st.integers(1, 6))):
        down = draw(st.integers(0, depth)) if i else 0
        lines += ["}"] * down
        depth -= down
        counts.append(draw(st.integers(0 if i else 1, 6)))
        offset = " ".join(repr(draw(st.floats(-100, 100))) for _ in range(3))
        channels = draw(CHANNEL)[: counts[-1]]
        lines += [f"{'JOINT' if depth else 'ROOT'} joint {i}", "{", f"OFFSET {offset}"]
        lines += [" ".join(["CHANNELS", str(counts[-1]), *channels])]
        depth += 1
    frames = draw(st.integers(1, 5))
    rows = [" ".join(repr(draw(ANGLE)) for _ in range(sum(counts))) for _ in range(frames)]
    lines += ["}"] * depth + ["MOTION", f"Frames: {frames}", "Frame Time: 0.01", *rows, ""]
    return draw(st.sampled_from(["\n", "\r\n", "\r"])).join(lines)


@settings(max_examples=150, deadline=None)
@given(text=files())
def test_any_file_comes_back_as_it_was(text: str) -> None:
    motion = read(text)
    out = bvh.render(motion)
    assert out.startswith(motion.skeleton.layout.header)
    np.testing.assert_array_equal(read(out).source.values, motion.source.values)


@settings(max_examples=150, deadline=None)
@given(text=files())
def test_any_file_without_its_numbers_comes_back_with_the_same_motion(text: str) -> None:
    motion = read(text)
    again = read(bvh.render(motion.with_(source=None)))
    same = np.abs(np.einsum("tji,tji->tj", again.rotations, motion.rotations))
    assert same.min() > 1 - 1e-12
    np.testing.assert_allclose(again.translations, motion.translations, atol=1e-6)
