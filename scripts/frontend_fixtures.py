"""Write what the page's tests compare with: clips as they travel, and where Python has joints and solids.

Each fixture is two files in ``frontend/src/motion/fixtures``: ``NAME.clip.bin`` as the server sends it, and
``NAME.truth.bin`` in the same container: the ``frames`` looked at, world transforms and solids there, and
``between``, joint positions half-way from each of these frames to the next.
"""

import sys
from pathlib import Path

import numpy as np

from mien import samples
from mien.kinematics.fk import fk
from mien.motion import Motion
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
        "pendulum": samples.pendulum(**form),
    }
    return {name: sample.motion for name, sample in made.items()}


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
    if len(one) != len(other):
        return False
    start = 8 + int.from_bytes(other[4:8], "little")
    if one[:start] == other[:start] and one[start:] == other[start:]:
        return True
    a, b = (np.frombuffer(data[start:], "<f4") for data in (one, other))
    return np.allclose(a, b, rtol=1e-5, atol=1e-5, equal_nan=True)


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
