"""Do the feet stay? Every preset on every real walk and run: slide and sink against the source clip.

Run: python benchmarks/feet.py [--presets sad,angry] [--all] [--no-safe] [--every 4] [folder of clips]

What an edit at another tempo is compared with is the source at that tempo.

For each contact of the source: how far the planted point moves over the ground, in the edit minus in
the source (cm). For each frame: how much deeper the lowest point of each foot is than the lowest level
the source reaches (cm). Beside these, measures that do not know our contacts: the share of frames
counted as skating by the definition used with SMooDi (height below 5 cm twice running, speed above
0.5 m/s now and on a five-frame mean), in the source and in the edit; and the jerk of the ankles.
"""

import argparse
import os
import re
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

import mien
from mien.emotion.presets import PRESETS
from mien.errors import MienError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, foot_points, slides
from mien.kinematics.fk import end_positions, world

DATA = Path(os.environ.get("MIEN_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))
# Clips that walk or run, by file name or (CMU) by number.
MOVING = re.compile(
    r"walk|run|(?<!\d)(02_0[13]|05_01|05_0[5-9]|07_\d\d|09_\d\d|10_0[4-6]|12_0[1-3]|16_\d\d|35_\d\d|69_\d\d)|"
    r"00[27]_0|neutral_01|sexy_01|strutting_01|angry_13|depressed_1|old_13|neutral_16|10_02",
    re.I,
)


def skating(motion, body):
    """Share of frames in which a foot is low and fast."""
    points = foot_points(motion, body, *world(motion)) * body.metres_per_unit
    height = points @ body.up
    height = height - np.percentile(height, 2, axis=0)
    flat = points - (points @ body.up)[..., None] * body.up
    speed = np.linalg.norm(np.diff(flat, axis=0), axis=-1) * motion.fps
    width = min(5, len(speed))
    mean = np.apply_along_axis(lambda s: np.convolve(s, np.ones(width) / width, "same"), 0, speed)
    low = (height[1:] < 0.05) & (height[:-1] < 0.05)
    return float((low & (speed > 0.5) & (mean > 0.5)).any(axis=(1, 2)).mean()) if len(speed) else 0.0


def lowest(motion, body):
    """Height of the lowest point of each foot in each frame (T, 2)."""
    rotations, positions = world(motion)
    ends, skeleton = end_positions(motion, rotations, positions), motion.skeleton
    out = []
    for side in ("left", "right"):
        joints = skeleton.descendants(body.roles[f"{side}_ankle"])
        tips = np.isin(skeleton.end_parents, joints)
        out.append(np.concatenate([positions[:, joints], ends[:, tips]], axis=1).dot(body.up).min(axis=1))
    return np.stack(out, axis=1)


def jerk(motion, body):
    ankles = world(motion)[1][:, [body.roles["left_ankle"], body.roles["right_ankle"]]]
    return (
        float(np.sqrt((np.diff(ankles, 3, axis=0) ** 2).sum(-1)).mean()) * motion.fps**3
        if len(ankles) > 3
        else 0.0
    )


def knee_rate(motion, body):
    """Fastest knee turn in degrees a frame."""
    knees = [body.roles["left_knee"], body.roles["right_knee"]]
    q = motion.rotations[:, knees]
    return (
        float(np.degrees(2 * np.arccos(np.clip(np.abs((q[1:] * q[:-1]).sum(-1)), 0, 1))).max())
        if len(q) > 1
        else 0.0
    )


def measure(job):
    """One clip under all presets: a list of rows."""
    path, names, safe = job
    try:
        source = mien.load(path)
        body = Body.of(source)
    except MienError as error:
        return [(str(path), "-", None, str(error))]
    if len(source) < 5:
        return []
    cm = 100 * body.metres_per_unit
    rows, known = [], {}
    for name in names:
        edited = mien.edit(source, name, safe=safe)
        reference = edited.reference if edited.reference is not None else source
        rhythm = reference.rotations.tobytes()
        if rhythm not in known:
            contacts = detect(reference, body=body)
            known[rhythm] = (
                contacts,
                slides(reference, contacts, body),
                lowest(reference, body),
                (skating(reference, body), jerk(reference, body), knee_rate(reference, body)),
            )
        contacts, own, floor, base = known[rhythm]
        extra = slides(edited, contacts, body) - own
        sink = np.minimum(floor, floor.min(axis=0)) - lowest(edited, body)
        rows.append(
            (
                str(path),
                name,
                (
                    float(extra.max(initial=0.0)) * cm,
                    float(own.max(initial=0.0)) * cm,
                    float(sink.max()) * cm,
                    base[0],
                    skating(edited, body),
                    jerk(edited, body) / max(base[1], 1e-12),
                    knee_rate(edited, body),
                    base[2],
                    len(own),
                ),
                "",
            )
        )
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", nargs="?", type=Path, default=DATA)
    parser.add_argument("--presets", default=",".join(PRESETS))
    parser.add_argument("--all", action="store_true", help="every clip, not only walks and runs")
    parser.add_argument("--no-safe", action="store_true", help="as the steps of the presets leave the feet")
    parser.add_argument("--every", type=int, default=1, help="only every so manieth clip")
    parser.add_argument("--worst", type=int, default=15)
    options = parser.parse_args()
    files = sorted(options.folder.rglob("*.bvh"))
    files = [f for f in files if "malformed" not in f.parts and "stylized_outputs" not in f.parts]
    if not options.all:
        files = [f for f in files if MOVING.search(f.name)]
    names = options.presets.split(",")
    jobs = [(f, names, not options.no_safe) for f in files[:: options.every]]
    with ProcessPoolExecutor() as pool:
        rows = [row for found in pool.map(measure, jobs) for row in found]
    for path, _, values, message in rows:
        if values is None:
            print(f"refused {Path(path).name}: {message.splitlines()[0][:150]}")
    rows = [r for r in rows if r[2] is not None]
    report(rows, names, options.worst)


def report(rows, names, worst):
    print(f"{len({r[0] for r in rows})} clips")
    head = (
        "slide over source: worst, share of clips within 0.2 cm; sink over source: worst, share within 1 cm; "
    )
    print(
        head
        + "skating frames before, after; ankle jerk ratio, median and 95th percentile; fastest knee deg/frame"
    )
    heads = ("slide cm", "<=0.2", "sink cm", "<=1", "skate0", "skate", "jerk", "p95", "knee0", "knee")
    print(f"{'preset':<20}" + "".join(f"{h:>9}" for h in heads))
    for name in names:
        v = np.array([r[2] for r in rows if r[1] == name])
        shown = [
            f"{v[:, 0].max():.2f}",
            f"{(v[:, 0] <= 0.2).mean():.1%}",
            f"{v[:, 2].max():.2f}",
            f"{(v[:, 2] <= 1).mean():.1%}",
            f"{v[:, 3].mean():.1%}",
            f"{v[:, 4].mean():.1%}",
            f"{np.median(v[:, 5]):.2f}",
            f"{np.percentile(v[:, 5], 95):.2f}",
            f"{v[:, 7].max():.0f}",
            f"{v[:, 6].max():.0f}",
        ]
        print(f"{name:<20}" + "".join(f"{cell:>9}" for cell in shown))
    print("\nworst slides")
    for r in sorted(rows, key=lambda r: -r[2][0])[:worst]:
        print(f"  {r[2][0]:6.2f} cm (source {r[2][1]:.2f}) {r[1]:<20} {r[0]}")
    print("worst sinks")
    for r in sorted(rows, key=lambda r: -r[2][2])[:worst]:
        print(f"  {r[2][2]:6.2f} cm {r[1]:<20} {r[0]}")
    print("fastest knees beside the source, degrees a frame")
    for r in sorted(rows, key=lambda r: r[2][7] - r[2][6])[:worst]:
        print(f"  {r[2][6]:6.1f} (source {r[2][7]:.1f}) {r[1]:<20} {r[0]}")
    failed = [r for r in rows if r[2][0] > 0.2 or r[2][2] > 1.0]
    print(f"\n{len(rows) - len(failed)} passed, {len(failed)} failed")
    sys.exit(bool(failed))


if __name__ == "__main__":
    main()
