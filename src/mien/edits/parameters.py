"""What an edit's typed, keyword-only signature says of its parameters, and the check of their values."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import isfinite
from numbers import Real
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from ..curve import Varying, read_varying
from ..errors import RecipeError, unknown

# What the pipeline gives an edit that asks for it: no parameters, as no recipe holds them.
NOT_PARAMETERS = ("original", "joints", "only_time")


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
    """One parameter of an edit, read from its signature. ``kind``: float, int, bool, str or list.

    ``varies``: the edit itself takes one value a frame (T,) as well as one number.
    """

    name: str
    kind: type
    default: Any
    about: Param
    choices: tuple[str, ...] = ()
    optional: bool = False
    varies: bool = False

    @property
    def doc(self) -> str:
        """The one-line description."""
        return self.about.doc


def check_value(owner: str, parameter: Parameter, value: Any) -> Any:
    """Return ``value`` as the parameter's type, or raise ``RecipeError`` saying what would fit."""
    where = f"{owner}: {parameter.name}"
    if value is None and parameter.optional:
        return None
    if parameter.kind is bool:
        if not isinstance(value, bool):
            raise RecipeError(f"{where} must be true or false, got {value!r}")
        return value
    if parameter.kind is float and isinstance(value, list | tuple):
        return _curve(where, parameter, value)
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


def _curve(where: str, parameter: Parameter, value: Any) -> Varying:
    """Return a curve whose every value is in the parameter's range."""
    read = read_varying(where, value)
    if not isinstance(read, tuple):
        return _number(where, parameter, read)
    return tuple((time, _number(where, parameter, amount)) for time, amount in read)


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


def read_parameters(function: Callable[..., Any]) -> dict[str, Parameter]:
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
        found[name] = replace(_read(kind), name=name, default=p.default, about=about)
    return found


def _read(hint: Any) -> Parameter:
    """Return the plain type, the choices, whether None is allowed and whether it varies, of a type hint."""
    if isinstance(hint, UnionType) or get_origin(hint) is Union:
        kinds = [h for h in get_args(hint) if h is not type(None)]
        optional = len(kinds) < len(get_args(hint))
        return replace(_read(kinds[0]), optional=optional, varies=len(kinds) > 1)
    if get_origin(hint) is Literal:
        return Parameter("", str, None, Param(""), get_args(hint))
    if get_origin(hint) is tuple:
        return Parameter("", tuple, None, Param(""), _read(get_args(hint)[0]).choices)
    return Parameter("", hint, None, Param(""))
