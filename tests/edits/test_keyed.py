"""Numbers of a step that change over time."""

from dataclasses import replace

import numpy as np
import pytest

from mien import samples
from mien.edits.pipeline import apply, check
from mien.errors import RecipeError
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion as quat

HEAD = Step("posture", {"head": 30.0, "fade": False})
TALL = Step("posture", {"hips_height": 0.08})


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=3.0, fps=60.0).motion


def turned(before: Motion, after: Motion, joint: str) -> np.ndarray:
    """How far a joint is turned in each frame, degrees."""
    j = before.skeleton.names.index(joint)
    change = quat.multiply(quat.conjugate(before.rotations[:, j]), after.rotations[:, j])
    return np.degrees(np.linalg.norm(quat.log(change), axis=-1))


def test_a_curve_of_one_key_is_that_number(walk: Motion) -> None:
    one = apply(walk, [replace(HEAD, strength=((1.0, 0.4),))])
    other = apply(walk, [replace(HEAD, strength=0.4)])
    np.testing.assert_allclose(one.rotations, other.rotations, atol=1e-12)


def test_strength_and_the_parameter_it_scales_say_the_same(walk: Motion) -> None:
    by_strength = apply(walk, [replace(HEAD, strength=((0.5, 0.0), (2.0, 1.0)))])
    by_value = apply(walk, [Step("posture", {"head": [[0.5, 0.0], [2.0, 30.0]], "fade": False})])
    np.testing.assert_allclose(by_strength.rotations, by_value.rotations, atol=1e-12)


def test_frames_at_a_key_are_exactly_those_of_its_number(walk: Motion) -> None:
    curve = ((0.0, 0.3), (1.0, 1.0), (2.0, 0.0))
    after = apply(walk, [replace(HEAD, strength=curve)])
    for time, strength in curve:
        alone = apply(walk, [replace(HEAD, strength=strength)])
        frame = round(time * walk.fps)
        np.testing.assert_allclose(after.rotations[frame], alone.rotations[frame], atol=1e-12)


def test_in_between_it_is_the_edit_with_the_number_of_the_moment(walk: Motion) -> None:
    """Between the renderings poses are blended: half to one and a half of the path is met within 2 degrees.

    That is in a toe that swings through 60; the renderings themselves are up to 20 degrees apart.
    """
    after = apply(walk, [Step("path_length", {"mid": [[0.0, 0.5], [3.0, 1.5]]})])
    for frame in range(0, len(walk), 15):
        u = frame / 180
        mid = 0.5 + 3 * u**2 - 2 * u**3
        alone = apply(walk, [Step("path_length", {"mid": mid})])
        dot = np.abs(np.einsum("ji,ji->j", after.rotations[frame], alone.rotations[frame]))
        assert np.degrees(2 * np.arccos(np.minimum(dot, 1.0))).max() < 2.0


def test_the_effect_starts_and_ends_without_a_pop(walk: Motion) -> None:
    """A still body: all movement comes from the curve, a smoothstep of a second up and down."""
    still = walk.with_(
        rotations=np.repeat(walk.rotations[:1], len(walk), axis=0),
        translations=np.repeat(walk.translations[:1], len(walk), axis=0),
    )
    after = apply(still, [replace(TALL, strength=((0.5, 0.0), (1.5, 1.0), (2.5, 0.0)))])
    height = world(after)[1][:, 0, 1]
    rise = height.max() - height.min()
    speed = np.diff(height) * walk.fps
    assert np.abs(speed).max() == pytest.approx(1.5 * rise, rel=0.01)  # smoothstep of one second
    assert np.abs(np.diff(speed)).max() * walk.fps < 6.2 * rise  # and its acceleration, 6 / s^2
    assert (height[:31] == height[0]).all()
    assert (height[150:] == height[0]).all()


def test_two_numbers_may_change_apart(walk: Motion) -> None:
    step = Step(
        "posture", {"head": ((0.0, 0.0), (1.0, 20.0)), "trunk": ((1.0, 0.0), (2.0, 10.0)), "fade": False}
    )
    after = apply(walk, [step])
    end = apply(walk, [Step("posture", {"head": 20.0, "trunk": 10.0, "fade": False})])
    middle = apply(walk, [Step("posture", {"head": 20.0, "fade": False})])
    np.testing.assert_allclose(after.rotations[60], middle.rotations[60], atol=1e-12)
    np.testing.assert_allclose(after.rotations[120:], end.rotations[120:], atol=1e-12)


def test_many_keys_are_met_by_few_renderings(walk: Motion) -> None:
    """Forty keys are more than the levels that are rendered; the head still follows the curve."""
    times = np.linspace(0.0, 3.0, 41)
    curve = tuple(zip(times.tolist(), (0.5 - 0.5 * np.cos(2 * np.pi * times)).tolist(), strict=True))
    after = apply(walk, [replace(HEAD, strength=curve)])
    full = turned(walk, apply(walk, [HEAD]), "Head")
    wanted = 0.5 - 0.5 * np.cos(2 * np.pi * walk.times)
    assert np.abs(turned(walk, after, "Head") - full * wanted).max() < 0.5


def test_curves_follow_parts_and_spans(walk: Motion) -> None:
    step = replace(HEAD, strength=((0.0, 1.0), (3.0, 0.0)), span=(1.0, 2.0), parts=("head",))
    after = apply(walk, [step])
    change = turned(walk, after, "Head")
    assert change[:60].max() < 1e-12
    assert change[121:].max() < 1e-12
    assert change[80:100].min() > 3.0
    np.testing.assert_array_equal(after.rotations[:, :2], walk.rotations[:, :2])


def test_history_holds_the_curve_and_replays(walk: Motion) -> None:
    steps = [
        replace(HEAD, strength=((0.0, 0.0), (1.5, 1.0))),
        Step("foot_plant", {"blend": ((0, 0.1), (3, 0.4))}),
    ]
    after = apply(walk, steps, strength=((0.0, 1.0), (3.0, 0.5)))
    again = apply(walk, after.history)
    assert after.rotations.tobytes() == again.rotations.tobytes()
    assert [t for t, _ in after.history[0].strength] == [0.0, 1.5, 3.0]


def test_a_clip_rate_may_change_over_time_where_the_edit_can(walk: Motion) -> None:
    """Travel is taken out of the second half only: before it goes on as it was, then the body stays."""
    after = apply(walk, [Step("in_place", {"amount": ((1.4, 0.0), (1.6, 1.0))})])
    x, was = (world(m)[1][:, 0, 2] for m in (after, walk))
    np.testing.assert_allclose(x[:80], was[:80], atol=1e-9)
    assert np.ptp(x[100:]) < 0.1 * np.ptp(was[100:])


@pytest.mark.parametrize(
    ("step", "message"),
    [
        (Step("resample", {"fps": [[0, 30], [1, 60]]}), "resample: fps cannot change over time"),
        (
            Step("posture", {"head": [[0, 0], [1, 99]]}),
            "posture: head must be from -60 to 60 degrees, got 99",
        ),
        (Step("posture", {"head": [[0, 0], [0, 9]]}), "posture: head: the times of its keys must go up"),
        (Step("posture", {"head": "20"}), "posture: head must be a number"),
        (Step("posture", strength=((0, 1), (1, 2.5))), "posture: strength must be from 0 to 2, got 2.5"),
    ],
)
def test_what_cannot_be_is_said(step: Step, message: str) -> None:
    with pytest.raises(RecipeError, match=message):
        check(step)


def test_too_many_keys_at_once_are_refused(walk: Motion) -> None:
    wild = [[t / 10, t % 7] for t in range(20)]
    with pytest.raises(RecipeError, match="head, trunk, arms change over time with too many keys at once"):
        apply(walk, [Step("posture", dict.fromkeys(("head", "trunk", "arms"), wild))])
