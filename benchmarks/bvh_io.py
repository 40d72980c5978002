"""How fast BVH is read and written, and with how much memory, beside other libraries.

Run: python benchmarks/bvh_io.py [--frames 10000]

Makes a clip of 22 joints (69 channels, six decimals), then has each library load it and save it again.
Prints the best time of several runs in milliseconds, the ratio to ours, and the peak of memory over one
load and save (Python's and NumPy's; what bvhio keeps in C++ is not seen). Our load includes the
quaternions of all joints, as does that of bvhio; pybvh keeps the angles. Each library runs
in a process of its own.
"""

import argparse
import multiprocessing
import tempfile
import time
import tracemalloc
from pathlib import Path

import numpy as np

from mien.formats import load, save


def clip(frames):
    """Return the text of a clip: a chain of 22 joints whose angles and places wander smoothly."""
    rng = np.random.default_rng(7)
    phase, rate = rng.uniform(0, 6.3, 69), rng.uniform(0.01, 0.05, 69)
    rows = 60 * np.sin(np.arange(frames)[:, None] * rate + phase) + rng.normal(0, 0.05, (frames, 69))
    lines = ["HIERARCHY"]
    for joint in range(22):
        turns = "Zrotation Xrotation Yrotation"
        channels = f"6 Xposition Yposition Zposition {turns}" if joint == 0 else f"3 {turns}"
        kind = "JOINT" if joint else "ROOT"
        lines += [f"{kind} joint{joint}", "{", "OFFSET 0.0 10.0 0.0", f"CHANNELS {channels}"]
    lines += ["End Site", "{", "OFFSET 0.0 5.0 0.0", "}"] + ["}"] * 22
    lines += ["MOTION", f"Frames: {frames}", "Frame Time: 0.008333"]
    return "\n".join([*lines, *(" ".join(f"{x:.6f}" for x in row) for row in rows), ""])


def ours(path):
    return load(path), lambda clip, out: save(clip, out, force=True)


def edited(path):
    """Load and turn every joint, so that saving converts all of them."""
    motion = load(path)
    turned = motion.rotations * [-1.0, 1.0, -1.0, 1.0]
    return motion.with_(rotations=turned), lambda clip, out: save(clip, out, force=True)


def by_pybvh(path):
    import pybvh

    return pybvh.read_bvh_file(path), pybvh.write_bvh_file


def by_bvhio(path):
    import bvhio

    return bvhio.readAsBvh(str(path)), lambda clip, out: bvhio.writeBvh(str(out), clip)


READERS = {"mien": ours, "mien, all edited": edited, "pybvh": by_pybvh, "bvhio": by_bvhio}


def measure(name, path, runs):
    """Return load and save times in milliseconds, and the memory peak in MiB, in a process of its own."""
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        return pool.apply(_measure, (name, path, runs))


def _measure(name, path, runs):
    reader = READERS[name]
    reader(path.with_name("small.bvh"))  # imports and caches
    loads, saves = [], []
    for _ in range(runs):
        start = time.perf_counter()
        held, write = reader(path)
        loads.append(time.perf_counter() - start)
        start = time.perf_counter()
        write(held, path.with_name("out.bvh"))
        saves.append(time.perf_counter() - start)
    del held, write
    tracemalloc.start()
    held, write = reader(path)
    write(held, path.with_name("out.bvh"))
    return 1000 * min(loads), 1000 * min(saves), tracemalloc.get_traced_memory()[1] / 2**20


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--frames", type=int, default=10_000)
    frames = parser.parse_args().frames
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "clip.bvh"
        path.write_text(clip(frames))
        path.with_name("small.bvh").write_text(clip(10))
        print(f"{frames} frames x 69 channels, {path.stat().st_size / 2**20:.1f} MiB")
        print(f"{'':18}{'load ms':>9}{'ratio':>7}{'save ms':>9}{'ratio':>7}{'peak MiB':>10}")
        base = None
        for name in READERS:
            load_ms, save_ms, memory = measure(name, path, runs=3 if name == "bvhio" else 9)
            base = base or (load_ms, save_ms)
            ratios = load_ms / base[0], save_ms / base[1]
            print(f"{name:18}{load_ms:9.1f}{ratios[0]:7.1f}{save_ms:9.1f}{ratios[1]:7.1f}{memory:10.0f}")


if __name__ == "__main__":
    main()
