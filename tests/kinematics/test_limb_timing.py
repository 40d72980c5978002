"""Maps of time for limbs: showing a motion at given maps, and what the maps are made from."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from mien.kinematics.body import Body
from mien.kinematics.fk import end_positions, world
from mien.kinematics.limb_timing import LimbMaps, limb_maps, loop, show, tip_paths
from mien.samples import walk, wave
from mien.signal.time_map import Rule


@pytest.fixture(scope="module")
def clip():
    return wave(seconds=2.0, fps=50.0).motion


@pytest.fixture(scope="module")
def body(clip):
    return Body.of(clip)


def test_a_map_shows_what_scipy_interpolates(clip, body):
    at = np.clip(np.arange(len(clip)) + 3.3 * np.sin(np.arange(len(clip)) / 9.0), 0, len(clip) - 1)
    shown = show(clip, body, LimbMaps({"right_arm": at}))
    for joint in body.joints(("right_arm",)):
        curve = Slerp(np.arange(len(clip)), Rotation.from_quat(clip.rotations[:, joint]))
        apart = curve(at).inv() * Rotation.from_quat(shown.rotations[:, joint])
        assert apart.magnitude().max() < 1e-7
    others = [j for j in range(len(clip.skeleton)) if j not in body.joints(("right_arm",))]
    np.testing.assert_array_equal(shown.rotations[:, others], clip.rotations[:, others])


def test_translations_that_move_go_along(clip, body):
    moved = np.array(clip.translations)
    joint = body.roles["right_wrist"]
    moved[:, joint, 0] += np.arange(len(clip))
    at = np.linspace(0.0, len(clip) - 1, len(clip)) ** 2 / (len(clip) - 1)
    shown = show(clip.with_(translations=moved), body, LimbMaps({"right_arm": at}))
    np.testing.assert_allclose(shown.translations[:, joint, 0] - clip.translations[0, joint, 0], at)


def test_beyond_the_ends_the_ends_are_held_and_loops_go_on(clip, body):
    joint, frames = body.roles["right_elbow"], len(clip)
    late = np.arange(frames) + 10.0
    held = show(clip, body, LimbMaps({"right_arm": late}))
    expected = clip.rotations[np.minimum(np.arange(frames) + 10, frames - 1), joint]
    assert np.abs(np.abs((held.rotations[:, joint] * expected).sum(-1)) - 1.0).max() < 1e-12
    round_ = show(clip, body, LimbMaps({"right_arm": late}, round_length=frames))
    expected = np.roll(clip.rotations[:, joint], -10, axis=0)
    assert np.abs(np.abs((round_.rotations[:, joint] * expected).sum(-1)) - 1.0).max() < 1e-12


def test_the_frames_that_are_there_show_the_very_motion(clip, body):
    maps = LimbMaps({limb: np.arange(len(clip), dtype=float) for limb in ("left_arm", "head")})
    np.testing.assert_allclose(show(clip, body, maps).rotations, clip.rotations, atol=1e-15)


def test_paths_are_those_of_the_ends_seen_from_the_hips(clip, body):
    rotations, positions = world(clip)
    hand = np.flatnonzero(clip.skeleton.end_parents == body.roles["right_wrist"])
    end = end_positions(clip, rotations, positions)[:, hand].mean(axis=1)
    paths = tip_paths(clip, body, limbs=("right_arm", "tail"))
    assert set(paths) == {"right_arm"}
    np.testing.assert_allclose(paths["right_arm"], end - positions[:, body.roles["hips"]], atol=1e-9)


@pytest.mark.parametrize("acceleration", [-1.0, 0.7])
def test_maps_keep_the_ends_and_run_forward(clip, body, acceleration):
    maps = limb_maps(clip, body, Rule(acceleration))
    assert "right_arm" in maps.frames  # the one that waves
    assert maps.round_length == 0
    for at in maps.frames.values():
        assert np.abs(at - np.arange(len(clip))).max() > 0.5
        assert (np.diff(at) > 0).all()
        np.testing.assert_allclose(at[[0, -1]], [0, len(clip) - 1], atol=1e-9)


def test_a_looping_walk_is_one():
    stride = walk(seconds=4.0, cadence=1.6, fps=60.0).motion[60:135]  # two steps
    assert loop(stride, Body.of(stride)) == 75
    assert loop(stride, Body.of(stride), boundary="hold") == 0
    maps = limb_maps(stride, Body.of(stride), Rule(0.5), round_length=75)
    assert maps.round_length == 75
    for at in maps.frames.values():
        gone = np.unwrap(2 * np.pi * at / 75) * 75 / (2 * np.pi)
        assert gone[-1] - gone[0] == pytest.approx(74, abs=2.0)  # one round, but for the last step
