"""Keys as data: one line and one file hold them; between keys nothing goes beyond them."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien import samples
from mien.edits.posture import posture
from mien.errors import RecipeError
from mien.kinematics.keyed_poses import (
    Keys,
    format_keys,
    keys_between,
    parse_keys,
    read_keys,
    turns_at,
)
from mien.kinematics.poses import Pose, posture_pose, write_pose

LINE = "1.0 head 25 0 0; trunk 10 0 0 | 2.0 none | 3.0 left_shoulder 0 0 40"
KEYS: Keys = (
    (1.0, Pose({"head": (25.0, 0.0, 0.0), "trunk": (10.0, 0.0, 0.0)})),
    (2.0, Pose()),
    (3.0, Pose({"left_shoulder": (0.0, 0.0, 40.0)})),
)


def test_one_line_holds_keys_exactly() -> None:
    assert parse_keys(LINE) == KEYS
    assert format_keys(KEYS) == LINE
    odd: Keys = ((-1 / 3, Pose({"head": (1e-17, -0.1, 1 / 7)})), (1e9, Pose()))
    assert parse_keys(format_keys(odd)) == odd
    assert parse_keys("none") == parse_keys("") == parse_keys(format_keys(())) == ()
    assert parse_keys(" 0.5  head 1 2 3|1 none ") == ((0.5, Pose({"head": (1, 2, 3)})), (1.0, Pose()))


def test_named_poses_are_meant_as_posture_means_them() -> None:
    ((_, pose),) = parse_keys("2 elbows_out")
    assert pose == posture_pose({"arms": 20.0, "elbows": 10.0})
    assert pose.turns["left_elbow"] == (-10.0, 0.0, 0.0)
    assert "head" not in pose.turns


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("head 25 0 0", "does not start with a time in seconds"),
        ("1 head 25 0 0 |", "does not start with a time"),
        ("1 head 25 0", "three numbers"),
        ("1 haed 25 0 0", "did you mean 'head'"),
        ("1 head_dwon", "did you mean 'head_down'"),
        ("1 none | 1 head 5 0 0", "must go up, got 1 s after 1 s"),
        ("nan none", "a time must be a number of seconds"),
        ("keys.toml", "read_keys"),
    ],
)
def test_wrong_keys_are_answered_with_what_would_do(text: str, says: str) -> None:
    with pytest.raises(RecipeError, match=says):
        parse_keys(text)


def test_a_file_of_keys_may_name_pose_files_beside_it(tmp_path: Path) -> None:
    bow = Pose({"trunk": (40.0, 0.0, 1.5)})
    write_pose(tmp_path / "bow.toml", bow)
    rows = [("0.5", "bow.toml"), ("1", "none"), ("2.5", "head_down"), ("3", "head 0 30 0")]
    text = "\n".join(f'[[keys]]\ntime = {time}\npose = "{pose}"\n' for time, pose in rows)
    (tmp_path / "keys.toml").write_text(text)
    keys = read_keys(tmp_path / "keys.toml")
    assert keys[0] == (0.5, bow)
    assert keys[1:] == parse_keys("1 none | 2.5 head_down | 3 head 0 30 0")


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("keys = 3", r"tables \[\[keys\]\]"),
        ("turns = {}", r"tables \[\[keys\]\]"),
        ("[[keys]\n", "not a file of keys"),
        ("[[keys]]\ntime = 1", "a time in seconds and a pose"),
        ("[[keys]]\ntime = 1\npose = 3", "a pose in quotes"),
        ('[[keys]]\ntime = "1"\npose = "none"', "a number of seconds"),
        ('[[keys]]\ntime = 1\npose = "gone.toml"', r"gone\.toml: there is no such file"),
        ('[[keys]]\ntime = 1\npose = "none"\n[[keys]]\ntime = 0\npose = "none"', "must go up"),
    ],
)
def test_a_wrong_file_is_named(tmp_path: Path, content: str, says: str) -> None:
    (tmp_path / "keys.toml").write_text(content)
    with pytest.raises(RecipeError, match=says) as error:
        read_keys(tmp_path / "keys.toml")
    assert "keys.toml: " in str(error.value)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(RecipeError, match=r"gone\.toml: there is no such file"):
        read_keys(tmp_path / "gone.toml")


def test_keys_are_read_off_captured_stills() -> None:
    """Stills made with known turns, given in no order, one of them the neutral one."""
    neutral = samples.still(seconds=0.2).motion
    nod = posture(neutral, pose="head 20 0 0", method="body_fixed", fade=False)
    keys = keys_between(neutral, {2.0: neutral, 1.0: nod})
    assert [time for time, _ in keys] == [1.0, 2.0]
    assert keys[0][1].turns["head"] == pytest.approx((20.0, 0.0, 0.0), abs=1e-6)
    assert np.abs(list(keys[1][1].turns.values())).max() < 1e-6
    assert parse_keys(format_keys(keys)) == keys


def test_at_a_key_it_is_the_keys_and_beyond_the_ends_it_stays() -> None:
    turns = turns_at(KEYS, np.array([-5.0, 1.0, 2.0, 3.0, 99.0]))
    np.testing.assert_array_equal(turns["head"][:, 0], [25, 25, 0, 0, 0])
    np.testing.assert_array_equal(turns["left_shoulder"][:, 2], [0, 0, 0, 40, 40])
    assert not turns["trunk"][:, 1:].any()


@given(st.lists(st.floats(-90, 90), min_size=2, max_size=6), st.integers(0, 2**32))
def test_between_keys_nothing_goes_beyond_them(values: list[float], seed: int) -> None:
    """Where a cubic spline with continuous acceleration would, by a quarter of the way and more."""
    times = np.cumsum(np.random.default_rng(seed).uniform(0.2, 3.0, len(values)))
    keys = tuple((float(t), Pose({"head": (v, 0.0, 0.0)})) for t, v in zip(times, values, strict=True))
    for number in range(len(keys) - 1):
        at = np.linspace(times[number], times[number + 1], 50)
        got = turns_at(keys, at)["head"][:, 0]
        low, high = sorted(values[number : number + 2])
        assert (got >= low - 1e-9).all()
        assert (got <= high + 1e-9).all()


def test_it_goes_on_through_keys_on_the_way_and_has_no_kink() -> None:
    keys = parse_keys("0 none | 1 head 10 0 0 | 2 head 20 0 0 | 3 head 30 0 0 | 4 head 30 0 0")
    at = np.linspace(-0.5, 4.5, 5001)
    speed = np.gradient(turns_at(keys, at)["head"][:, 0], at)
    assert speed[np.searchsorted(at, [1.0, 2.0])].min() > 9.0
    assert np.abs(speed[at > 3.01]).max() < 1e-6
    assert np.abs(np.diff(speed)).max() < 0.1
