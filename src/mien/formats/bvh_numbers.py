"""The rows of numbers in a BVH file, text to array: quickly when whole, line by line when not.

Whole files go through SciPy's Matrix Market reader (C++, correctly rounded), five times faster than
``float``. It ignores what follows a number on its line, so the text is checked first; whatever is not
plainly regular is left to the careful reader, which says what is wrong and where.
"""

import io
import math
from dataclasses import dataclass

import numpy as np

from ..typing import Array
from .bvh_header import number

_DIGITS = b"0123456789"
_PLAIN = bytes.maketrans(b"E+", b"e-")
_SHAPES = bytes.maketrans(b"123456789E+ ", b"000000000e-\n")


@dataclass(frozen=True)
class Problem:
    """Where rows stop being whole, in lines after the first; what is wrong; whether the text just ends."""

    line: int
    message: str
    ends: bool = False


def read_rows(body: bytes, frames: int, width: int) -> tuple[Array, Problem | None]:
    """Return the whole frames ``(T, width)`` before the first problem, and that problem.

    ``frames`` is how many are promised: a hint, for which nothing is reserved.
    """
    values = _read_whole(body, frames, width)
    return (values, None) if values is not None else _read_careful(body, width)


def _read_whole(body: bytes, frames: int, width: int) -> Array | None:
    """Return ``frames`` rows of finite numbers, or None if ``body`` is not plainly that."""
    if 2 * frames * width > len(body) + 1:
        return None
    signs = _count_signs(body, frames, width)
    if signs is None:
        body = _tidy(body)
        signs = _count_signs(body, frames, width)
    values = None if signs is None else _parse(body, frames * width)
    if values is None or not np.isfinite(values).all():
        return None
    if signs != np.count_nonzero(np.signbit(values)):
        values = _sign(values, body, signs)
    return None if values is None else values.reshape(frames, width)


def _sign(values: Array, body: bytes, signs: int | None) -> Array | None:
    """Return the values with the signs of their words: the parser makes 0 of -0.

    None if there are more ``signs`` than words that begin with one: inside a number ("1-2") the parser
    stops reading.
    """
    letters = np.frombuffer(body, np.uint8)
    starts = np.flatnonzero(letters[:-1] <= ord(" ")) + 1
    minus = letters[np.concatenate([[0], starts])] == ord("-")
    if np.count_nonzero(minus) != signs:
        return None
    return np.copysign(values.ravel(), np.where(minus, -1.0, 1.0))


def _count_signs(body: bytes, frames: int, width: int) -> int | None:
    """Return how many signs mantissas have, or None unless there are ``frames`` rows of ``width`` words.

    Words are made of digits and ``.eE+-``, with one separator between them, not all possible orders.
    """
    if body.translate(None, _DIGITS + b"-") == (b". " * (width - 1) + b".\n") * frames:
        return int(np.count_nonzero(np.frombuffer(body, np.uint8) == ord("-")))
    marks = body.translate(_PLAIN, _DIGITS)
    if marks.translate(None, b".e-") != (b" " * (width - 1) + b"\n") * frames or b".." in marks:
        return None
    if b"e" in marks and _odd_exponents(body, marks):
        return None
    return marks.count(b"-") - marks.count(b"e-")


def _tidy(body: bytes) -> bytes:
    """Return the text with one blank between numbers and none at the ends of lines."""
    body = body.strip() + b"\n"
    body = body.replace(b"\r\n", b"\n").replace(b"\r", b"\n").replace(b"\t", b" ")
    while b"  " in body:
        body = body.replace(b"  ", b" ")
    body = body.replace(b" \n", b"\n").replace(b"\n ", b"\n")
    while b"\n\n" in body:
        body = body.replace(b"\n\n", b"\n")
    return body


def _odd_exponents(body: bytes, marks: bytes) -> bool:
    """Return whether something beside ``e``, a sign and digits follows a mantissa, or a sign a digit."""
    shapes = body.translate(_SHAPES)
    return any(odd in marks for odd in (b"e.", b"e-.", b"ee", b"e-e", b".-", b"--")) or any(
        odd in shapes for odd in (b"0-", b"e\n", b"e-\n")
    )


def _parse(body: bytes, count: int) -> Array | None:
    from scipy.io import mmread

    text = bytearray(b"%%%%MatrixMarket matrix array real general\n%d 1\n" % count)
    start = len(text)
    text += body
    letters = np.frombuffer(text, np.uint8)[start:]
    letters -= (letters == ord(" ")) * np.uint8(ord(" ") - ord("\n"))  # one number a line
    try:
        return np.asarray(mmread(io.BytesIO(text)), np.float64)
    except (ValueError, OverflowError):
        return None


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
        if math.isnan(number(text)):
            hint = "; write decimals with a point" if "," in text else ""
            return f"number {i % width + 1} is {text[:30]!r}, not a finite number{hint}"
    return f"{count} numbers where {width} were declared" if len(words) % width else ""


def _cut(values: list[float], width: int) -> list[list[float]]:
    return [values[i : i + width] for i in range(0, len(values), width)]


def _array(frames: list[list[float]], width: int) -> Array:
    return np.array(frames, np.float64).reshape(-1, width)
