"""Maps of time: on curves of speed made by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mien.signal import time_map

curves = arrays(np.float64, st.integers(2, 400), elements=st.floats(0.0, 5.0, allow_subnormal=False))


def bell(centre, count=300, width=6.0):
    """A dip of speed around ``centre``, down to nothing, in a speed of 1."""
    return 1.0 - np.exp(-0.5 * ((np.arange(count) - centre) / width) ** 2)


def hits(pauses):
    """The first step of each pause."""
    return np.flatnonzero(np.diff(np.concatenate([[0.0], pauses])) > 0)


class TestSpeed:
    @pytest.mark.parametrize("fps", [24.0, 30.0, 60.0, 100.0, 120.0])
    def test_even_movement_has_even_speed(self, fps):
        t = np.arange(int(2 * fps) + 1) / fps
        speed, step = time_map.speed_curve(np.stack([3.0 * t, 4.0 * t, 0.0 * t], -1), 1.0 / fps)
        assert step == pytest.approx(0.01, rel=0.01)
        np.testing.assert_allclose(speed, 5.0, rtol=1e-12)

    def test_the_path_length_is_kept(self):
        points = np.cumsum(np.random.default_rng(1).normal(size=(200, 3)), axis=0)
        speed, step = time_map.speed_curve(points, 1.0 / 50.0, wrap=True)
        closed = np.concatenate([points, points[:1]])
        assert speed.sum() * step == pytest.approx(np.linalg.norm(np.diff(closed, axis=0), axis=-1).sum())

    def test_the_frame_rate_does_not_matter(self):
        curves = []
        for fps in (24.0, 60.0, 120.0):
            t = np.arange(int(4 * fps) + 1) / fps
            curves.append(time_map.speed_curve(np.stack([np.cos(3 * t), np.sin(5 * t), t], -1), 1 / fps)[0])
        inside = slice(10, -10)  # at the ends the last frame's step is held: half a frame of delay
        np.testing.assert_allclose(curves[0][inside], curves[2][inside], atol=0.05)
        np.testing.assert_allclose(curves[1][inside], curves[2][inside], atol=0.02)

    def test_noise_is_low_passed(self):
        t = np.arange(0.0, 4.0, 0.01)
        x = t + 0.002 * np.sin(2 * np.pi * 30.0 * t)
        speed, _ = time_map.speed_curve(np.stack([x, 0 * t, 0 * t], -1), 0.01)
        assert np.ptp(speed[20:-20]) < 0.005  # of 0.75 before

    @pytest.mark.parametrize("frames", [1, 2, 3])
    def test_a_few_frames(self, frames):
        speed, _ = time_map.speed_curve(np.zeros((frames, 3)), 1.0 / 30.0)
        assert np.isfinite(speed).all()


class TestConstantSpeed:
    def test_two_speeds_become_one_exactly(self):
        speed = np.repeat([1.0, 3.0], 75)
        durations = time_map.constant_speed(speed, speed < 0.1, np.array([0, 150]))
        shown = speed / durations
        assert shown.std() / shown.mean() < 1e-14
        assert durations.sum() == pytest.approx(150.0)

    def test_each_segment_keeps_its_length_and_its_pauses(self):
        speed = np.array([0.0, 1.0, 3.0, 0.0, 5.0, 5.0, 1.0, 0.0])
        durations = time_map.constant_speed(speed, speed == 0.0, np.array([0, 4, 8]))
        np.testing.assert_allclose(durations, [1, 0.5, 1.5, 1, 15 / 11, 15 / 11, 3 / 11, 1])

    def test_nothing_moves(self):
        speed = np.zeros(10)
        assert (time_map.constant_speed(speed, speed == 0.0, np.array([0, 10])) == 1.0).all()


class TestShortPauses:
    @pytest.mark.parametrize("mode", ["peaks", "grid"])
    def test_a_uniform_circle_has_none_in_spite_of_rounding(self, mode):
        for fps in (30.0, 100.0):
            t = np.arange(int(8 * fps)) / fps
            points = np.stack([np.cos(2.3 * t), np.sin(2.3 * t), 0 * t], -1)
            speed, _ = time_map.speed_curve(points, 1.0 / fps)
            assert not time_map.short_pauses(speed, 0.2, mode=mode).any()

    def test_a_dip_is_found_wherever_it_lies(self):
        for centre in range(60, 90):
            assert hits(time_map.short_pauses(bell(centre), 0.1)).tolist() == [centre - 7]

    def test_the_fixed_grid_misses_some(self):
        found = [len(hits(time_map.short_pauses(bell(c), 0.1, mode="grid"))) for c in range(60, 75)]
        assert 0 < sum(found) < len(found)

    def test_shallow_dips_do_not_count(self):
        shallow = 1.0 - 0.2 * (1.0 - bell(150))
        assert not time_map.short_pauses(shallow, 0.1).any()

    def test_long_rests_are_left_alone(self):
        speed = np.ones(300)
        speed[100:160] = 0.01
        assert not time_map.short_pauses(speed, 0.1).any()

    def test_a_pause_is_15_steps_long_and_pauses_do_not_overlap(self):
        speed = bell(100) * bell(131) * bell(200)
        pauses = time_map.short_pauses(speed, 0.1)
        assert set(pauses) == {0.0, 1.0}
        assert pauses.sum() == 15 * len(hits(pauses)) == 45

    @pytest.mark.parametrize("mode", ["peaks", "grid"])
    def test_in_a_loop_a_pause_may_lie_across_the_seam(self, mode):
        speed = np.roll(bell(157), -157 + 7)  # in the middle of the first set
        assert not time_map.short_pauses(speed, 0.1, mode=mode).any()
        assert time_map.short_pauses(speed, 0.1, mode=mode, wrap=True).sum() == 15

    @pytest.mark.parametrize("mode", ["peaks", "grid"])
    def test_shorter_than_three_sets(self, mode):
        assert not time_map.short_pauses(bell(20, 44), 0.1, mode=mode).any()


class TestBorders:
    @given(curves, st.integers(4, 90))
    @settings(max_examples=60, deadline=None)
    def test_segments_are_short_and_cover_everything(self, speed, longest):
        borders = time_map.segment_borders(speed, longest)
        lengths = np.diff(borders)
        assert (borders[0], borders[-1]) == (0, len(speed))
        assert (lengths <= longest).all()
        assert len(lengths) == 1 or (lengths >= longest // 2).all()

    def test_they_lie_where_it_is_slowest(self):
        assert time_map.segment_borders(bell(70) * bell(130) * bell(210), 90).tolist() == [
            0,
            70,
            130,
            210,
            300,
        ]


class TestBalance:
    @given(curves, st.floats(1.2, 10.0), st.booleans())
    @settings(max_examples=60, deadline=None)
    def test_segments_keep_their_length_and_the_slope_is_capped(self, raw, steepest, wrap):
        borders = time_map.segment_borders(raw, 40)
        durations = time_map.balance(raw + 0.01, borders, steepest=steepest, wrap=wrap)
        sums = np.add.reduceat(durations, borders[:-1])
        np.testing.assert_allclose(sums, np.diff(borders), rtol=1e-9)
        assert durations.min() >= 1.0 / steepest - 1e-12

    def test_even_durations_stay(self):
        durations = time_map.balance(np.ones(200), np.array([0, 90, 130, 200]), steepest=2.5)
        np.testing.assert_allclose(durations, 1.0, atol=1e-14)

    def test_where_the_cap_is_far_away_it_is_a_plain_division(self):
        raw = np.where(np.arange(60) < 20, 2.0, 1.0)
        np.testing.assert_allclose(time_map.balance(raw, np.array([0, 60]), steepest=9.0), raw * 0.75)


class TestRule:
    def test_segments_are_longer_for_even_movement_unless_said(self):
        assert [time_map.Rule(a).longest for a in (0.5, -0.5)] == [0.9, 1.5]
        assert time_map.Rule(0.5, segment=4.0).longest == 4.0

    def test_above_0_pauses_last_longer_and_below_0_what_is_slow_lasts_shorter(self):
        speed, whole = bell(150), np.array([0, 300])
        rushed, even = (
            time_map.durations(speed, 0.05, whole, time_map.Rule(a, steepest=20.0)) for a in (0.5, -0.5)
        )
        assert rushed[150] / rushed[50] == pytest.approx(1.0 + 9.0 * 0.5)
        # At full speed a step lasts 1 + |a| (s / mean s - 1) as long, in a pause as long as it did.
        moving = speed >= 0.05
        assert even[50] / even[150] == pytest.approx(1.0 + 0.5 * (1.0 / speed[moving].mean() - 1.0), rel=1e-6)
        for lasting in (rushed, even):
            assert lasting.mean() == pytest.approx(1.0)

    def test_rests_count_when_asked(self):
        speed, whole = np.ones(300), np.array([0, 300])
        speed[100:160] = 0.01
        plain, rests = (
            time_map.durations(speed, 0.1, whole, time_map.Rule(0.5, rests=r)) for r in (False, True)
        )
        np.testing.assert_allclose(plain, 1.0)
        assert rests[130] > 1.5 * rests[50]


class TestBetween:
    def test_moments_lie_between_two_frames(self):
        here, after, weight = time_map.between(np.array([0.0, 1.25, 3.0]), 4)
        assert (here.tolist(), after.tolist(), weight.tolist()) == ([0, 1, 3], [1, 2, 3], [0.0, 0.25, 0.0])

    def test_beyond_the_ends(self):
        at = np.array([-0.5, 4.5])
        assert [a.tolist() for a in time_map.between(at, 4)[:2]] == [[0, 3], [0, 3]]
        assert [a.tolist() for a in time_map.between(at, 4, wrap=True)[:2]] == [[3, 0], [0, 1]]


class TestSourceTimes:
    @given(arrays(np.float64, 80, elements=st.floats(0.1, 10.0)), st.floats(0.005, 0.02))
    @settings(max_examples=40, deadline=None)
    def test_the_map_rises_and_its_ends_are_fixed(self, durations, step):
        at = np.linspace(0.0, 80 * step, 333)
        source = time_map.source_times(durations, step, at)
        assert (np.diff(source) > 0).all()
        assert source[0] == 0.0
        assert source[-1] == pytest.approx(80 * step)

    def test_borders_are_fixed(self):
        raw = np.random.default_rng(5).uniform(0.5, 3.0, 200)
        borders = np.array([0, 60, 130, 200])
        durations = time_map.balance(raw, borders, steepest=4.0)
        np.testing.assert_allclose(time_map.source_times(durations, 0.01, borders * 0.01), borders * 0.01)

    def test_it_is_the_inverse_of_the_sum(self):
        durations = time_map.balance(np.linspace(1.0, 3.0, 100), np.array([0, 100]), steepest=9.0)
        shown = np.cumsum(durations) * 0.01
        np.testing.assert_allclose(time_map.source_times(durations, 0.01, shown), np.arange(1, 101) * 0.01)


def test_a_knock_becomes_even_while_it_moves():
    """As the thesis has it: std / mean over moving frames from .32 to .05; here 0.4 s moves, 0.3 s pauses."""
    t = np.arange(241) / 100.0
    x = np.zeros(241)
    for start, sign in ((0.3, 1), (1.0, -1), (1.7, 1)):
        x += sign * 0.15 * (1.0 - np.cos(np.pi * np.clip((t - start) / 0.4, 0.0, 1.0)))
    speed, step = time_map.speed_curve(np.stack([x, 0 * x, 0 * x], -1), 0.01)
    still = 0.1 * np.percentile(speed, 95)
    borders = time_map.segment_borders(speed, 150)
    durations = time_map.balance(
        time_map.blur(time_map.constant_speed(speed, speed < still, borders), width=3), borders, steepest=20.0
    )
    source = time_map.source_times(durations, step, t)
    shown = np.abs(np.diff(np.interp(source, t, x))) * 100.0
    before = np.abs(np.diff(x)) * 100.0
    moving = speed >= still
    middle = 0.5 * (source[1:] + source[:-1])
    moving_shown = moving[np.minimum((middle / step).astype(int), len(speed) - 1)]
    assert before[moving].std() / before[moving].mean() > 0.3
    assert shown[moving_shown].std() / shown[moving_shown].mean() < 0.06


def test_two_speeds_become_one_but_for_the_smoothing_of_speed():
    """Below 2%. What is left lies within 0.1 s of the step: the longer the clip, the less."""
    t = np.arange(2001) / 100.0
    x = np.where(t < 10.0, t, 10.0 + 3.0 * (t - 10.0))
    speed, step = time_map.speed_curve(np.stack([x, 0 * x, 0 * x], -1), 0.01)
    whole = np.array([0, len(speed)])
    durations = time_map.constant_speed(speed, speed < 0.1, whole)
    shown = np.diff(np.interp(time_map.source_times(durations, step, t), t, x)) * 100.0
    assert shown.std() / shown.mean() < 0.02
    away = np.concatenate([shown[:490], shown[510:]])  # the step is shown at 5 s
    assert away.std() / away.mean() < 1e-3
