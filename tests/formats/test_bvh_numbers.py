"""Text to numbers and back: the fast roads against ``float`` and ``repr``."""

import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from mien.formats.bvh_digits import write_rows
from mien.formats.bvh_numbers import read_rows

START = b"Frame Time: 0.01\n"
ODD = [".5", "-.5", "5.", "-0", "0", "-0.0", "1e5", "1E-300", "+1.5", "1e+3", "12345678901234567890"]


def by_float(text: bytes, width: int) -> np.ndarray | None:
    """Return what Python's own ``float`` makes of words that split into whole rows, else None."""
    rows = []
    for line in text.splitlines():
        try:
            row = [float(word) for word in line.split()]
        except ValueError:
            return None
        if len(row) not in (0, width) or not (np.abs(row) <= 1e9).all():
            return None
        rows += [row] if row else []
    return np.array(rows).reshape(-1, width)


def word(rng: random.Random) -> str:
    kind = rng.random()
    if kind < 0.6:
        return f"{rng.uniform(-200, 200):.{rng.randint(0, 7)}f}"
    if kind < 0.8:
        return f"{rng.gauss(0, 1e-5):.{rng.randint(0, 5)}{rng.choice('eE')}}"
    return str(rng.randint(-9, 9)) if kind < 0.9 else rng.choice(ODD)


def mutate(text: bytes, rng: random.Random) -> bytes:
    out = bytearray(text)
    for _ in range(rng.choice([0, 0, 1, 1, 2, 3])):
        at, letter = rng.randrange(len(out)), rng.choice(b"0123456789.eE+- \n\t\r,x")
        out[at : at + rng.randint(0, 1)] = bytes([letter]) if rng.random() < 0.8 else b""
    return bytes(out)


@pytest.mark.parametrize("seed", range(4))
def test_whatever_is_read_is_what_float_reads(seed: int) -> None:
    rng = random.Random(seed)
    whole = 0
    for _ in range(1000):
        frames, width = rng.randint(1, 4), rng.randint(1, 4)
        rows = "\n".join(" ".join(word(rng) for _ in range(width)) for _ in range(frames))
        text = mutate(rows.encode() + b"\n", rng)
        values, problem = read_rows(START + text, len(START), width)
        expected = by_float(text, width)
        if expected is not None:
            assert problem is None, text
            np.testing.assert_array_equal(values, expected, err_msg=repr(text))
            np.testing.assert_array_equal(np.signbit(values), np.signbit(expected), err_msg=repr(text))
            whole += 1
        elif problem is None:  # rows wrapped over lines: the same words in the same order
            np.testing.assert_array_equal(values.ravel(), np.array(text.split(), float), err_msg=repr(text))
    assert 300 < whole < 900


FINITE = st.floats(-1e9, 1e9)
ROWS = hnp.arrays(np.float64, hnp.array_shapes(min_dims=2, max_dims=2, max_side=6), elements=FINITE)


@settings(max_examples=300, deadline=None)
@given(values=ROWS, decimals=st.integers(0, 9))
def test_any_numbers_come_back_bit_for_bit(values: np.ndarray, decimals: int) -> None:
    text = write_rows(values, b"\n", decimals=decimals)
    again, problem = read_rows(START + text, len(START), values.shape[1])
    assert problem is None
    assert again.tobytes() == values.tobytes()


@settings(max_examples=300, deadline=None)
@given(
    numbers=st.lists(st.integers(-(10**15), 10**15), min_size=1, max_size=8),
    decimals=st.integers(0, 9),
    newline=st.sampled_from([b"\n", b"\r\n", b"\r"]),
)
def test_fixed_decimals_are_written_as_format_does(numbers: list[int], decimals: int, newline: bytes) -> None:
    values = np.array([numbers], np.float64) / 10.0**decimals
    values = values[:, np.abs(values[0]) < 1e8]
    expected = b" ".join(b"%.*f" % (decimals, x) for x in values[0]) + newline
    if values.size:
        assert write_rows(values, newline, decimals=decimals) == expected


def test_many_frames_keep_their_order() -> None:
    values = np.round(np.random.default_rng(0).normal(size=(3000, 5)) * 1000, 4)
    lines = write_rows(values, b"\r\n", decimals=4).decode().split("\r\n")
    assert lines == [*(" ".join(f"{x:.4f}" for x in row) for row in values), ""]
