"""Does an edit break the body? Every preset on every real clip: checks failed before, bare, mended and safe.

Run: python benchmarks/safe.py [--presets sad,angry] [--every 4] [--networks FOLDER] [folder of clips]

The first table has the share of clips, or of edits, that fail each check of ``mien check``: the captures by
themselves (by the wide limits for clips without a source), then edits against the same capture at the same
tempo: as the steps of the preset leave them, after ``repair``, and as presets are done by default. Below it,
how much was taken back. ``--networks`` names a folder of clips that neural style transfer made: the second
table has what both leave behind in absolute numbers, as nobody has the networks' sources.
"""

import argparse
import os
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import mien
from mien.analysis.checks import jitter
from mien.analysis.checks.check import Measured
from mien.analysis.checks.report import CHECKS, check, compare_scenes, measured
from mien.analysis.checks.scene import Scene
from mien.curve import evaluate
from mien.emotion.presets import PRESETS
from mien.emotion.safe import LIMBS, safe
from mien.errors import MienError
from mien.kinematics.contacts import slides

DATA = Path(os.environ.get("MIEN_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))
WALKS = ("walk", "02_0", "neutral_01")  # what the networks' clips show too
LEFT_OUT = ("malformed", "stylized_outputs")


@dataclass(frozen=True)
class Row:
    """One edit of one clip: the checks that fail at each stage, and what stands in absolute numbers."""

    clip: str
    preset: str
    bare: tuple[str, ...]
    repaired: tuple[str, ...]
    safe: tuple[str, ...]
    taken_back: float
    seconds: float
    frames: int
    found: dict[str, float]


def absolute(motion: mien.Motion) -> dict[str, float]:
    """Return what a viewer would see, without a source.

    Slide of the mean and of the worst contact (cm), share of frames that skate (%), deepest sinking or
    hovering (cm), how far joints are beyond their range (degrees), trembling above 8 Hz (mm) alone and for
    each metre a second that head, hands and feet go, and the share of movement above 12.5 Hz (%).
    """
    scene = Scene.of(motion.with_(reference=None, history=()))
    report = compare_scenes(scene, None)
    each = slides(scene.motion, scene.contacts, scene.body) * scene.centimetres
    places = scene.tips[1] * scene.body.metres_per_unit
    speed = np.linalg.norm(np.diff(places, axis=0), axis=-1) * motion.fps
    tremble = float(np.mean(jitter.measure(scene).values))
    return {
        "slide, mean": float(each.mean()) if len(each) else 0.0,
        "slide, worst": report["foot_slide"].value,
        "skating": 100 * report["foot_slide"].facts["skating frames"][1],
        "floor": report["floor"].value,
        "limits": report["limits"].value,
        "trembling": tremble,
        "per m/s": tremble / max(float(speed.mean()) if len(speed) else 0.0, 0.05),
        "above 12.5 Hz": 100 * report["jitter"].facts["share above 12.5 Hz"][1],
    }


def taken_back(motion: mien.Motion) -> float:
    """Return the mean share of the original, over time and limbs, that safe edits brought back."""
    steps = [step for step in motion.history if step.edit == "restore"]
    shares = [
        float(np.mean(evaluate(s.parameters["amount"], motion.times)))
        * (len(s.parts) / len(LIMBS) if s.parts else 1.0)
        for s in steps
    ]
    return sum(shares)


def measure(job: tuple[Path, list[str], bool]) -> tuple[str, tuple[str, ...], list[Row]]:
    """Return the name of a clip, what it fails by itself, and its edits."""
    path, names, look = job
    try:
        source = mien.load(path, salvage=True)
        alone = check(source).failed
    except MienError as error:
        return path.name, (str(error).splitlines()[0],), []
    known: dict[bytes, tuple[Scene, dict[str, Measured]]] = {}

    def failed(motion: mien.Motion) -> tuple[str, ...]:
        reference = motion.reference if motion.reference is not None else source
        rhythm = reference.rotations.tobytes()
        if rhythm not in known:
            scene = Scene.of(reference)
            known[rhythm] = scene, measured(scene)
        before, values = known[rhythm]
        return compare_scenes(Scene.of(motion, source=before), before, known=values).failed

    rows = []
    for name in names:
        bare = mended = done = mien.edit(source, name, safe=False)
        first = second = last = failed(bare)
        start = time.perf_counter()
        if first:  # an edit that passes is safe as it is
            done = safe(bare)
        seconds = time.perf_counter() - start
        if first:
            mended = mien.apply(bare, [mien.Step("repair")])
            second, last = failed(mended), failed(done)
        back, found = taken_back(done), absolute(done) if look else {}
        rows.append(Row(path.name, name, first, second, last, back, seconds, len(done), found))
    return path.name, alone, rows


def report(clips: dict[str, tuple[str, ...]], rows: list[Row]) -> None:
    """Print the tables."""
    stages = {
        "bare": [r.bare for r in rows],
        "repaired": [r.repaired for r in rows],
        "safe": [r.safe for r in rows],
    }
    alone = list(clips.values())
    print(f"{len(clips)} clips, {len(rows)} edits; share that fails, in %\n")
    print(f"| check | captures alone | {' | '.join(stages)} |\n| --- | --- | --- | --- | --- |")
    for name in CHECKS:
        cells = [100 * np.mean([name in failed for failed in f]) for f in (alone, *stages.values())]
        print(f"| `{name}` | " + " | ".join(f"{cell:.1f}" for cell in cells) + " |")
    cells = [100 * np.mean([bool(failed) for failed in f]) for f in (alone, *stages.values())]
    print("| any | " + " | ".join(f"{cell:.1f}" for cell in cells) + " |\n")
    back = np.array([r.taken_back for r in rows])
    some = back[back > 0]
    print(f"Taken back: something in {100 * np.mean(back > 0):.1f} % of the edits, there {some.mean():.2f}")
    print(f"of the whole on average; more than a third in {100 * np.mean(back > 1 / 3):.1f} %")
    own = np.array([r.taken_back for r in rows if not r.preset.startswith("s0/")])
    if len(own):
        print(f"Of the presets that are not the thesis's: something in {100 * np.mean(own > 0):.1f} %")
    seconds, frames = sum(r.seconds for r in rows), sum(r.frames for r in rows)
    print(f"Checking, mending and taking back: {1000 * seconds / frames:.2f} ms a frame of all edits")
    still = Counter((r.clip, r.preset, name) for r in rows for name in r.safe)
    for clip, preset, name in still:
        print(f"still fails: {clip} {preset} {name}")


def compare(rows: list[Row], folder: Path) -> None:
    """Print what edits and networks leave behind."""
    networks = []
    for path in sorted(folder.rglob("*.bvh")):
        networks.append((path.name, absolute(mien.load(path))))
    walks = [r for r in rows if r.found]
    names = list(networks[0][1])
    print(f"\n| | {' | '.join(names)} |\n| --- | {' | '.join('---' for _ in names)} |")
    for title, found in (
        *([(f"mien, {len(walks)} edits of walks, median", [r.found for r in walks])] if walks else []),
        (f"networks, {len(networks)} outputs, median", [f for _, f in networks]),
        *((name, [f]) for name, f in networks),
    ):
        print(f"| {title} | " + " | ".join(f"{np.median([f[n] for f in found]):.2f}" for n in names) + " |")


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", nargs="?", type=Path, default=DATA)
    parser.add_argument("--presets", default=",".join(PRESETS))
    parser.add_argument("--every", type=int, default=1, help="only every so manieth clip")
    parser.add_argument("--networks", type=Path, help="a folder of clips that networks made")
    options = parser.parse_args()
    files = [f for f in sorted(options.folder.rglob("*.bvh")) if not set(LEFT_OUT) & set(f.parts)]
    names = options.presets.split(",")
    jobs = [
        (f, names, options.networks is not None and any(word in f.name.lower() for word in WALKS))
        for f in files[:: options.every]
    ]
    clips, rows = {}, []
    with ProcessPoolExecutor() as pool:
        for name, alone, found in pool.map(measure, jobs):
            if found:
                clips[name] = alone
                rows += found
                failed = sum(bool(r.safe) for r in found)
                print(f"{name}: {len(found)} edits, {failed} of them fail when safe", file=sys.stderr)
            else:
                print(f"refused {name}: {alone[0][:150]}")
    report(clips, rows)
    if options.networks:
        compare(rows, options.networks)


if __name__ == "__main__":
    main()
