"""The same edit on skeletons that share nothing: ``python examples/05_another_skeleton.py [folder]``.

Other names, rest poses, local axes, units and up axes; the result looks the same on all of them.
"""

import sys
from pathlib import Path

import mien
from mien.samples import SKELETONS, walk


def main(folder: str = ".") -> None:
    """Draw one preset on every sample skeleton, each in another unit, axis and frame rate."""
    forms = zip(SKELETONS, ("cm", "inch", "m", "mm"), "yzzy", (60.0, 120.0, 30.0, 24.0), strict=True)
    rows = {}
    for skeleton, unit, up, fps in forms:
        motion = walk(seconds=2, skeleton=skeleton, unit=unit, up=up, fps=fps).motion
        body = mien.Body.of(motion)
        names = motion.skeleton.names
        print(f"{skeleton}: {len(names)} joints, left knee is {names[body.roles['left_knee']]!r}")
        rows[f"{skeleton}, {unit}, {up} up, {fps:g} fps"] = mien.edit(motion, "sad")
    mien.render.compare(rows).save(Path(folder) / "05_another_skeleton.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
