"""Which clips count as loops."""

import numpy as np
import pytest

from mien.kinematics.body import Body
from mien.kinematics.heading import heading_free
from mien.kinematics.loops import loop_length, period
from mien.rotations import quaternion
from mien.samples import turn, walk


def swinging(frames, round_length, still_joints=0):
    """Three joints that swing with whole periods in ``round_length`` frames."""
    t = 2.0 * np.pi * np.arange(frames)[:, None] / round_length
    angle = np.concatenate([np.sin(t), 0.5 * np.sin(2 * t + 1.0), 0.3 * np.cos(t)], axis=1)
    q = quaternion.exp(angle[..., None] * np.array([0.6, 0.8, 0.0]))
    return np.concatenate([q, np.tile(quaternion.IDENTITY, (frames, still_joints, 1))], axis=1)


@pytest.mark.parametrize("frames", [24, 60, 250])
@pytest.mark.parametrize("still_joints", [0, 30])
def test_the_first_frame_follows_the_last(frames, still_joints):
    assert loop_length(swinging(frames, frames, still_joints)) == frames


@pytest.mark.parametrize("frames", [25, 61, 251])
def test_the_last_frame_repeats_the_first(frames):
    assert loop_length(swinging(frames, frames - 1)) == frames - 1


@pytest.mark.parametrize("share", [0.5, 0.8, 1.3])
def test_part_of_a_round_is_no_loop(share):
    assert loop_length(swinging(int(100 * share), 100)) == 0


def test_there_and_back_is_no_loop_if_it_arrives_in_full_motion():
    """The first pose is met again, but the wrong way round."""
    angle = np.sin(np.linspace(0.0, np.pi, 80))
    q = quaternion.exp(angle[:, None, None] * np.array([1.0, 0.0, 0.0]))
    assert loop_length(q) == 0


@pytest.mark.parametrize("frames", [1, 2, 7])
def test_a_few_frames_are_no_loop(frames):
    assert loop_length(swinging(frames, frames)) == 0


def test_signs_of_quaternions_do_not_matter():
    q = swinging(60, 60)
    q[40:] *= -1.0
    assert loop_length(q) == 60


def free(motion):
    """The rotations of a sample, whose hips are its root, without the heading."""
    return heading_free(motion, Body.of(motion))[0]


def test_boundary_decides():
    cycle = walk(seconds=3.0, cadence=1.8, fps=54.0).motion[20:80]  # two steps, not cut at a heel strike
    assert period(free(cycle), "auto") == 60
    assert period(free(cycle), "hold") == 0
    part = free(cycle[:43])
    assert period(part, "auto") == 0
    assert period(part, "wrap") == 43


def test_a_turning_walk_loops_where_its_poses_do():
    clip = turn(seconds=4.0, fps=51.0).motion  # 1.7 steps a second: 60 frames are two steps
    assert period(free(clip[40:100]), "auto") == 60
    assert period(clip[40:100].rotations, "auto") == 0
    assert period(free(clip[40:85]), "auto") == 0
