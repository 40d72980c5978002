"""Contacts against the samples, which know the truth, and against made-up traces."""

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.contacts import Contacts, detect, slides, spans


@pytest.mark.parametrize("fps", [24.0, 30.0, 60.0, 120.0])
@pytest.mark.parametrize("name", ["walk", "tired_walk", "turn"])
def test_steps_begin_and_end_when_they_do(name, fps):
    sample = samples.SAMPLES[name](fps=fps)
    found, true = detect(sample.motion).feet, sample.contacts.any(axis=2)
    assert (found == true).mean() > 0.94
    for foot in range(2):
        a, b = spans(found[:, foot]), spans(true[:, foot])
        assert len(a) == len(b), "every step found, none made up"
        late = 2.0 + 0.04 * fps  # a shuffling foot is low and slow before it stands
        np.testing.assert_allclose(a, b, atol=late)


def test_flight_of_a_jump_is_flight():
    sample = samples.jump(fps=120.0)
    found, true = detect(sample.motion).feet.any(axis=1), sample.contacts.any(axis=(1, 2))
    assert len(spans(~found)) == 1
    np.testing.assert_allclose(spans(~found), spans(~true), atol=8)


@pytest.mark.parametrize("name", ["still", "knock", "wave"])
def test_standing_feet_stand_all_the_time(name):
    assert detect(samples.SAMPLES[name]().motion).feet.all()


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize(("unit", "up"), [("m", "y"), ("inch", "z")])
def test_unit_axis_and_skeleton_do_not_matter(skeleton, unit, up):
    here = detect(samples.walk().motion).feet
    there = detect(samples.walk(skeleton=skeleton, unit=unit, up=up).motion).feet
    assert (here == there).mean() > 0.97


def test_noise_of_two_millimetres_does_not_make_contacts_flicker():
    walk = samples.walk(fps=120.0, unit="m").motion
    hips = np.array(walk.translations)
    hips[:, Body.of(walk).roles["hips"]] += np.random.default_rng(3).normal(scale=0.002, size=(len(walk), 3))
    clean, noisy = detect(walk), detect(walk.with_(translations=hips))
    for foot in range(2):
        assert len(noisy.spans(foot)) <= len(clean.spans(foot)) + 1


def test_a_walk_on_the_spot_of_a_treadmill_has_hardly_any_contacts():
    walk = samples.walk(unit="m").motion
    still = np.array(walk.translations)
    hips = Body.of(walk).roles["hips"]
    forward = np.polyfit(walk.times, still[:, hips], 1)[0]
    still[:, hips] -= walk.times[:, None] * forward
    assert detect(walk.with_(translations=still)).feet.mean() < 0.15
    assert detect(walk).feet.mean() > 0.5


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_very_short_clips(frames):
    motion = samples.still().motion[:frames]
    assert detect(motion).points.shape == (frames, 2, 2)


def test_spans_of_a_mask():
    assert spans(np.array([True, True, False, True])) == [(0, 2), (3, 4)]
    assert spans(np.zeros(3, bool)) == []


def test_slides_measures_a_known_slide():
    sample = samples.still(unit="m", seconds=2.0)
    body = Body.of(sample.motion)
    moved = np.array(sample.motion.translations)
    moved[:, body.roles["hips"]] += np.linspace(0, 0.10, len(moved))[:, None] * body.forward
    contacts = Contacts(np.ones((len(moved), 2, 2), bool))
    np.testing.assert_allclose(slides(sample.motion, contacts, body), 0.0, atol=1e-9)
    np.testing.assert_allclose(
        slides(sample.motion.with_(translations=moved), contacts, body), 0.05, rtol=0.02
    )
