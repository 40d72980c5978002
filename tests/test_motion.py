"""Skeleton and Motion refuse what cannot be, and nothing can be written into them."""

from dataclasses import FrozenInstanceError
from typing import Any

import numpy as np
import pytest

import mien
from mien import samples
from mien.errors import MienError
from mien.formats import bvh
from mien.kinematics.contacts import detect
from mien.motion import Motion, Skeleton
from mien.recipe import Step

NAMES = ("hips", "spine", "left", "foot", "right")
PARENTS = np.array([-1, 0, 0, 2, 0])


def skeleton(**changes: Any) -> Skeleton:
    fields: dict[str, Any] = {
        "names": NAMES,
        "parents": PARENTS.copy(),
        "offsets": np.arange(15.0).reshape(5, 3),
        "end_parents": np.array([1, 3]),
        "end_offsets": np.ones((2, 3)),
    }
    return Skeleton(**(fields | changes))


def motion(frames: int = 4, **changes: Any) -> Motion:
    rotations = np.zeros((frames, 5, 4))
    rotations[..., 3] = 1.0
    fields: dict[str, Any] = {
        "skeleton": skeleton(),
        "rotations": rotations,
        "translations": np.zeros((frames, 5, 3)),
        "frame_time": 0.5,
    }
    return Motion(**(fields | changes))


def test_tree_questions() -> None:
    tree = skeleton()
    assert len(tree) == 5
    assert tree.children(0) == [1, 2, 4]
    assert tree.children(3) == []
    assert tree.descendants(2) == [2, 3]
    assert tree.descendants(0) == [0, 1, 2, 3, 4]


def test_several_roots_are_allowed() -> None:
    tree = skeleton(parents=np.array([-1, 0, -1, 2, 2]))
    assert tree.descendants(0) == [0, 1]
    assert tree.descendants(2) == [2, 3, 4]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"names": NAMES[:4]}, r"parents must have shape \(4,\), got \(5,\)"),
        ({"offsets": np.zeros((5, 2))}, r"offsets must have shape \(5, 3\)"),
        ({"end_offsets": np.zeros((1, 3))}, r"end_offsets must have shape \(2, 3\)"),
        ({"parents": np.array([-1, 0, 3, 2, 0])}, "an earlier joint, got"),
        ({"parents": np.array([-1, 1, 0, 2, 0])}, "an earlier joint, got"),
        ({"parents": np.array([-2, 0, 0, 2, 0])}, "must be -1 or"),
        ({"end_parents": np.array([1, 5])}, "end site"),
        ({"end_parents": np.array([-1, 1])}, "end site"),
        (
            {"names": (), "parents": np.zeros(0, int), "offsets": np.zeros((0, 3))},
            "at least one joint",
        ),
    ],
)
def test_a_skeleton_that_cannot_be_is_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(MienError, match=message):
        skeleton(**changes)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"rotations": np.zeros((4, 4, 4))}, r"rotations must have shape \(4, 5, 4\), got \(4, 4, 4\)"),
        ({"translations": np.zeros((3, 5, 3))}, r"translations must have shape \(4, 5, 3\)"),
        ({"rotations": np.ones((4, 5, 4))}, "unit quaternions"),
        ({"rotations": np.full((4, 5, 4), np.nan)}, "unit quaternions"),
        ({"translations": np.full((4, 5, 3), np.inf)}, "not finite"),
        ({"frame_time": 0.0}, "above 0 seconds, got 0"),
        ({"frame_time": -0.1}, "above 0 seconds"),
        ({"frame_time": float("nan")}, "above 0 seconds"),
        ({"frame_time": float("inf")}, "above 0 seconds"),
        ({"rotations": np.zeros((0, 5, 4)), "translations": np.zeros((0, 5, 3))}, "at least one frame"),
    ],
)
def test_a_motion_that_cannot_be_is_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(MienError, match=message):
        motion(**changes)


def test_fields_cannot_be_set() -> None:
    for owner, name in [(skeleton(), "names"), (motion(), "rotations")]:
        with pytest.raises(FrozenInstanceError):
            setattr(owner, name, None)


@pytest.mark.parametrize("name", ["rotations", "translations"])
def test_arrays_of_a_motion_cannot_be_written(name: str) -> None:
    with pytest.raises(ValueError, match="read-only"):
        getattr(motion(), name)[0, 0, 0] = 2.0


@pytest.mark.parametrize("name", ["parents", "offsets", "end_parents", "end_offsets"])
def test_arrays_of_a_skeleton_cannot_be_written(name: str) -> None:
    with pytest.raises(ValueError, match="read-only"):
        getattr(skeleton(), name)[0] = 0


def test_the_callers_own_array_stays_writable() -> None:
    mine = np.zeros((4, 5, 3))
    motion(translations=mine)
    mine[0] = 1.0
    assert mine.flags.writeable


def test_numbers_are_kept_as_float64() -> None:
    made = motion(translations=np.zeros((4, 5, 3), np.float32))
    assert made.translations.dtype == np.float64


def test_time() -> None:
    made = motion(frames=5)
    assert (len(made), made.fps, made.duration) == (5, 2.0, 2.0)
    np.testing.assert_array_equal(made.times, [0, 0.5, 1, 1.5, 2])
    assert motion(frames=1).duration == 0.0


def test_a_range_of_frames() -> None:
    step = Step("posture")
    made = motion(translations=np.arange(60.0).reshape(4, 5, 3), history=(step,), source="kept", name="clip")
    part = made[1:3]
    np.testing.assert_array_equal(part.translations, made.translations[1:3])
    assert (part.frame_time, part.history, part.name) == (0.5, (step,), "clip")
    assert part.source is None, "the file's own numbers no longer fit"


def test_every_second_frame_takes_twice_as_long() -> None:
    assert motion()[::2].frame_time == 1.0
    assert len(motion()[::2]) == 2


def test_backwards_keeps_the_frame_time() -> None:
    made = motion(translations=np.arange(60.0).reshape(4, 5, 3))[::-1]
    assert made.frame_time == 0.5
    assert made.translations[0, 0, 0] == 45.0


@pytest.mark.parametrize("frames", [0, (0, 1), "a"])
def test_only_a_range_is_taken(frames: Any) -> None:
    with pytest.raises(MienError, match=r"motion\[10:50\]"):
        motion()[frames]


def test_an_empty_range_is_refused() -> None:
    with pytest.raises(MienError, match="at least one frame"):
        motion()[2:2]


def test_with_changes_a_copy() -> None:
    first = motion()
    second = first.with_(frame_time=0.25)
    assert (first.frame_time, second.frame_time) == (0.5, 0.25)
    assert second.skeleton is first.skeleton


def test_a_notebook_shows_a_picture() -> None:
    shown = samples.still(seconds=0.5).motion._repr_html_()
    assert "<img" in shown
    assert "base64" in shown


def test_what_is_shown_is_one_short_line() -> None:
    walk = samples.walk(seconds=1.0, fps=30.0)
    edited = mien.edit(walk.motion, "sad")
    assert repr(motion(frames=1)) == "Motion(1 frame, 5 joints, 2 fps, 0.00 s)"
    assert repr(walk.motion) == "Motion('walk', 31 frames, 22 joints, 30 fps, 1.00 s)"
    assert repr(edited).endswith(f"{edited.duration:.2f} s, {len(edited.history)} steps)")
    assert repr(skeleton()) == "Skeleton(5 joints: hips to right)"
    shown = [
        walk,
        mien.Body.of(walk.motion),
        detect(walk.motion),
        mien.compare(walk.motion, edited),
        walk.motion.skeleton.layout,
        bvh.parse(bvh.render(walk.motion), "walk").source,
    ]
    for thing in shown:
        assert repr(thing).startswith(type(thing).__name__ + "(")
        assert len(repr(thing)) < 110
        assert "array" not in repr(thing)
        assert "\n" not in repr(thing)


def test_the_front_door_shows_what_is_public_and_nothing_else() -> None:
    assert set(dir(mien)) == set(mien.__all__)
