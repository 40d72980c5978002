"""Numbers to the rows of text of a BVH file, by look-up of four characters at a time.

Each number is laid out in words of four bytes: separator and sign, one or two words of the integer,
one for each three decimals. Places not needed hold NUL, and all NULs are dropped at the end.
"""

from functools import cache

import numpy as np

from ..typing import Array, Integers

_BLOCK = 1024  # frames at a time, so that the words stay in the cache


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
