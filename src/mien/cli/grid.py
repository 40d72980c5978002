"""``mien grid``: the nine variants of a clip, or one at any point between them."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import MienError
from . import arguments as a
from .report import located, note, show_json

if TYPE_CHECKING:
    from ..batch import Job
    from ..recipe import Step
    from ..styles.grid import Grid

FOLDER = "_grid"  # behind a clip's name: the folder of its nine
ENGINE_FILES = (".json", ".tres")
At = Annotated[
    str,
    typer.Option(
        metavar="P,Q",
        help="Write one clip, at a point of the thesis's square: P is 0 for short paths, 1 for the clip's "
        "own, 2 for long ones; Q is 0 for added acceleration, 1 for the clip's own timing, 2 for constant "
        "speed.",
    ),
]
Short = Annotated[float, typer.Option(help="Gain of the paths at P 0 (0 to 1).")]
Long = Annotated[float, typer.Option(help="Gain of the paths at P 2 (1 to 4).")]
Acceleration = Annotated[float, typer.Option(help="Added acceleration at Q 0, and evenness at Q 2 (0 to 1).")]
Rests = Annotated[
    bool, typer.Option("--rests/--no-rests", help="Long rests count as pauses, so that a knock rushes, too.")
]
Mode = Annotated[
    str,
    typer.Option(
        metavar="timemap|bilinear", help="Blend the maps of time, or the motions, as in the thesis."
    ),
]


def grid(
    clip: a.Clip,
    at: At = "",
    short: Short = 0.3,
    long: Long = 1.5,
    acceleration: Acceleration = 1.0,
    rests: Rests = True,
    mode: Mode = "timemap",
    out: a.Out = None,
    force: a.Force = False,
    dry_run: a.DryRun = False,
    as_json: a.Json = False,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
    *,
    flags: Mapping[str, Mapping[str, Any]],
) -> None:
    """Vary the paths and the timing of a clip: nine variants, or one at any point between them.

    Writes the nine into a folder, named by their letters in the thesis (A to I) and in words, each with its
    recipe beside it, and how an engine blends them (CLIP.blendspace.json, and CLIP.blendspace.tres for
    Godot). With --at writes the one clip. A posture is added last, and the feet are put back after it.

    mien grid walk.bvh -o square/

    mien grid walk.bvh --at 1.4,0.3 --posture-head 10
    """
    from ..batch import doubts
    from .inputs import existing, refuse_existing

    options = {"short": short, "long": long, "acceleration": acceleration, "rests": rests, "mode": mode}
    targets = _targets(existing(clip), at, out, options)
    engine = [] if at else [targets[0].file.parent / f"{clip.stem}.blendspace{kind}" for kind in ENGINE_FILES]
    posture = _posture(flags)
    if dry_run:
        _plan(clip, targets, engine, posture, force, as_json)
        return
    jobs = [_job(clip, target.file, fps, salvage, map_file) for target in targets]
    if not force:
        refuse_existing([*(file for job in jobs for file in job.files), *engine])
    square = _square(jobs[0], options)
    targets[0].file.parent.mkdir(parents=True, exist_ok=True)
    for job, target in zip(jobs, targets, strict=True):
        _write(job, square, target, posture)
    for file in engine:
        _write_engine_file(file, square, targets, posture)
    notes = [located(clip, doubt) for doubt in doubts(jobs[0], square.motion, square.motion)]
    for text in notes:
        note(f"mien: note: {text}")
    _report(clip, targets, engine, notes, as_json)


@dataclass(frozen=True)
class _Target:
    """A clip to write: where, which point of the square it is, and its letter if it is one of the nine."""

    file: Path
    path: float
    timing: float
    letter: str = ""


def _targets(clip: Path, at: str, out: Path | None, options: Mapping[str, Any]) -> list[_Target]:
    """Return what is to be written; raise ``MienError`` for what does not fit, before a clip is read."""
    from ..edits.registry import EDITS
    from ..formats import files
    from ..styles.blend_space import file_stem
    from ..styles.grid import NINE
    from .inputs import STDOUT, Input, label, outputs

    if clip.is_dir():
        raise MienError(f"{clip} is a folder; mien grid takes one clip")
    EDITS["grid"].complete(options)
    if at:
        path, timing = _point(at)
        name = label(f"grid_{path:g}_{timing:g}", 1.0, (), None)
        return [_Target(outputs([Input(clip)], out, label=name)[0], path, timing)]
    folder = clip.with_name(f"{clip.stem}{FOLDER}") if out is None else out
    if folder == STDOUT or (folder.suffix and not folder.is_dir()):
        raise MienError(f"{folder}: the nine clips need a folder, such as -o {clip.stem}{FOLDER}")
    files.check_folder(folder)
    return [
        _Target(folder / f"{file_stem(clip.stem, c.letter)}{clip.suffix}", c.path, c.timing, c.letter)
        for c in NINE
    ]


def _point(text: str) -> tuple[float, float]:
    """Return the two coordinates of ``--at``."""
    try:
        path, timing = (float(number) for number in text.split(","))
    except ValueError:
        raise MienError(f"--at needs two numbers from 0 to 2, e.g. 1.4,0.3, got {text!r}") from None
    if not (0.0 <= path <= 2.0 and 0.0 <= timing <= 2.0):
        raise MienError(f"--at needs two numbers from 0 to 2, e.g. 1.4,0.3, got {text!r}")
    return path, timing


def _posture(flags: Mapping[str, Mapping[str, Any]]) -> "tuple[Step, ...]":
    """Return the steps that flags of the posture mean, checked, with the feet put back after them."""
    from ..edits import pipeline
    from .flags import compose

    return tuple(pipeline.check(step) for step in compose((), flags, foot_plant=True))


def _job(clip: Path, target: Path, fps: float | None, salvage: bool, map_file: Path | None) -> "Job":
    """Return one clip as a job of its own, which says how it is read and written."""
    from ..batch import Job
    from ..recipe import Recipe

    read: dict[str, Any] = {} if fps is None else {"fps": fps}
    read |= {"salvage": True} if salvage else {}
    return Job(clip, target, Recipe("grid", ()), read=read, body=a.read_map(map_file))


def _square(job: "Job", options: Mapping[str, Any]) -> "Grid":
    """Return the square of the clip; errors begin with the path as it was given."""
    from ..batch import opened
    from ..styles.grid import grid as square_of

    try:
        return square_of(opened(job.source, body=job.body, **job.read), **options)
    except MienError as error:
        raise MienError(located(job.source, str(error))) from None


def _write(job: "Job", square: "Grid", target: _Target, posture: "Sequence[Step]") -> None:
    """Write one clip, and beside it the recipe that makes it."""
    from ..batch import provenance
    from ..emotion.files import sidecar_of
    from ..formats import files, save

    motion = square.at(target.path, target.timing, posture=posture)
    save(motion, target.file, force=True)
    files.write(sidecar_of(job.target), provenance(job, motion).encode())


def _write_engine_file(
    file: Path, square: "Grid", targets: "Sequence[_Target]", posture: "Sequence[Step]"
) -> None:
    """Write how an engine blends the nine: JSON for any, .tres for Godot."""
    from importlib.metadata import version

    from ..formats import files
    from ..styles.blend_space import describe, godot

    if file.suffix == ".tres":
        text = godot({target.letter: target.file.stem for target in targets})
    else:
        source: dict[str, Any] = {"clip": square.motion.name, "mien": version("mien")}
        if posture:
            source["posture"] = [{"edit": step.edit, **step.parameters} for step in posture]
        names = {target.letter: target.file.name for target in targets}
        text = json.dumps(describe(square, names, source=source), indent=2, ensure_ascii=False) + "\n"
    files.write(file, text.encode())


def _plan(
    clip: Path,
    targets: "Sequence[_Target]",
    engine: "Sequence[Path]",
    posture: "Sequence[Step]",
    force: bool,
    as_json: bool,
) -> None:
    """Say what would be written, without reading the clip."""
    from dataclasses import asdict

    if as_json:
        files = [_as_data(target) | {"exists": target.file.exists()} for target in targets]
        more = {"posture": [asdict(step) for step in posture], "engine_files": [str(f) for f in engine]}
        show_json({"dry_run": True, "input": str(clip), "files": files} | more)
        return
    needs = "exists: will be replaced" if force else "exists: needs --force"
    points = [f": path {target.path:g}, timing {target.timing:g}" for target in targets]
    for file, point in zip(
        [t.file for t in targets] + list(engine), points + [""] * len(engine), strict=True
    ):
        typer.echo(f"{clip} -> {file}{point}{f' ({needs})' if file.exists() else ''}")


def _report(
    clip: Path, targets: "Sequence[_Target]", engine: "Sequence[Path]", notes: "Sequence[str]", as_json: bool
) -> None:
    if as_json:
        made = {"input": str(clip), "files": [_as_data(target) for target in targets]}
        show_json(made | {"engine_files": [str(file) for file in engine], "notes": list(notes)})
        return
    for file in (*(target.file for target in targets), *engine):
        typer.echo(str(file))


def _as_data(target: _Target) -> dict[str, Any]:
    letter = {"letter": target.letter} if target.letter else {}
    return {"output": str(target.file), "at": [target.path, target.timing]} | letter
