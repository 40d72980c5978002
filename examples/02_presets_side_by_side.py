"""Show one walk under several words: ``python examples/02_presets_side_by_side.py [clip.bvh] [folder]``."""

import sys
from pathlib import Path

import mien

WORDS = ("sad", "tired", "afraid", "proud", "strong")


def main(clip: str = "", folder: str = ".") -> None:
    """Draw one row for each word, the original as a ghost."""
    walk = mien.load(clip) if clip else mien.samples.walk(seconds=2).motion
    rows = {word: mien.edit(walk, word) for word in WORDS}
    mien.render.compare(rows, against=walk, poses=4).save(Path(folder) / "02_presets_side_by_side.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
