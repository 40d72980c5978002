"""Alignment: known warps are found, walks meet in phase, and nothing else of a clip matters."""

import numpy as np
import pytest

from mien import MienError, samples
from mien.edits.resample import resample
from mien.kinematics.alignment import align, features
from mien.motion import Motion
from mien.rotations import quaternion
from mien.signal.sampling import spline


def warped(motion: Motion, exponent: float) -> Motion:
    """The same movement with another timing: at share t of the clip is what was at t ** exponent."""
    last = len(motion) - 1
    at = last * (np.arange(len(motion)) / last) ** exponent
    rotations = quaternion.normalise(spline(quaternion.continuous(motion.rotations), at))
    return motion.with_(rotations=rotations, translations=spline(motion.translations, at), source=None)


def phase(sample: samples.Sample, frames: np.ndarray) -> np.ndarray:
    cadence = sample.facts["cadence"]
    return 0.5 * cadence * frames * sample.motion.frame_time


def common(knots: np.ndarray) -> np.ndarray:
    return np.linspace(0, 1, len(knots))


@pytest.mark.parametrize("name", ["wave", "knock", "punch"])
@pytest.mark.parametrize("exponent", [1.2, 1 / 1.2])
def test_a_known_warp_of_a_gesture_is_found(name, exponent):
    motion = samples.SAMPLES[name]().motion
    found = align([motion, warped(motion, exponent)])
    assert found.method == "dtw"
    last = len(motion) - 1
    true = last * (found.knots[:, 1] / last) ** exponent
    moving = np.abs(np.diff(features(motion, len(motion)), axis=0)).sum(axis=1)
    inside = np.interp(true, np.arange(last), moving) > np.percentile(moving, 40)
    assert inside.sum() > 5
    assert np.abs(found.knots[:, 0] - true)[inside].max() * motion.frame_time < 0.06


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_walks_meet_in_phase(skeleton):
    slow = samples.tired_walk(seconds=6.0, skeleton=skeleton)
    fast = samples.walk(seconds=4.0, fps=48.0, unit="m", heading=2.5, skeleton=skeleton)
    found = align([slow.motion, fast.motion])
    assert found.method == "steps"
    at = np.linspace(0, 1, 200)
    frames = found.frames(common(found.knots), at)
    apart = phase(slow, frames[:, 0]) - phase(fast, frames[:, 1])
    apart -= np.round(apart)
    assert np.abs(apart).max() < 0.04, "of a stride"


def test_every_column_rises_from_whole_frame_to_whole_frame():
    clips = [samples.walk(seconds=4.0).motion, samples.tired_walk().motion, samples.walk(cadence=2.2).motion]
    for method in ("steps", "dtw", "none"):
        knots = align(clips, method=method).knots
        assert (np.diff(knots, axis=0) > 0).all()
        assert (knots[0] >= 0).all()
        assert (knots[-1] <= [len(clip) - 1 for clip in clips]).all()
        np.testing.assert_array_equal(knots[[0, -1]], np.round(knots[[0, -1]]))


@pytest.mark.parametrize("method", ["auto", "dtw", "none"])
@pytest.mark.parametrize("name", ["walk", "wave"])
def test_of_equal_clips_equal_frames_belong_together(name, method):
    motion = samples.SAMPLES[name]().motion
    knots = align([motion] * 3, method=method).knots
    np.testing.assert_allclose(knots, np.repeat(knots[:, :1], 3, axis=1), atol=1e-9)
    np.testing.assert_array_equal(knots[-1], len(motion) - 1)


@pytest.mark.parametrize("method", ["auto", "dtw", "none"])
@pytest.mark.parametrize("names", [("walk", "tired_walk", "turn"), ("wave", "knock", "punch")])
def test_the_order_of_the_clips_does_not_matter(names, method):
    a, b, c = (samples.SAMPLES[name]().motion for name in names)
    one, other = align([a, b, c], method=method), align([c, a, b], method=method)
    np.testing.assert_array_equal(one.knots, other.knots[:, [1, 2, 0]])


@pytest.mark.parametrize("names", [("walk", "tired_walk"), ("wave", "knock")])
def test_place_heading_and_unit_do_not_matter(names):
    a, b = (samples.SAMPLES[name]() for name in names)
    moved = samples.SAMPLES[names[1]](heading=1.9, unit="m").motion
    one, other = align([a.motion, b.motion]), align([a.motion, moved])
    np.testing.assert_allclose(one.knots, other.knots, atol=1e-6)


def test_the_frame_rate_does_not_matter():
    a, b = samples.walk(fps=60.0).motion, samples.tired_walk(fps=60.0).motion
    one, other = align([a, b]).knots, align([a, resample(b, fps=30.0)]).knots
    np.testing.assert_allclose(one[:, 1], 2 * other[:, 1], atol=1.0)


def test_none_matches_shares_of_the_length():
    a, b = samples.walk(seconds=2.0).motion, samples.wave(seconds=5.0).motion
    found = align([a, b], method="none")
    at = found.frames(np.array([0.0, 1.0]), np.array([0.5]))
    np.testing.assert_allclose(at, [[0.5 * (len(a) - 1), 0.5 * (len(b) - 1)]])


def test_to_says_whom_the_others_follow():
    motions = [samples.wave().motion, warped(samples.wave().motion, 1.3), warped(samples.wave().motion, 0.8)]
    for to in range(3):
        spread = np.diff(align(motions, method="dtw", to=to).knots[:, to])
        np.testing.assert_allclose(spread, spread.mean(), rtol=1e-6)


@pytest.mark.parametrize("frames", [1, 2, 3, 4])
def test_very_short_clips(frames):
    a, b = samples.walk().motion[:frames], samples.tired_walk().motion[:frames]
    knots = align([a, b]).knots
    np.testing.assert_allclose(knots[-1], frames - 1)


def test_what_does_not_fit_is_said():
    walk, wave = samples.walk().motion, samples.wave().motion
    with pytest.raises(MienError, match="did you mean 'steps'"):
        align([walk, walk], method="step")
    with pytest.raises(MienError, match="no two steps in common"):
        align([walk, wave], method="steps")
    with pytest.raises(MienError, match="clip 2 has a single frame"):
        align([walk, walk[:1]])
    with pytest.raises(MienError, match="one of the 2 clips"):
        align([walk, walk], to=2)


def test_it_says_what_it_is():
    walk = samples.walk(seconds=2.0).motion
    assert repr(align([walk, walk], method="none")) == "Alignment(2 motions by none, 2 knots)"
