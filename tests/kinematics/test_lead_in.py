"""A still before the action is found, left out of filters, and put back."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.lead_in import lead_in, with_lead_in, without_lead_in
from mien.rotations import quaternion


@pytest.mark.parametrize("fps", [30.0, 60.0, 120.0])
@pytest.mark.parametrize("frames", [1, 3])
def test_a_t_pose_before_a_walk_is_found(with_t_pose, frames, fps):
    assert lead_in(with_t_pose(samples.walk(fps=fps).motion, frames)) == frames


@pytest.mark.parametrize("name", [name for name in samples.SAMPLES if name != "still"])
@pytest.mark.parametrize("fps", [24.0, 60.0])
@pytest.mark.parametrize("frames", [1, 2, 30])
def test_a_t_pose_that_is_held_is_found(held_t_pose, name, fps, frames):
    assert lead_in(held_t_pose(samples.SAMPLES[name](fps=fps).motion, frames)) == frames


def test_a_t_pose_that_is_left_by_moving_is_movement(held_t_pose):
    motion = samples.walk(fps=60.0).motion
    posed = held_t_pose(motion, 30)
    smooth = np.array(posed.rotations)
    share = (0.5 - 0.5 * np.cos(np.pi * np.arange(30) / 30.0))[:, None]
    first = np.repeat(posed.rotations[:1], 30, 0), np.repeat(motion.rotations[:1], 30, 0)
    between = posed.with_(
        rotations=np.concatenate([smooth[:30], quaternion.slerp(*first, share), motion.rotations]),
        translations=np.concatenate([posed.translations[:30], posed.translations]),
    )
    assert lead_in(between) == 0


def test_a_pose_that_is_held_for_ever_is_no_still_before_anything(held_t_pose):
    still = held_t_pose(samples.walk(fps=30.0).motion, 200)
    assert lead_in(still[:150]) == 0
    assert lead_in(still) == 0, "it is the clip's own, for longer than anybody waits"


@pytest.mark.parametrize("name", samples.SAMPLES)
@pytest.mark.parametrize("fps", [24.0, 120.0])
def test_clips_without_a_still_have_none(name, fps):
    assert lead_in(samples.SAMPLES[name](fps=fps).motion) == 0


@pytest.mark.parametrize("name", ["punch", "jump"])
@pytest.mark.parametrize("fps", [30.0, 120.0])
def test_a_clip_cut_out_of_a_fast_movement_has_none(name, fps):
    motion = samples.SAMPLES[name](fps=fps).motion
    assert [start for start in range(len(motion) - 10) if lead_in(motion[start:])] == []


@pytest.mark.parametrize("frames", [1, 2, 3, 5])
def test_short_clips_have_none(frames):
    assert lead_in(samples.walk().motion[:frames]) == 0


def test_taking_out_and_putting_back_changes_nothing(with_t_pose):
    motion = with_t_pose(samples.walk().motion, 3)
    back = with_lead_in(without_lead_in(motion, 3), motion, 3)
    np.testing.assert_allclose(back.rotations, motion.rotations, atol=1e-12)
    np.testing.assert_array_equal(back.translations, motion.translations)
    assert without_lead_in(motion, 0) is motion


def test_an_edit_keeps_the_t_pose_and_does_not_smear_it(with_t_pose):
    walk = samples.walk(fps=60.0).motion
    long = with_t_pose(walk, 1)
    alone = mien.apply(walk, [mien.Step("path_length", {"mid": 0.3, "boundary": "hold"})])
    edited = mien.apply(long, [mien.Step("path_length", {"mid": 0.3, "boundary": "hold"})])
    np.testing.assert_array_equal(edited.rotations[0], long.rotations[0])
    arm = Body.of(walk).roles["left_shoulder"]
    np.testing.assert_allclose(
        np.abs(np.einsum("ti,ti->t", edited.rotations[1:, arm], alone.rotations[:, arm])), 1.0, atol=1e-4
    )


def test_real_captures_start_with_one_or_not(data):
    def of(name):
        return lead_in(mien.load(data / name, salvage=True))

    assert of("cmu_daz/02_01.bvh") > 0
    assert of("cmu_iclone100j/007_04.bvh") == 1
    assert of("bandai1/dataset-1_walk_normal_001.bvh") == 0
    assert of("reactidle/000_genuine.bvh") == 0
