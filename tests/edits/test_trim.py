"""Trim: which frames are kept, exactly."""

import numpy as np
import pytest

from mien import samples
from mien.edits.trim import trim
from mien.errors import MienError


def test_both_ends_are_kept() -> None:
    walk = samples.walk(seconds=2.0, fps=30.0).motion
    cut = trim(walk, start=0.5, end=1.0)
    np.testing.assert_array_equal(cut.rotations, walk.rotations[15:31])
    np.testing.assert_array_equal(cut.translations, walk.translations[15:31])
    assert cut.duration == pytest.approx(0.5)
    assert cut.frame_time == walk.frame_time


def test_a_time_between_frames_names_the_nearest() -> None:
    walk = samples.walk(seconds=1.0, fps=10.0).motion
    np.testing.assert_array_equal(trim(walk, start=0.11, end=0.59).rotations, walk.rotations[1:7])
    np.testing.assert_array_equal(trim(walk, start=0.33, end=0.33).rotations, walk.rotations[3:4])


def test_times_with_few_decimals_name_their_frame() -> None:
    walk = samples.walk(seconds=1.0, fps=30.0).motion
    for frame in range(len(walk)):
        at = float(f"{frame * walk.frame_time:.8f}")
        np.testing.assert_array_equal(
            trim(walk, start=at, end=at).rotations, walk.rotations[frame : frame + 1]
        )


def test_the_whole_clip_is_the_motion_itself() -> None:
    walk = samples.walk(seconds=1.0).motion
    np.testing.assert_array_equal(trim(walk, end=50.0).rotations, walk.rotations)


@pytest.mark.parametrize("times", [{"start": 3.0}, {"start": 0.5, "end": 0.4}, {"start": 3.0, "end": 4.0}])
def test_nothing_left_is_refused(times: dict[str, float]) -> None:
    walk = samples.walk(seconds=1.0, fps=10.0).motion
    with pytest.raises(MienError, match="after the end"):
        trim(walk, **times)
