"""Emotion to motion: how long does it take, and how much of what was asked is reached?

Run: python benchmarks/synthesis.py [clip.bvh ...]

The first table has the time for 680 frames at 30 frames a second, the clip for which Aristidou et al. (2017)
report 12 seconds: of finding the numbers, of doing the steps, of both, and of doing them with the checks of
safe edits; wall time and processor time, the best of several runs. The second has, for eight places on the
disc, how much is wished (root mean square over the thirty features and the clusters of poses, in spreads),
what share of the cost that is made small is left with the body that follows, and where the reading of manner
sees the result against its source. With clips, the second is about those.
"""

import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import mien
from mien import samples
from mien.emotion.circumplex import Point, point
from mien.emotion.joint_fitting import drifted, joint, objective
from mien.emotion.model import shipped_model
from mien.emotion.rule_curves import at_times, in_time
from mien.emotion.rule_fitting import Found, sequential
from mien.emotion.rule_wish import Wish
from mien.emotion.synthesis import synthesise
from mien.emotion.toward import aim
from mien.emotion.wishes import wanted
from mien.kinematics.control_points import NAMES
from mien.recipe import Recipe

FRAMES, PUBLISHED, RUNS = 680, 12.0, 7
BUDGET = {"recipe": 1.0, "rules": 0.1, "joint": 0.3}
RADIUS = 0.7


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


def reached(motion: mien.Motion) -> None:
    """Print what eight places ask of a motion and what is reached."""
    model = shipped_model()
    print(f"{motion.name or 'clip'}")
    for angle in range(0, 360, 45):
        turn = np.radians(angle)
        place = Point(RADIUS * float(np.cos(turn)), RADIUS * float(np.sin(turn)))
        asked = wanted(model, place)
        wish = Wish.of(motion, asked)
        size = float(np.sqrt(np.mean((asked.numbers * asked.weights) ** 2)))
        nothing = objective(wish, Found(np.ones((wish.clusters, len(NAMES))), 1.0))
        rules = sequential(wish)
        line = f"  {angle:3} deg, {wish.clusters} clusters, asked {size:4.2f}"
        for method, found in (("rules", rules), ("joint", joint(wish, rules))):
            edited = mien.apply(motion, synthesise(motion, place, method=method, model=model))
            manner = mien.read(edited, model=model).place
            line += (
                f" | {method} cost {objective(wish, found) / nothing:4.2f}, "
                f"manner {manner.valence:+.2f} {manner.arousal:+.2f}"
            )
        curves = in_time(wish.stays, joint(wish, rules).pose)
        drift = drifted(wish, lambda times, curves=curves: at_times(curves, times))
        print(f"{line} | second stage {drift.before:4.2f} to {drift.after:4.2f}")


def main() -> None:
    """Print both tables."""
    times()
    paths = sys.argv[1:]
    for motion in [mien.load(Path(p)) for p in paths] if paths else [samples.walk().motion]:
        reached(motion)


if __name__ == "__main__":
    main()
