"""Manner: what is done to a clip is found again; what a clip does, where and on whom does not matter."""

from dataclasses import replace

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.manner import LIMBS, Change, Manner, body_beside, difference, mean_change
from mien.errors import MienError
from mien.kinematics.body import Body
from mien.kinematics.poses import Pose
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=6.0).motion


def change(before: Motion, after: Motion) -> Change:
    return difference(Manner.of(before), Manner.of(after))


def test_nothing_differs_from_itself(walk: Motion) -> None:
    same = change(walk, walk)
    assert all(np.allclose(turn, 0.0, atol=1e-6) for turn in same.pose.turns.values())
    assert same.hips_height == same.rate - 1 == same.sharpness - 1 == 0.0
    assert set(same.swing.values()) == {1.0}


def test_a_sine_has_its_own_rate_swing_and_sharpness() -> None:
    """Oracle: of ``a sin(w t)``, the root mean square is ``a / sqrt 2``, and speed over it ``w``."""
    still = samples.still(seconds=10.0).motion
    keys = " | ".join(f"{t:.2f} head {20 * np.sin(2 * np.pi * t):.3f} 0 0" for t in np.arange(0, 10.01, 0.05))
    nodding = Manner.of(mien.apply(still, [Step("displacement", {"keys": keys})]))
    assert nodding.swing["head"] == pytest.approx(np.radians(20) / np.sqrt(2), rel=0.08)
    assert nodding.rate["head"] == pytest.approx(2 * np.pi, rel=0.05)
    assert nodding.sharpness["head"] == pytest.approx(1.0, rel=0.1)
    assert nodding.swing["left_leg"] < 0.01


def test_posture_is_found_again(walk: Motion) -> None:
    held = mien.apply(walk, [Step("posture", {"head": 20.0, "elbows": 15.0, "hips_height": -0.05})])
    found = change(walk, held)
    turns = found.pose.turns
    assert turns["neck"][0] + turns["head"][0] == pytest.approx(20.0, abs=1.0)
    assert np.linalg.norm(turns["left_elbow"]) == pytest.approx(15.0, abs=2.0)
    assert np.abs(turns["trunk"]).max() < 0.5
    assert set(found.swing) == set(LIMBS)
    assert found.swing["left_leg"] == pytest.approx(1.0, abs=0.02)


def test_path_length_and_tempo_are_found_again(walk: Motion) -> None:
    smaller = change(
        walk, mien.apply(walk, [Step("path_length", {"mid": 0.6, "mode": "edges", "edge_low": 0.3})])
    )
    assert smaller.swing["left_arm"] == pytest.approx(0.6, abs=0.06)
    assert smaller.swing["right_leg"] == pytest.approx(0.6, abs=0.06)
    assert smaller.rate == pytest.approx(1.0, abs=0.05)
    slower = change(walk, mien.apply(walk, [Step("tempo", {"rate": 0.8})]))
    assert slower.rate == pytest.approx(0.8, abs=0.03)
    assert slower.swing["left_arm"] == pytest.approx(1.0, abs=0.05)


def test_frame_rate_unit_and_heading_do_not_matter(walk: Motion) -> None:
    coarse = mien.apply(walk, [Step("resample", {"fps": 30.0})])
    skeleton = replace(walk.skeleton, offsets=39.37 * walk.skeleton.offsets)
    larger = Motion(skeleton, walk.rotations, 39.37 * walk.translations, walk.frame_time)
    turn = quaternion.exp(np.array([0.0, 1.1, 0.0]))
    rotations, translations = np.array(walk.rotations), np.array(walk.translations)
    rotations[:, 0] = quaternion.multiply(turn, rotations[:, 0])
    translations[:, 0] = quaternion.rotate(turn, translations[:, 0])
    turned = walk.with_(rotations=rotations, translations=translations)
    for found in (change(walk, coarse), change(walk, larger), change(walk, turned)):
        assert max(np.abs(turn).max() for turn in found.pose.turns.values()) < 1.0
        assert found.rate == pytest.approx(1.0, abs=0.02)
        assert all(gain == pytest.approx(1.0, abs=0.03) for gain in found.swing.values())


def test_the_mean_of_changes() -> None:
    one = Change(Pose({"head": (10, 0, 0)}), 0.02, {"head": 2.0}, 1.21, 1.0)
    other = Change(Pose({"head": (20, 0, 0), "trunk": (4, 0, 0)}), 0.0, {"head": 0.5}, 1.0, 1.0)
    mean = mean_change([one, other])
    assert mean.pose.turns["head"] == pytest.approx((15, 0, 0))
    assert mean.pose.turns["trunk"] == pytest.approx((2, 0, 0))
    assert (mean.hips_height, mean.swing["head"], mean.rate) == pytest.approx((0.01, 1.0, 1.1))
    half = one * 0.5
    assert (half.swing["head"], half.rate, half.hips_height) == pytest.approx((2**0.5, 1.1, 0.01))
    with pytest.raises(MienError, match="no changes"):
        mean_change([])


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_the_shortest_clips_have_a_manner(walk: Motion, frames: int) -> None:
    found = change(walk[:frames], walk[:frames])
    assert found.rate == found.sharpness == 1.0
    assert np.isfinite(found.hips_height)


def test_the_body_beside_a_neutral_clip(walk: Motion) -> None:
    """On the same bones it stands as the neutral clip does, at its own size; on others as itself."""
    body = Body.of(walk)
    bowed = mien.apply(walk, [Step("posture", {"head": 40.0})])
    alone = Motion(replace(walk.skeleton), bowed.rotations, bowed.translations, walk.frame_time)
    assert body_beside(body, walk, alone) is body
    elsewhere = np.array(walk.skeleton.offsets)
    elsewhere[0] = [300.0, 0.0, -500.0]  # where the clip begins, and no bone
    moved = Motion(replace(walk.skeleton, offsets=elsewhere), *(alone.rotations, alone.translations), 1 / 60)
    assert body_beside(body, walk, moved) is body
    bones = walk.skeleton
    skeleton = replace(bones, offsets=0.01 * bones.offsets, end_offsets=0.01 * bones.end_offsets)
    metres = Motion(skeleton, alone.rotations, 0.01 * alone.translations, walk.frame_time)
    small = body_beside(body, walk, metres)
    assert small.leg_length == pytest.approx(0.01 * body.leg_length)
    assert small.height == pytest.approx(0.01 * body.height)
    assert small.neutral is body.neutral
    assert difference(Manner.of(walk), Manner.of(metres, body=small)).hips_height == pytest.approx(
        0.0, abs=1e-6
    )
    for other in (samples.SKELETONS[1], samples.SKELETONS[2]):
        else_ = samples.walk(seconds=1.0, skeleton=other).motion
        assert body_beside(body, walk, else_) is Body.of(else_)
