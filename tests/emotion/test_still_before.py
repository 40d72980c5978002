"""A T-pose before the action changes nothing of what is read in the action."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.curves import CURVES, curve
from mien.emotion.course import course
from mien.emotion.reading import Reading
from mien.kinematics.lead_in import lead_in, still_before
from mien.motion import Motion

NAMES = ("walk", "dance", "jump", "punch", "tired_walk")
# Clips of others that begin with a T-pose, and some that do not.
WITH = ("cmu_daz/02_01.bvh", "cmu_60fps_badheader/16_12_60fps.bvh", "cmu_mb_misc/05_01.bvh")
WITHOUT = ("bandai1/dataset-1_walk_normal_001.bvh", "reactidle/000_genuine.bvh")


def apart(one: Reading, other: Reading) -> float:
    """Return how far two readings are from each other on the disc."""
    return float(np.hypot(one.place.valence - other.place.valence, one.place.arousal - other.place.arousal))


def alike(one: Reading, other: Reading) -> bool:
    return next(iter(one.labels)) == next(iter(other.labels)) and apart(one, other) < 0.05


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("frames", [1, 30])
def test_a_clip_reads_as_without_it(
    held_t_pose: Callable[[Motion, int], Motion], name: str, frames: int
) -> None:
    motion = samples.SAMPLES[name](fps=30.0).motion
    posed = held_t_pose(motion, frames)
    assert alike(mien.read(posed), mien.read(motion))
    np.testing.assert_allclose(mien.features(posed).clip, mien.features(motion).clip, rtol=0.02, atol=0.02)


@pytest.mark.parametrize("frames", [1, 30])
@pytest.mark.parametrize("word", ["sad", "excited"])
def test_an_edited_clip_reads_as_without_it(
    held_t_pose: Callable[[Motion, int], Motion], word: str, frames: int
) -> None:
    motion = samples.walk(fps=30.0).motion
    posed = mien.edit(held_t_pose(motion, frames), word, safe=False)
    assert frames <= still_before(posed) <= frames + 2
    assert apart(mien.read(posed), mien.read(mien.edit(motion, word, safe=False))) < 0.05


@pytest.mark.parametrize("frames", [1, 30])
def test_its_course_begins_after_it(held_t_pose: Callable[[Motion, int], Motion], frames: int) -> None:
    motion = samples.walk(seconds=5.0, fps=30.0).motion
    times, places = course(motion)
    later, same = course(held_t_pose(motion, frames))
    np.testing.assert_allclose(later, times + frames / 30.0)
    np.testing.assert_allclose(same, places, atol=1e-9)


@pytest.mark.parametrize("name", CURVES)
def test_curves_have_no_spike(held_t_pose: Callable[[Motion, int], Motion], name: str) -> None:
    motion = samples.walk(fps=30.0).motion
    _, plain = curve(motion, name)
    _, posed = curve(held_t_pose(motion, 30), name)
    assert len(posed) == len(plain) + 30
    assert posed.max() <= 1.02 * plain.max()
    np.testing.assert_allclose(posed[45:], plain[15:], rtol=1e-3, atol=1e-3)
    assert np.ptp(posed[:20]) < 0.01 * np.ptp(plain)


def test_without_one_the_course_is_of_all_frames() -> None:
    motion = samples.walk(seconds=5.0, fps=30.0).motion
    assert lead_in(motion) == 0
    times, places = course(motion)
    np.testing.assert_array_equal(times, (15 * np.arange(len(times)) + 37.0) * motion.frame_time)
    first = mien.read(motion[0:75]).place
    np.testing.assert_array_equal(places[0], first)


@pytest.mark.parametrize("name", WITH)
def test_real_clips_that_begin_with_one(data: Path, name: str) -> None:
    motion = mien.load(data / name, salvage=True)[:900]
    still = lead_in(motion)
    assert still > 0
    assert alike(mien.read(motion), mien.read(motion[still:]))
    times, places = course(motion)
    alone = course(motion[still:])
    np.testing.assert_allclose(places, alone[1], atol=1e-9)
    np.testing.assert_allclose(times, alone[0] + still * motion.frame_time)
    _, speed = curve(motion, "hand speed")
    _, plain = curve(motion[still:], "hand speed")
    assert speed.max() <= 1.05 * plain.max()


@pytest.mark.parametrize("name", WITHOUT)
@pytest.mark.parametrize("frames", [1, 30])
def test_real_clips_after_one(
    held_t_pose: Callable[[Motion, int], Motion], data: Path, name: str, frames: int
) -> None:
    motion = mien.load(data / name)[:900]
    assert lead_in(motion) == 0
    posed = held_t_pose(motion, frames)
    assert lead_in(posed) == frames
    assert alike(mien.read(posed), mien.read(motion))
