"""Build, keep and use a recipe: ``python examples/04_your_own_recipe.py [clip.bvh] [folder]``."""

import sys
from pathlib import Path

import mien
from mien import Recipe, Step

STEALTHY = Recipe(
    "stealthy",
    (
        Step("path_length", {"mid": 0.8}),
        Step("posture", {"trunk": 18, "head": -12, "elbows": 35, "legs": 3, "hips_height": -0.08}),
        Step("foot_plant"),
    ),
    description="crouched, elbows bent, eyes ahead",
)


def main(clip: str = "", folder: str = ".") -> None:
    """Write the recipe, read it again, and draw what it does at two strengths."""
    out = Path(folder)
    walk = mien.load(clip) if clip else mien.samples.walk(seconds=2).motion
    mien.write_recipe(STEALTHY, out / "04_stealthy.toml")
    again = mien.read_recipe(out / "04_stealthy.toml")
    rows = {f"strength {s:g}": mien.edit(walk, again, strength=s) for s in (0.5, 1.0, 1.5)}
    mien.render.compare(rows, against=walk).save(out / "04_your_own_recipe.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
