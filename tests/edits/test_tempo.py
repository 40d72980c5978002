"""tempo: everything in another time, feet that stand, flights that fall, cadence apart from speed."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits.tempo import tempo
from mien.errors import RecipeError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, foot_points, slides
from mien.kinematics.fk import world
from mien.kinematics.mass import GRAVITY, mass_model
from mien.motion import Motion
from mien.rotations import quaternion


def hips(motion: Motion) -> np.ndarray:
    return world(motion)[1][:, Body.of(motion).roles["hips"]]


def speed(motion: Motion) -> float:
    """Leg lengths a second between the middle of the first second and that of the last."""
    body, second = Body.of(motion), round(motion.fps)
    way = hips(motion)[-second:].mean(axis=0) - hips(motion)[:second].mean(axis=0)
    return float(np.linalg.norm(way - (way @ body.up) * body.up) / body.leg_length / (motion.duration - 1.0))


def fall(motion: Motion) -> float:
    """Acceleration of the centre of mass in the highest 0.16 s, as a share of gravity."""
    body = Body.of(motion)
    height = mass_model(motion, body).centre_of_mass(*world(motion)) @ body.up * body.metres_per_unit
    top, half = int(height.argmax()), round(0.08 * motion.fps)
    frames = slice(top - half, top + half + 1)
    return float(-2.0 * np.polyfit(motion.times[frames], height[frames], 2)[0] / GRAVITY)


@pytest.mark.parametrize("rate", [0.5, 0.8, 1.25, 2.0])
def test_the_length_is_divided_by_the_rate(rate: float) -> None:
    walk = samples.walk(seconds=4.0).motion
    after = tempo(walk, rate=rate)
    assert after.duration == pytest.approx(walk.duration / rate, abs=walk.frame_time)
    assert after.frame_time == walk.frame_time


def test_a_rate_of_one_returns_the_motion_itself() -> None:
    walk = samples.walk(seconds=2.0).motion
    after = tempo(walk)
    np.testing.assert_array_equal(after.rotations, walk.rotations)
    np.testing.assert_array_equal(after.translations, walk.translations)


@pytest.mark.parametrize("rate", [0.5, 0.8, 1.25])
def test_poses_are_those_of_other_moments(rate: float) -> None:
    """Oracle: the sample, which is a function of time, made at those moments.

    In its toes it has corners at the strike of a foot, which a curve through frames rounds off.
    """
    walk, expected = samples.walk(seconds=4.0).motion, samples.walk(seconds=4.0, fps=60.0 / rate).motion
    after = tempo(walk, rate=rate)
    count = min(len(after), len(expected))
    assert abs(len(after) - len(expected)) <= 1
    turn = quaternion.multiply(quaternion.conjugate(after.rotations[:count]), expected.rotations[:count])
    away = np.degrees(np.linalg.norm(quaternion.log(turn), axis=-1))
    assert np.percentile(away, 99) < 0.15
    off = np.abs(world(after)[1][:count] - world(expected)[1][:count]).max() / Body.of(walk).leg_length
    assert off < 0.003


def test_what_stands_still_stands() -> None:
    """Within the moments that a foot is planted in the clip it wanders no further than there."""
    walk = samples.walk(seconds=4.0, unit="m").motion
    body, contacts = Body.of(walk), detect(walk)
    before = foot_points(walk, body, *world(walk))
    assert all(len(contacts.spans(foot)) > 1 for foot in range(2))
    for rate in (0.7, 1.4):
        after = tempo(walk, rate=rate)
        feet = foot_points(after, body, *world(after))
        moments = np.linspace(0.0, len(walk) - 1.0, len(after))
        for foot in range(2):
            for start, stop in contacts.spans(foot):
                shown = (moments >= start) & (moments <= stop - 1)
                wander = np.ptp(feet[shown, foot], axis=0) - np.ptp(before[start:stop, foot], axis=0)
                assert wander.max() < 0.001


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("rate", [0.75, 1.3])
def test_cadence_without_speed(rate: float, skeleton: str) -> None:
    """As many steps in less time over less ground: the speed stays, and so do planted feet."""
    walk = samples.walk(seconds=6.0, skeleton=skeleton, unit="m").motion
    body = Body.of(walk)
    quick, steps = tempo(walk, rate=rate, travel="speed"), tempo(walk, rate=rate)
    assert speed(steps) == pytest.approx(rate * speed(walk), rel=0.03)
    assert speed(quick) == pytest.approx(speed(walk), rel=0.03)
    assert quick.duration == steps.duration
    contacts = detect(steps, body=body)
    assert slides(quick, contacts, body).max() < slides(steps, contacts, body).max() + 0.001


@pytest.mark.parametrize("travel", ["steps", "speed"])
def test_the_frame_rate_does_not_matter(travel: str) -> None:
    """60 and 120 Hz, up to the last whole step: within 2 % of a leg length."""
    slow, fast = (
        tempo(samples.walk(seconds=4.0, fps=fps).motion, rate=0.8, travel=travel) for fps in (60, 120)
    )
    common = min(len(slow), len(fast[::2])) - round(0.6 * slow.fps)
    away = np.abs(world(slow)[1][:common] - world(fast)[1][: 2 * common : 2]) / Body.of(slow).leg_length
    assert away.max() < 0.02


def test_a_jump_falls_by_gravity_at_any_tempo() -> None:
    jump = samples.jump(fps=120.0).motion
    assert fall(jump) == pytest.approx(1.0, abs=0.05)
    for rate in (0.8, 1.25):
        assert fall(tempo(jump, rate=rate, flight="free")) == pytest.approx(rate**2, rel=0.06)
        kept = tempo(jump, rate=rate)
        assert fall(kept) == pytest.approx(1.0, abs=0.06)
        # What does not fly keeps the tempo: only the flight, half a second, is shown at its own pace.
        assert kept.duration == pytest.approx(jump.duration / rate, abs=0.15)


def test_a_low_hop_gets_lower_as_it_gets_shorter() -> None:
    """So little height that the whole rate fits: T / r and, by g T^2 / 8, h / r^2."""
    hop = samples.jump(fps=120.0, height=0.15).motion
    high = np.ptp(hips(hop) @ Body.of(hop).up)
    quick, slow = tempo(hop, rate=1.1), tempo(hop, rate=0.9)
    assert np.ptp(hips(quick) @ Body.of(hop).up) < high < np.ptp(hips(slow) @ Body.of(hop).up)
    assert fall(quick) == pytest.approx(fall(hop), abs=0.06)
    assert fall(slow) == pytest.approx(fall(hop), abs=0.06)


def test_the_rate_may_change_over_time_and_within_a_span() -> None:
    walk = samples.walk(seconds=4.0).motion
    faster = mien.apply(walk, [mien.Step("tempo", {"rate": 2.0}, span=(1.0, 3.0), ease=0.1)])
    assert faster.duration == pytest.approx(3.05, abs=0.1)  # two seconds in one, without the eases
    np.testing.assert_allclose(faster.rotations[:30], walk.rotations[:30], atol=0.01)
    keyed = mien.apply(walk, [mien.Step("tempo", {"rate": ((0.0, 1.0), (4.0, 2.0))})])
    times = np.linspace(0.0, 4.0, 4001)  # of the same curve, the integral of 1 / rate
    rate = mien.curve.evaluate(((0.0, 1.0), (4.0, 2.0)), times)
    assert keyed.duration == pytest.approx(np.trapezoid(1.0 / rate, times), abs=2.0 * walk.frame_time)


def test_half_strength_is_half_the_change_of_rate() -> None:
    walk = samples.walk(seconds=4.0).motion
    half = mien.apply(walk, [mien.Step("tempo", {"rate": 1.5})], strength=0.5)
    assert half.duration == pytest.approx(walk.duration / 1.25, abs=walk.frame_time)


def test_edits_before_it_find_their_feet_after_it() -> None:
    """The reference is retimed along: a repair after the tempo compares the same moments."""
    walk = samples.walk(seconds=4.0, unit="m").motion
    steps = {"path_length": {"mid": 1.3}, "tempo": {"rate": 1.2}, "foot_plant": {}}
    after = mien.apply(walk, [mien.Step(name, given) for name, given in steps.items()])
    assert after.reference is not None
    assert len(after.reference) == len(after)
    body = Body.of(walk)
    contacts = detect(after.reference, body=body)
    assert slides(after, contacts, body).max() < slides(after.reference, contacts, body).max() + 0.001


def test_a_rate_out_of_range_is_refused() -> None:
    with pytest.raises(RecipeError, match="rate"):
        tempo(samples.still().motion, rate=9.0)
