"""waveshape: a hinge in closed form, limits, loops, joints that go round, and feet that stay."""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

import mien
from mien import samples
from mien.edits.pipeline import apply
from mien.edits.waveshape import waveshape
from mien.errors import BodyError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, slides
from mien.kinematics.fk import world
from mien.kinematics.heading import heading
from mien.kinematics.smoothing import slow_mean
from mien.motion import Motion, Skeleton
from mien.recipe import Step
from mien.rotations import quaternion as quat

FPS = 100.0
AXIS = np.array([2.0, -1.0, 2.0]) / 3.0


def hinge(angle: np.ndarray, role: str = "right_elbow", fps: float = FPS) -> tuple[Motion, int]:
    """A figure at rest but for one joint that turns by ``angle`` (T,) about its own ``AXIS``."""
    first = samples.walk(seconds=0.1).motion
    rotations = np.repeat(first.rotations[:1], len(angle), axis=0)
    joint = Body.of(first).roles[role]
    rotations[:, joint] = quat.multiply(rotations[:, joint], quat.exp(angle[:, None] * AXIS))
    still = np.repeat(first.translations[:1], len(angle), axis=0)
    return Motion(first.skeleton, quat.continuous(rotations), still, 1.0 / fps), joint


def turned(motion: Motion, joint: int) -> np.ndarray:
    """The turn (T, 3) of a joint of ``hinge`` from where it is at rest."""
    rest = samples.walk(seconds=0.1).motion.rotations[0, joint]
    return quat.log(quat.multiply(quat.conjugate(rest), motion.rotations[:, joint]))


def sine(size: float, frequency: float = 3.125, frames: int = 640) -> np.ndarray:
    """A whole number of periods (at 3.125 Hz the mean of the bands below 1 Hz is exactly 0)."""
    return size * np.sin(2 * np.pi * frequency * np.arange(frames) / FPS)


def apart(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.linalg.norm(quat.log(quat.multiply(quat.conjugate(a), b)), axis=-1)


@pytest.mark.parametrize(("small", "large", "border"), [(0.3, 1.0, 10.0), (2.0, 0.5, 25.0), (0.0, 1.5, 5.0)])
@pytest.mark.parametrize("size", [0.02, 0.3, 1.2])
def test_a_hinge_goes_through_the_curve(small: float, large: float, border: float, size: float) -> None:
    """Oracle: the slope in words, added up by SciPy; the axis stays."""
    angle = sine(size)
    clip, joint = hinge(angle)
    after = turned(waveshape(clip, small=small, large=large, border=border, boundary="wrap"), joint)

    def slope(degrees: float) -> float:
        return large + (small - large) / (1.0 + (degrees / border) ** 2)

    for frame in range(0, 32, 3):
        degrees = abs(np.degrees(angle[frame]))
        wanted = np.sign(angle[frame]) * np.radians(quad(slope, 0.0, degrees)[0])
        np.testing.assert_allclose(after[frame], wanted * AXIS, atol=1e-6)


def test_small_movement_goes_and_large_stays() -> None:
    """A hand that fidgets by two degrees, then swings through eighty."""
    quiet, wide = (waveshape(hinge(sine(np.radians(d)))[0], small=0.0, border=4.0) for d in (2.0, 80.0))
    joint = hinge(sine(0.1))[1]
    assert np.degrees(np.linalg.norm(turned(quiet, joint), axis=1)).max() < 0.2
    assert np.degrees(np.linalg.norm(turned(wide, joint), axis=1)).max() == pytest.approx(80.0 - 6.1, abs=0.5)


def test_more_movement_is_never_less_afterwards() -> None:
    sizes = np.radians(np.linspace(1.0, 140.0, 30))  # to and fro by more than that, no mean is clear
    for small, large, limit in ((0.2, 1.0, 180.0), (3.0, 0.0, 180.0), (3.0, 2.0, 180.0), (1.0, 1.0, 30.0)):
        most = []
        for size in sizes:
            clip, joint = hinge(sine(size, frames=320))
            after = waveshape(clip, boundary="wrap", small=small, large=large, limit=limit)
            most.append(np.linalg.norm(turned(after, joint)[8]))
        assert (np.diff(most) > -1e-9).all(), (small, large, limit)
        assert max(most) <= np.pi + 1e-9


@pytest.mark.parametrize("limit", [5.0, 20.0, 60.0, 150.0])
@pytest.mark.parametrize("sample", ["walk", "punch", "jump"])
def test_no_joint_goes_beyond_the_limit(sample: str, limit: float) -> None:
    motion = samples.SAMPLES[sample](fps=FPS).motion
    after = waveshape(motion, small=1.5, limit=limit, boundary="hold")
    body = Body.of(motion)
    joints = [j for j in motion.skeleton.descendants(body.roles["hips"]) if j != body.roles["hips"]]
    mean, clear = slow_mean(quat.continuous(motion.rotations[:, joints]), FPS, frames=0)
    assert clear.min() > 0.6
    before, found = (np.degrees(apart(mean, m.rotations[:, joints])) for m in (motion, after))
    assert found.max() <= limit + 1e-6
    if limit <= 20.0:
        assert before.max() > limit, "the limit was never reached"


def test_a_limit_leaves_what_is_well_inside_and_180_is_none() -> None:
    clip, joint = hinge(sine(np.radians(19.0)))
    inside = waveshape(clip, limit=40.0, boundary="wrap")
    np.testing.assert_allclose(turned(inside, joint), turned(clip, joint), atol=1e-9)
    far, joint = hinge(sine(np.radians(170.0)))
    np.testing.assert_array_equal(waveshape(far, limit=180.0).rotations, far.rotations)
    nearly = waveshape(far, limit=179.99, boundary="wrap")
    assert apart(nearly.rotations, far.rotations).max() < 1e-3


def test_the_limit_is_reached_without_a_kink() -> None:
    clip, joint = hinge(sine(1.5, frequency=0.78125, frames=2560), fps=400.0)
    speed = np.diff(turned(waveshape(clip, limit=30.0, boundary="wrap"), joint) @ AXIS) * 400.0
    free = np.diff(turned(clip, joint) @ AXIS) * 400.0
    assert np.abs(np.diff(speed)).max() < 2.0 * np.abs(np.diff(free)).max() * (1.5 / np.radians(15.0))
    assert np.abs(speed).max() <= np.abs(free).max() + 1e-9


def test_equal_gains_are_the_gain_of_the_whole_movement() -> None:
    clip, joint = hinge(sine(0.4))
    after = waveshape(clip, small=0.5, large=0.5, border=33.0, boundary="wrap")
    np.testing.assert_allclose(turned(after, joint), 0.5 * turned(clip, joint), atol=1e-9)


def test_a_movement_that_is_held_is_not_taken_back() -> None:
    """An arm that goes up and stays: the slow mean follows, and so does the arm."""
    t = np.arange(800) / FPS
    clip, joint = hinge(1.2 * np.clip(t - 2.0, 0.0, 1.0), role="left_shoulder")
    after = waveshape(clip, small=0.0, large=0.0)
    np.testing.assert_allclose(turned(after, joint)[-200:], turned(clip, joint)[-200:], atol=1e-6)


def test_a_joint_that_goes_round_and_round_is_left_alone() -> None:
    """A wheel of an arm, three turns a second: it has no mean; and no joint ever jumps."""
    spin = 2 * np.pi * 3.0 * np.arange(600) / FPS
    clip, joint = hinge(spin, role="left_shoulder")
    after = waveshape(clip, small=2.0, large=0.3, limit=40.0)
    middle = slice(150, 450)
    assert apart(after.rotations[middle, joint], clip.rotations[middle, joint]).max() < 1e-6
    steps = apart(after.rotations[1:, joint], after.rotations[:-1, joint])
    assert np.degrees(steps.max()) < 2.0 * np.degrees(spin[1])


def test_the_hips_neither_travel_nor_turn_otherwise() -> None:
    clip = samples.turn(seconds=3.0).motion
    body = Body.of(clip)
    after = waveshape(clip, small=2.0, large=0.6, limit=25.0)
    np.testing.assert_array_equal(after.translations, clip.translations)
    was, now = (heading(world(m)[1], body) for m in (clip, after))
    assert np.ptp(was) > 0.9
    np.testing.assert_allclose(now, was, atol=np.radians(1.0))


def test_a_loop_stays_a_loop_wherever_it_is_cut() -> None:
    t = 2 * np.pi * np.arange(120) / 120
    clip, _ = hinge(0.4 * np.sin(t) + 0.2 * np.cos(2 * t), fps=60.0)
    after = waveshape(clip, small=0.3, limit=15.0)
    rolled = waveshape(clip.with_(rotations=np.roll(clip.rotations, 41, axis=0)), small=0.3, limit=15.0)
    assert apart(after.rotations, clip.rotations).max() > 0.05
    assert apart(rolled.rotations, np.roll(after.rotations, 41, axis=0)).max() < 1e-9


def test_only_the_joints_that_are_asked_for_are_worked_on() -> None:
    clip = samples.walk(seconds=2.0).motion
    body = Body.of(clip)
    arms = body.joints(("arms",))
    alone, whole = waveshape.__wrapped__(clip, small=0.4, joints=arms), waveshape(clip, small=0.4)
    np.testing.assert_allclose(alone.rotations[:, arms], whole.rotations[:, arms], atol=1e-12)
    others = [j for j in range(len(clip.skeleton)) if j not in (*arms, body.roles["hips"])]
    np.testing.assert_array_equal(alone.rotations[:, others], clip.rotations[:, others])
    by_parts = apply(clip, [Step("waveshape", {"small": 0.4}, parts=("arms",))])
    np.testing.assert_allclose(by_parts.rotations[:, arms], whole.rotations[:, arms], atol=1e-12)


def slid(motion: Motion, values: dict[str, float]) -> tuple[float, float]:
    """How far planted feet slide at most before and after, in leg lengths, in the contacts of before."""
    after = apply(motion, [Step("waveshape", values), Step("foot_plant")])
    body, contacts = Body.of(motion), detect(motion)
    was, now = (slides(m, contacts, body).max() / body.leg_length for m in (motion, after))
    return was, now


CHANGES = [{"small": 0.3}, {"small": 1.8, "large": 0.7}, {"limit": 20.0}]


@pytest.mark.parametrize("values", CHANGES)
def test_feet_stay_where_they_stand_with_foot_plant(values: dict[str, float]) -> None:
    was, now = slid(samples.walk(seconds=4.0).motion, values)
    assert now < was + 0.002


@pytest.mark.parametrize("values", CHANGES)
@pytest.mark.parametrize(
    "clip", ["bandai1/dataset-1_walk_normal_001", "cmu_mb_misc/02_01", "xia/neutral_01_000"]
)
def test_real_feet_stay_too(data: Path, clip: str, values: dict[str, float]) -> None:
    was, now = slid(mien.load(data / f"{clip}.bvh"), values)
    assert now < was + 0.002


def test_no_body_is_an_error() -> None:
    arm = Skeleton(("a", "b", "c"), np.array([-1, 0, 1]), np.eye(3))
    motion = Motion(arm, np.tile(quat.IDENTITY, (5, 3, 1)), np.tile(np.eye(3), (5, 1, 1)), 0.02)
    with pytest.raises(BodyError):
        waveshape(motion, small=0.5)
