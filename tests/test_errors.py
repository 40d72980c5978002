"""Hints name what was meant, or nothing."""

import pytest

import mien
from mien.errors import unknown
from mien.kinematics.body import PARTS, ROLES

BODY = [*PARTS, *ROLES]


@pytest.mark.parametrize(
    ("asked", "known", "meant"),
    [
        ("saad", mien.PRESETS, "sad"),
        ("sda", mien.PRESETS, "sad"),
        ("SDA", mien.PRESETS, "sad"),
        ("confidnet", mien.PRESETS, "confident"),
        ("haed", BODY, "head"),
        ("arm", BODY, "arms"),
        ("Left_Arm", BODY, "left_arm"),
        ("rigth_wirst", BODY, "right_wrist"),
    ],
)
def test_a_slip_is_understood(asked: str, known: list[str], meant: str) -> None:
    assert f"did you mean {meant!r}?" in unknown("name", asked, known)


@pytest.mark.parametrize(
    ("asked", "known"),
    [
        ("depressed", mien.PRESETS),
        ("bored", mien.PRESETS),
        ("joyful", mien.PRESETS),
        ("", mien.PRESETS),
        ("left_hand", BODY),
        ("left_foot", BODY),
        ("hand", BODY),
        (3, BODY),
        ("sad", []),
    ],
)
def test_nothing_is_guessed_where_nothing_is_close(asked: object, known: list[str]) -> None:
    assert "did you mean" not in unknown("name", asked, known)


def test_every_known_name_is_listed_once() -> None:
    assert unknown("part", "tail", ["head", "arm", "head"]) == "there is no part 'tail' (known: arm, head)"
    assert unknown("part", "tail", []).endswith("(known: none)")
