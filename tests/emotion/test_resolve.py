from pathlib import Path

import numpy as np
import pytest

import mien
from mien import samples
from mien.emotion.files import write_recipe
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
    with pytest.raises(RecipeError, match="cannot be read"):
        resolve("sda.toml")
    with pytest.raises(RecipeError, match="cannot be read"):
        resolve(Path("sad"))


def test_what_is_not_a_recipe_at_all_is_refused() -> None:
    for wrong in (3, None, ["sad"], [3]):
        with pytest.raises(RecipeError, match="emotion word"):
            resolve(wrong)  # type: ignore[arg-type]


def test_a_recipe_is_taken_as_it_is() -> None:
    recipe = Recipe("mine", ())
    assert resolve(recipe) is recipe
    assert resolve(STEPS).steps == tuple(STEPS)
