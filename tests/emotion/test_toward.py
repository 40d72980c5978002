"""To a place on the circumplex, and in the manner of an example: strength 0 is the clip, further is more."""

from dataclasses import replace

import pytest

import mien
from mien import samples
from mien.analysis.manner import Manner, difference
from mien.emotion.circumplex import point
from mien.emotion.presets import preset
from mien.emotion.toward import Like, aim
from mien.errors import RecipeError
from mien.motion import Motion
from mien.recipe import Step


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=4.0).motion


def same(one: Motion, other: Motion) -> bool:
    return one.rotations.tobytes() == other.rotations.tobytes() and (
        one.translations.tobytes() == other.translations.tobytes()
    )


def test_where_it_is_already_nothing_changes_to_the_last_bit(walk: Motion) -> None:
    assert same(mien.toward(walk, to=(0.0, 0.0)), walk)
    assert same(mien.toward(walk, by=(0.0, 0.0)), walk)
    assert same(mien.toward(walk, to="sad", start="sad"), walk)
    assert same(mien.toward(walk, to="sad", strength=0.0), walk)
    assert same(mien.like(walk, walk, neutral=walk), walk)


def test_a_word_that_is_a_preset_is_that_preset(walk: Motion) -> None:
    assert same(mien.toward(walk, to="tired", method="plain"), mien.edit(walk, "tired"))
    searched, written = aim(to="tired").recipe(walk), preset("tired")
    assert [step.edit for step in searched.steps] == [step.edit for step in written.steps]
    assert all(float(step.strength) >= 1.0 for step in searched.steps)  # type: ignore[arg-type]


def test_what_is_asked_is_what_is_read(walk: Motion) -> None:
    sad = mien.read(mien.toward(walk, to="sad"), neutral=walk).place
    assert sad.valence < -0.3
    excited = mien.read(mien.toward(walk, to=(0.7, 0.7), safe=False), neutral=walk).place
    assert excited.arousal > sad.arousal + 0.2


def test_stronger_is_further(walk: Motion) -> None:
    """The change of manner grows with the strength, in posture, size and speed alike."""
    rest = Manner.of(walk)
    changes = [
        difference(rest, Manner.of(mien.toward(walk, to="bored", strength=s, safe=False)))
        for s in (0.3, 0.6, 1.0)
    ]
    heads = [c.pose.turns["trunk"][0] for c in changes]
    assert heads == sorted(heads)
    assert heads[0] > 1.0
    rates = [c.rate for c in changes]
    assert rates == sorted(rates, reverse=True)
    assert rates[0] < 0.97


def test_an_aim_says_where_to() -> None:
    assert aim(to="sad").to == point("sad")
    assert aim(by=(0.3, 0.1), start="sad").to == pytest.approx((-0.348, -0.167))
    assert aim(by=(2.0, 0.0)).to == pytest.approx((1.0, 0.0))
    for wrong in (
        {"to": "hapy"},
        {"to": (1,)},
        {"to": (1, "x")},
        {},
        {"to": "sad", "by": (0, 1)},
        {"to": (9, 0)},
    ):
        with pytest.raises(RecipeError):
            aim(**wrong)  # type: ignore[arg-type]
    with pytest.raises(RecipeError, match="recipe"):
        aim(to="sad", method="recip")


def test_an_example_is_followed_whoever_gives_it(walk: Motion) -> None:
    """What is done to a wave is done to a walk: its posture, size and speed come out again."""
    wave = samples.wave().motion
    steps = [Step("posture", {"head": 25.0, "trunk": 12.0}), Step("tempo", {"rate": 0.85})]
    example = mien.apply(wave, steps)
    made = mien.like(walk, example, neutral=wave)
    change = difference(Manner.of(walk), Manner.of(made))
    turns = change.pose.turns
    assert turns["neck"][0] + turns["head"][0] == pytest.approx(25.0, abs=5.0)
    assert turns["trunk"][0] == pytest.approx(12.0, abs=4.0)
    assert change.rate == pytest.approx(0.85, abs=0.06)
    assert mien.check(made).passed


def test_without_a_neutral_clip_the_example_is_compared_with_the_clip_itself(walk: Motion) -> None:
    slumped = mien.apply(walk, [Step("posture", {"trunk": 15.0})])
    recipe = Like(slumped).recipe(walk)
    made = mien.edit(walk, recipe, safe=False)
    left = difference(Manner.of(made), Manner.of(slumped))
    assert abs(left.pose.turns["trunk"][0]) < 2.0


def test_its_history_replays(walk: Motion) -> None:
    made = mien.toward(walk, by=(-0.4, -0.3))
    assert same(mien.apply(walk, made.history), made)


def test_the_unit_of_an_example_does_not_matter(walk: Motion) -> None:
    """Same joints, other unit: nothing differs but what was done, and so nothing else is done."""
    bent = mien.apply(walk, [Step("posture", {"trunk": 15.0})])
    skeleton = replace(bent.skeleton, offsets=0.0254 * bent.skeleton.offsets)
    inches = Motion(skeleton, bent.rotations, 0.0254 * bent.translations, bent.frame_time)
    one, other = (Like(example, walk).recipe(walk) for example in (bent, inches))
    assert [step.edit for step in one.steps][:1] == ["posture"]
    for first, second in zip(one.steps, other.steps, strict=True):
        assert first.edit == second.edit
        for key in ("hips_height", "hips_forward", "arms"):
            ours, theirs = (float(s.parameters.get(key, 0.0)) for s in (first, second))
            assert ours == pytest.approx(theirs, abs=0.01)


def test_a_bow_on_the_clips_own_skeleton_is_seen_without_a_neutral_clip(walk: Motion) -> None:
    bowed = mien.apply(walk, [Step("posture", {"trunk": 25.0, "head": 20.0})])
    alone = Motion(bowed.skeleton, bowed.rotations, bowed.translations, bowed.frame_time)
    made = mien.edit(walk, Like(alone).recipe(walk), safe=False)
    change = difference(Manner.of(walk), Manner.of(made))
    assert change.pose.turns["trunk"][0] == pytest.approx(25.0, abs=5.0)
