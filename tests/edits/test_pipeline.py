"""Steps and recipes: strength, body parts, spans, the reference of repairs, and replay to the same bytes."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Annotated

import numpy as np
import pytest

from mien import samples
from mien.edits.pipeline import apply, check, plan
from mien.edits.registry import EDITS, Param, edit
from mien.errors import RecipeError
from mien.motion import Motion, Skeleton
from mien.recipe import Recipe, Step
from mien.rotations import quaternion as quat

SEEN: list[Motion | None] = []


@pytest.fixture(autouse=True)
def edits() -> Iterator[None]:
    """Three small edits with a result known by hand; gone afterwards."""
    before = dict(EDITS)
    SEEN.clear()

    @edit(paper="none")
    def shift(motion: Motion, *, by: Annotated[float, Param("Along x", -9, 9, neutral=0)] = 1.0) -> Motion:
        """Move along x and turn about x by as many radians."""
        turned = quat.multiply(motion.rotations, quat.exp(np.array([by, 0.0, 0.0])))
        return motion.with_(rotations=turned, translations=motion.translations + [by, 0.0, 0.0])

    @edit(kind="time", paper="none")
    def cut(motion: Motion, *, start: Annotated[int, Param("First frame", low=0)] = 1) -> Motion:
        """Drop the first frames."""
        return motion[start:]

    @edit(kind="repair", paper="none")
    def look(motion: Motion, *, original: Motion | None = None) -> Motion:
        """Remember what it was given; take the original's height."""
        SEEN.append(original)
        height = (motion if original is None else original).translations[..., 1]
        moved = np.array(motion.translations)
        moved[..., 1] = height
        return motion.with_(translations=moved)

    yield
    EDITS.clear()
    EDITS.update(before)


@pytest.fixture
def clip() -> Motion:
    """Two joints, 11 frames of 0.1 s; y of a translation is the frame's own number."""
    rotations = quat.exp(np.random.default_rng(0).normal(size=(11, 2, 3)))
    translations = np.zeros((11, 2, 3))
    translations[..., 1] = np.arange(11)[:, None]
    return Motion(Skeleton(("a", "b"), [-1, 0], np.zeros((2, 3))), rotations, translations, 0.1)


def same(a: Motion, b: Motion) -> bool:
    return (
        a.rotations.tobytes() == b.rotations.tobytes()
        and a.translations.tobytes() == b.translations.tobytes()
    )


@pytest.mark.parametrize(
    ("step", "message"),
    [
        (Step("shfit"), "there is no edit 'shfit'; did you mean 'shift'?"),
        (Step("shift", {"bye": 1}), "there is no parameter 'bye'; did you mean 'by'?"),
        (Step("shift", {"by": 10}), "shift: by must be from -9 to 9, got 10"),
        (Step("shift", strength=2.1), "shift: strength must be from 0 to 2, got 2.1"),
        (Step("shift", strength=-0.1), "strength must be from 0 to 2"),
        (Step("shift", strength=float("nan")), "strength must be from 0 to 2"),
        (Step("shift", ease=-1.0), "ease must be 0 seconds or more"),
        (Step("shift", span=(1.0, 1.0)), "a span must end after it starts"),
        (Step("shift", span=(float("nan"), 1.0)), "a span must end after it starts"),
    ],
)
def test_a_step_that_does_not_fit_is_refused_before_anything_is_done(
    clip: Motion, step: Step, message: str
) -> None:
    with pytest.raises(RecipeError, match=r".") as caught:
        apply(clip, [Step("look"), step])
    assert message in str(caught.value)
    assert SEEN == []


@pytest.mark.parametrize("strength", [-0.5, 2.5, float("nan")])
def test_a_strength_that_does_not_fit_is_refused(clip: Motion, strength: float) -> None:
    with pytest.raises(RecipeError, match="strength must be from 0 to 2"):
        apply(clip, [Step("shift")], strength=strength)


def test_check_fills_in_parameters() -> None:
    assert check(Step("shift")).parameters == {"by": 1.0}


def test_strength_zero_is_the_very_motion(clip: Motion) -> None:
    assert apply(clip, [Step("shift")], strength=0.0) is clip
    assert apply(clip, [Step("shift", strength=0.0)]) is clip


def test_a_recipe_and_its_steps_do_the_same(clip: Motion) -> None:
    steps = (Step("shift"), Step("cut"))
    assert same(apply(clip, Recipe("both", steps)), apply(clip, steps))


@pytest.mark.parametrize(
    ("own", "given", "by"), [(1.0, 1.0, 2.0), (0.5, 1.0, 1.0), (0.5, 0.5, 0.5), (2.0, 2.0, 4.0)]
)
def test_strengths_multiply_and_stop_at_two(clip: Motion, own: float, given: float, by: float) -> None:
    after = apply(clip, [Step("shift", {"by": 2.0}, strength=own)], strength=given)
    np.testing.assert_allclose(after.translations[..., 0], by, atol=1e-15)


def test_strength_does_not_reach_time_and_repair_steps(clip: Motion) -> None:
    after = apply(clip, [Step("cut", {"start": 4}), Step("look")], strength=0.5)
    assert len(after) == 7
    assert [s.strength for s in after.history] == [1.0, 1.0]


def test_history_says_what_was_done(clip: Motion) -> None:
    after = apply(clip, [Step("shift", strength=0.5), Step("cut")], strength=0.5)
    assert after.history == (Step("shift", {"by": 1.0}, strength=0.25), Step("cut", {"start": 1}))
    assert clip.history == ()


def test_a_span_grows_and_fades_without_a_jump_in_speed(clip: Motion) -> None:
    fine = clip.with_(
        rotations=np.repeat(clip.rotations[:1], 1001, axis=0),
        translations=np.zeros((1001, 2, 3)),
        frame_time=0.001,
    )
    after = apply(fine, [Step("shift", span=(0.2, 0.8), ease=0.2)])
    shown = after.translations[:, 0, 0]
    assert not shown[:201].any()
    assert not shown[800:].any()
    np.testing.assert_array_equal(shown[401:600], 1.0)
    assert shown[300] == pytest.approx(0.5, abs=1e-9)  # half way through the ease
    # Smootherstep over 0.2 s: speed at most 1.875 / 0.2 s, acceleration 5.774 / 0.2^2.
    assert np.abs(np.diff(shown)).max() / 0.001 == pytest.approx(1.875 / 0.2, rel=1e-3)
    assert np.abs(np.diff(shown, n=2)).max() / 0.001**2 == pytest.approx(5.7735 / 0.04, rel=1e-2)
    turned = np.linalg.norm(quat.log(quat.multiply(quat.conjugate(fine.rotations), after.rotations)), axis=-1)
    np.testing.assert_allclose(turned[:, 0], shown, atol=1e-9)


def test_outside_a_span_the_numbers_are_untouched(clip: Motion) -> None:
    smooth = clip.with_(rotations=quat.continuous(clip.rotations))
    after = apply(smooth, [Step("shift", {"by": 0.1}, span=(0.35, 0.65), ease=0.1)])
    for frame in (0, 1, 2, 3, 7, 8, 9, 10):
        assert after.translations[frame].tobytes() == smooth.translations[frame].tobytes()
        np.testing.assert_array_equal(np.abs(after.rotations[frame]), np.abs(smooth.rotations[frame]))
    assert after.translations[5, 0, 0] == 0.1


def test_a_span_without_ease_is_a_switch(clip: Motion) -> None:
    after = apply(clip, [Step("shift", span=(0.25, 0.55), ease=0.0)])
    np.testing.assert_array_equal(after.translations[:, 0, 0], [0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0])


def test_the_frames_on_the_borders_of_a_span_without_ease_are_inside(clip: Motion) -> None:
    """Times are sums of tenths: 3 * 0.1 and 6 * 0.1 are a last digit above 0.3 and 0.6."""
    after = apply(clip, [Step("shift", span=(0.3, 0.6), ease=0.0)])
    np.testing.assert_array_equal(after.translations[:, 0, 0], [0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0])


def test_an_ease_longer_than_half_the_span_is_cut_to_it(clip: Motion) -> None:
    after = apply(clip, [Step("shift", span=(0.2, 0.6), ease=9.0)])
    assert after.translations[4, 0, 0] == 1.0
    np.testing.assert_allclose(after.translations[3, 0, 0], after.translations[5, 0, 0], atol=1e-12)


def test_a_span_given_for_all_and_a_step_of_its_own_leave_what_lies_in_both(clip: Motion) -> None:
    steps = [Step("shift", span=(0.0, 0.7)), Step("shift"), Step("shift", span=(0.0, 0.3))]
    after = apply(clip, steps, span=(0.5, 1.0))
    assert [s.span for s in after.history] == [(0.5, 0.7), (0.5, 1.0)]


def test_a_repair_gets_the_motion_before_any_step(clip: Motion) -> None:
    apply(clip, [Step("shift"), Step("shift"), Step("look")])
    assert SEEN[0] is clip


def test_the_reference_goes_through_time_edits_too(clip: Motion) -> None:
    after = apply(
        clip,
        [Step("shift"), Step("cut", {"start": 3}), Step("look"), Step("cut", {"start": 2}), Step("look")],
    )
    first, second = SEEN
    np.testing.assert_array_equal(first.translations, clip.translations[3:])
    np.testing.assert_array_equal(second.translations, clip.translations[5:])
    np.testing.assert_array_equal(after.translations[:, 0, 1], np.arange(5, 11))


def test_history_replays_to_the_same_bytes(clip: Motion) -> None:
    steps = [
        Step("shift", {"by": 0.3}, strength=1.7),
        Step("cut", {"start": 2}),
        Step("shift", span=(0.1, 0.6)),
        Step("look"),
    ]
    after = apply(clip, steps, strength=0.9, span=(0.2, 0.5))
    again = apply(clip, after.history)
    assert same(after, again)
    assert again.history == after.history


def test_two_calls_replay_to_the_same_bytes(clip: Motion) -> None:
    """The second call's repair looks at the first call's result, and so must the replay."""

    @edit(paper="none")
    def lift(motion: Motion, *, by: Annotated[float, Param("Along y", neutral=0)] = 1.0) -> Motion:
        """Move up."""
        return motion.with_(translations=motion.translations + [0.0, by, 0.0])

    steps = [Step("lift"), Step("cut"), Step("look"), Step("lift")]
    after = apply(apply(clip, steps), [Step("lift"), Step("look")])
    assert same(after, apply(clip, after.history))


def test_input_is_untouched(clip: Motion) -> None:
    before = clip.rotations.tobytes(), clip.translations.tobytes()
    apply(clip, [Step("shift", span=(0.1, 0.6)), Step("cut"), Step("look")])
    assert (clip.rotations.tobytes(), clip.translations.tobytes()) == before


def test_a_whole_clip_step_equals_the_call(clip: Motion) -> None:
    after = apply(clip, [Step("shift", {"by": 0.7})])
    direct = EDITS["shift"].run(clip, by=0.7)
    assert same(after, direct)
    assert replace(after.history[0]) == Step("shift", {"by": 0.7})


@pytest.mark.parametrize("span", [(5.0, 6.0), (-2.0, -1.0), (0.5, 0.5)])
def test_a_span_that_holds_nothing_of_the_clip_is_refused(clip: Motion, span: tuple[float, float]) -> None:
    with pytest.raises(RecipeError, match="holds nothing of the clip"):
        apply(clip, [Step("shift")], span=span)


def test_a_plan_is_the_history_that_apply_leaves() -> None:
    walk = samples.walk(seconds=1.0, fps=30.0).motion
    steps = [
        Step("posture", {"head": 20.0}, strength=0.5, parts=("upper",), span=(0.0, 0.6)),
        Step("posture", {"trunk": 5.0}, parts=("legs",)),
        Step("path_length", {"mid": 0.5}, strength=0.0),
        Step("foot_plant"),
    ]
    limits = {"strength": 1.5, "parts": ("arms", "head"), "span": (0.2, 0.9)}
    planned = plan(steps, **limits)
    assert [step.edit for step in planned] == ["posture", "foot_plant"]
    assert (planned[0].strength, planned[0].span) == (0.75, (0.2, 0.6))
    assert tuple(planned) == apply(walk, steps, **limits).history
    assert plan(steps, strength=0.0) == []
