"""Strokes: which ends of a hand's movements meet something, and when."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.strokes import Hand, strokes
from mien.samples import SAMPLES, SKELETONS

RATES = (30.0, 50.0, 60.0, 100.0, 120.0)


def ends(motion, side="right"):
    """When the strokes of a hand end, in seconds."""
    body = Body.of(motion)
    return strokes(Hand.of(body, motion, side, *world(motion)), motion.frame_time)[:, 1]


def least_jerk(t, keys):
    """A value that goes from key to key with least jerk: keys are (start, end, by how much)."""
    out = np.zeros(len(t))
    for start, end, by in keys:
        u = np.clip((t - start) / (end - start), 0.0, 1.0)
        out += by * u**3 * (10.0 - 15.0 * u + 6.0 * u * u)
    return out


def moving(along, *, reach=None, apart=None):
    """A hand on a straight line, reaching out as far as it goes unless said otherwise."""
    path = np.column_stack([along, np.zeros(len(along)), np.zeros(len(along))])
    far = np.full(len(along), 5.0)
    return Hand(path, along if reach is None else reach, far if apart is None else apart)


@pytest.mark.parametrize("fps", RATES)
@pytest.mark.parametrize("skeleton", SKELETONS)
def test_knocks_are_where_the_hand_turns_at_the_door(fps, skeleton):
    sample = samples.knock(fps=fps, skeleton=skeleton)
    hits = np.array(sample.events["stroke"]) + 0.2  # half of there and back
    np.testing.assert_allclose(ends(sample.motion), hits, atol=2.0 / fps)
    assert len(ends(sample.motion, "left")) == 0


@pytest.mark.parametrize("fps", RATES)
@pytest.mark.parametrize("skeleton", SKELETONS)
def test_punches_are_where_the_fist_arrives(fps, skeleton):
    sample = samples.punch(fps=fps, skeleton=skeleton)
    np.testing.assert_allclose(ends(sample.motion), sample.events["hit"], atol=2.0 / fps)
    assert len(ends(sample.motion, "left")) == 0


@pytest.mark.parametrize("fps", RATES)
@pytest.mark.parametrize("name", sorted({*SAMPLES} - {"knock", "punch", "jump"}))
def test_walking_waving_swinging_and_standing_arms_meet_nothing(name, fps):
    motion = SAMPLES[name](fps=fps).motion
    for side in ("left", "right"):
        assert len(ends(motion, side)) == 0


@pytest.mark.parametrize("rate", [0.5, 1.0, 2.0, 2.5])
def test_no_turn_of_a_wave_is_one_at_any_pace(rate):
    sample = samples.wave(seconds=12.0, waves=6, rate=rate)
    turning = (ends(sample.motion) > 1.1) & (ends(sample.motion) < sample.events["end"][0])
    assert not turning.any()


@pytest.mark.parametrize("frequency", [0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("size", [0.1, 0.3, 1.0])
def test_no_turn_of_a_pendulum_is_one(frequency, size):
    t = np.arange(600) / 100.0
    swing = size * np.sin(2.0 * np.pi * frequency * t)
    assert len(strokes(moving(swing), 0.01)) == 0


def test_noise_makes_none_and_loses_none():
    sample = samples.knock(fps=60.0)
    motion, body = sample.motion, Body.of(sample.motion)
    noise = np.random.default_rng(3).normal(size=(len(motion), 3)) * 0.002 / 0.87
    for side, expected in (("right", ends(motion)), ("left", np.zeros(0))):
        hand = Hand.of(body, motion, side, *world(motion))
        shaken = Hand(hand.path + noise, hand.reach + noise[:, 0], hand.apart + noise[:, 1])
        np.testing.assert_allclose(strokes(shaken, motion.frame_time)[:, 1], expected, atol=0.02)


def test_a_slow_reach_is_none_and_a_fast_one_that_stays_is_one():
    t = np.arange(400) / 100.0
    for lasts, expected in ((0.9, []), (0.6, []), (0.3, [1.3]), (0.2, [1.2])):
        found = strokes(moving(least_jerk(t, [(1.0, 1.0 + lasts, 0.5)])), 0.01)
        np.testing.assert_allclose(found[:, 1], expected, atol=0.02)
        assert np.all(found[:, 0] < 1.0)  # the rest before belongs to the wind-up


def test_a_small_or_a_faint_one_is_none():
    t = np.arange(400) / 100.0
    assert len(strokes(moving(least_jerk(t, [(1.0, 1.2, 0.1)])), 0.01)) == 0
    always = 0.5 * np.sin(2.0 * np.pi * 3.0 * t) * (t > 2.0)
    assert len(strokes(moving(always + least_jerk(t, [(1.0, 1.2, 0.2)])), 0.01)) == 0


def test_drawing_back_to_the_shoulder_meets_nothing():
    t = np.arange(400) / 100.0
    along = least_jerk(t, [(1.0, 1.2, 0.4), (2.5, 2.7, -0.4)])
    np.testing.assert_allclose(strokes(moving(along), 0.01)[:, 1], [1.2], atol=0.02)


def test_a_hammer_never_rests_but_stops_harder_than_it_sets_off():
    """Up slowly, down with growing speed, and stopped at once: blow after blow."""
    t = np.arange(500) / 100.0
    u = t % 0.8
    down = np.where(u < 0.5, 0.25 * (1.0 + np.cos(np.pi * u / 0.5)), 0.5 * ((u - 0.5) / 0.3) ** 2)
    found = strokes(moving(down), 0.01)
    np.testing.assert_allclose(found[:, 1], np.arange(1, 7) * 0.8, atol=0.03)
    even = 0.25 * (1.0 - np.cos(2.0 * np.pi * t / 0.8))  # as often, as far, without blows
    assert len(strokes(moving(even), 0.01)) == 0


@pytest.mark.parametrize("meeting", [True, False])
def test_hands_that_clap_meet_each_other(meeting):
    """Drawn back towards the shoulder, so that only the other hand makes it a clap."""
    t = np.arange(500) / 100.0
    u = t % 0.6
    inwards = np.where(u < 0.4, 0.15 * (1.0 + np.cos(np.pi * u / 0.4)), 0.3 * ((u - 0.4) / 0.2) ** 2)
    apart = 2.0 * (0.3 - inwards) + (0.1 if meeting else 0.6)
    found = strokes(moving(inwards, reach=0.5 - 0.3 * inwards, apart=apart), 0.01)
    if meeting:
        np.testing.assert_allclose(found[:, 1], np.arange(1, 9) * 0.6, atol=0.03)
    else:
        assert len(found) == 0


@pytest.mark.parametrize("frames", [1, 2, 3, 4, 10])
def test_short_clips_have_none(frames):
    assert strokes(moving(np.linspace(0.0, 1.0, frames)), 0.01).shape == (0, 2)


def real(data, pattern):
    found = sorted(data.glob(pattern))
    if not found:
        pytest.skip(f"no {pattern}")
    return found


@pytest.mark.parametrize(
    "pattern",
    [
        "bandai1/*_walk*.bvh",
        "bandai1/*_run_*.bvh",
        "bandai1/*_bye_*.bvh",
        "bandai2/*.bvh",
        "cmu_daz/0[279]_0[1-6].bvh",
        "cmu_iclone100j/*.bvh",
        "xia/*.bvh",
    ],
)
def test_no_arm_of_a_captured_walk_run_or_wave_meets_anything(data, pattern):
    found = {}
    for path in real(data, pattern):
        motion = mien.load(path)
        hits = [ends(motion, side) for side in ("left", "right")]
        found |= {path.name: hits} if any(map(len, hits)) else {}
    assert not found


def test_captured_punches_are_found(data):
    """Seen in pictures: the left fist is out at these moments, the right one guards."""
    motion = mien.load(real(data, "bandai1/*_punch_normal_001.bvh")[0])
    np.testing.assert_allclose(ends(motion, "left"), [0.95, 2.32, 3.77, 5.17, 6.58], atol=0.04)
    assert len(ends(motion, "right")) == 0
