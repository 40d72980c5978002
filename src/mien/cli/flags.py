"""One flag for every parameter of every edit, made from the signatures, and the steps they mean."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any

import typer

from ..curve import read_varying, shown
from ..edits.order import insert, rank
from ..edits.registry import EDITS, Edit, Param, Parameter
from ..recipe import Step
from .signature import with_parameters

_JOIN = "__"  # between edit and parameter in the name that a flag has inside


def flag_name(edit: str, parameter: str = "") -> str:
    """Return the flag of an edit (``--in-place``) or of its parameter (``--posture-head``)."""
    return "--" + f"{edit}_{parameter}".strip("_").replace("_", "-")


def with_flags(function: Callable[..., None], *, edits: Sequence[str] = ()) -> Callable[..., None]:
    """Return ``function`` with a flag for every edit and parameter, or those of ``edits``; as ``flags``.

    ``flags`` is a mapping edit -> parameter -> value that holds what was given, and nothing else.
    """
    return with_parameters(
        function,
        [p for edit in _ordered() if not edits or edit.name in edits for p in _options(edit)],
        _given,
    )


def compose(
    steps: tuple[Step, ...], flags: Mapping[str, Mapping[str, Any]], *, foot_plant: bool | None
) -> tuple[Step, ...]:
    """Return the steps of a recipe with those that flags mean.

    A flag of an edit that the recipe has changes every step of that edit in it; any other adds a step, at
    its place in ``edits.order``. ``foot_plant`` True puts the feet back after the poses are edited,
    False leaves no repair of the feet, None leaves the recipe as it is.
    """
    made = list(steps)
    for name in sorted(flags, key=rank):
        there = [i for i, step in enumerate(made) if step.edit == name]
        for i in there:
            made[i] = replace(made[i], parameters={**made[i].parameters, **flags[name]})
        if not there:
            insert(made, Step(name, dict(flags[name])))
    if foot_plant is False:
        return tuple(step for step in made if step.edit != "foot_plant")
    names = {step.edit for step in made}
    if foot_plant and "foot_plant" not in names and any(EDITS[name].poses for name in names):
        insert(made, Step("foot_plant"))
    return tuple(made)


def _ordered() -> list[Edit]:
    return sorted(EDITS.values(), key=lambda edit: (rank(edit.name), edit.name))


def _options(edit: Edit) -> list[inspect.Parameter]:
    """Return the flags of one edit; an edit that does something as it is also gets a flag of its own."""
    found = [_option(edit, p) for p in edit.parameters.values()]
    if not _works_as_it_is(edit):
        return found
    about = typer.Option(
        flag_name(edit.name), help="do this", rich_help_panel=_panel(edit), show_default=False
    )
    return [_keyword(edit.name, "", bool | None, about), *found]


def _works_as_it_is(edit: Edit) -> bool:
    """Return whether the edit does something with its defaults: nothing to set, or none is neutral.

    One that takes free text does nothing without it.
    """
    known = edit.parameters.values()
    scaled = [p for p in known if p.about.neutral is not None]
    free_text = any(p.kind is str and not p.choices for p in known)
    nothing_to_set = bool(scaled) and all(p.default != p.about.neutral for p in scaled)
    return (nothing_to_set and not free_text) or not known


def _option(edit: Edit, parameter: Parameter) -> inspect.Parameter:
    flag = flag_name(edit.name, parameter.name)
    if parameter.kind is bool:
        flag = f"{flag}/{flag_name('no_' + edit.name, parameter.name)}"
    kind = parameter.kind if parameter.kind in (int, bool) else str
    metavar = "NUMBER" if parameter.kind is float else "|".join(parameter.choices) or None
    about = typer.Option(
        flag, help=describe(parameter), rich_help_panel=_panel(edit), show_default=False, metavar=metavar
    )
    return _keyword(edit.name, parameter.name, kind | None, about)


def describe(parameter: Parameter) -> str:
    """Return what a parameter does, its range, unit and default, in one line."""
    about, default = parameter.about, parameter.default
    usual = shown(default) if type(default) in (int, float) else str(default).lower()
    usual = ",".join(default) if isinstance(default, tuple) else usual
    facts = [f"{_limits(about)} {about.unit}".strip(), f"default {usual or 'none'}"]
    return f"{_plain(about.doc)} ({'; '.join(fact for fact in facts if fact)})"


def _limits(about: Param) -> str:
    low = "" if about.low is None else f"{about.low:g}"
    high = "" if about.high is None else f"{about.high:g}"
    if low and high:
        return f"{low} to {high}"
    return f"at least {low}" if low else f"at most {high}" if high else ""


def _panel(edit: Edit) -> str:
    return f"{edit.name}: {_plain(edit.summary)}"


def _plain(text: str) -> str:
    return text.replace("``", "")


def _keyword(edit: str, parameter: str, kind: Any, about: Any) -> inspect.Parameter:
    name, annotation = f"{edit}{_JOIN}{parameter}", Annotated[kind, about]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation)


def _given(values: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the flags that were given, by edit; an edit's own flag gives it no parameter."""
    found: dict[str, dict[str, Any]] = {}
    for key, value in values.items():
        name, parameter = key.split(_JOIN)
        if value is None or (not parameter and value is False):
            continue
        parameters = found.setdefault(name, {})
        if parameter:
            flag = flag_name(name, parameter)
            parameters[parameter] = _value(flag, EDITS[name].parameters[parameter], value)
    return found


def _value(flag: str, parameter: Parameter, value: Any) -> Any:
    if parameter.kind is float:
        return read_varying(flag, value)
    if parameter.kind is tuple:
        return tuple(item.strip() for item in value.split(",") if item.strip())
    return _from_file(parameter, value) if str(value).endswith(".toml") else value


def _from_file(parameter: Parameter, path: str) -> str:
    """Return what a recipe holds in place of a file: the pose, or the keys, themselves."""
    if parameter.name == "pose":
        from ..kinematics.poses import read_pose

        return str(read_pose(path))
    if parameter.name == "keys":
        from ..kinematics.keyed_poses import format_keys, read_keys

        return format_keys(read_keys(path))
    return path
