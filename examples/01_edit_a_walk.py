"""Make a walk sad and see what changed: ``python examples/01_edit_a_walk.py [clip.bvh] [folder]``.

Without a clip a synthetic walk is taken.
"""

import sys
from pathlib import Path

import mien


def main(clip: str = "", folder: str = ".") -> None:
    """Edit the clip, write the result as BVH and a picture with the original behind it."""
    out = Path(folder)
    walk = mien.load(clip) if clip else mien.samples.walk(seconds=3).motion
    sad = mien.edit(walk, "sad", strength=0.8)
    mien.save(sad, out / "01_walk_sad.bvh", force=True)
    mien.render.strip(sad, against=walk, title="sad, strength 0.8").save(out / "01_edit_a_walk.png")
    for step in sad.history:
        print(step.edit, dict(step.parameters))


if __name__ == "__main__":
    main(*sys.argv[1:])
