"""The rows of numbers in a BVH file, text to array: quickly when whole, line by line when not.

Most files have the same number of decimals everywhere and take the road of ``bvh_digits``; other whole
files go through NumPy's C reader. What either refuses is left to the careful reader, which says what is
wrong and where.
"""

import io
import math
from dataclasses import dataclass

import numpy as np

from ..typing import Array
from .bvh_digits import read_fixed
from .bvh_header import LARGEST, coordinate

_LETTERS = b"0123456789.+-eE \t\r\n"


@dataclass(frozen=True)
class Problem:
    """Where rows stop being whole, in lines after the first; what is wrong; whether the text just ends."""

    line: int
    message: str
    ends: bool = False


def read_rows(data: bytes, start: int, width: int) -> tuple[Array, Problem | None]:
    """Return the whole frames ``(T, width)`` from byte ``start`` to the first problem, and that problem."""
    values = read_fixed(data, start, width)
    if values is not None and _in_range(values):
        return values, None
    body = data[start:]
    values = _read_plain(body, width)
    return (values, None) if values is not None else _read_careful(body, width)


def _read_plain(body: bytes, width: int) -> Array | None:
    """Return rows of finite numbers, or None if ``body`` is not plainly that."""
    if not body.strip() or body.translate(None, _LETTERS):
        return None
    try:
        values: Array = np.loadtxt(io.BytesIO(body), comments=None, ndmin=2)
    except ValueError:
        return None
    return values if values.shape[1] == width and _in_range(values) else None


def _in_range(values: Array) -> bool:
    """Say whether every number is one that a body can have; NaN is none."""
    return bool(values.min(initial=0.0) >= -LARGEST and values.max(initial=0.0) <= LARGEST)


def _read_careful(body: bytes, width: int) -> tuple[Array, Problem | None]:
    """Read line by line. A frame may be wrapped over lines, but the next begins on a new line."""
    frames: list[list[float]] = []
    pending: list[bytes] = []
    first = count = 0  # the line on which the pending frame begins, and how many numbers it has
    for line, text in enumerate(body.splitlines()):
        words = text.split()
        if not pending:
            first, count = line, len(words)
        pending += words
        if words and len(pending) >= width:
            fault = _fault(pending, count, width)
            if fault:
                return _array(frames, width), Problem(first, fault)
            frames += _cut([float(word) for word in pending], width)
            pending = []
    if pending:
        return _array(frames, width), Problem(first, _fault(pending, len(pending), width), ends=True)
    return _array(frames, width), None


def _fault(words: list[bytes], count: int, width: int) -> str:
    for i, word in enumerate(words):
        text = word.decode("latin-1")
        if math.isnan(coordinate(text)):
            hint = "; write decimals with a point" if "," in text else ""
            return f"number {i % width + 1} is {text[:30]!r}, not a finite number up to 1e9{hint}"
    return f"{count} numbers where {width} were declared" if len(words) % width else ""


def _cut(values: list[float], width: int) -> list[list[float]]:
    return [values[i : i + width] for i in range(0, len(values), width)]


def _array(frames: list[list[float]], width: int) -> Array:
    return np.array(frames, np.float64).reshape(-1, width)
