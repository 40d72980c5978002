"""From the layers of the studio's stack to one recipe, which the command line replays to the same bytes."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ..curve import Varying, read_varying
from ..edits import pipeline
from ..edits.registry import EDITS
from ..emotion.circumplex import Point, words
from ..emotion.presets import preset
from ..emotion.toward import aim
from ..errors import RecipeError
from ..motion import Motion
from ..recipe import Recipe, Step
from .messages import Layer, Place, Stack, Strength

NAME = "studio"


def active(stack: Stack) -> list[Layer]:
    """Return the layers that are done: those that are on, or of them only the solo ones."""
    on = [layer for layer in stack.layers if layer.on]
    return [layer for layer in on if layer.solo] or on


def recipe_of(stack: Stack, motion: Motion) -> Recipe:
    """Return the recipe of a stack for a motion, layer after layer, feet put back once at the end.

    Raises ``RecipeError`` for a layer that cannot be, ``BodyError`` where a place on the disc needs a body.
    """
    steps = [step for layer in active(stack) for step in steps_of(layer, motion)]
    strength = varying(stack.strength)
    planted = with_feet(steps) if stack.foot_plant else [s for s in steps if s.edit != "foot_plant"]
    return Recipe(NAME, tuple(pipeline.plan(planted, strength=strength)), safe=stack.safe)


def steps_of(layer: Layer, motion: Motion) -> list[Step]:
    """Return the steps of one layer, as strong, where and when it says."""
    span = _span(layer)
    if layer.kind == "edit":
        strength = varying(layer.strength)
        step = Step(layer.name, _parameters(layer), strength, tuple(layer.parts), span, layer.ease)
        return pipeline.plan([step])
    recipe = preset(layer.name) if layer.kind == "emotion" else _place_recipe(layer, motion)
    steps = pipeline.plan(recipe, strength=varying(layer.strength), parts=layer.parts, span=span)
    return [replace(step, ease=layer.ease) if step.span else step for step in steps]


def with_feet(steps: Sequence[Step]) -> list[Step]:
    """Return the steps with one ``foot_plant``, after the last that moves anything, if poses change."""
    own = [step for step in steps if step.edit == "foot_plant"]
    others = [step for step in steps if step.edit != "foot_plant"]
    if not own and not any(EDITS[step.edit].poses for step in others):
        return others
    moving = [i for i, step in enumerate(others) if EDITS[step.edit].kind != "repair"]
    after = moving[-1] + 1 if moving else 0
    return [*others[:after], own[-1] if own else pipeline.check(Step("foot_plant")), *others[after:]]


def varying(strength: Strength) -> Varying:
    """Return a number or a curve as recipes have it."""
    return read_varying("strength", strength)


def asked(stack: Stack) -> Place | None:
    """Return the place on the disc that a stack asks for: of its last layer that has one."""
    for layer in reversed(active(stack)):
        if layer.kind == "place":
            return place(_point(layer))
        if layer.kind == "emotion" and layer.name in words():
            return place(words()[layer.name])
    return None


def place(point: Point) -> Place:
    """Return a point of the disc with the word nearest to it."""
    from ..emotion.circumplex import nearest

    return Place(float(point.valence), float(point.arousal), nearest(*point)[0][0])


def _place_recipe(layer: Layer, motion: Motion) -> Recipe:
    return aim(to=_point(layer), method=layer.name).recipe(motion)


def _point(layer: Layer) -> Point:
    values = layer.parameters.get("valence"), layer.parameters.get("arousal")
    numbers = [value for value in values if isinstance(value, int | float) and not isinstance(value, bool)]
    if len(numbers) != 2:
        raise RecipeError(f"a place on the disc needs valence and arousal, got {values}")
    return Point(*map(float, numbers))


def _parameters(layer: Layer) -> dict[str, Any]:
    """Return the parameters that are given, whole numbers as such: JSON knows one kind of number."""
    if layer.name not in EDITS:
        return dict(layer.parameters)
    known = EDITS[layer.name].parameters
    return {
        name: int(value)
        if name in known and known[name].kind is int and isinstance(value, float) and value.is_integer()
        else value
        for name, value in layer.parameters.items()
    }


def _span(layer: Layer) -> tuple[float, float] | None:
    if layer.span is None:
        return None
    if len(layer.span) != 2:
        raise RecipeError(f"a span is two times in seconds, got {layer.span}")
    start, end = layer.span
    return float(start), float(end)
