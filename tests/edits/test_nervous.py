"""nervous: paths and pace wander slowly, their means stay, feet stand once they are put back."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits.nervous import nervous
from mien.errors import RecipeError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, slides
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.recipe import Step


def hand_speed(motion: Motion) -> np.ndarray:
    """Speed of the right hand beside the hips (T - 1,), leg lengths a second."""
    body = Body.of(motion)
    positions = world(motion)[1]
    beside = positions[:, body.roles["right_wrist"]] - positions[:, body.roles["hips"]]
    return np.linalg.norm(np.diff(beside, axis=0), axis=1) * motion.fps / body.leg_length


def strides(motion: Motion) -> np.ndarray:
    """Seconds from each landing of the left foot to the next."""
    return np.diff([start for start, _ in detect(motion).spans(0)][1:]) * motion.frame_time


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_paths_wander_and_their_mean_stays(skeleton: str) -> None:
    walk = samples.walk(seconds=12.0, skeleton=skeleton).motion
    ratios = []
    for seed in range(6):
        after = nervous(walk, paths=1.0, seed=seed)
        window = np.ones(round(walk.fps)) / round(walk.fps)
        gain = np.convolve(hand_speed(after) / hand_speed(walk).mean(), window, mode="valid")
        assert 0.5 < gain.min() < 0.9
        assert 1.1 < gain.max() < 1.6
        ratios.append(gain.mean())
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.04)


def test_strides_are_uneven_and_the_clip_as_long() -> None:
    walk = samples.walk(seconds=12.0).motion
    even, uneven = strides(walk), strides(nervous(walk, rhythm=0.2))
    assert np.ptp(even) < 0.02 + walk.frame_time
    assert 0.08 < np.ptp(uneven) / even.mean() < 0.4
    assert uneven.mean() == pytest.approx(even.mean(), rel=0.03)
    assert len(nervous(walk, rhythm=0.4)) == len(walk)


def test_it_is_seeded_and_slow() -> None:
    wave = samples.wave().motion
    one, same, other = (nervous(wave, paths=1.0, rhythm=0.2, seed=seed) for seed in (3, 3, 4))
    np.testing.assert_array_equal(one.rotations, same.rotations)
    assert np.abs(one.rotations - other.rotations).max() > 0.01
    assert {m.check.name: m.passed for m in mien.check(one, against=wave).findings}["jitter"]


def test_arms_wander_apart_and_legs_together() -> None:
    """Slower than the strides, so that each has one gain: legs share it, arms do not."""
    walk = samples.walk(seconds=24.0).motion
    after, body = nervous(walk, paths=1.0, low=0.05, high=0.15), Body.of(walk)

    def gain(role: str) -> np.ndarray:
        """Return how far a joint swings to and fro as a share of what it did, stride by stride."""
        ways = []
        for motion in (after, walk):
            positions = world(motion)[1]
            ways.append((positions[:, body.roles[role]] - positions[:, body.roles["hips"]]) @ body.forward)
        stride = round(walk.fps * 1.1)
        one, other = ([np.ptp(way[i : i + stride]) for i in range(0, 1300, 40)] for way in ways)
        return np.divide(one, other)

    assert np.corrcoef(gain("left_ankle"), gain("right_ankle"))[0, 1] > 0.9
    assert np.corrcoef(gain("left_wrist"), gain("right_wrist"))[0, 1] < 0.7


def test_the_reference_takes_the_time_and_not_the_paths() -> None:
    walk = samples.walk(seconds=4.0, unit="m").motion
    after = mien.apply(walk, [Step("nervous", {"paths": 1.0, "rhythm": 0.2}), Step("foot_plant")])
    only_time = nervous(walk, rhythm=0.2)
    assert after.reference is not None
    np.testing.assert_allclose(after.reference.rotations, only_time.rotations, atol=1e-12)
    body = Body.of(walk)
    contacts = detect(after.reference, body=body)
    assert slides(after, contacts, body).max() < slides(after.reference, contacts, body).max() + 0.001


def test_it_may_grow_over_time() -> None:
    walk = samples.walk(seconds=6.0).motion
    step = Step("nervous", {"paths": 1.0, "rhythm": 0.3})
    grown = mien.apply(walk, [step], strength=((0.0, 0.0), (3.0, 0.0), (4.0, 1.0)))
    whole = mien.apply(walk, [step])
    early, late = slice(0, 60), slice(260, None)
    away = [np.abs(m.rotations - walk.rotations) for m in (grown, whole)]
    assert away[0][early].max() < 0.5 * away[1][early].max()
    assert away[0][late].max() > 0.05


def test_what_makes_no_sense_is_refused() -> None:
    with pytest.raises(RecipeError, match="below high"):
        nervous(samples.still().motion, paths=0.5, low=2.0)
