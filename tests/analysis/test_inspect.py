"""Notes point out what is wrong with a clip, and are silent about what is not."""

from pathlib import Path

import numpy as np
import pytest

from mien import samples
from mien.analysis.inspect import notes
from mien.formats import load
from mien.kinematics.body import Body
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion

# Exports of 120 or 60 frames a second whose headers say 24 or 30; found by comparing with their sources.
WRONG_RATE = {"walking_neutral", "jumping_old"}


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=4.0).motion


def test_a_sound_walk_has_no_notes(walk: Motion) -> None:
    assert notes(walk) == []


def test_one_frame_and_still_clips(walk: Motion) -> None:
    assert "one frame only" in notes(walk[:1])[0]
    still = walk.with_(
        rotations=np.repeat(walk.rotations[:1], 30, axis=0),
        translations=np.repeat(walk.translations[:1], 30, axis=0),
        reference=None,
    )
    assert notes(still) == ["nothing moves: all frames are the same"]
    moving = still.with_(translations=walk.translations[:30])
    assert "the pose never changes" in notes(moving)[0]
    turning = still.with_(rotations=walk.rotations[:30])
    assert "the body stays in place" in notes(turning)[0]


def test_a_first_frame_in_another_pose(walk: Motion) -> None:
    rotations = np.array(walk.rotations)
    rotations[0] = quaternion.multiply(rotations[0], quaternion.exp(np.array([0.0, 0.0, 0.6])))
    found = notes(walk.with_(rotations=quaternion.continuous(rotations)))
    assert len(found) == 1
    assert found[0].startswith("frame 0 is far from the motion that follows")


def test_a_jump_of_the_hips_is_named_by_its_frames(walk: Motion) -> None:
    translations = np.array(walk.translations)
    translations[60:, 0] += 2.0 * np.abs(walk.skeleton.offsets).max()
    found = notes(walk.with_(translations=translations))
    assert len(found) == 1
    assert "from frame 59 to frame 60" in found[0]


@pytest.mark.parametrize("times", [0.2, 4.0, 5.0])
def test_a_wrong_rate_is_suspected(walk: Motion, times: float) -> None:
    found = notes(walk.with_(frame_time=walk.frame_time * times))
    assert len(found) == 1
    assert "--fps" in found[0]
    suggested = float(found[0].split("nearer ")[1].split()[0])
    assert 0.5 < suggested / walk.fps < 2


def test_without_a_humanoid_the_rest_is_still_said() -> None:
    point = Skeleton(("a",), np.array([-1]), np.zeros((1, 3)))
    still = Motion(point, np.tile([0, 0, 0, 1.0], (9, 1, 1)), np.zeros((9, 1, 3)), 0.1)
    assert notes(still) == ["nothing moves: all frames are the same"]


def test_real_clips_with_wrong_rates_or_jumps_are_named_and_no_others(data: Path) -> None:
    for path in sorted(data.glob("*/*.bvh")):
        if path.stem == "kick_1row_of_61":
            continue
        said = " ".join(notes(load(path, salvage=True)))
        wrong = path.parent.name == "cmu_60fps_badheader" or path.stem in WRONG_RATE
        assert ("--fps" in said) == wrong, (path, said)
        if wrong and path.parent.name == "cmu_60fps_badheader":
            assert "nearer 60" in said, (path, said)
        assert ("hips jump" in said) == (path.stem in {"07_12", "09_10"}), (path, said)
        if path.parent.name == "cmu_daz" and path.stem != "09_10":
            assert "T-pose" in said, path
        if path.parent.name.startswith("bandai"):
            assert said == "", (path, said)


def lifted(walk: Motion, rise: np.ndarray) -> Motion:
    """The walk with its hips raised by ``rise`` (T) leg lengths."""
    body = Body.of(walk)
    translations = np.array(walk.translations)
    translations[:, body.roles["hips"]] += rise[:, None] * body.leg_length * body.up
    return walk.with_(translations=translations)


def test_feet_that_hover_are_named(walk: Motion) -> None:
    """Heights that drift up by half a leg, on feet that slide as fast as people stroll."""
    share = np.linspace(0.0, 1.0, len(walk))
    drifting = lifted(walk, 0.6 * np.minimum(4.0 * share, 1.0))
    translations = np.array(drifting.translations)
    body = Body.of(walk)
    translations[:, body.roles["hips"]] += (4.0 * share)[:, None] * body.leg_length * body.left
    found = notes(drifting.with_(translations=translations))
    assert len(found) == 1
    assert "the feet hover about 0." in found[0]


def test_somebody_who_stands_on_a_step_does_not_hover(walk: Motion) -> None:
    high = np.where(np.arange(len(walk)) < len(walk) // 4, 0.0, 0.15)
    assert notes(lifted(walk, high)) == []


def test_positions_that_fold_the_body_are_named(walk: Motion) -> None:
    folded = np.array(walk.translations)
    folded[:, 1:] = 0.0
    for motion in (walk, walk[:1]):
        found = notes(motion.with_(translations=folded[: len(motion)], reference=None))
        assert found[0].startswith("21 of 22 joints lie on their parents")


def test_real_clips_that_hover_or_fold_are_named_and_no_others(data: Path) -> None:
    for path in sorted(data.glob("*/*.bvh")):
        if path.parent.name == "malformed":
            continue
        said = " ".join(notes(load(path, salvage=True)))
        assert ("hover" in said) == (path.stem in {"jesse_dance", "louise"}), (path, said)
        assert ("on their parents" in said) == (path.stem == "makehuman_tpose"), (path, said)
