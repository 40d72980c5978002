"""``mien blend``: one clip out of several."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer

from ..errors import MienError, unknown
from . import arguments as a
from .report import note, show_json, show_table

if TYPE_CHECKING:
    from ..kinematics.alignment import Method
    from ..styles.multitarget import Mixture
    from ..styles.shares import Shares

COLUMNS = ("input", "weight", "low", "mid", "high")


def blend(
    clips: a.Clips,
    weights: Annotated[
        str,
        typer.Option(metavar="W,W", help="How much of each clip, sum 1 (default: --mid, else equal)."),
    ] = "",
    low: Annotated[
        str,
        typer.Option(metavar="W,W", help="The same for below 1 Hz: the posture (default: --weights)."),
    ] = "",
    mid: Annotated[
        str, typer.Option(metavar="W,W", help="For 1 to 12.5 Hz: the movement, and the way over the ground.")
    ] = "",
    high: Annotated[
        str, typer.Option(metavar="W,W", help="For what is above 12.5 Hz: jerks and trembling.")
    ] = "",
    align: Annotated[
        str, typer.Option(metavar="auto|steps|dtw|none", help="What brings the clips together in time.")
    ] = "auto",
    out: a.Out = None,
    force: a.Force = False,
    dry_run: a.DryRun = False,
    as_json: a.Json = False,
    sidecar: Annotated[
        bool,
        typer.Option("--sidecar/--no-sidecar", help="Write what was blended beside it (OUTPUT.blend.toml)."),
    ] = True,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
) -> None:
    """Blend clips of one skeleton, aligned in time, into one: half sad, or one's posture on another's walk.

    Writes FIRST_blend.bvh beside the first clip (or where -o says), on its skeleton and at its frame rate.
    Walks are aligned step by step, other movements by how the limbs move; what only one of the clips has
    before or after is left out. Weights below 0 and above 1 exaggerate.

    mien blend neutral.bvh sad.bvh --weights 0.5,0.5 -o half_sad.bvh

    mien blend neutral.bvh sad.bvh --low 0,1 --mid 1,0 --high 1,0 -o slumped.bvh
    """
    from ..kinematics.alignment import METHODS
    from ..styles.multitarget import mix
    from ..styles.record import record_of
    from ..styles.shares import shares
    from .inputs import expand, refuse_existing

    files = [clip.path for clip in expand(clips)]
    if len(files) < 2:
        raise MienError(f"a blend needs two clips or more, got {files[0]}; name what to blend it with")
    common = _numbers("--weights", weights)
    named = {"low": _numbers("--low", low), "mid": _numbers("--mid", mid), "high": _numbers("--high", high)}
    bands = {band: numbers for band, numbers in named.items() if numbers is not None}
    parts = shares(len(files), common, bands)
    if align not in METHODS:
        raise MienError(unknown("alignment", align, METHODS))
    target = _target(files, out)
    written = [target, record_of(target)] if sidecar else [target]
    if dry_run:
        _plan(files, target, parts, as_json, exists=any(file.exists() for file in written), force=force)
        return
    if not force:
        refuse_existing(written)
    motions = [a.opened(file, fps, salvage, map_file) for file in files]
    made = mix(motions, common, bands=bands, align=cast("Method", align))
    read = {"fps": fps, "salvage": salvage, "roles": a.read_map(map_file)}
    _write(made, files, written, read)
    _report(made, files, target, as_json, [len(motion) for motion in motions])


def _numbers(flag: str, text: str) -> list[float] | None:
    """Return the numbers of a flag, None where it is not given."""
    if not text:
        return None
    try:
        return [float(number) for number in text.split(",")]
    except ValueError:
        raise MienError(f"{flag} needs one number for each clip, such as 0.5,0.5, got {text!r}") from None


def _target(files: Sequence[Path], out: Path | None) -> Path:
    """Return the file to write: FIRST_blend.bvh beside the first clip, or in or as ``out``."""
    from .inputs import STDOUT, Input, outputs

    if out == STDOUT:
        raise MienError("a blend is written to a file; name one after -o")
    return outputs([Input(files[0])], out, label="blend")[0]


def _plan(
    files: Sequence[Path], target: Path, parts: "Shares", as_json: bool, *, exists: bool, force: bool
) -> None:
    """Say what would be blended, without reading a clip."""
    weights = [parts.of(i) for i in range(len(files))]
    if as_json:
        rows = zip(files, weights, strict=True)
        clips = [dict(zip(COLUMNS, (str(file), *numbers), strict=True)) for file, numbers in rows]
        show_json({"dry_run": True, "output": str(target), "exists": exists, "clips": clips})
        return
    shown = [[f"{weight:g}" for weight in numbers] for numbers in weights]
    show_table(COLUMNS, [(str(file), *numbers) for file, numbers in zip(files, shown, strict=True)])
    needs = "will be replaced" if force else "needs --force"
    typer.echo(f"-> {target}{f' (exists: {needs})' if exists else ''}")


def _write(made: "Mixture", files: Sequence[Path], written: Sequence[Path], read: Mapping[str, Any]) -> None:
    """Write the blend, and beside it what it was made of where ``written`` names a second file."""
    from ..formats import files as disk
    from ..formats import save
    from ..styles.record import format_record

    target, *beside = written
    record = format_record(files, target, made, read)
    target.parent.mkdir(parents=True, exist_ok=True)
    save(made.motion, target, force=True)
    for file in beside:
        disk.write(file, record.encode())


def _report(
    made: "Mixture", files: Sequence[Path], target: Path, as_json: bool, lengths: Sequence[int]
) -> None:
    """Say what was written, and what was left out of the clips."""
    from ..styles.record import ingredients

    if as_json:
        clips = ingredients(files, made)
        size = {"frames": len(made.motion), "seconds": made.motion.duration}
        show_json({"output": str(target), **size, "align": made.method, "clips": clips})
        return
    for file, (first, last), length in zip(files, made.frames.tolist(), lengths, strict=True):
        if (first, last) != (0, length - 1):
            note(f"mien: note: {file}: frames {first} to {last} of {length} are in the blend")
    typer.echo(str(target))
