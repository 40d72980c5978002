"""A recipe as text that a person can read, write and send to somebody: TOML or JSON.

::

    version = 1
    name = "sad"
    description = "shorter paths, head down"
    evidence = "works"

    [sources]
    head = "where the number comes from"

    [[steps]]
    edit = "path_length"
    mid = 0.6
    parts = ["arms"]
    span = [0.5, 2.0]
    strength = [[0.5, 0.0], [1.0, 1.0]]

A step holds its parameters beside ``edit``, ``strength``, ``parts``, ``span`` and ``ease``. A number may be
a curve: a list of times in seconds, each with its value. ``emotion = "sad"`` in place of ``edit`` stands for
the steps of that emotion; a recipe with such steps is done in the usual order (``edits.order``).
"""

import json
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from typing import Any, Literal

from ..curve import Varying, read_varying
from ..edits import pipeline
from ..edits.order import merged
from ..edits.registry import EDITS
from ..errors import RecipeError, unknown
from ..kinematics.body import PARTS, ROLES
from ..recipe import VERSION, Recipe, Step

Kind = Literal["toml", "json"]
Words = Callable[[str], Recipe]
_STEP_KEYS = tuple(f.name for f in fields(Step) if f.name != "parameters")
_RECIPE_KEYS = tuple(f.name for f in fields(Recipe))


def parse(text: str, *, kind: Kind = "toml", where: str = "recipe", words: Words | None = None) -> Recipe:
    """Return the recipe written in ``text``.

    ``where`` names its place in error messages, ``words`` returns the recipe of an emotion that a step may
    name; without it steps name edits only. Raises ``RecipeError`` naming the step and what does not fit.
    """
    table = decode(text, kind, where)
    version = table.get("version")
    if version is None and "turns" in table:
        raise RecipeError(f"{where}: is a pose file, not a recipe; give it with --posture-pose")
    if version is None and "keys" in table:
        raise RecipeError(f"{where}: is a file of keys, not a recipe; give it with --displacement-keys")
    if version is None:
        raise RecipeError(f"{where}: has no version; add the line: version = {VERSION}")
    if version != VERSION or isinstance(version, bool):
        raise RecipeError(
            f"{where}: version is {version!r}, but this mien reads recipes of version {VERSION}"
        )
    _known_keys(where, "recipe key", table, (*_RECIPE_KEYS, "provenance"))
    sources = require(where, "sources", table.get("sources", {}), dict)
    for key, source in sources.items():
        require(where, f"sources.{key}", source, str)
    return Recipe(
        name=require(where, "name", table.get("name"), str),
        steps=_steps(where, require(where, "steps", table.get("steps", []), list), words),
        description=require(where, "description", table.get("description", ""), str),
        evidence=require(where, "evidence", table.get("evidence", ""), str),
        sources=sources,
        safe=require(where, "safe", table.get("safe", False), bool),
    )


def format_recipe(recipe: Recipe, *, kind: Kind = "toml", provenance: Mapping[str, Any] | None = None) -> str:
    """Return the text that ``parse`` reads back to an equal recipe.

    ``provenance`` is a table about the clip that the recipe made, written beside the recipe.
    """
    head: dict[str, Any] = {"version": recipe.version, "name": recipe.name}
    for key in ("description", "evidence"):
        if getattr(recipe, key):
            head[key] = getattr(recipe, key)
    head |= {"safe": True} if recipe.safe else {}
    tables = {"sources": dict(recipe.sources), "provenance": dict(provenance or {})}
    head |= {name: table for name, table in tables.items() if table}
    steps = [_plain_step(step) for step in recipe.steps]
    if kind == "json":
        return json.dumps(head | {"steps": steps}, indent=2, ensure_ascii=False) + "\n"
    import tomli_w

    tables_of_steps = [f"[[steps]]\n{tomli_w.dumps(step)}" for step in steps]
    return "\n".join([tomli_w.dumps(head), *tables_of_steps])


def decode(text: str, kind: Kind, where: str) -> dict[str, Any]:
    """Return the table written in TOML or JSON; raises ``RecipeError`` where it is neither."""
    try:
        table = json.loads(text) if kind == "json" else tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise RecipeError(f"{where}: is not valid {kind.upper()}: {error}") from None
    return require(where, "a recipe", table, dict)


def _steps(where: str, tables: list[Any], words: Words | None) -> tuple[Step, ...]:
    """Return the checked steps; where emotions are among them, all in the usual order."""
    found = []
    for number, table in enumerate(tables, start=1):
        place = f"{where} step {number}"
        if words is not None and isinstance(table, dict) and "emotion" in table:
            found.append(_emotion(place, table, words))
        else:
            found.append((_step(place, table),))
    steps = tuple(step for some in found for step in some)
    return steps if len(steps) == len(tables) else merged(found)


def _emotion(where: str, table: dict[str, Any], words: Words) -> tuple[Step, ...]:
    """Return the steps of the emotion that a table names, as strong, where and when it says."""
    own = {key: value for key, value in table.items() if key != "emotion"}
    _known_keys(where, "key beside emotion", own, _STEP_KEYS[1:])
    about = _step(where, {"edit": "posture"} | own)
    try:
        recipe = words(require(where, "emotion", table["emotion"], str))
    except RecipeError as error:
        raise RecipeError(f"{where}: {error}") from None
    steps = pipeline.plan(recipe, strength=about.strength, parts=about.parts, span=about.span)
    return tuple(replace(step, ease=about.ease) if step.span else step for step in steps)


def _step(where: str, table: Any) -> Step:
    """Return the checked step of one ``[[steps]]`` table, with the parameters that it gives."""
    table = require(where, "a step", table, dict)
    name = table.get("edit")
    if name is None:
        raise RecipeError(f'{where}: names no edit; add a line such as: edit = "posture"')
    name = require(where, "edit", name, str)
    if name in EDITS:
        _known_keys(f"{where}: {name}", "parameter", table, (*EDITS[name].parameters, *_STEP_KEYS))
    step = Step(
        edit=name,
        parameters={key: value for key, value in table.items() if key not in _STEP_KEYS},
        strength=_strength(where, table.get("strength", 1.0)),
        parts=tuple(_part(where, part) for part in require(where, "parts", table.get("parts", []), list)),
        span=_span(where, table.get("span")),
        ease=_number(where, "ease", table.get("ease", Step.ease)),
    )
    try:
        checked = pipeline.check(step)
    except (RecipeError, OverflowError) as error:
        raise RecipeError(f"{where}: {error}") from None
    return replace(step, parameters={key: checked.parameters[key] for key in step.parameters})


def _plain_step(step: Step) -> dict[str, Any]:
    """Return a step as a flat table, leaving out what stands at its default."""
    usual = Step(step.edit)
    table: dict[str, Any] = {"edit": step.edit}
    for key, value in step.parameters.items():
        if value is not None:  # a parameter that may be None has None as its default
            table[key] = _plain(value)
    for key in _STEP_KEYS[1:]:
        value = getattr(step, key)
        if value != getattr(usual, key):
            table[key] = _plain(value)
    return table


def _plain(value: Any) -> Any:
    """Return tuples, and tuples in tuples, as lists."""
    return [_plain(item) for item in value] if isinstance(value, tuple) else value


def _known_keys(where: str, kind: str, table: Mapping[str, Any], known: tuple[str, ...]) -> None:
    for key in table:
        if key not in known:
            raise RecipeError(f"{where}: {unknown(kind, key, known)}")


def require(where: str, what: str, value: Any, kind: type) -> Any:
    """Return ``value`` if it is of a kind: text, a list or a table; else raise ``RecipeError``."""
    if not isinstance(value, kind):
        names: dict[type, str] = {str: "text", list: "a list", dict: "a table of keys and values"}
        got = "nothing" if value is None else repr(value)
        raise RecipeError(f"{where}: {what} must be {names[kind]}, got {got:.80}")
    return value


def _number(where: str, what: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise RecipeError(f"{where}: {what} must be a number, got {value!r}")
    try:
        return float(value)
    except OverflowError:
        raise RecipeError(f"{where}: {what} is far too large") from None


def _strength(where: str, value: Any) -> Varying:
    if not isinstance(value, list):
        return _number(where, "strength", value)
    try:
        return read_varying("strength", value)
    except RecipeError as error:
        raise RecipeError(f"{where}: {error}") from None


def _part(where: str, part: Any) -> str:
    if part not in (*PARTS, *ROLES):
        raise RecipeError(f"{where}: {unknown('body part or role', part, [*PARTS, *ROLES])}")
    return str(part)


def _span(where: str, span: Any) -> tuple[float, float] | None:
    if span is None:
        return None
    if not isinstance(span, list) or len(span) != 2:
        raise RecipeError(f"{where}: span must be two times in seconds, [start, end], got {span!r}")
    start, end = (_number(where, "span", time) for time in span)
    return start, end
