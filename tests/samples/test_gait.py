"""The walks: events, symmetry, and the peaks of normal gait."""

from collections.abc import Callable

import numpy as np
import pytest

from mien.errors import MienError
from mien.samples import Sample, tired_walk, turn, walk

Places = Callable[[Sample], dict[str, np.ndarray]]
WALKS = {"walk": walk, "tired_walk": tired_walk}
MIRROR = np.array([-1.0, 1.0, 1.0])


def stride(sample: Sample) -> tuple[np.ndarray, np.ndarray]:
    """The frames of one stride in order of the right leg's phase, and that phase."""
    frames = round(2.0 / sample.facts["cadence"] * sample.motion.fps)
    order = np.argsort(sample.phases[:frames])
    return order, sample.phases[order]


@pytest.mark.parametrize("name", WALKS)
def test_the_second_half_of_a_stride_mirrors_the_first(name: str, places: Places) -> None:
    sample = WALKS[name](seconds=2.0, fps=180.0, cadence=1.8, unit="m")
    at, half = places(sample), 100  # frames of a step: 180 / 1.8
    step = np.array([0.0, 0.0, sample.facts["step_length"]])
    for role, place in at.items():
        other = role.replace("left", "LEFT").replace("right", "left").replace("LEFT", "right")
        np.testing.assert_allclose(place[half:], at[other][:-half] * MIRROR + step, atol=1e-9, err_msg=role)


@pytest.mark.parametrize("fps", [24.0, 30.0, 60.0, 100.0, 120.0])
@pytest.mark.parametrize("name", WALKS)
def test_events_agree_with_contacts(name: str, fps: float) -> None:
    sample = WALKS[name](seconds=5.0, fps=fps)
    times = sample.motion.times
    for i, side in enumerate(("left", "right")):
        heel, toe = sample.contacts[:, i].T
        on = times[1:][heel[1:] & ~heel[:-1]]
        off = times[1:][toe[:-1] & ~toe[1:]]
        strikes = [t for t in sample.events[f"{side}_heel_strike"] if t > 0]
        assert len(on) == len(strikes)
        np.testing.assert_allclose(on, strikes, atol=1.0 / fps)
        np.testing.assert_allclose(off, sample.events[f"{side}_toe_off"], atol=1.0 / fps)


def test_step_length_and_cadence_are_those_asked_for(places: Places) -> None:
    sample = walk(seconds=6.0, fps=90.0, cadence=1.5, step_length=0.6, unit="m")
    at = places(sample)
    flat = sample.contacts.all(axis=2)
    stands = {s: at[f"{s}_ankle"][:, 2][flat[:, i]] for i, s in enumerate(("left", "right"))}
    prints = np.unique(np.round(np.concatenate(list(stands.values())), 9))
    np.testing.assert_allclose(np.diff(prints), 0.6, atol=1e-8)
    strikes = np.sort(sample.events["left_heel_strike"] + sample.events["right_heel_strike"])
    np.testing.assert_allclose(np.diff(strikes), 1.0 / 1.5)
    assert (at["hips"][-1, 2] - at["hips"][0, 2]) / 6.0 == pytest.approx(sample.facts["speed"], rel=5e-3)


def test_the_heel_stays_on_its_point_while_the_foot_rolls_over_it(places: Places) -> None:
    """Ankle and toe joint keep their distance to one floor point between heel strike and foot flat."""
    sample = walk(seconds=3.0, fps=240.0, unit="m")
    at = places(sample)
    for i, side in enumerate(("left", "right")):
        heel, toe = sample.contacts[:, i].T
        (starts,) = np.nonzero((heel & ~toe)[1:] & ~(heel & ~toe)[:-1])
        start = int(starts[0]) + 1
        frames = slice(start, start + int(np.argmin((heel & ~toe)[start:])))
        flat = frames.stop + 2
        assert frames.stop - frames.start > 10
        ahead = at[f"{side}_toe"][flat] - at[f"{side}_ankle"][flat]
        ahead[1] = 0.0
        point = at[f"{side}_ankle"][flat] - ahead / np.linalg.norm(ahead) * 0.2 * 0.152 * 1.75
        point[1] = 0.0
        for role in ("ankle", "toe"):
            reach = np.linalg.norm(at[f"{side}_{role}"][frames] - point, axis=1)
            np.testing.assert_allclose(reach, np.linalg.norm(at[f"{side}_{role}"][flat] - point), atol=1e-9)


def test_the_walk_has_the_peaks_of_normal_gait() -> None:
    """Peaks and when they come, in degrees and shares of the stride (Winter; Perry & Burnfield)."""
    sample = walk(seconds=1.2, fps=360.0)
    order, phase = stride(sample)
    knee, hip, ankle = (np.degrees(sample.angles[f"right_{j}"][order]) for j in ("knee", "hip", "ankle"))
    loading, swing = (phase > 0.05) & (phase < 0.3), (phase > 0.6) & (phase < 0.9)
    assert knee[loading].max() == pytest.approx(18.0, abs=4.0)
    assert phase[loading][knee[loading].argmax()] == pytest.approx(0.15, abs=0.04)
    assert knee[swing].max() == pytest.approx(60.0, abs=5.0)
    assert phase[swing][knee[swing].argmax()] == pytest.approx(0.73, abs=0.04)
    stance = (phase > 0.3) & (phase < 0.5)
    assert knee[stance].min() == pytest.approx(5.0, abs=4.0)
    assert hip.max() - hip.min() == pytest.approx(43.0, abs=11.0)
    assert phase[hip.argmin()] == pytest.approx(0.53, abs=0.05)
    assert ankle.min() == pytest.approx(-19.0, abs=6.0)
    assert phase[ankle.argmin()] == pytest.approx(0.61, abs=0.04)
    assert 8.0 < ankle[stance].max() < 20.0


def test_arms_swing_against_the_legs() -> None:
    sample = walk(seconds=10.0)
    for side in ("left", "right"):
        arm, leg = sample.angles[f"{side}_shoulder"], sample.angles[f"{side}_hip"]
        assert np.corrcoef(arm, leg)[0, 1] < -0.7
    # Murray, Sepic & Barnard 1967: about 24 degrees back and 8 forward at a free pace, elbow 10 to 40.
    shoulder, elbow = (np.degrees(sample.angles[f"right_{j}"]) for j in ("shoulder", "elbow"))
    assert -28.0 < shoulder.min() < -15.0
    assert 5.0 < shoulder.max() < 20.0
    assert 5.0 < elbow.min() < 20.0
    assert 25.0 < elbow.max() < 45.0


def test_the_body_rises_twice_and_sways_once_a_stride(places: Places) -> None:
    sample = walk(seconds=10.0 / 0.9, fps=54.0, unit="m")
    hips = places(sample)["hips"][:600]  # ten strides of 60 frames
    for axis, per_stride, low, high in ((1, 2, 0.02, 0.06), (0, 1, 0.02, 0.06)):
        curve = hips[:, axis] - hips[:, axis].mean()
        power = np.abs(np.fft.rfft(curve))
        assert power.argmax() == 10 * per_stride
        assert low < np.ptp(curve) < high


def test_the_tired_walk_is_tired(places: Places) -> None:
    """Michalak et al. 2009: slower, smaller arm swing and bob, more sway, trunk and head forward."""
    fresh, tired = walk(seconds=8.0, unit="m"), tired_walk(seconds=8.0, unit="m")
    a, b = places(fresh), places(tired)
    assert tired.facts["speed"] < 0.6 * fresh.facts["speed"]
    assert np.ptp(tired.angles["right_shoulder"]) < 0.5 * np.ptp(fresh.angles["right_shoulder"])
    assert np.ptp(b["hips"][:, 1]) < np.ptp(a["hips"][:, 1])
    assert np.ptp(b["hips"][:, 0]) > np.ptp(a["hips"][:, 0])
    assert tired.angles["trunk_lean"].mean() > fresh.angles["trunk_lean"].mean() + np.radians(10.0)
    assert tired.angles["head_lean"].mean() > fresh.angles["head_lean"].mean() + np.radians(20.0)
    assert (b["head"][:, 1]).mean() < (a["head"][:, 1]).mean()


@pytest.mark.parametrize("rate", [0.4, -0.4, 1.0])
def test_a_turn_turns_at_its_rate(rate: float, places: Places) -> None:
    cadence = 1.7
    seconds = 8.0 / cadence  # four strides: the yaw of the pelvis comes back to itself
    sample = turn(seconds=seconds, fps=cadence * 40.0, rate=rate, unit="m")
    at = places(sample)
    side = at["left_hip"] - at["right_hip"]
    heading = np.unwrap(np.arctan2(-side[:, 2], side[:, 0]))
    assert heading[-1] - heading[0] == pytest.approx(rate * seconds, abs=1e-9)
    assert sample.facts["heading_rate"] == pytest.approx(rate)
    # Hips of equal phase lie on one circle about the centre, whose radius is speed over rate.
    hips = at["hips"][::80, [0, 2]]
    rows = np.column_stack([2.0 * hips, np.ones(len(hips))])
    centre = np.linalg.lstsq(rows, (hips**2).sum(axis=1), rcond=None)[0]
    radius = np.sqrt(centre[2] + centre[0] ** 2 + centre[1] ** 2)
    assert radius == pytest.approx(sample.facts["speed"] / abs(rate), abs=0.03)


@pytest.mark.parametrize(
    "wrong",
    [
        {"cadence": 0.1},
        {"cadence": 9.0},
        {"step_length": 0.0},
        {"step_length": 2.0},
        {"cadence": float("nan")},
    ],
)
def test_a_pace_no_one_walks_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(MienError, match="cadence must be"):
        walk(**wrong)


def test_a_turn_too_fast_to_walk_is_refused() -> None:
    with pytest.raises(MienError, match="rate must be"):
        turn(rate=3.0)


@pytest.mark.parametrize("step_length", [0.2, 0.45, 0.9])
@pytest.mark.parametrize("make", WALKS.values())
def test_every_step_length_can_be_reached(make: Callable[..., Sample], step_length: float) -> None:
    sample = make(step_length=step_length, fps=240.0, seconds=2.5)
    for side in ("left", "right"):
        assert np.degrees(sample.angles[f"{side}_knee"].min()) > 3.0
