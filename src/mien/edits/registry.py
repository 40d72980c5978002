"""The one registry of edits: a typed, keyword-only signature makes flag, slider, check and docs."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import wraps
from math import inf, isfinite
from numbers import Real
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from ..errors import RecipeError, unknown
from ..kinematics.lead_in import lead_in, with_lead_in, without_lead_in
from ..motion import Motion
from ..recipe import Step

Kind = Literal["pose", "time", "repair"]
# What the pipeline gives an edit that asks for it: no parameters, as no recipe holds them.
NOT_PARAMETERS = ("original", "joints")


@dataclass(frozen=True)
class Param:
    """What a signature says of one parameter beside its type and default.

    ``neutral`` is the value that changes nothing: strength goes from there to the given value and
    beyond. Without it a parameter does not follow strength (a choice, a seed, a threshold).
    """

    doc: str
    low: float | None = None
    high: float | None = None
    unit: str = ""
    neutral: float | None = None


@dataclass(frozen=True)
class Parameter:
    """One parameter of an edit, read from its signature. ``kind``: float, int, bool, str or list."""

    name: str
    kind: type
    default: Any
    about: Param
    choices: tuple[str, ...] = ()
    optional: bool = False

    @property
    def doc(self) -> str:
        """The one-line description."""
        return self.about.doc


@dataclass(frozen=True)
class Edit:
    """A registered edit.

    ``kind`` says how it meets the rest of a recipe: a ``pose`` edit changes poses frame by frame and
    can be limited to parts and spans; a ``time`` edit changes frames or the whole clip, and is done to
    the reference too; a ``repair`` is given the reference and always sees the whole clip.
    """

    name: str
    run: Callable[..., Motion]
    kind: Kind
    summary: str
    paper: str
    equation: str
    deviations: str
    parameters: Mapping[str, Parameter]
    by_joint: bool

    def perform(
        self,
        motion: Motion,
        values: Mapping[str, Any],
        *,
        original: Motion | None = None,
        joints: Sequence[int] | None = None,
    ) -> Motion:
        """Run the edit with checked values, giving a repair the reference and carrying that along.

        ``joints`` are those that are asked for; an edit that goes joint by joint leaves out the others.
        A still at the start of the capture, such as a T-pose, is no movement: poses are edited without it.
        """
        reference = motion.reference or motion
        if self.kind == "repair":
            return self.run(motion, **values, original=original or reference).with_(reference=reference)
        if self.kind == "time":
            after = self.run(motion, **values)
            return after.with_(reference=after if reference is motion else self.run(reference, **values))
        still = lead_in(reference) if len(reference) == len(motion) else 0
        only = {"joints": joints} if self.by_joint else {}
        after = self.run(without_lead_in(motion, still), **values, **only)
        return with_lead_in(after, motion, still).with_(reference=reference)

    def complete(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """Return all parameters: those given, checked, and the defaults of the others."""
        for name in given:
            if name not in self.parameters:
                raise RecipeError(f"{self.name}: " + unknown("parameter", name, self.parameters))
        return {
            name: check_value(self.name, p, given[name]) if name in given else p.default
            for name, p in self.parameters.items()
        }

    def scaled(self, values: Mapping[str, Any], strength: float) -> dict[str, Any]:
        """Return ``values`` moved from neutral by ``strength``, within each parameter's range."""
        out = dict(values)
        for name, p in self.parameters.items():
            neutral = p.about.neutral
            if neutral is None or strength == 1.0 or not isinstance(values[name], int | float):
                continue
            value = neutral + strength * (values[name] - neutral)
            low = -inf if p.about.low is None else p.about.low
            high = inf if p.about.high is None else p.about.high
            out[name] = min(max(value, low), high)
        return out


EDITS: dict[str, Edit] = {}


def edit(*, kind: Kind = "pose", paper: str, equation: str = "", deviations: str = "") -> Callable[..., Any]:
    """Register ``function(motion, *, parameters) -> Motion`` under its name.

    The registered function checks its parameters and appends one step to the motion's history. A
    ``repair`` also takes ``original``, the motion to compare with (without it the motion before the first
    step of the history), which is not a parameter. Nor is ``joints`` of an edit that works joint by joint:
    the joints whose result is wanted (None: all).
    """

    def register(function: Callable[..., Motion]) -> Callable[..., Motion]:
        name = function.__name__
        known = _parameters(function)
        doc = inspect.getdoc(function) or ""
        by_joint = "joints" in inspect.signature(function).parameters
        summary = doc.split("\n")[0]
        found = Edit(name, function, kind, summary, paper, equation, deviations, known, by_joint)

        @wraps(function)
        def run(motion: Motion, **given: Any) -> Motion:
            original = given.pop("original", None) if kind == "repair" else None
            values = found.complete(given)
            after = found.perform(motion, values, original=original)
            return after.with_(history=(*motion.history, Step(name, values)))

        EDITS[name] = found
        return run

    return register


def check_value(owner: str, parameter: Parameter, value: Any) -> Any:
    """Return ``value`` as the parameter's type, or raise ``RecipeError`` saying what would fit."""
    where = f"{owner}: {parameter.name}"
    if value is None and parameter.optional:
        return None
    if parameter.kind is bool:
        if not isinstance(value, bool):
            raise RecipeError(f"{where} must be true or false, got {value!r}")
        return value
    if parameter.kind in (float, int):
        return _number(where, parameter, value)
    if parameter.kind is tuple:
        if not isinstance(value, str | list | tuple):
            raise RecipeError(f"{where} must be a list, got {value!r}")
        items = [value] if isinstance(value, str) else list(value)
        for item in items:
            if parameter.choices and item not in parameter.choices:
                raise RecipeError(f"{where}: " + unknown("choice", item, parameter.choices))
        return tuple(items)
    if not isinstance(value, str):
        raise RecipeError(f"{where} must be text, got {value!r}")
    if parameter.choices and value not in parameter.choices:
        raise RecipeError(f"{where}: " + unknown("choice", value, parameter.choices))
    return value


def _number(where: str, parameter: Parameter, value: Any) -> float | int:
    if isinstance(value, bool) or not isinstance(value, Real) or not isfinite(value):
        raise RecipeError(f"{where} must be a number, got {value!r}")
    number, about = float(value), parameter.about
    low, high, unit = about.low, about.high, f" {about.unit}".rstrip()
    if (low is not None and number < low) or (high is not None and number > high):
        bounds = f"at least {low:g}" if high is None else f"at most {high:g}"
        bounds = f"from {low:g} to {high:g}" if low is not None and high is not None else bounds
        raise RecipeError(f"{where} must be {bounds}{unit}, got {number:g}")
    if parameter.kind is int:
        if not number.is_integer():
            raise RecipeError(f"{where} must be a whole number, got {value!r}")
        return int(number)
    return number


def _parameters(function: Callable[..., Motion]) -> dict[str, Parameter]:
    """Read the keyword-only parameters of an edit from its signature."""
    hints = get_type_hints(function, include_extras=True)
    found = {}
    for name, p in list(inspect.signature(function).parameters.items())[1:]:
        if name in NOT_PARAMETERS:
            continue
        hint = hints[name]
        if p.kind is not p.KEYWORD_ONLY or p.default is p.empty or get_origin(hint) is not Annotated:
            raise TypeError(f"{function.__name__}: {name} must be keyword-only, with a default and a Param")
        kind, about = get_args(hint)[:2]
        plain, choices, optional = _plain(kind)
        found[name] = Parameter(name, plain, p.default, about, choices, optional)
    return found


def _plain(hint: Any) -> tuple[type, tuple[str, ...], bool]:
    """Return the plain type, the choices and whether None is allowed, of a type hint."""
    if isinstance(hint, UnionType) or get_origin(hint) is Union:
        inner = [h for h in get_args(hint) if h is not type(None)]
        return (*_plain(inner[0])[:2], True)
    if get_origin(hint) is Literal:
        return str, get_args(hint), False
    if get_origin(hint) is tuple:
        return tuple, _plain(get_args(hint)[0])[1], False
    return hint, (), False
