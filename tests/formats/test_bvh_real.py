"""Real clips: saved as they were read, and placed where other libraries place them."""

import re
from pathlib import Path

import numpy as np
import pytest

from mien.errors import BodyError, FormatError
from mien.formats import bvh, load
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.typing import Array

bvhio = pytest.importorskip("bvhio")
pybvh = pytest.importorskip("pybvh")

WRONG_COUNT = {"16_13_60fps", "16_19_60fps", "16_37_60fps", "16_44_60fps", "35_01_60fps", "Boxing_Toes"}
BROKEN = WRONG_COUNT | {"kick_1row_of_61"}
SHOWN = 8  # frames of each clip given to the other libraries


@pytest.fixture(scope="module")
def clips(data: Path) -> list[Path]:
    found = sorted(data.glob("*/*.bvh"))
    assert len(found) > 200
    return found


@pytest.fixture(scope="module")
def whole(clips: list[Path]) -> dict[Path, Motion]:
    return {path: load(path) for path in clips if path.stem not in BROKEN}


def test_every_clip_is_saved_as_it_was_read(whole: dict[Path, Motion]) -> None:
    for path, motion in whole.items():
        out = bvh.render(motion)
        header = motion.skeleton.layout.header
        assert path.read_bytes().startswith(header), path
        assert out.startswith(header), path
        again = bvh.parse(out, "again.bvh").source.values
        np.testing.assert_array_equal(again, motion.source.values, err_msg=str(path))


def test_numbers_are_those_in_the_text(whole: dict[Path, Motion]) -> None:
    for path in list(whole)[::10]:
        rows = re.split(rb"Frame Time:\s*\S+\s", path.read_bytes())[1]
        expected = np.array(rows.split(), np.float64)
        np.testing.assert_array_equal(whole[path].source.values.ravel(), expected, err_msg=str(path))


def test_wrong_counts_are_refused_and_salvaged(clips: list[Path]) -> None:
    for path in clips:
        if path.stem in WRONG_COUNT:
            rows = path.read_bytes().strip().count(b"\n") - path.read_bytes().split(b"Frame Time")[0].count(
                b"\n"
            )
            with pytest.raises(FormatError, match=f"frames are declared, but {rows} follow"):
                load(path)
            assert len(load(path, salvage=True)) == rows


def test_a_broken_hierarchy_is_named(clips: list[Path]) -> None:
    broken = next(path for path in clips if path.stem == "kick_1row_of_61")
    with pytest.raises(FormatError, match="line 35: 'z' has no place here"):
        load(broken)


def excerpt(path: Path, motion: Motion, folder: Path) -> tuple[Path, Array]:
    """Write a few rows of a clip, copied as text, for slow readers; return the file and which rows."""
    shown = np.unique(np.linspace(0, len(motion) - 1, SHOWN).astype(int))
    text = path.read_bytes()
    start = len(motion.skeleton.layout.header)
    head = re.sub(rb"(?i)(Frames:\s*)\d+", rb"\g<1>%d" % len(shown), text[:start])
    rows = text[start:].split(b"\n")
    (folder / path.name).write_bytes(head + b"\n".join(rows[i] for i in shown) + b"\n")
    return folder / path.name, shown


def leg_length(motion: Motion) -> float:
    try:
        return Body.of(motion).leg_length
    except BodyError:  # a few joints only
        return float(np.abs(motion.skeleton.offsets).max())


def test_pybvh_agrees_on_where_every_joint_is(whole: dict[Path, Motion], tmp_path: Path) -> None:
    opened = 0
    for path, motion in whole.items():
        file, shown = excerpt(path, motion, tmp_path)
        try:
            other = pybvh.read_bvh_file(file, warn_on_world_up_disagreement=False)
        except ValueError:  # it refuses position channels on joints that are not the root
            assert sum("position" in c for names in motion.skeleton.layout.channels[1:] for c in names)
            continue
        assert tuple(other.joint_names) == motion.skeleton.names
        off = np.abs(other.joint_positions() - world(motion)[1][shown]).max()
        assert off < 1e-4 * leg_length(motion), path
        opened += 1
    assert opened > 100


def test_bvhio_agrees_on_where_every_joint_is(whole: dict[Path, Motion], tmp_path: Path) -> None:
    opened = 0
    for path, motion in whole.items():
        file, shown = excerpt(path, motion, tmp_path)
        try:
            other = bvhio.readAsBvh(str(file))
        except (SyntaxError, IndexError):
            continue
        places = by_bvhio(other, len(shown))
        off = np.abs(places - world(motion)[1][shown]).max()
        assert off < 1e-4 * leg_length(motion), path
        opened += 1
    assert opened > 200


def by_bvhio(clip: "bvhio.BvhContainer", frames: int) -> Array:
    """Return the joints' places (T, J, 3) from bvhio's local poses, chained one by one."""
    places = []
    for frame in range(frames):
        stack, row = [(clip.Root, None, None)], []
        while stack:
            joint, rotation, place = stack.pop()
            pose = joint.Keyframes[frame]
            here = pose.Position if place is None else place + rotation * pose.Position
            turned = pose.Rotation if rotation is None else rotation * pose.Rotation
            row.append(tuple(here))
            stack += [(child, turned, here) for child in reversed(joint.Children)]
        places.append(row)
    return np.array(places)
