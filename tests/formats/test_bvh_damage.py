"""Damaged BVH files: one clear sentence with file and line, or with salvage what is whole."""

import re

import numpy as np
import pytest

from mien.errors import FormatError, MienError
from mien.formats import bvh
from mien.motion import Motion

HEAD = """HIERARCHY
ROOT Hips
{
OFFSET 0 0 0
CHANNELS 3 Xposition Yposition Zposition
JOINT Chest
{
OFFSET 0 5 0
CHANNELS 3 Zrotation Xrotation Yrotation
End Site
{
OFFSET 0 2 0
}
}
}
MOTION
"""
ROWS = [f"{i} {i}.5 0 1 2 {i}" for i in range(10)]
FIRST_ROW = 19


def clip(rows: list[str] = ROWS, *, frames: object = 10, time: object = "0.01", head: str = HEAD) -> str:
    return "\n".join([f"{head}Frames: {frames}", f"Frame Time: {time}", *rows, ""])


def read(text: str | bytes, **options: object) -> Motion:
    data = text.encode() if isinstance(text, str) else text
    return bvh.parse(data, "walk.bvh", **options)  # type: ignore[arg-type]


def changed(row: int, text: str) -> str:
    return clip([*ROWS[:row], text, *ROWS[row + 1 :]])


def test_the_undamaged_clip_is_whole() -> None:
    assert len(read(clip())) == 10
    assert clip().split("\n")[FIRST_ROW - 1] == ROWS[0]


ROW_DAMAGE = {
    "short row": (changed(4, "4 4.5 0 1 2"), 4, ": 5 numbers where 6 were declared; frame 5 is damaged"),
    "long row": (changed(4, "4 4.5 0 1 2 4 9"), 4, "7 numbers where 6 were declared"),
    "cut-off last row": (
        clip()[:-4],
        9,
        "4 numbers where 6 were declared; the file looks cut off after frame 9 ",
    ),
    "nan": (changed(4, "4 4.5 0 nan 2 4"), 4, "number 4 is 'nan', not a finite number"),
    "huge": (changed(4, "4 4.5 0 1e308 2 4"), 4, "number 4 is '1e308', not a finite number up to 1e9"),
    "infinity": (changed(4, "4 4.5 0 1 -inf 4"), 4, "number 5 is '-inf'"),
    "too large for a float": (changed(4, "4 4.5 0 1 1e999 4"), 4, "number 5 is '1e999'"),
    "text": (changed(4, "4 4.5 0 1 2 oops"), 4, "number 6 is 'oops'"),
    "two numbers run together": (changed(4, "4 4.5 0 1 2-3 4"), 4, "number 5 is '2-3'"),
    "two points": (changed(4, "4 4.5.1 0 1 2 4"), 4, "number 2 is '4.5.1'"),
    "exponent without digits": (changed(4, "4 4.5e 0 1 2 4"), 4, "number 2 is '4.5e'"),
    "decimal comma": (changed(4, "4 4,5 0 1 2 4"), 4, "write decimals with a point"),
    "underscore": (changed(4, "4 1_0 0 1 2 4"), 4, "number 2 is '1_0'"),
    "bytes": (clip().encode().replace(b"4.5", b"\x00\xff\xfe"), 4, "number 2 is"),
    "words after the last row": (clip([*ROWS, "the end"]), 10, "'the'"),
}


@pytest.mark.parametrize("name", ROW_DAMAGE)
def test_damaged_rows_name_the_line_and_salvage_keeps_what_comes_before(name: str) -> None:
    text, good, message = ROW_DAMAGE[name]
    with pytest.raises(FormatError) as caught:
        read(text)
    said = str(caught.value)
    assert said.startswith(f"walk.bvh line {FIRST_ROW + good}: ")
    assert re.search(message, said)
    assert f"--salvage to keep the first {good} frames" in said
    assert "\n" not in said
    kept = read(text, salvage=True)
    assert len(kept) == good
    np.testing.assert_array_equal(kept.source.values, read(clip()).source.values[:good])
    assert f"Frames: {good}\n".encode() in bvh.render(kept)


def test_the_line_is_right_with_any_line_end() -> None:
    for end in ("\r\n", "\r"):
        with pytest.raises(FormatError, match=f"line {FIRST_ROW + 4}: number 6"):
            read(changed(4, "4 4.5 0 1 2 oops").replace("\n", end))


@pytest.mark.parametrize("declared", [9, 11, 1000, 10**12, 10**18 - 1])
def test_a_wrong_frame_count_is_refused_or_corrected(declared: int) -> None:
    with pytest.raises(FormatError, match=f"line 17: {declared} frames are declared, but 10 follow"):
        read(clip(frames=declared))
    kept = read(clip(frames=declared), salvage=True)
    assert len(kept) == 10
    assert b"Frames: 10\n" in bvh.render(kept)


@pytest.mark.parametrize("frames", [0, -5, "ten", "1e3", "10.0", "9" * 5000])
def test_a_frame_count_that_is_none(frames: object) -> None:
    with pytest.raises(FormatError, match="line 17: the number of frames must be a whole number above 0"):
        read(clip(frames=frames))


@pytest.mark.parametrize("time", [0, -0.01, "nan", "inf", "fast", "0,01", 1e-320, 1e300])
def test_a_frame_time_that_is_none_can_be_overridden(time: object) -> None:
    with pytest.raises(FormatError, match=r"line 18: the frame time must be .* --fps"):
        read(clip(time=time))
    motion = read(clip(time=time), fps=50)
    assert motion.frame_time == 0.02
    assert b"Frame Time: 0.02\n" in bvh.render(motion)


HEADER_DAMAGE = {
    "empty": ("", "the file is empty"),
    "only blanks": (" \n\t\n", "the file is empty"),
    "no MOTION": (clip()[: clip().index("MOTION")], "there is no MOTION"),
    "only rows": ("\n".join(ROWS), "does not start with HIERARCHY"),
    "another kind of text": ('{"asset": {"version": "2.0"}}', "does not start with HIERARCHY"),
    "another kind of text with MOTION": ("hello\nMOTION\n", "line 1: not a BVH file: it starts with 'hello'"),
    "binary": (bytes(range(256)) * 40, "not a text file"),
    "UTF-16": (clip().encode("utf-16"), "this is UTF-16 text; save it as UTF-8"),
    "no Frames": (clip().replace("Frames: 10\n", ""), "line 17: expected 'Frames: 10'"),
    "no Frame Time": (clip().replace("Frame Time: 0.01\n", ""), "line 18: expected 'Frame Time: 0.01'"),
    "ends after MOTION": (HEAD, "expected 'Frames"),
    "no rows": (clip([]), "there are no numbers"),
    "no joints": ("HIERARCHY\nMOTION\nFrames: 1\nFrame Time: 1\n1\n", "no HIERARCHY with a ROOT"),
    "no channels": (re.sub("CHANNELS.*", "CHANNELS 0", clip()), "no joint has channels"),
    "brace too many": (clip().replace("}\nMOTION", "}\n}\nMOTION"), "line 16: a '}' without a '{'"),
    "brace missing": (
        clip().replace("}\n}\nMOTION", "}\nMOTION"),
        "block of 'Hips' .line 2. is never",
    ),
    "brace not opened": (clip().replace("Chest\n{", "Chest"), "line 7: expected '{' after 'Chest'"),
    "brace from nowhere": (clip().replace("OFFSET 0 5", "{\nOFFSET 0 5"), "line 8: a '{' that belongs to no"),
    "JOINT outside": (clip().replace("ROOT", "JOINT"), "line 2: JOINT 'Hips' hangs on no joint"),
    "ROOT inside": (clip().replace("JOINT", "ROOT"), "line 6: ROOT 'Chest' inside joint 'Hips'"),
    "no name": (clip().replace("JOINT Chest", "JOINT"), "line 6: JOINT without a name"),
    "no OFFSET": (clip().replace("OFFSET 0 2 0\n", ""), "line 12: 'Site' .line 10. has no OFFSET"),
    "short OFFSET": (clip().replace("OFFSET 0 5 0", "OFFSET 0 5"), "line 8: OFFSET needs three numbers"),
    "OFFSET of words": (clip().replace("OFFSET 0 5 0", "OFFSET 0 x 0"), "line 8: OFFSET needs three"),
    "OFFSET without end": (clip().replace("OFFSET 0 5 0", "OFFSET 0 inf 0"), "line 8: OFFSET needs three"),
    "too few channel names": (clip().replace(" Zposition", ""), "line 5: CHANNELS needs a count"),
    "a billion channels": (clip().replace("CHANNELS 3 X", "CHANNELS 999999999 X"), "line 5: CHANNELS needs"),
    "unknown channel": (
        clip().replace("Zrotation", "Zrotaton"),
        "did you mean 'Zrotation'",
    ),
    "channel twice": (clip().replace("Zrotation", "Xrotation"), "line 9: joint 'Chest' has a channel twice"),
    "unknown word": (clip().replace("OFFSET 0 5", "OFSET 0 5"), "line 8: 'OFSET 0 5 0' has no place here"),
}


@pytest.mark.parametrize("name", HEADER_DAMAGE)
def test_damaged_headers_are_named(name: str) -> None:
    text, message = HEADER_DAMAGE[name]
    with pytest.raises(FormatError, match=message) as caught:
        read(text)
    assert str(caught.value).startswith("walk.bvh")


def test_salvage_closes_open_braces_and_writes_a_whole_file() -> None:
    broken = clip().replace("}\n}\nMOTION", "MOTION")
    kept = read(broken, salvage=True)
    again = read(bvh.render(kept))
    assert again.skeleton.names == ("Hips", "Chest")
    np.testing.assert_array_equal(again.source.values, read(clip()).source.values)


def test_salvage_ignores_a_brace_too_many() -> None:
    kept = read(clip().replace("}\nMOTION", "}\n}\nMOTION"), salvage=True)
    np.testing.assert_array_equal(read(bvh.render(kept)).source.values, read(clip()).source.values)


def test_salvage_of_nothing_is_an_error() -> None:
    with pytest.raises(FormatError, match="no frame is whole"):
        read(changed(0, "x"), salvage=True)


def test_deep_nesting_and_a_million_joints_end_quickly() -> None:
    deep = "HIERARCHY\n" + "ROOT a {\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n"
    deep += "JOINT b {\nOFFSET 0 1 0\n" * 3000 + "}" * 3001 + "\n"
    motion = read(f"{deep}MOTION\nFrames: 1\nFrame Time: 1\n5\n")
    assert len(motion.skeleton) == 3001
    assert read(bvh.render(motion.with_(source=None))).skeleton.names == motion.skeleton.names
    many = "HIERARCHY\n" + "ROOT a {\nOFFSET 0 0 0\n}\n" * 1_000_000
    with pytest.raises(FormatError, match="more than 5000 joints"):
        read(f"{many}MOTION\nFrames: 1\nFrame Time: 1\n5\n")


@pytest.mark.parametrize("fps", [0, -30, float("nan"), float("inf")])
def test_a_rate_that_is_none(fps: float, tmp_path: object) -> None:
    from mien.formats import load

    with pytest.raises(MienError, match="fps must be above 0"):
        load(f"{tmp_path}/a.bvh", fps=fps)
