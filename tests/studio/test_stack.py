"""A stack is a recipe: that of its preset, of its layers in order, of what is on."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits import pipeline
from mien.edits.registry import EDITS
from mien.emotion.presets import PRESETS, preset
from mien.errors import RecipeError
from mien.studio.messages import Layer, Stack
from mien.studio.stack import asked, recipe_of

MOTION = samples.walk(seconds=1.5).motion


def emotion(name: str, **more: object) -> Layer:
    return Layer(name, "emotion", name, **more)


@pytest.mark.parametrize("name", PRESETS)
def test_one_emotion_is_its_preset(name: str) -> None:
    recipe = recipe_of(Stack([emotion(name)]), MOTION)
    assert list(recipe.steps) == pipeline.plan(preset(name))
    assert recipe.safe


def test_an_empty_stack_and_one_that_is_off_do_nothing() -> None:
    assert recipe_of(Stack(), MOTION).steps == ()
    assert recipe_of(Stack([emotion("sad", on=False)]), MOTION).steps == ()
    assert recipe_of(Stack([emotion("sad")], strength=0.0), MOTION).steps == ()


def test_solo_layers_are_done_alone() -> None:
    both = Stack([emotion("sad"), emotion("angry", solo=True)])
    assert recipe_of(both, MOTION) == recipe_of(Stack([emotion("angry")]), MOTION)


def test_layers_are_done_in_their_order_and_feet_put_back_once_and_last() -> None:
    layers = [emotion("sad"), Layer("b", "edit", "posture", {"arms": 10.0}), emotion("happy")]
    steps = [step.edit for step in recipe_of(Stack(layers), MOTION).steps]
    own = [step.edit for name in ("sad", "happy") for step in preset(name).steps]
    assert steps.count("foot_plant") == 1
    last = max(i for i, name in enumerate(steps) if EDITS[name].kind != "repair")
    assert steps.index("foot_plant") > last
    assert sorted([*own, "posture"]) == sorted([*steps, "foot_plant"])
    assert "foot_plant" not in [s.edit for s in recipe_of(Stack(layers, foot_plant=False), MOTION).steps]


def test_a_layer_is_limited_as_edit_limits() -> None:
    layer = emotion("sad", strength=0.5, parts=["arms"], span=[0.2, 1.0], ease=0.1)
    steps = recipe_of(Stack([layer], foot_plant=True, safe=False), MOTION).steps
    want = mien.edit(MOTION, "sad", strength=0.5, parts="arms", span=(0.2, 1.0), safe=False)
    assert [(s.edit, s.strength, s.parts, s.span) for s in steps] == [
        (s.edit, s.strength, s.parts, s.span) for s in want.history
    ]
    assert {s.ease for s in steps if s.span} == {0.1}


def test_whole_numbers_and_curves_come_through_json() -> None:
    layer = Layer("n", "edit", "nervous", {"seed": 3.0}, strength=[[0.0, 0.0], [1.0, 1.5]])
    (step, *_) = recipe_of(Stack([layer]), MOTION).steps
    assert step.parameters["seed"] == 3
    assert isinstance(step.parameters["seed"], int)
    assert step.strength == ((0.0, 0.0), (1.0, 1.5))


def test_a_place_is_toward() -> None:
    layer = Layer("p", "place", "recipe", {"valence": 0.6, "arousal": -0.2})
    after = mien.edit(MOTION, recipe_of(Stack([layer], safe=False), MOTION))
    want = mien.toward(MOTION, to=(0.6, -0.2), safe=False)
    assert np.array_equal(after.rotations, want.rotations)
    assert asked(Stack([layer, emotion("feminine")])).valence == pytest.approx(0.6)
    assert asked(Stack([layer, emotion("sad")])).word == "sad"


@pytest.mark.parametrize(
    ("layer", "said"),
    [
        (emotion("sda"), "did you mean 'sad'"),
        (Layer("x", "edit", "postur"), "posture"),
        (Layer("x", "edit", "posture", {"head": 1e9}), "must be from"),
        (Layer("x", "place", "recipe", {"valence": 0.5}), "valence and arousal"),
        (Layer("x", "place", "magic", {"valence": 0.5, "arousal": 0.1}), "method"),
        (emotion("sad", strength=7.0), "from 0 to 2"),
        (emotion("sad", span=[1.0]), "two times"),
    ],
)
def test_what_cannot_be_is_refused_with_a_sentence(layer: Layer, said: str) -> None:
    with pytest.raises(RecipeError, match=said):
        recipe_of(Stack([layer]), MOTION)
