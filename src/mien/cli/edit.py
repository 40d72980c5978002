"""``mien edit``: change what clips express."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from ..errors import MienError
from . import arguments as a
from . import edit_options as o
from .report import located, progress

if TYPE_CHECKING:
    from ..batch import Job


def edit(
    clips: a.Clips,
    emotion: o.Emotion = None,
    recipe: o.RecipeFile = None,
    to: o.To = None,
    valence: o.Valence = None,
    arousal: o.Arousal = None,
    by: o.By = "",
    start: o.Start = "",
    method: o.Way = "recipe",
    model: o.Model = None,
    from_example: o.FromExample = None,
    example_neutral: o.ExampleNeutral = None,
    strength: o.Strength = "1",
    parts: o.Parts = "",
    span: o.Span = "",
    ease: o.Ease = None,
    foot_plant: o.FootPlant = None,
    safe: o.Safe = None,
    out: o.Out = None,
    force: a.Force = False,
    dry_run: a.DryRun = False,
    as_json: a.Json = False,
    sidecar: o.Sidecar = True,
    jobs: a.Jobs = 1,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
    *,
    flags: Mapping[str, Mapping[str, Any]],
) -> None:
    """Change what clips express: by an emotion, a place, an example, a recipe, or any edit's own flags.

    Writes CLIP_EMOTION.bvh beside each clip (or where -o says) with the same skeleton, channels and
    frame rate, and says in CLIP_EMOTION.bvh.recipe.toml how it was made. Strength, parts and span
    become part of the name. In a folder, what mien made is passed over.

    A flag of an edit changes every step of that edit in the emotion or recipe, or adds a step. Any number may
    change over time: write seconds and values, such as --strength 0:0,1.5:1.

    mien edit walk.bvh --emotion sad --strength 0.8

    mien edit "takes/*.bvh" --emotion tired --posture-head 10 -o tired/

    mien edit walk.bvh --valence 0.6 --arousal -0.2

    mien edit walk.bvh --from-example sad_wave.bvh --example-neutral wave.bvh
    """
    from ..batch import Job
    from .edit_report import tell_plan
    from .edit_wish import eased, parts_of, recipe_of, span_of, strength_of
    from .goals import Asked, goal_of
    from .inputs import STDOUT

    place = Asked(to, valence, arousal, by, start, method, model)
    goal = goal_of(place, from_example, example_neutral, map_file=map_file)
    made = recipe_of(emotion, recipe, flags, foot_plant, goal.name if goal else "")
    made = made if safe is None else replace(made, safe=safe)
    whole = Job(
        Path(),
        Path(),
        eased(made, ease, bool(span)),
        goal=goal,
        strength=strength_of(strength),
        parts=parts_of(parts),
        span=span_of(span),
        sidecar=sidecar and out != STDOUT,
        force=force,
        **_reading(recipe, fps, salvage, map_file),
    )
    todo = _jobs(clips, whole, out)
    if dry_run:
        tell_plan(todo, as_json)
    elif out == STDOUT:
        _to_stdout(todo[0], as_json)
    else:
        _write(todo, jobs, as_json)


def _jobs(clips: list[str], whole: "Job", out: Path | None) -> "list[Job]":
    """Return one job a clip, each like ``whole``."""
    from ..emotion.files import sidecar_of
    from .inputs import STDOUT, expand, label, outputs, passed_over

    found = passed_over(expand(clips), lambda path: sidecar_of(path).exists())
    if out == STDOUT and len(found) == 1:
        return [replace(whole, source=found[0].path, target=STDOUT)]
    name = label(whole.recipe.name, whole.strength, whole.parts, whole.span)
    targets = outputs(found, out, label=name)
    return [replace(whole, source=c.path, target=target) for c, target in zip(found, targets, strict=True)]


def _write(todo: "Sequence[Job]", jobs: int, as_json: bool) -> None:
    """Do the jobs, unless a file would be lost, and say what was written."""
    from ..batch import edit_files
    from .edit_report import tell_outcomes
    from .inputs import refuse_existing

    if not todo[0].force:
        refuse_existing(file for job in todo for file in job.files)
    workers = jobs or os.cpu_count() or 1
    work = progress(edit_files(todo, workers=workers), total=len(todo), doing="editing")
    tell_outcomes(list(work), as_json)


def _to_stdout(job: "Job", as_json: bool) -> None:
    """Write the edited clip, and nothing else, to stdout."""
    from ..batch import doubts, edited
    from ..formats import bvh
    from .edit_report import tell_doubts

    if as_json:
        raise MienError("stdout takes the clip (-o -) or --json, not both")
    try:
        before, after = edited(job)
    except MienError as error:
        raise MienError(located(job.source, str(error))) from None
    tell_doubts(job, doubts(job, before, after))
    typer.echo(bvh.render(after), nl=False)


def _reading(recipe: Path | None, fps: float | None, salvage: bool, map_file: Path | None) -> dict[str, Any]:
    """Return how clips are read: as the flags say, else as a sidecar given as recipe says."""
    from ..batch import how_it_was_read

    read, roles = how_it_was_read(recipe) if recipe else ({}, {})
    if fps is not None:
        read["fps"] = fps
    return {"read": read | ({"salvage": True} if salvage else {}), "body": a.read_map(map_file) or roles}
