"""Heading: the yaw of the hips, taken off and put back."""

import numpy as np
import pytest

from mien.kinematics.body import Body
from mien.kinematics.fk import chain, world
from mien.kinematics.heading import heading, heading_free, heading_rotation, hips_frame
from mien.rotations import quaternion
from mien.samples import SKELETONS, turn, walk


@pytest.mark.parametrize("skeleton", SKELETONS)
@pytest.mark.parametrize("up", ["y", "z"])
def test_the_frame_gives_the_hips_back(skeleton, up):
    clip = turn(seconds=2.0, skeleton=skeleton, up=up).motion
    body = Body.of(clip)
    hips = body.roles["hips"]
    free, frame = heading_free(clip, body)
    back = quaternion.multiply(frame, free[:, hips])
    np.testing.assert_allclose(back, clip.rotations[:, hips], atol=1e-12)
    others = [j for j in range(len(clip.skeleton)) if j != hips]
    np.testing.assert_array_equal(free[:, others], clip.rotations[:, others])


def test_free_of_heading_there_is_no_yaw_left():
    clip = turn(seconds=2.0).motion
    body = Body.of(clip)
    free, _ = heading_free(clip, body)
    _, positions = world(clip.with_(rotations=free))
    assert np.ptp(heading(world(clip)[1], body)) > 0.5
    np.testing.assert_allclose(heading(positions, body), 0.0, atol=1e-9)


def test_the_frame_of_a_root_is_the_heading():
    clip = walk(seconds=1.0).motion
    body = Body.of(clip)
    assert clip.skeleton.parents[body.roles["hips"]] == -1
    np.testing.assert_allclose(hips_frame(clip, body), heading_rotation(world(clip)[1], body), atol=1e-12)


def test_a_chain_is_the_same_as_the_whole():
    clip = turn(seconds=2.0).motion
    body = Body.of(clip)
    wanted = [body.roles["left_wrist"], body.roles["head"]]
    joints, rotations, positions = chain(clip, wanted)
    whole_rotations, whole_positions = world(clip)
    assert set(wanted) < set(joints)
    assert len(joints) < len(clip.skeleton)
    np.testing.assert_allclose(rotations, whole_rotations[:, joints], atol=1e-14)
    np.testing.assert_allclose(positions, whole_positions[:, joints], atol=1e-12)


def test_a_jerk_of_the_hips_is_no_turn_but_a_turn_is():
    clip = turn(seconds=4.0, fps=60.0).motion
    body = Body.of(clip)
    hips = body.roles["hips"]
    jerked = np.array(clip.rotations)
    jerked[120, hips] = quaternion.multiply(quaternion.exp(0.2 * body.up), jerked[120, hips])
    shaken = clip.with_(rotations=jerked)
    plain, steady = (hips_frame(shaken, body, steady=s) for s in (False, True))
    was = hips_frame(clip, body)

    def apart(a, b):
        return np.abs(quaternion.log(quaternion.multiply(quaternion.conjugate(a), b)) @ body.up)

    assert apart(plain, was)[120] > 0.19
    assert apart(steady, was)[120] < 0.03
    assert apart(steady, was).max() < 0.1, "the turn itself stays in the heading"
    assert apart(steady[:1], steady[-1:])[0] > 1.0
