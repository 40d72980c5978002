"""Rows of numbers with a fixed number of decimals, to text and from text, many numbers at a time.

Writing: each number is laid out in words of four bytes, looked up in tables: separator and sign, one or
two words of the integer, one for each three decimals. Places not needed hold NUL, and all NULs are
dropped at the end.

Reading: the eight letters before each point and before each number's end are taken as one 64-bit word,
and three multiplications add up its digits (Lemire 2021, "Number parsing at a gigabyte per second").
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from ..typing import Array, Integers

Letters = NDArray[np.uint8]
Words = NDArray[np.uint64]

_BLOCK = 1024  # frames at a time, so that the words stay in the cache
_LETTERS = 1 << 17  # letters at a time, for the same reason
_LAST = np.array([2**64 - 2 ** (64 - 8 * n) for n in range(9)], np.uint64)  # selects the last n letters


def write_rows(values: Array, newline: bytes, *, decimals: int) -> bytes:
    """Return the text of the frames ``(T, C)``; reading it gives back the same numbers, bit for bit.

    All get ``decimals`` places if that is exact, else six or nine, else each as many as it needs.
    """
    reachable = np.abs(values).max() < 1e8  # two words of four digits
    for places in (decimals, 6, 9) if reachable else ():
        if _exact(values, 10.0**places):
            blocks = range(0, len(values), _BLOCK)
            text = b"".join(_fixed(values[i : i + _BLOCK], newline, places) for i in blocks)
            return text.removeprefix(newline) + newline
    end = newline.decode()
    return "".join(" ".join(map(repr, row)) + end for row in values.tolist()).encode()


def _exact(values: Array, scale: float) -> bool:
    """Return whether the numbers are whole multiples of 1 / scale, up to float64's rounding."""
    scaled = np.rint(values * scale)  # whole numbers up to 2^53 divide to the nearest float64
    return bool((np.abs(scaled) < 2.0**53).all() and (scaled / scale == values).all())


def _fixed(values: Array, newline: bytes, places: int) -> bytes:
    """Return the text of some frames, each line with its ``newline`` in front."""
    size = np.abs(values)
    integer, fraction = np.divmod(np.rint(size * 10.0**places).astype(np.int64), 10**places)
    groups = -(-places // 3)
    wide = 1 + int(integer.max() >= 10_000)
    words = np.empty((*values.shape, 1 + wide + groups), np.uint32)
    negative = np.signbit(values).astype(np.int64)
    words[..., 0] = _table([b" ", b" -"])[negative]
    words[:, 0, 0] = _table([newline, newline + b"-"])[negative[:, 0]]
    _put_integer(words[..., 1 : 1 + wide], integer)
    fraction *= 10 ** (3 * groups - places)
    for group in range(groups - 1, -1, -1):
        fraction, digits = np.divmod(fraction, 1000)
        unused = 3 * groups - places if group == groups - 1 else 0
        words[..., 1 + wide + group] = _decimals(b"" if group else b".", unused)[digits]
    return words.tobytes().translate(None, b"\0")


def _put_integer(words: Array, integer: Integers) -> None:
    if words.shape[-1] == 1:
        words[..., 0] = _integers(False)[integer]
        return
    high, low = np.divmod(integer, 10_000)
    words[..., 0] = np.where(high > 0, _integers(False)[high], 0)
    words[..., 1] = np.where(high > 0, _integers(True)[low], _integers(False)[low])


def _table(texts: list[bytes]) -> Array:
    """Return texts of up to four bytes as words, whose memory is the text."""
    return np.frombuffer(b"".join(text.ljust(4, b"\0") for text in texts), np.uint32)


@cache
def _integers(padded: bool) -> Array:
    return _table([b"%04d" % i if padded else b"%d" % i for i in range(10_000)])


@cache
def _decimals(point: bytes, unused: int) -> Array:
    return _table([point + (b"%03d" % i)[: 3 - unused] for i in range(1000)])


def read_fixed(data: bytes, start: int, width: int) -> Array | None:
    """Return the rows ``(T, width)`` that ``data`` holds from ``start`` on, if all have as many decimals.

    One to seven of them; None where it is anything else: the caller must then read in another way. Each
    number is the float64 nearest to its text.
    """
    point = data.find(b".", start)
    fraction = data[point + 1 : point + 9].split()
    places = len(fraction[0]) if point >= 0 and fraction else 0
    if not 1 <= places <= 7 or start < 8:
        return None
    data = data if data.endswith(b"\n") else data + b"\n"
    rows = []
    while start < len(data):
        stop = data.rfind(b"\n", start, start + _LETTERS) + 1 or len(data)
        values = _read_block(np.frombuffer(data, np.uint8, stop - start + 8, start - 8), places, width)
        if values is None:
            return None
        rows.append(values)
        start = stop
    return np.concatenate(rows)


def _read_block(letters: Letters, places: int, width: int) -> Array | None:
    """Read whole lines; before them stand eight letters that are not theirs."""
    gaps = np.flatnonzero(letters <= ord(" "))
    gaps = gaps[np.searchsorted(gaps, 8) :]
    starts, ends = np.concatenate([[8], gaps[:-1] + 1]), gaps
    if (starts == ends).any():  # several separators in a row
        starts, ends = starts[starts < ends], ends[starts < ends]
    points = ends - places - 1
    minus = letters[starts] == ord("-")
    digits = points - starts - minus  # before the point
    if not _regular(letters, gaps, ends, width) or ((digits < 1) | (digits > 8)).any():
        return None
    if np.count_nonzero(letters[8:] == ord(".")) != len(ends) or (letters[points] != ord(".")).any():
        return None
    words: Words = np.ndarray((len(letters) - 7,), "<u8", letters, strides=(1,))  # eight letters from each on
    whole, fraction = _add_up(words[points - 8], digits), _add_up(words[ends - 8], places)
    if whole is None or fraction is None:
        return None
    values: Array = (whole * np.uint64(10**places) + fraction).astype(np.float64) / 10.0**places
    return np.negative(values, where=minus, out=values).reshape(-1, width)


def _regular(letters: Letters, gaps: Integers, ends: Integers, width: int) -> bool:
    """Return whether there is a line break after every ``width`` numbers and nowhere else."""
    marks = letters[gaps]
    breaks = gaps[(marks == ord("\n")) | (marks == ord("\r"))]
    before = np.unique(np.searchsorted(ends, breaks, side="right"))
    return bool((before % width == 0).all()) and np.count_nonzero(before) * width == len(ends)


def _add_up(words: Words, digits: Integers | int) -> Words | None:
    """Return the numbers that the last ``digits`` letters of each word spell; None if one is no digit."""
    words = (words ^ np.uint64(0x3030303030303030)) & _LAST[digits]
    if ((words | (words + np.uint64(0x7676767676767676))) & np.uint64(0x8080808080808080)).any():
        return None
    pairs = words * np.uint64(10) + (words >> np.uint64(8))
    every = np.uint64(0x000000FF000000FF)
    first, second = pairs & every, (pairs >> np.uint64(16)) & every
    return (first * np.uint64(0x000F424000000064) + second * np.uint64(0x0000271000000001)) >> np.uint64(32)
