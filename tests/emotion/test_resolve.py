from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mien
from mien import samples
from mien.emotion.files import format_recipe, parse_recipe, write_recipe
from mien.emotion.resolve import resolve
from mien.errors import RecipeError
from mien.recipe import Recipe, Step

STEPS = [Step("posture", {"head": 20.0})]


@pytest.fixture(scope="module")
def walk() -> mien.Motion:
    return samples.walk(seconds=1.0, fps=30.0).motion


def same(a: mien.Motion, b: mien.Motion) -> bool:
    return np.array_equal(a.rotations, b.rotations) and np.array_equal(a.translations, b.translations)


def test_a_word_a_recipe_steps_and_a_file_mean_the_same(walk: mien.Motion, tmp_path: Path) -> None:
    recipe = mien.preset("sad")
    write_recipe(recipe, tmp_path / "sad.toml")
    wanted = mien.apply(walk, recipe, strength=0.8, parts=("arms",), span=(0.2, 0.8))
    for what in ("sad", recipe, list(recipe.steps), tmp_path / "sad.toml", str(tmp_path / "sad.toml")):
        made = mien.edit(walk, what, strength=0.8, parts=("arms",), span=(0.2, 0.8))
        assert same(made, wanted)
        assert made.history == wanted.history


def test_one_part_may_be_given_as_a_word(walk: mien.Motion) -> None:
    assert same(mien.edit(walk, STEPS, parts="head"), mien.edit(walk, STEPS, parts=("head",)))


def test_words_that_are_not_known() -> None:
    with pytest.raises(RecipeError, match=r"no emotion 'sda'; did you mean 'sad'.*recipe file"):
        resolve("sda")
    with pytest.raises(RecipeError, match=r"^sda\.toml: there is no such file"):
        resolve("sda.toml")
    with pytest.raises(RecipeError, match=r"^sad: there is no such file"):
        resolve(Path("sad"))


def test_what_is_not_a_recipe_at_all_is_refused() -> None:
    for wrong in (3, None, ["sad"], [3], ("posture", {"head": 20.0}), [("posture", {})], {"head": 20.0}):
        with pytest.raises(RecipeError, match=r"emotion word.*mien\.Step\("):
            resolve(wrong)  # type: ignore[arg-type]


def test_a_recipe_is_taken_as_it_is() -> None:
    recipe = Recipe("mine", ())
    assert resolve(recipe) is recipe
    assert resolve(STEPS).steps == tuple(STEPS)


@pytest.mark.parametrize("word", ["Sad", "SAD", " sad ", "S0/Sad"])
def test_case_does_not_matter(word: str) -> None:
    assert resolve(word) == mien.preset(word.strip().lower())


def test_one_step_is_enough(walk: mien.Motion) -> None:
    wanted = mien.apply(walk, STEPS)
    assert same(mien.apply(walk, STEPS[0]), wanted)
    assert same(mien.edit(walk, STEPS[0]), wanted)


def test_parts_and_span_are_taken_as_on_the_command_line(walk: mien.Motion) -> None:
    wanted = mien.edit(walk, "sad", parts=("arms", "head"), span=(0.2, 0.8))
    assert same(mien.edit(walk, "sad", parts="arms, head", span="0.2,0.8"), wanted)
    assert same(mien.apply(walk, mien.preset("sad"), parts="arms,head", span=[0.2, 0.8]), wanted)


def test_strength_over_time_is_taken_in_three_forms(walk: mien.Motion) -> None:
    curve = ((0.0, 1.0), (0.8, 0.0))
    wanted = mien.edit(walk, "sad", strength=curve)
    assert same(mien.edit(walk, "sad", strength="0:1,0.8:0"), wanted)
    assert same(mien.apply(walk, mien.preset("sad"), strength=[[0, 1], [0.8, 0]]), wanted)
    assert wanted.history[0].strength == curve


def test_sad_to_happy_is_one_recipe() -> None:
    walk = samples.walk(seconds=3.0, fps=30.0).motion
    poses = {name: [s for s in mien.preset(name).steps if s.edit == "posture"] for name in ("sad", "happy")}
    out, into = ((0.5, 1.0), (2.5, 0.0)), ((0.5, 0.0), (2.5, 1.0))
    steps = [replace(s, strength=out) for s in poses["sad"]]
    both = mien.apply(walk, [*steps, *(replace(s, strength=into) for s in poses["happy"])])
    for name, frames in (("sad", slice(0, 16)), ("happy", slice(75, None))):
        alone = mien.apply(walk, poses[name])
        assert np.abs(both.rotations[frames] - alone.rotations[frames]).max() < 1e-12
    parse = parse_recipe(format_recipe(Recipe("change", both.history)))
    assert same(mien.apply(walk, parse), both)


def test_without_the_feet_put_back(walk: mien.Motion) -> None:
    steps = mien.preset("sad").steps
    wanted = mien.apply(walk, [step for step in steps if step.edit != "foot_plant"])
    assert same(mien.edit(walk, "sad", foot_plant=False, safe=False), wanted)
    assert [step.edit for step in mien.edit(walk, "sad", safe=False).history] == [step.edit for step in steps]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"span": 3}, "two times in seconds, .* got 3"),
        ({"span": (0.1, 0.2, 0.3)}, "two times"),
        ({"span": ("a", "b")}, "two times"),
        ({"span": "now"}, "two times"),
        ({"span": (0.8, 0.2)}, "must end after it starts"),
        ({"parts": "hed"}, "no body part or role 'hed'; did you mean 'head'"),
        ({"parts": 3}, "parts must be names"),
        ({"parts": (1, 2)}, "parts must be names"),
        ({"strength": "much"}, "strength must be a number, or times .* got 'much'"),
        ({"strength": [(0, 1), (0, 2)]}, "the times of its keys must go up"),
        ({"strength": [(0, 1), (1, 3)]}, "strength must be from 0 to 2, got 3"),
        ({"strength": True}, "strength must be a number"),
        ({"strength": float("nan")}, "strength must be from 0 to 2"),
    ],
)
def test_limits_that_do_not_fit_are_told_in_a_sentence(
    walk: mien.Motion, options: dict[str, object], message: str
) -> None:
    for change in (mien.edit, mien.apply):
        with pytest.raises(RecipeError, match=message):
            change(walk, STEPS, **options)


@pytest.mark.parametrize("wrong", ["walk.bvh", Path("walk.bvh")])
def test_a_path_is_no_motion(wrong: object) -> None:
    for change in (mien.edit, mien.apply):
        with pytest.raises(mien.MienError, match=r"give a Motion.*mien\.load\('walk\.bvh'\)"):
            change(wrong, STEPS)


def test_what_is_no_motion_is_told_so() -> None:
    with pytest.raises(mien.MienError, match=r"mien\.load.*not Sample\(Motion"):
        mien.edit(samples.still(seconds=0.5), STEPS)
