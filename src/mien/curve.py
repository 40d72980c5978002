"""Numbers that change over time: curves through keys of ``(seconds, value)``.

A curve is plain data, as steps and recipes hold it: ``((0.0, 0.0), (1.5, 1.0))`` grows from 0 to 1 in the
first second and a half. Before its first key and after its last it stays; in between it goes smoothly from
key to key and never beyond them, so that what follows it neither starts nor stops with a jerk.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import isfinite
from numbers import Real
from typing import Any

import numpy as np

from .errors import RecipeError
from .typing import Array

Curve = tuple[tuple[float, float], ...]
Varying = float | Curve


def is_curve(value: Any) -> bool:
    """Say whether a value of a step is a curve and not one number."""
    return isinstance(value, tuple)


def read_varying(what: str, value: Any) -> Varying:
    """Return a number, or a curve given as pairs of time and value or as text such as ``"0:0,1.5:1"``.

    Raises ``RecipeError``, naming ``what``, for anything else, and where times do not go up.
    """
    if _is_number(value):
        return value
    if isinstance(value, str):
        value = _parsed(what, value)
        if _is_number(value):
            return value
    try:
        keys = tuple((time, amount) for time, amount in value)
    except (TypeError, ValueError):
        keys = ()
    if not keys or not all(_is_number(x) and isfinite(x) for key in keys for x in key):
        raise RecipeError(
            f"{what} must be a number, or times with their values such as [[0, 0], [1.5, 1]], "
            f"got {value!r:.80}"
        )
    for (before, _), (after, _) in pairwise(keys):
        if not before < after:
            raise RecipeError(f"{what}: the times of its keys must go up, got {after:g} s after {before:g} s")
    return tuple((float(time), float(amount)) for time, amount in keys)


def values(value: Varying) -> tuple[float, ...]:
    """Return the one number, or the values of all keys: nothing that a curve passes lies outside them."""
    return tuple(amount for _, amount in value) if isinstance(value, tuple) else (value,)


def evaluate(value: Varying, at: Array) -> Array:
    """Return the value (T,) at the moments ``at`` (T,) in seconds.

    Between keys it is the monotone cubic of Fritsch & Butland (1984), level at the first and the last key.
    """
    if not isinstance(value, tuple):
        return np.full(len(at), float(value))
    from scipy.interpolate import PchipInterpolator

    times, amounts = np.array(value).T
    # A level stretch before and after makes the ends level.
    wide = np.concatenate([[times[0] - 1.0], times, [times[-1] + 1.0]])
    found: Array = PchipInterpolator(wide, np.pad(amounts, 1, mode="edge"))(np.clip(at, times[0], times[-1]))
    return np.clip(found, amounts.min(), amounts.max())


def multiply(one: Varying, other: Varying, *, most: float) -> Varying:
    """Return the product, at most ``most``; of two curves, at the times of the keys of both."""
    if not isinstance(one, tuple) and not isinstance(other, tuple):
        return min(one * other, most)
    keys = {time for value in (one, other) if isinstance(value, tuple) for time, _ in value}
    times = np.array(sorted(keys))
    product = np.minimum(evaluate(one, times) * evaluate(other, times), most)
    return tuple(zip(times.tolist(), product.tolist(), strict=True))


def shown(value: Varying) -> str:
    """Return a number or curve as a person writes it on a command line: ``0.8`` or ``0:0,1.5:1``."""
    if not isinstance(value, tuple):
        return f"{value:g}"
    return ",".join(f"{time:g}:{amount:g}" for time, amount in value)


def _parsed(what: str, text: str) -> float | list[Sequence[float]]:
    try:
        if ":" not in text:
            return float(text)
        return [tuple(float(number) for number in key.split(":")) for key in text.split(",")]
    except ValueError:
        raise RecipeError(
            f"{what} must be a number, or times with their values such as 0:0,1.5:1, got {text!r}"
        ) from None


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)
