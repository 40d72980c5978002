"""How fast: forward kinematics and whole presets on a long clip, with memory, beside a peer.

Run: python benchmarks/edits.py [--frames 10000]

Prints milliseconds (the best of several runs), the ratio to the peer measured in the same run, and the
peak of memory as a multiple of the clip's own arrays. The peer of forward kinematics is the same chain
through SciPy's ``Rotation``; whole presets have no peer, their budget is 0.5 s and six times the arrays.
Beside it stands the time with what makes them safe.
"""

import argparse
import tracemalloc

import numpy as np
from clock import best
from scipy.spatial.transform import Rotation

import mien
from mien.kinematics.fk import fk
from mien.samples import walk


def peak(job):
    """Return the largest amount of memory in use during the job beyond what was there, in bytes."""
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    tracemalloc.reset_peak()
    kept = job()
    high = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    del kept
    return high - before


def scipy_fk(rotations, translations, parents):
    """The peer: one Rotation object for each joint."""
    world, positions = [], []
    for j, p in enumerate(parents):
        local = Rotation.from_quat(rotations[:, j])
        if p < 0:
            world.append(local)
            positions.append(translations[:, j])
        else:
            world.append(world[p] * local)
            positions.append(positions[p] + world[p].apply(translations[:, j]))
    return np.stack([w.as_quat() for w in world], axis=1), np.stack(positions, axis=1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--frames", type=int, default=10_000)
    parser.add_argument("--presets", default="sad,angry,excited,tired,s0/sad,s0/tired")
    options = parser.parse_args()
    fps = 60.0
    motion = walk(seconds=(options.frames - 1) / fps, fps=fps).motion
    size = motion.rotations.nbytes + motion.translations.nbytes
    arrays = (np.array(motion.rotations), np.array(motion.translations), motion.skeleton.parents)
    print(f"{len(motion)} frames x {len(motion.skeleton)} joints, arrays {size / 2**20:.1f} MiB")
    ours, theirs = best(lambda: fk(*arrays)), best(lambda: scipy_fk(*arrays), runs=3)
    print(f"forward kinematics {ours:8.1f} ms   SciPy Rotation {theirs:8.1f} ms   ratio {ours / theirs:.2f}")
    for name in options.presets.split(","):
        took = best(lambda name=name: mien.edit(motion, name, safe=False), runs=3)
        whole = best(lambda name=name: mien.edit(motion, name), runs=1)
        memory = peak(lambda name=name: mien.edit(motion, name, safe=False))
        print(
            f"preset {name:<21}{took:8.1f} ms   safe {whole:8.1f} ms   peak {memory / size:5.1f} x the arrays"
        )


if __name__ == "__main__":
    main()
