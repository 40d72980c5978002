"""Steps: found where the samples' feet come down, on any skeleton, and matched foot to foot."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.kinematics.steps import is_gait, match, steps, with_ends

RIGHT, LEFT = 1, 0


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("form", [{}, {"fps": 24.0, "unit": "m"}, {"up": "z", "heading": 2.0}])
def test_a_step_is_shortly_before_each_heel_strike(skeleton, form):
    made = samples.walk(seconds=4.0, skeleton=skeleton, **form)
    found = steps(made.motion)
    for foot, side in enumerate(("left", "right")):
        # At the very ends of a clip a foot may not have been seen further back yet.
        inside = [t for t in made.events[f"{side}_heel_strike"] if 0.3 < t < 3.9]
        times = found[found[:, 1] == foot, 0] * made.motion.frame_time
        assert len(times) >= len(inside)
        for strike in inside:
            assert np.min(np.abs(times - strike + 0.03)) < 0.06
    assert is_gait(found, made.motion.frame_time)


def test_steps_are_finer_than_a_frame():
    """An even walk has even steps, though its frames fall anywhere in them."""
    made = samples.walk(seconds=5.0, fps=24.0, cadence=1.83)
    times = np.diff(steps(made.motion)[:, 0]) * made.motion.frame_time
    np.testing.assert_allclose(times, 1 / 1.83, atol=0.25 / 24)


def test_on_the_spot_there_are_as_many():
    walk = samples.walk(seconds=4.0).motion
    np.testing.assert_allclose(steps(mien.apply(walk, [mien.Step("in_place")])), steps(walk), atol=0.3)


@pytest.mark.parametrize("name", ["still", "wave", "knock", "punch", "pendulum"])
def test_who_stands_takes_no_steps(name):
    motion = samples.SAMPLES[name]().motion
    assert not is_gait(steps(motion), motion.frame_time)


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_very_short_clips_have_no_steps(frames):
    assert steps(samples.walk().motion[:frames]).shape == (0, 2)


@pytest.mark.parametrize(
    ("found", "gait"),
    [
        ([(10, LEFT), (40, RIGHT), (75, LEFT)], True),
        ([(10, LEFT), (40, RIGHT), (75, RIGHT)], False),
        ([(10, LEFT)], False),
        ([(10, LEFT), (12, RIGHT)], False),
        ([(10, LEFT), (30, RIGHT), (130, LEFT)], False),
    ],
    ids=["walk", "a hop", "one step", "a jump", "a pause"],
)
def test_what_is_a_gait(found, gait):
    assert is_gait(np.array(found, float), 1 / 60) is gait


def walk(*frames: int, first: int = LEFT) -> np.ndarray:
    return np.array([(frame, (first + i) % 2) for i, frame in enumerate(frames)], float)


def poses(length: int, start: float) -> np.ndarray:
    """A pose that says when it is."""
    return start + np.arange(length, dtype=float)[:, None]


def test_the_same_foot_is_matched_and_as_many_steps_as_can_be():
    a, b = walk(10, 20, 30, 40), walk(7, 22, 37, 52, 67, first=RIGHT)
    found = match([a, b], [np.zeros((50, 1)), np.zeros((80, 1))])
    np.testing.assert_array_equal(found, [[10, 22], [20, 37], [30, 52], [40, 67]])


def test_of_equal_matches_the_poses_decide():
    a, b = walk(10, 20, 30), walk(10, 20, 30, 40, 50, 60, 70)
    for late in (0, 20, 40):
        found = match([a, b], [poses(40, late), poses(80, 0)])
        np.testing.assert_array_equal(found[:, 1] - found[:, 0], late)


def test_three_walks_share_what_all_have():
    a, b, c = walk(10, 20, 30, 40, 50), walk(11, 21, 31, first=RIGHT), walk(5, 15, 25, 35)
    found = match([a, b, c], [np.zeros((60, 1))] * 3)
    assert found.shape == (3, 3)
    feet = [
        {int(w[w[:, 0] == frame, 1][0]) for frame, w in zip(row, (a, b, c), strict=True)} for row in found
    ]
    assert all(len(foot) == 1 for foot in feet)


def test_walks_that_share_less_than_two_steps_are_not_matched():
    assert match([walk(10, 20), walk(10, 20, first=RIGHT)], [np.zeros((30, 1))] * 2) is None


def test_ends_near_enough_are_kept():
    matched = np.array([[10.3, 12.0], [20.2, 27.0], [30.1, 42.0]])
    np.testing.assert_array_equal(with_ends(matched, [36, 52])[[0, -1]], [[0, 0], [35, 51]])


def test_who_goes_on_longer_is_cut_off_at_a_whole_frame():
    matched = np.array([[5.0, 45.0], [15.0, 65.0], [25.0, 85.0]])
    found = with_ends(matched, [61, 90])
    np.testing.assert_array_equal(found[0], [0, 35])
    np.testing.assert_array_equal(found[-1], [27, 89])


def test_who_stands_long_before_the_walk_keeps_it():
    matched = np.array([[50.0, 90.0], [60.0, 100.0], [70.0, 110.0]])
    np.testing.assert_array_equal(with_ends(matched, [71, 111])[0], [0, 0])
