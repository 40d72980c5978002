"""Laban features: how long does a clip take, how long 108 of them, and what do its parts cost?

Run: python benchmarks/laban.py [folder of clips]

One core: the features of 600 frames at 30 frames a second (the 20 seconds of a dance of Aristidou et al.
2017) and of as many seconds at 120; the six hulls of every frame beside their peer, Qhull frame by frame.
Two cores: 108 files from BVH to table, to stay below 15 s (the paper took 45 minutes). With a folder, every
clip of it as well. The best of several runs.
"""

import resource
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from clock import best
from scipy.spatial import ConvexHull

import mien
from mien.analysis.effort import effort
from mien.analysis.hulls import hull_volumes
from mien.analysis.laban import VOLUMES, features
from mien.batch import Subject, analyse_files
from mien.kinematics.body import Body
from mien.kinematics.landmarks import INDEX, landmarks
from mien.samples import knock, turn, walk, wave

CLIPS, SECONDS, RUNS = 108, 599 / 30.0, 5


def processor():
    """Return the seconds of processor time of finished child processes."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def one_clip():
    for fps in (30.0, 120.0):
        motion = walk(seconds=SECONDS, fps=fps).motion
        body = Body.of(motion)
        took = best(lambda m=motion, b=body: features(m, body=b))
        also = best(lambda m=motion, b=body: effort(m, body=b))
        print(f"{len(motion)} frames at {fps:.0f} fps: features {took:.0f} ms, Effort {also:.0f} ms")


def hulls():
    motion = walk(seconds=SECONDS, fps=30.0).motion
    points = landmarks(motion, Body.of(motion)).points
    groups = [[INDEX[name] for name in group] for group in VOLUMES]

    def peer():
        return np.array([[ConvexHull(p[group]).volume for group in groups] for p in points])

    ours, theirs = best(lambda: hull_volumes(points, groups)), best(peer, runs=2)
    differ = np.abs(hull_volumes(points, groups) / peer() - 1.0).max()
    print(f"six hulls a frame: {ours:.0f} ms, Qhull {theirs:.0f} ms; they differ by {differ:.0e}")


def many(paths):
    start, before = time.perf_counter(), processor()
    done = list(analyse_files([Subject(path) for path in paths], workers=2))
    took, worked = time.perf_counter() - start, processor() - before
    frames = sum(d.frames for d in done)
    failed = sum(bool(d.error) for d in done)
    print(f"{len(done)} files, {frames} frames, two processes: {took:.1f} s ({failed} failed)")
    print(f"  {worked:.1f} s of processor time, so {worked / 2:.1f} s on two cores that nobody else uses")


def main():
    one_clip()
    hulls()
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{i}.bvh" for i in range(CLIPS)]
        for i, path in enumerate(paths):
            sample = (walk, turn, knock, wave)[i % 4]
            motion = sample(seconds=SECONDS, fps=30.0, heading=0.05 * i).motion
            mien.save(motion, path)
        many(paths)
    for folder in sys.argv[1:]:
        many(sorted(Path(folder).rglob("*.bvh")))


if __name__ == "__main__":
    main()
