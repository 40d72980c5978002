"""The square of nine: how fast, how much memory, do the feet stay, do limbs stay on their paths.

Run: python benchmarks/grid.py [--feet [folder of clips]]

Speed is that of ten seconds of 22 joints at 60 frames a second: microseconds a frame (best of several
runs; the budget is 50), beside the peer measured in the same run: the edits done from scratch at the same
point. Memory is a multiple of the clip's own arrays. With ``--feet``, on every clip of a folder and at
points between the nine: how far planted feet slide beyond the source, how deep they sink (cm), and how far
the right arm leaves its path in either mode (degrees, the largest of a clip).
"""

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from clock import best
from edits import peak
from feet import lowest

import mien
from mien.errors import MienError
from mien.kinematics.body import Body
from mien.kinematics.bones import main_bones
from mien.kinematics.contacts import detect, slides
from mien.kinematics.lead_in import without_lead_in
from mien.rotations import directions
from mien.samples import walk

DATA = Path(os.environ.get("MIEN_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))
POINTS = ((0.5, 1.0), (0.25, 0.5), (0.75, 1.8), (1.5, 1.0), (1.25, 0.2), (1.75, 1.5))


def speed():
    motion = walk(seconds=599 / 60.0, fps=60.0).motion
    size = motion.rotations.nbytes + motion.translations.nbytes
    print(f"{len(motion)} frames x {len(motion.skeleton)} joints, arrays {size / 2**20:.1f} MiB")
    for mode in ("timemap", "bilinear"):
        took, memory = (
            best(lambda m=mode: mien.grid(motion, mode=m), runs=3),
            peak(lambda m=mode: mien.grid(motion, mode=m)),
        )
        print(f"{mode}: made in {took:.0f} ms, peak {memory / size:.1f} x the arrays")
        square = mien.grid(motion, mode=mode)
        for path, timing in ((1.4, 0.3), (0.3, 1.7), (1.4, 1.0), (2.0, 0.3)):
            steps = [
                mien.Step("path_length", {"mid": 1.0 + 0.5 * (path - 1.0) if path > 1 else 0.3 + 0.7 * path}),
                mien.Step("foot_plant"),
                mien.Step("timing", {"acceleration": 1.0 - timing, "rests": True}),
            ]
            ours = best(lambda s=square, p=path, q=timing: s.at(p, q), runs=20)
            peer = best(lambda s=steps: mien.apply(motion, s), runs=3)
            memory = peak(lambda s=square, p=path, q=timing: s.at(p, q))
            print(
                f"  at {path:g}, {timing:g}: {1000 * ours / len(motion):5.1f} us a frame, "
                f"peak {memory / size:.1f} x the arrays; from scratch {1000 * peer / len(motion):5.1f}, "
                f"ratio {ours / peer:.3f}"
            )
        print(f"  one frame alone: {best(lambda s=square: s.frame(300, 1.4, 0.3), runs=50):.2f} ms")


def off_path(source, shown, body):
    """Largest distance of the right arm's direction vectors from the curve they draw in the source."""
    joints = list(body.limbs["right_arm"])
    u, v = (axis[joints] for axis in directions.axes(main_bones(source.skeleton)))
    curve, points = (
        directions.encode(m.rotations[:, joints], u, v).reshape(len(m), -1) for m in (source, shown)
    )
    start, step = curve[:-1], np.diff(curve, axis=0)
    square = np.maximum((step**2).sum(-1), 1e-30)
    far = 0.0
    for point in points:
        along = np.clip(((point - start) * step).sum(-1) / square, 0.0, 1.0)
        far = max(far, np.linalg.norm(point - start - along[:, None] * step, axis=-1).min())
    return float(np.degrees(far))


def measure(path):
    """One clip: worst slide and sink at points between the nine, and the arm's way off its path."""
    try:
        motion = mien.load(path)[:3000]
        body = Body.of(motion)
        squares = {mode: mien.grid(motion, mode=mode) for mode in ("timemap", "bilinear")}
    except MienError:
        return None
    if len(motion) < 5:
        return None
    still = squares["timemap"].still
    source, cm = without_lead_in(motion, still), 100.0 * body.metres_per_unit
    contacts = detect(source, body=body)
    own, floor = slides(source, contacts, body), lowest(source, body).min(axis=0)
    slide, sink = 0.0, 0.0
    for path_, timing in POINTS:
        shown = without_lead_in(squares["timemap"].at(path_, timing), still)
        slide = max(slide, float((slides(shown, contacts, body) - own).max(initial=0.0)) * cm)
        sink = max(sink, float((floor - lowest(shown, body)).max()) * cm)
    off = [off_path(source, without_lead_in(s.at(1.0, 1.5), still), body) for s in squares.values()]
    return path.name, slide, sink, *off


def feet(folder):
    files = [f for f in sorted(folder.rglob("*.bvh")) if not {"malformed", "stylized_outputs"} & {*f.parts}]
    with ProcessPoolExecutor() as pool:
        rows = [row for row in pool.map(measure, files) if row]
    if not rows:
        sys.exit(f"no clips in {folder}")
    table = np.array([row[1:] for row in rows])
    print(f"{len(rows)} clips, {len(POINTS)} points between the nine in each")
    for number, what in enumerate(("slide, cm", "sink, cm", "off path timemap", "off path bilinear")):
        column = table[:, number]
        worst = rows[int(column.argmax())][0]
        print(
            f"  {what:<18} median {np.median(column):.3f}, 95 % {np.percentile(column, 95):.3f}, "
            f"worst {column.max():.3f} ({worst})"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--feet", nargs="?", type=Path, const=DATA, help="folder of clips")
    options = parser.parse_args()
    feet(options.feet) if options.feet else speed()


if __name__ == "__main__":
    main()
