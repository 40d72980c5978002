"""Dose an emotion: ``python examples/03_strength_and_parts.py [clip.bvh] [folder]``.

Less, more, only some parts of the body, only for a while.
"""

import sys
from pathlib import Path

import mien


def main(clip: str = "", folder: str = ".") -> None:
    """Draw the same emotion in five doses."""
    walk = mien.load(clip) if clip else mien.samples.walk(seconds=3).motion
    rows = {
        "strength 0.4": mien.edit(walk, "proud", strength=0.4),
        "strength 1": mien.edit(walk, "proud"),
        "strength 1.6": mien.edit(walk, "proud", strength=1.6),
        "only head and torso": mien.edit(walk, "proud", parts=("head", "torso")),
        "from 1 s to 2 s": mien.edit(walk, "proud", span=(1.0, 2.0)),
    }
    mien.render.compare(rows, against=walk, poses=5).save(Path(folder) / "03_strength_and_parts.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
