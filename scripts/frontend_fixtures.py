"""Write what the page's tests compare with: clips as they travel, and where Python has joints and solids.

Each fixture is two files in ``frontend/src/motion/fixtures``: ``NAME.clip.bin`` as the server sends it, and
``NAME.truth.bin`` in the same container: the ``frames`` looked at, world transforms and solids there, and
``between``, joint positions half-way from each of these frames to the next.
"""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

from mien import samples
from mien.kinematics.fk import fk
from mien.motion import Motion, Skeleton
from mien.render.figure import Figure
from mien.render.wire import encode, packed, places
from mien.rotations import quaternion

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "frontend" / "src" / "motion" / "fixtures"
COMMAND = "python scripts/frontend_fixtures.py"
FRAMES = np.array([0, 3, 6])


def motions() -> dict[str, Motion]:
    """Return the motions by name: all skeletons, several units and ways up, and one without a body."""
    form = {"seconds": 1.0, "fps": 8.0}
    made = {
        "walk": samples.walk(**form),
        "wave": samples.wave(skeleton="capture31", unit="inch", up="z", heading=0.7, **form),
        "jump": samples.jump(skeleton="poser43", unit="mm", heading=-2.0, **form),
        "turn": samples.turn(skeleton="engine23", unit="m", up="z", **form),
    }
    return {name: sample.motion for name, sample in made.items()} | {"tail": tail()}


def tail() -> Motion:
    """Return four joints in a row, with a tip, that swing from side to side: nothing that has a body."""
    offsets = np.array([[0.0, 90.0, 0.0], [0.0, -30.0, 0.0], [0.0, -25.0, 5.0], [0.0, -20.0, 0.0]])
    tip = np.array([[0.0, -15.0, 3.0]])
    skeleton = Skeleton(("root", "one", "two", "three"), np.arange(-1, 3), offsets, np.array([3]), tip)
    phase = 2.0 * np.pi * np.arange(9)[:, None] / 8.0 - 0.6 * np.arange(4)
    zero = np.zeros_like(phase)
    half = 0.2 * np.sin(phase)
    rotations = np.stack([zero, zero, np.sin(half), np.cos(half)], axis=-1)
    moved = np.repeat(offsets[None], 9, axis=0)
    moved[:, 0, 2] += 10.0 * np.arange(9)
    return Motion(skeleton, rotations, moved, 1.0 / 8.0, name="tail")


def files() -> dict[str, bytes]:
    """Return the content of every fixture by file name."""
    found = {}
    for name, motion in motions().items():
        found[f"{name}.clip.bin"] = encode(motion, name)
        found[f"{name}.truth.bin"] = _truth(motion)
    return found


def stale() -> list[str]:
    """Return the fixtures that are not what this script writes, to a hundred-thousandth."""
    return [
        name
        for name, data in files().items()
        if not (FOLDER / name).is_file() or not _same((FOLDER / name).read_bytes(), data)
    ]


def _same(one: bytes, other: bytes) -> bool:
    """Return whether two fixtures say the same; the last digits differ from machine to machine."""
    (head, arrays), (other_head, other_arrays) = _parts(one), _parts(other)
    near = len(arrays) == len(other_arrays) and np.allclose(
        *(np.frombuffer(data, "<f4") for data in (arrays, other_arrays)), rtol=1e-4, atol=1e-4, equal_nan=True
    )
    return near and _near(head, other_head)


def _parts(data: bytes) -> tuple[Any, bytes]:
    start = 8 + int.from_bytes(data[4:8], "little")
    return json.loads(data[8:start]), data[start:]


def _near(one: Any, other: Any) -> bool:
    """Return whether two values from JSON are the same but for the last digits of numbers."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_near(one[key], other[key]) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_near, one, other))
    if isinstance(one, float) and isinstance(other, float | int):
        return bool(np.isclose(one, other, rtol=1e-4, atol=1e-4))
    return bool(one == other)


def _truth(motion: Motion) -> bytes:
    figure = Figure.of(motion)
    solids = figure.solids(FRAMES)
    half = quaternion.slerp(motion.rotations[FRAMES], motion.rotations[FRAMES + 1], np.full((3, 1), 0.5))
    moved = 0.5 * (motion.translations[FRAMES] + motion.translations[FRAMES + 1])
    arrays = {
        "frames": FRAMES,
        "rotations": figure.rotations[FRAMES],
        "positions": figure.positions[FRAMES],
        "between": fk(half, moved, motion.skeleton.parents)[1],
        "starts": solids.starts,
        "ends": solids.ends,
        "start_radii": solids.start_radii,
        "end_radii": solids.end_radii,
        "centres": solids.centres,
        "axes": solids.axes,
        "colours": solids.colours,
    }
    small = {name: array.astype("<f4") for name, array in arrays.items()}
    return packed({"arrays": [vars(place) for place in places(small)]}, small)


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, data in files().items():
        (FOLDER / name).write_bytes(data)
    print(
        f"{FOLDER.relative_to(ROOT)}: {sum(p.stat().st_size for p in FOLDER.iterdir())} bytes",
        file=sys.stderr,
    )
