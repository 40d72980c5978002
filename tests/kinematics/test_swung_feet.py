"""Feet on their path, though their legs are shown in other time than trembling hips."""

import numpy as np
import pytest

from mien.kinematics.ankles import Ankles, move_ankles
from mien.kinematics.body import Body
from mien.kinematics.limb_timing import LimbMaps, show
from mien.kinematics.swung_feet import keep_feet
from mien.samples import walk

FPS = 60.0


@pytest.fixture(scope="module")
def clip():
    return walk(seconds=3.0, fps=FPS).motion


@pytest.fixture(scope="module")
def shaken(clip):
    """The walk with hips that tremble by some millimetres, which its legs take back."""
    body = Body.of(clip)
    moved = np.array(clip.translations)
    moved[:, body.roles["hips"]] += 0.005 * body.leg_length * np.random.default_rng(1).normal(size=(181, 3))
    return move_ankles(clip.with_(translations=moved), body, Ankles.of(clip, body))


@pytest.fixture(scope="module")
def maps(clip):
    """Legs that are late by up to two frames for a while, one after the other."""
    own = np.arange(len(clip), dtype=float)
    late = [own - 2.0 * np.sin(np.pi * np.clip((own - start) / 60.0, 0.0, 1.0)) ** 2 for start in (30, 90)]
    return LimbMaps(dict(zip(("left_leg", "right_leg"), late, strict=True)))


def test_what_the_legs_took_back_they_take_back(clip, shaken, maps):
    body = Body.of(clip)
    calm = Ankles.of(show(clip, body, maps), body).positions
    plain = show(shaken, body, maps)
    kept = keep_feet(plain, shaken, body, maps)
    wrong, right = (
        np.linalg.norm(Ankles.of(m, body).positions - calm, axis=-1)[30:150] for m in (plain, kept)
    )
    assert np.sqrt((right**2).mean()) < 0.6 * np.sqrt((wrong**2).mean())
    trembles = [
        np.abs(np.diff(Ankles.of(m, body).positions, n=3, axis=0)).mean() for m in (clip, plain, kept)
    ]
    assert trembles[2] - trembles[0] < 0.6 * (trembles[1] - trembles[0])


def test_a_calm_walk_hardly_changes(clip, maps):
    body = Body.of(clip)
    plain = show(clip, body, maps)
    kept = keep_feet(plain, clip, body, maps)
    moved = Ankles.of(kept, body).positions - Ankles.of(plain, body).positions
    assert np.linalg.norm(moved, axis=-1).max() < 0.002 * body.leg_length


def test_frames_at_their_own_time_stay_to_the_last_bit(shaken, maps):
    body = Body.of(shaken)
    plain = show(shaken, body, maps)
    kept = keep_feet(plain, shaken, body, maps)
    own = np.arange(len(shaken))
    for leg, at in maps.frames.items():
        joints, still = body.joints((leg,)), at == own
        assert 0 < still.sum() < len(own)
        np.testing.assert_array_equal(kept.rotations[still][:, joints], shaken.rotations[still][:, joints])
        assert np.abs(kept.rotations[~still] - plain.rotations[~still])[:, joints].max() > 1e-4
    others = [j for j in range(len(shaken.skeleton)) if j not in body.joints(("legs",))]
    np.testing.assert_array_equal(kept.rotations[:, others], shaken.rotations[:, others])
    np.testing.assert_array_equal(kept.translations, shaken.translations)


def test_what_is_no_tremble_is_left_alone(clip, maps):
    """A hop of the hips by a foot's length: the legs go along but a little."""
    body = Body.of(clip)
    moved = np.array(clip.translations)
    moved[60:63, body.roles["hips"]] += 0.15 * body.leg_length * body.up
    hopped = clip.with_(translations=moved)
    plain = show(hopped, body, maps)
    kept = keep_feet(plain, hopped, body, maps)
    away = np.linalg.norm(Ankles.of(kept, body).positions - Ankles.of(plain, body).positions, axis=-1)
    assert 0.001 * body.leg_length < away.max() < 0.02 * body.leg_length


def test_without_legs_it_is_the_very_motion(clip):
    maps = LimbMaps({"left_arm": np.arange(len(clip)) * 0.5})
    assert keep_feet(clip, clip, Body.of(clip), maps) is clip
