"""Ten thousand mutated files: read right or refused, never anything else, and never for long."""

import random
import re
import time

import numpy as np
import pytest

from mien.errors import MienError
from mien.formats import bvh

SEED_FILES = [
    """HIERARCHY
ROOT Hips
{
\tOFFSET 0.00 0.00 0.00
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT Chest
\t{
\t\tOFFSET 0.00 5.21 0.00
\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 0.00 2.00 0.00
\t\t}
\t}
}
MOTION
Frames: 3
Frame Time: 0.033333
8.03 35.01 88.36 -3.41 14.78 -164.35 13.09 40.30 -24.60
7.81 35.10 86.47 -3.78 12.94 -166.97 12.64 42.57 -22.34
7.75 35.11 86.40 -3.70 12.90 -166.90 12.60 42.50 -22.30
""",
    "\ufeffHIERARCHY\r\nROOT a b\r\n{ OFFSET 1e-3 -2.5E+2 3\r\nCHANNELS 1 Yrotation\r\nJOINT ü {\r\n"
    "OFFSET 0 1 0\r\nCHANNELS 0\r\n}}\r\nROOT c\r\n{\r\nOFFSET 0 0 0\r\n"
    "CHANNELS 2 Zposition Xrotation\r\n}\r\nMOTION\r\nFrames:\t2\r\nFrame Time:\t.008\r\n"
    "1e1 2 -3\r\n\t4.5 .5 6.\r\n",
]
TOKENS = (
    b"{ } HIERARCHY ROOT JOINT End Site OFFSET CHANNELS MOTION Frames: Frame Time: Xposition Zrotation "
    b"nan inf -inf 1e999 0 -1 1e-320 1000000000000 99999999999999999999999 3.3.3 - . e 1,5 0x10 1_0 "
    b"\xc3\xbc \xff \x00 \r \n"
).split(b" ")


def mutate(data: bytes, rng: random.Random) -> bytes:
    for _ in range(rng.choice([1, 1, 2, 4])):
        data = rng.choice([flip, cut, swap, duplicate, insert, shuffle])(data, rng) or b"\n"
    return data


def flip(data: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(data))
    return data[:at] + bytes([rng.randrange(256)]) + data[at + 1 :]


def cut(data: bytes, rng: random.Random) -> bytes:
    """Lose a few letters, or all from somewhere on."""
    at = rng.randrange(len(data))
    return data[:at] + (data[at + rng.randint(1, 6) :] if rng.random() < 0.7 else b"")


def swap(data: bytes, rng: random.Random) -> bytes:
    words = data.split(b" ")
    words[rng.randrange(len(words))] = rng.choice(TOKENS)
    return b" ".join(words)


def duplicate(data: bytes, rng: random.Random) -> bytes:
    lines = data.splitlines(keepends=True)
    at = rng.randrange(len(lines))
    return b"".join([*lines[:at], lines[at] * rng.choice([0, 2, 40]), *lines[at + 1 :]])


def insert(data: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + rng.choice(TOKENS) + data[at:]


def shuffle(data: bytes, rng: random.Random) -> bytes:
    lines = data.splitlines(keepends=True)
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]
    return b"".join(lines)


@pytest.mark.parametrize("seed", range(10))
def test_mutated_files_are_read_or_refused(seed: int) -> None:
    rng = random.Random(seed)
    start, read, said = time.perf_counter(), 0, set[str]()
    for i in range(1000):
        data = mutate(SEED_FILES[i % 2].encode(), rng)
        salvage = rng.random() < 0.5
        try:
            motion = bvh.parse(data, "fuzz.bvh", fps=rng.choice([None, 30.0]), salvage=salvage)
        except MienError as error:
            said.add(str(error))
            continue
        again = bvh.parse(bvh.render(motion), "again.bvh")
        np.testing.assert_array_equal(again.source.values, motion.source.values, err_msg=repr(data))
        assert again.skeleton.names == motion.skeleton.names, data
        read += 1
    assert all(re.match("fuzz.bvh[^\n]+$", sentence) for sentence in said)
    assert 50 < read < 950  # the mutations neither spare nor break nearly everything
    assert time.perf_counter() - start < 60  # a hang guard, not a measure of speed
