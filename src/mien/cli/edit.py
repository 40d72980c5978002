"""``mien edit``: change what clips express."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import MienError
from . import arguments as a
from .report import complain, note, progress, show_json

if TYPE_CHECKING:
    from ..batch import Job, Outcome
    from ..recipe import Recipe

Emotion = Annotated[
    str | None, typer.Option("--emotion", "-e", help="An emotion word; `mien presets` lists them.")
]
RecipeFile = Annotated[
    Path | None, typer.Option("--recipe", "-r", help="A recipe file (.toml or .json), or a clip's sidecar.")
]
Strength = Annotated[
    float, typer.Option(help="How much: 0 changes nothing, 1 as written, up to 2 exaggerates.")
]
Parts = Annotated[
    str, typer.Option(help="Only these body parts, e.g. arms,head (or roles such as left_wrist).")
]
Span = Annotated[str, typer.Option(help="Only from one time to another, in seconds, e.g. 1.0,3.5.")]
FootPlant = Annotated[
    bool | None,
    typer.Option(
        "--foot-plant/--no-foot-plant",
        help="Put the feet back on the floor after pose edits (default: yes, or what --recipe says).",
    ),
]
Sidecar = Annotated[
    bool,
    typer.Option("--sidecar/--no-sidecar", help="Write what was done beside each clip (OUTPUT.recipe.toml)."),
]
Jobs = Annotated[int, typer.Option("--jobs", "-j", help="Processes to share the clips; 0 takes every core.")]


def edit(
    clips: a.Clips,
    emotion: Emotion = None,
    recipe: RecipeFile = None,
    strength: Strength = 1.0,
    parts: Parts = "",
    span: Span = "",
    foot_plant: FootPlant = None,
    out: a.Out = None,
    force: a.Force = False,
    dry_run: a.DryRun = False,
    as_json: a.Json = False,
    sidecar: Sidecar = True,
    jobs: Jobs = 1,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
    *,
    flags: Mapping[str, Mapping[str, Any]],
) -> None:
    """Change what clips express: by an emotion, a recipe, or any edit's own flags.

    Writes CLIP_EMOTION.bvh beside each clip (or where -o says) with the same skeleton, channels and
    frame rate, and says in CLIP_EMOTION.bvh.recipe.toml how it was made.

    mien edit walk.bvh --emotion sad --strength 0.8

    mien edit "takes/*.bvh" --emotion tired --posture-head 10 -o tired/
    """
    from ..batch import Job, edit_files
    from .inputs import expand, outputs, refuse_existing

    made = _recipe(emotion, recipe, flags, foot_plant)
    found = expand(clips)
    targets = outputs(found, out, label=made.name, force=force)
    read = {"fps": fps, "salvage": salvage}
    todo = [
        Job(
            clip.path,
            target,
            made,
            strength=_checked_strength(strength),
            parts=_parts(parts),
            span=_span(span),
            read=read,
            body=a.read_map(map_file),
            sidecar=sidecar,
            force=force,
        )
        for clip, target in zip(found, targets, strict=True)
    ]
    if sidecar and not force:
        from ..batch import sidecar_of

        refuse_existing(sidecar_of(job.target) for job in todo)
    if dry_run:
        _plan(todo, as_json)
        return
    workers = jobs or os.cpu_count() or 1
    done = list(progress(edit_files(todo, workers=workers), total=len(todo), doing="editing"))
    _report(done, as_json)


def _recipe(
    emotion: str | None, path: Path | None, flags: Mapping[str, Mapping[str, Any]], foot_plant: bool | None
) -> "Recipe":
    """Return what is to be done, checked before a single clip is read."""
    from dataclasses import replace

    from ..edits import pipeline
    from ..emotion.resolve import resolve
    from ..recipe import Recipe
    from .flags import compose

    what = emotion or path
    if emotion and path:
        raise MienError("give --emotion or --recipe, not both")
    if not (what or flags):
        raise MienError(
            "say what to change: --emotion, --recipe or a flag of an edit "
            "(`mien presets` lists emotions, `mien edit --help` all flags)"
        )
    recipe = resolve(what) if what else Recipe("edited", ())
    if foot_plant is None and not path:
        foot_plant = True
    steps = compose(recipe.steps, flags, foot_plant=foot_plant)
    for step in steps:
        pipeline.check(step)
    return replace(recipe, steps=steps)


def _checked_strength(strength: float) -> float:
    if not 0.0 <= strength <= 2.0:
        raise MienError(f"--strength must be from 0 to 2, got {strength:g}")
    return strength


def _parts(text: str) -> tuple[str, ...]:
    from ..errors import RecipeError, unknown
    from ..kinematics.body import PARTS, ROLES

    parts = tuple(part.strip() for part in text.split(",") if part.strip())
    for part in parts:
        if part not in (*PARTS, *ROLES):
            raise RecipeError("--parts: " + unknown("body part or role", part, [*PARTS, *ROLES]))
    return parts


def _span(text: str) -> tuple[float, float] | None:
    if not text:
        return None
    try:
        start, end = (float(time) for time in text.split(","))
    except ValueError:
        raise MienError(f"--span needs two times in seconds, e.g. 1.0,3.5, got {text!r}") from None
    if not start < end:
        raise MienError(f"--span must end after it starts, got {text!r}")
    return start, end


def _plan(todo: "Sequence[Job]", as_json: bool) -> None:
    """Say what would be written and the steps, without reading a clip."""
    from dataclasses import asdict

    recipe = todo[0].recipe
    if as_json:
        files = [{"input": str(job.source), "output": str(job.target)} for job in todo]
        show_json({"dry_run": True, "files": files, "steps": [asdict(step) for step in recipe.steps]})
        return
    for job in todo:
        typer.echo(f"{job.source} -> {job.target}")
    for number, step in enumerate(recipe.steps, start=1):
        values = " ".join(f"{key}={value}" for key, value in step.parameters.items())
        typer.echo(f"  {number}. {step.edit} {values}".rstrip())


def _report(done: "Sequence[Outcome]", as_json: bool) -> None:
    """Say what was written, and end with the exit code."""
    if as_json:
        show_json([_as_data(outcome) for outcome in done])
    for outcome in done:
        if outcome.error:
            complain(_failure(outcome))
        elif not as_json:
            typer.echo(str(outcome.job.target))
    failed = [outcome for outcome in done if outcome.error]
    if not failed:
        return
    if len(done) > 1:
        note(f"{len(done) - len(failed)} of {len(done)} clips written, {len(failed)} failed")
    bad_input = len(failed) == len(done) and not any(outcome.unexpected for outcome in failed)
    raise typer.Exit(2 if bad_input else 1)


def _failure(outcome: "Outcome") -> str:
    """Return one sentence that names the clip once."""
    name = outcome.job.source.name
    where = "" if name in outcome.error else f"{outcome.job.source}: "
    return f"{where}{outcome.error}"


def _as_data(outcome: "Outcome") -> dict[str, Any]:
    files = {"input": str(outcome.job.source), "output": str(outcome.job.target)}
    if outcome.error:
        return files | {"error": outcome.error}
    return files | {"frames": outcome.frames, "seconds": outcome.duration, "steps": list(outcome.steps)}
