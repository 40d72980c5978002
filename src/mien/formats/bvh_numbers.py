"""The rows of numbers in a BVH file: text to array, and back, at the speed of a C reader."""

from dataclasses import dataclass

import numpy as np

from ..typing import Array
from .bvh_header import number

DIGITS = b"0123456789"


@dataclass(frozen=True)
class Problem:
    """Where the rows stop being whole: how many lines after the first row, and what is wrong there."""

    line: int
    message: str


def read_rows(body: bytes, width: int) -> tuple[Array, Problem | None]:
    """Return the frames ``(T, width)`` up to the first problem, and that problem.

    A frame may be wrapped over several lines, but the next begins on a new line.
    """
    frames: list[list[float]] = []
    pending: list[bytes] = []
    first = 0
    for line, text in enumerate(body.splitlines()):
        words = text.split()
        first = first if pending else line
        pending += words
        if words and len(pending) >= width:
            fault = _fault(pending, width)
            if fault:
                return _array(frames, width), Problem(first, fault)
            frames += _split([float(word) for word in pending], width)
            pending = []
    if pending:
        fault = _fault(pending, width) or f"{len(pending)} numbers where {width} were declared"
        return _array(frames, width), Problem(first, fault)
    return _array(frames, width), None


def _fault(words: list[bytes], width: int) -> str:
    for i, word in enumerate(words):
        text = word.decode("latin-1")
        if number(text) != number(text):
            hint = "; write decimals with a point" if "," in text else ""
            return f"number {i % width + 1} is {text[:30]!r}, not a finite number{hint}"
    return f"{len(words)} numbers where {width} were declared" if len(words) % width else ""


def _split(values: list[float], width: int) -> list[list[float]]:
    return [values[i : i + width] for i in range(0, len(values), width)]


def _array(frames: list[list[float]], width: int) -> Array:
    return np.array(frames, np.float64).reshape(-1, width)


def write_rows(values: Array, newline: bytes) -> bytes:
    """Return the text of the frames ``(T, C)``, each number as the shortest that reads back the same."""
    end = newline.decode()
    return "".join(" ".join(map(repr, row)) + end for row in values.tolist()).encode()
