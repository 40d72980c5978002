"""Emotion to motion: how long does it take, and how much of what was asked is reached?

Run: python benchmarks/synthesis.py [clip.bvh ...]

The first table has the time for 680 frames at 30 frames a second, the clip for which Aristidou et al. (2017)
report 12 seconds: of finding the numbers, of doing the steps, of both, and of doing them with the checks of
safe edits; wall time and processor time, the best of several runs. The second has, for eight places on the
disc, how much of the wish is left (root mean square over features of the edited clip, in what emotions
usually change), what is left of the cost that is made small, how far the Laban reading of the clip moved, and
where the reading of manner sees it against its source. With clips, the second is about those.
"""

import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import mien
from mien import samples
from mien.emotion.circumplex import Point, point
from mien.emotion.joint_fitting import objective
from mien.emotion.model import shipped_model
from mien.emotion.rule_fitting import Wish
from mien.emotion.synthesis import METHODS, synthesise
from mien.emotion.toward import aim
from mien.emotion.wishes import scales, wanted
from mien.kinematics.control_points import NAMES
from mien.recipe import Recipe
from mien.typing import Array

FRAMES, PUBLISHED, RUNS = 680, 12.0, 7
BUDGET = {"recipe": 1.0, "rules": 0.1, "joint": 0.3}
RADIUS = 0.7
ZONES = (20, 21, 22)  # a hand on the border of two zones goes from one to the other for nothing


def best(job: Callable[[], object]) -> tuple[float, float]:
    """Return the least wall time and the least processor time of several runs, in seconds."""
    took = []
    for _ in range(RUNS):
        wall, own = time.perf_counter(), time.process_time()
        job()
        took.append((time.perf_counter() - wall, time.process_time() - own))
    return min(t[0] for t in took), min(t[1] for t in took)


def times() -> None:
    """Print how long each method takes."""
    motion = samples.walk(seconds=(FRAMES - 1) / 30.0, fps=30.0).motion
    place, model = point("sad"), shipped_model()
    print(f"{len(motion)} frames towards sad: wall, processor, and how often that goes into {PUBLISHED:g} s")
    finders: dict[str, Callable[[], Recipe]] = {
        "recipe": lambda: aim(to="sad").recipe(motion),
        "rules": lambda: synthesise(motion, place, method="rules", model=model),
        "joint": lambda: synthesise(motion, place, method="joint", model=model),
    }
    for method, find in finders.items():
        recipe = find()
        jobs = {"find": find, "do": lambda r=recipe: mien.apply(motion, r)}
        rows = {name: best(job) for name, job in jobs.items()}
        rows["both"] = tuple(map(sum, zip(*rows.values(), strict=True)))
        rows["do, checked"] = best(lambda r=recipe: mien.edit(motion, r))
        for name, (wall, own) in rows.items():
            note = f"  budget {BUDGET[method]:g} s" if name == "both" else ""
            print(f"  {method:6} {name:12} {wall:6.3f} s {own:6.3f} s   {PUBLISHED / wall:5.0f} x{note}")


def root_mean(misses: Array) -> float:
    """Return the root mean square of (31,) numbers, without the three counts of hands above and below."""
    return float(np.sqrt(np.mean(np.delete(misses, ZONES) ** 2)))


def reached(motion: mien.Motion) -> None:
    """Print what eight places ask of a motion and what is reached."""
    model = shipped_model()
    scale = scales(model)
    before = mien.features(motion)
    at = model.laban.place(before.clip)
    print(f"{motion.name or 'clip'}: Laban reading of the source {at.valence:+.2f} {at.arousal:+.2f}")
    for angle in range(0, 360, 45):
        turn = np.radians(angle)
        place = Point(RADIUS * float(np.cos(turn)), RADIUS * float(np.sin(turn)))
        change = wanted(model, place)
        wish = Wish.of(motion, change, scale)
        asked = root_mean(change / scale)
        nothing = objective(wish, np.ones(len(NAMES) + 1))
        line = f"  {angle:3} deg asked {asked:4.2f}"
        for method in METHODS:
            recipe = synthesise(motion, place, method=method, model=model)
            c = np.ones(len(NAMES) + 1)
            for step in recipe.steps:
                for name, value in step.parameters.items():
                    c[[*NAMES, "rate"].index(name)] = value
            edited = mien.apply(motion, recipe)
            after = mien.features(edited)
            left = root_mean((after.selected - before.selected - change) / scale)
            laban, manner = model.laban.place(after.clip), mien.read(edited, model=model).place
            line += (
                f" | {method} left {left:4.2f}, cost {objective(wish, c) / nothing:4.2f}, "
                f"Laban {laban.valence - at.valence:+.2f} {laban.arousal - at.arousal:+.2f}, "
                f"manner {manner.valence:+.2f} {manner.arousal:+.2f}"
            )
        print(line)


def main() -> None:
    """Print both tables."""
    times()
    paths = sys.argv[1:]
    for motion in [mien.load(Path(p)) for p in paths] if paths else [samples.walk().motion]:
        reached(motion)


if __name__ == "__main__":
    main()
