"""As strong as the clip needs: weak changes grow until they show, clear ones stay, further stays more."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.manner import Manner, difference
from mien.emotion.presets import preset
from mien.emotion.search import CLEAR, MOST, amount_for, searched, stronger, times_for
from mien.emotion.toward import aim
from mien.motion import Motion
from mien.recipe import Recipe, Step

CLIPS = ("bandai1/dataset-1_bow_normal_001", "cmu_daz/05_01", "reactidle/007_genuine")


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=4.0).motion


def same(one: Motion, other: Motion) -> bool:
    return one.rotations.tobytes() == other.rotations.tobytes() and (
        one.translations.tobytes() == other.translations.tobytes()
    )


def bend(before: Motion, after: Motion) -> float:
    """Degrees by which the trunk is bent forward."""
    return difference(Manner.of(before), Manner.of(after)).pose.turns["trunk"][0]


def test_a_bow_of_known_size_is_made_as_clear_as_it_takes(walk: Motion) -> None:
    """Ten degrees of the trunk count one: asked for 35 and for a size of 5, it becomes 50."""
    bow = Recipe("bow", (Step("posture", {"trunk": 35.0}),))
    found = searched(walk, bow)
    assert bend(walk, mien.apply(walk, found)) == pytest.approx(10.0 * CLEAR, rel=0.1)
    assert bend(walk, mien.apply(walk, bow)) < 36.0


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_the_change_comes_nearer_to_a_clear_one_on_every_skeleton(skeleton: str) -> None:
    motion = samples.walk(seconds=3.0, fps=30.0, skeleton=skeleton).motion
    bow = Recipe("bow", (Step("posture", {"trunk": 36.0}),))
    before, after = (bend(motion, mien.apply(motion, r)) for r in (bow, searched(motion, bow)))
    assert abs(after - 50.0) < 0.4 * abs(before - 50.0)


@pytest.mark.parametrize("clip", CLIPS)
def test_real_clips_show_more_of_a_weak_preset_and_no_more_than_allowed(data: Path, clip: str) -> None:
    motion = mien.load(data / f"{clip}.bvh")[1:300]
    recipe = preset("masculine")
    found = searched(motion, recipe)
    assert 1.0 < found.steps[0].strength <= MOST
    small, large = (bend(motion, mien.apply(motion, r)) for r in (recipe, found))
    assert large > 1.15 * small > 0.0


def test_what_is_clear_already_comes_back_as_it_is(walk: Motion) -> None:
    bow = Recipe("bow", (Step("posture", {"trunk": 55.0}),))
    assert searched(walk, bow) is bow
    assert times_for(walk, bow) == 1.0
    empty = Recipe("nothing", ())
    assert searched(walk, empty) is empty


def test_a_change_that_does_not_grow_is_left_alone() -> None:
    """Nothing to see, or a stop that is reached: no strength would help."""
    assert amount_for(lambda c: 0.0, 5.0) == 1.0
    assert amount_for(lambda c: min(c, 1.0), 5.0) <= MOST
    assert amount_for(lambda c: 4.0 * c, 5.0) == pytest.approx(1.25)
    assert amount_for(lambda c: 2.0 * c**2, 5.0) == pytest.approx(np.sqrt(2.5), abs=0.05)
    assert amount_for(lambda c: c, 5.0) == MOST


def test_it_says_the_same_every_time_and_replays(walk: Motion) -> None:
    one, other = (aim(to="happy").recipe(walk) for _ in range(2))
    assert one == other
    made = mien.toward(walk, to="happy")
    assert same(mien.apply(walk, made.history), made)
    assert "times as strong" in one.description


def test_the_unit_and_the_skeletons_axes_do_not_matter() -> None:
    found = {
        times_for(samples.walk(seconds=3.0, fps=30.0, unit=unit, up=up).motion, preset("happy"))
        for unit, up in (("m", "y"), ("inch", "z"), ("cm", "y"))
    }
    assert max(found) - min(found) < 0.03


def test_repairs_and_curves_keep_their_shape() -> None:
    steps = (Step("posture", {"head": 10.0}, strength=((0.0, 0.0), (1.0, 1.0))), Step("foot_plant"))
    found = stronger(Recipe("r", steps), 1.5).steps
    assert found[0].strength == ((0.0, 0.0), (1.0, 1.5))
    assert found[1].strength == 1.0
    strongest = stronger(Recipe("r", (replace(steps[0], strength=1.9),)), 1.6)
    assert strongest.steps[0].strength == 2.0


def test_further_stays_more_and_none_is_the_clip_itself(walk: Motion) -> None:
    """The strength is found per direction, so what is asked grows with the distance from the centre."""
    rates = []
    for away in (0.2, 0.5, 0.8):
        recipe = aim(to=(-0.7 * away, -0.7 * away)).recipe(walk)
        step = next(s for s in recipe.steps if s.edit == "tempo")
        rates.append(1.0 + float(step.strength) * (step.parameters["rate"] - 1.0))  # type: ignore[arg-type]
    assert rates == sorted(rates, reverse=True)
    assert rates[0] < 1.0
    assert same(mien.toward(walk, to="happy", strength=0.0), walk)


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_clips_of_a_few_frames_have_an_answer(walk: Motion, frames: int) -> None:
    assert 1.0 <= times_for(walk[:frames], preset("sad")) <= MOST
