"""Blending: how fast is time warping, and do the feet of blended clips stay?

Run: python benchmarks/blend.py [--weights 0.25,0.5,0.75] [--bands] [folder of clips]

First the time of dynamic time warping and its peak of memory, beside an obvious twin (SciPy's table of
distances, then a loop over its cells). Then, for pairs of clips of one skeleton and one content: in every
contact that both clips have in common, how far the planted point moves over the ground, in the blend
minus in the clip that slides more there (cm); how much deeper the feet come than in the clips (cm); and
two measures that do not know our contacts: the share of skating frames (as in feet.py) in the blend minus
that of the worse clip, and the jerk of the ankles over that of the jerkier clip.
"""

import argparse
import os
import tracemalloc
from pathlib import Path

import numpy as np
from clock import best
from feet import jerk, lowest, skating
from scipy.spatial.distance import cdist

import mien
from mien.errors import MienError
from mien.kinematics.alignment import align
from mien.kinematics.body import Body
from mien.kinematics.contacts import Contacts, detect, slides
from mien.motion import Motion
from mien.rotations import quaternion
from mien.signal import dtw
from mien.signal.sampling import spline
from mien.styles.multitarget import mix
from mien.styles.skeletons import on_one_skeleton

DATA = Path(os.environ.get("MIEN_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))
# Folder, pattern of the clips, pattern of those that every other is blended with.
SETS = [("bandai1", f"*_{what}_*", f"*_{what}_normal_*") for what in ("walk", "walk-left", "run")]
SETS += [("bandai1", f"*_{what}_*", f"*_{what}_normal_*") for what in ("bow", "bye", "guide")]
SETS += [("bandai2", f"*_{what}_*", f"*_{what}_normal_*") for what in ("walk", "wave-right-hand")]
SETS += [
    ("xia", "*_000.bvh", "neutral_01_*"),
    ("cmu_daz", "0[27]_*", "02_01*"),
    ("cmu_daz", "12_*", "02_01*"),
]


def twin(a, b, steps=((1, 1), (1, 2), (2, 1)), band=0.2):
    """The obvious way: the whole table of distances, then cell by cell."""
    distance = cdist(a, b)
    table = np.full(distance.shape, np.inf)
    table[0, 0] = 2 * distance[0, 0]
    n, m = table.shape
    for i in range(n):
        for j in range(m):
            if abs(i / (n - 1) - j / (m - 1)) <= band:
                for p, q in steps:
                    if i >= p and j >= q:
                        table[i, j] = min(table[i, j], table[i - p, j - q] + (p + q) * distance[i, j])
    return table[-1, -1] / (n + m)


def warping(frames, width):
    t = np.linspace(0, 1, frames)
    a, b = (np.stack([np.sin(9 * x + k * x * x) for k in range(width)], axis=1) for x in (t, t**1.2))
    ours, theirs = best(lambda: dtw.path(a, b)), best(lambda: twin(a, b), runs=1)
    tracemalloc.start()
    cost = dtw.path(a, b).cost
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    print(
        f"time warping of {frames} x {frames} frames, {width} numbers each: {ours:.0f} ms, "
        f"obvious twin {theirs:.0f} ms, ratio {ours / theirs:.3f}; {peak / 2**20:.1f} MiB, "
        f"a whole table of sums {frames * frames * 8 / 2**20:.1f}; costs differ by {cost - twin(a, b):.1e}"
    )


def same_time(clips, made):
    """Return the clips as they are at the moments that the blend shows."""
    found = align(clips)
    times = (found.knots * [clip.frame_time for clip in clips]) @ made.shares.time
    frames = found.frames(times - times[0], made.motion.times).T
    return [
        Motion(
            clip.skeleton,
            quaternion.normalise(spline(clip.rotations, at)),
            spline(clip.translations, at),
            made.motion.frame_time,
        )
        for clip, at in zip(clips, frames, strict=True)
    ]


def measure(clips, weights, bands):
    """Return slide, sink, skating and jerk of a blend beside its clips."""
    made = mix(clips, weights, bands=bands)
    clips = on_one_skeleton(clips)
    shown, bodies = same_time(clips, made), [Body.of(clip) for clip in clips]
    found = [detect(motion, body=body).points for motion, body in zip(shown, bodies, strict=True)]
    both, cm = Contacts(np.all(found, axis=0)), 100 * bodies[0].metres_per_unit
    own = [slides(motion, both, body) for motion, body in zip(shown, bodies, strict=True)]
    pairs = list(zip(shown, bodies, strict=True))
    motion, body = made.motion, bodies[0]
    return (
        cm * float((slides(motion, both, body) - np.max(own, axis=0)).max(initial=0.0)),
        cm * float(np.max(own, initial=0.0)),
        cm * float(min(lowest(*pair).min() for pair in pairs) - lowest(motion, body).min()),
        100 * (skating(motion, body) - max(skating(*pair) for pair in pairs)),
        jerk(motion, body) / max(*(jerk(*pair) for pair in pairs), 1e-12),
    )


def pairs_of(folder):
    for name, every, first in SETS:
        for start in sorted((folder / name).glob(first)):
            for other in sorted((folder / name).glob(every)):
                if other != start:
                    yield f"{name} {first.strip('*_')}", start, other


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", nargs="?", type=Path, default=DATA)
    parser.add_argument("--weights", default="0.25,0.5,0.75", help="of the second clip")
    parser.add_argument("--bands", action="store_true", help="posture of the second, movement of the first")
    options = parser.parse_args()
    warping(600, 60)
    rows = {}
    for name, first, second in pairs_of(options.folder):
        try:
            clips = [mien.load(first), mien.load(second)]
            for w in [0.0] if options.bands else map(float, options.weights.split(",")):
                bands = {"low": [0, 1], "mid": [1, 0], "high": [1, 0]} if options.bands else None
                rows.setdefault(name, []).append(measure(clips, [1 - w, w], bands))
        except MienError as error:
            print(f"refused {first.name} and {second.name}: {error}")
    heads = ("blends", "slide cm", "clips'", "sink cm", "skating %", "jerk", "worst")
    print(f"{'':<28}" + "".join(f"{head:>11}" for head in heads))
    for name, found in rows.items():
        v = np.array(found)
        shown = (
            v[:, 0].max(),
            v[:, 1].max(),
            v[:, 2].max(),
            v[:, 3].mean(),
            np.median(v[:, 4]),
            v[:, 4].max(),
        )
        print(f"{name:<28}{len(v):>11}" + "".join(f"{number:>11.2f}" for number in shown))


if __name__ == "__main__":
    main()
