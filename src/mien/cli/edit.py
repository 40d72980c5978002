"""``mien edit``: change what clips express."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import MienError
from . import arguments as a
from .report import complain, located, note, progress, show_json

if TYPE_CHECKING:
    from ..batch import Job, Outcome
    from ..curve import Varying
    from ..recipe import Recipe, Step

Emotion = Annotated[
    list[str] | None,
    typer.Option(
        "--emotion",
        "-e",
        metavar="WORD",
        help="An emotion word; mien presets lists them. Several, each with its strength: "
        "-e sad=0:1,5:0 -e happy=0:0,5:1 turns sad into happy.",
    ),
]
RecipeFile = Annotated[
    Path | None, typer.Option("--recipe", "-r", help="A recipe file (.toml or .json), or a clip's sidecar.")
]
To = Annotated[
    str | None,
    typer.Option(
        metavar="WORD", help="A word of the circumplex to move to, such as happy, bored or calm, or V,A."
    ),
]
Valence = Annotated[
    float | None, typer.Option(help="Move to this valence: -1 unpleasant, 1 pleasant; 0 without it.")
]
Arousal = Annotated[
    float | None, typer.Option(help="Move to this arousal: -1 calm, 1 intense; 0 without it.")
]
By = Annotated[str, typer.Option(metavar="V,A", help="Move by so much valence and arousal, such as +.3,0.")]
Start = Annotated[
    str,
    typer.Option(metavar="WORD", help="Where the clips are now, a word or V,A; without it in the middle."),
]
Way = Annotated[
    str,
    typer.Option(
        "--method",
        help="How to move there: recipe (presets, as strong as the clip needs), plain, rules, joint.",
    ),
]
Model = Annotated[
    Path | None,
    typer.Option(
        help="A model that mien learn wrote, to move and to read back by, in place of the shipped one."
    ),
]
FromExample = Annotated[
    Path | None, typer.Option(help="A clip of anyone whose manner to take, on any skeleton.")
]
ExampleNeutral = Annotated[
    Path | None,
    typer.Option(help="The neutral clip that the example differs from; without it, each clip itself."),
]
Strength = Annotated[
    str,
    typer.Option(
        metavar="NUMBER",
        help="How much: 0 changes nothing, 1 as written, up to 2 exaggerates; or times with their values, "
        "such as 0:0,1.5:1.",
    ),
]
Parts = Annotated[
    str, typer.Option(help="Only these body parts, e.g. arms,head (or roles such as left_wrist).")
]
Span = Annotated[str, typer.Option(help="Only from one time to another, in seconds, e.g. 1.0,3.5.")]
Ease = Annotated[
    float | None, typer.Option(help="Seconds that the ends of --span take to set in (0.25 without it).")
]
FootPlant = Annotated[
    bool | None,
    typer.Option(
        "--foot-plant/--no-foot-plant",
        help="Put the feet back on the floor after pose edits (default: yes, or what --recipe says).",
    ),
]
Safe = Annotated[
    bool | None,
    typer.Option(
        "--safe/--no-safe",
        help="Check the result, mend it, and take back what would break the body (default: yes for "
        "emotions, or what --recipe says).",
    ),
]
Sidecar = Annotated[
    bool,
    typer.Option("--sidecar/--no-sidecar", help="Write what was done beside each clip (OUTPUT.recipe.toml)."),
]
Out = Annotated[
    Path | None,
    typer.Option("--out", "-o", help="The file, or the folder, to write to; - is stdout, for one clip."),
]
Jobs = Annotated[
    int, typer.Option("--jobs", "-j", min=0, help="Processes to share the clips; 0 takes every core.")
]


def edit(
    clips: a.Clips,
    emotion: Emotion = None,
    recipe: RecipeFile = None,
    to: To = None,
    valence: Valence = None,
    arousal: Arousal = None,
    by: By = "",
    start: Start = "",
    method: Way = "recipe",
    model: Model = None,
    from_example: FromExample = None,
    example_neutral: ExampleNeutral = None,
    strength: Strength = "1",
    parts: Parts = "",
    span: Span = "",
    ease: Ease = None,
    foot_plant: FootPlant = None,
    safe: Safe = None,
    out: Out = None,
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
    from dataclasses import replace

    from ..batch import Job
    from .goals import Asked, goal_of
    from .inputs import STDOUT

    place = Asked(to, valence, arousal, by, start, method, model)
    goal = goal_of(place, from_example, example_neutral, map_file=map_file)
    made = _recipe(emotion, recipe, flags, foot_plant, goal.name if goal else "")
    made = made if safe is None else replace(made, safe=safe)
    whole = Job(
        Path(),
        Path(),
        _eased(made, ease, bool(span)),
        goal=goal,
        strength=_checked_strength(strength),
        parts=_parts(parts),
        span=_span(span),
        sidecar=sidecar and out != STDOUT,
        force=force,
        **_reading(recipe, fps, salvage, map_file),
    )
    todo = _jobs(clips, whole, out)
    if dry_run:
        _plan(todo, as_json)
    elif out == STDOUT:
        _to_stdout(todo[0], as_json)
    else:
        _write(todo, jobs, as_json)


def _jobs(clips: list[str], whole: "Job", out: Path | None) -> "list[Job]":
    """Return one job a clip, each like ``whole``."""
    from dataclasses import replace

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
    from .inputs import refuse_existing

    if not todo[0].force:
        refuse_existing(file for job in todo for file in _files(job))
    workers = jobs or os.cpu_count() or 1
    _report(list(progress(edit_files(todo, workers=workers), total=len(todo), doing="editing")), as_json)


def _files(job: "Job") -> list[Path]:
    """Return the files that a job writes."""
    from ..emotion.files import sidecar_of

    return [job.target, *([sidecar_of(job.target)] if job.sidecar else [])]


def _to_stdout(job: "Job", as_json: bool) -> None:
    """Write the edited clip, and nothing else, to stdout."""
    from ..batch import doubts, edited
    from ..formats import bvh

    if as_json:
        raise MienError("stdout takes the clip (-o -) or --json, not both")
    try:
        before, after = edited(job)
    except MienError as error:
        raise MienError(located(job.source, str(error))) from None
    for doubt in doubts(job, before, after):
        _doubt(job, doubt)
    typer.echo(bvh.render(after), nl=False)


def _reading(recipe: Path | None, fps: float | None, salvage: bool, map_file: Path | None) -> dict[str, Any]:
    """Return how clips are read: as the flags say, else as a sidecar given as recipe says."""
    from ..batch import how_it_was_read

    read, roles = how_it_was_read(recipe) if recipe else ({}, {})
    if fps is not None:
        read["fps"] = fps
    return {"read": read | ({"salvage": True} if salvage else {}), "body": a.read_map(map_file) or roles}


def _recipe(
    emotions: list[str] | None,
    path: Path | None,
    flags: Mapping[str, Mapping[str, Any]],
    foot_plant: bool | None,
    goal: str,
) -> "Recipe":
    """Return what is to be done, checked before a single clip is read; ``goal`` names where clips go."""
    from dataclasses import replace

    from ..edits import pipeline
    from ..edits.registry import EDITS
    from ..emotion.resolve import resolve
    from ..recipe import Recipe
    from .flags import compose
    from .inputs import existing

    if emotions and path:
        raise MienError("give --emotion or --recipe, not both")
    if goal and (emotions or path):
        raise MienError("give an emotion, a recipe or a place or example to move to, one of them")
    if not (emotions or path or flags or goal):
        raise MienError(
            "say what to change: --emotion, --to, --recipe or a flag of an edit "
            "(mien presets lists emotions, mien edit --help all flags, --repair-what floor mends a clip)"
        )
    recipe = _emotions(emotions) if emotions else resolve(existing(path)) if path else Recipe("edited", ())
    if goal:
        return Recipe(goal, compose((), flags, foot_plant=foot_plant), safe=True)
    if foot_plant is None and not path:
        foot_plant = True
    steps = compose(recipe.steps, flags, foot_plant=foot_plant)
    for step in steps:
        pipeline.check(step)
    kinds = {EDITS[step.edit].kind for step in steps}
    if path and foot_plant is None and "pose" in kinds and "repair" not in kinds:
        note(f"mien: note: {path} puts no feet back on the floor; --foot-plant adds that step")
    return replace(recipe, steps=steps)


def _emotions(given: list[str]) -> "Recipe":
    """Return the recipe of emotion words; of several, or with strengths (``sad=0:1,5:0``), all in one."""
    from ..emotion.mix import mixed
    from ..emotion.resolve import resolve

    if len(given) == 1 and "=" not in given[0]:
        return resolve(given[0])
    pairs = [(word.strip(), strength) for word, _, strength in (item.partition("=") for item in given)]
    if len(dict(pairs)) < len(pairs):
        raise MienError(f"--emotion: {' and '.join(word for word, _ in pairs)}: give each emotion once")
    return mixed({word: strength or 1.0 for word, strength in pairs})


def _eased(recipe: "Recipe", ease: float | None, limited: bool) -> "Recipe":
    """Return the recipe with another ease of its pose edits; ``limited`` says that a span is given."""
    from dataclasses import replace

    from ..edits import pipeline
    from ..edits.registry import EDITS

    if ease is None:
        return recipe
    if not (limited or any(step.span for step in recipe.steps)):
        raise MienError("--ease is how long the ends of a span take to set in: give --span too")
    steps = [replace(s, ease=ease) if EDITS[s.edit].kind in ("pose", "rhythm") else s for s in recipe.steps]
    return replace(recipe, steps=tuple(pipeline.check(step) for step in steps))


def _checked_strength(text: str) -> "Varying":
    from ..curve import read_varying, values

    strength = read_varying("--strength", text)
    for value in values(strength):
        if not 0.0 <= value <= 2.0:
            raise MienError(f"--strength must be from 0 to 2, got {value:g}")
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
    """Say what would be written and the steps as they would be done, without reading a clip."""
    from dataclasses import asdict

    from ..edits import pipeline

    job = todo[0]
    steps = pipeline.plan(job.recipe, strength=job.strength, parts=job.parts, span=job.span)
    there = [any(file.exists() for file in _files(job)) for job in todo]
    if as_json:
        files = [
            {"input": str(job.source), "output": str(job.target), "exists": exists}
            for job, exists in zip(todo, there, strict=True)
        ]
        show_json(
            {"dry_run": True, "files": files, "steps": [asdict(s) for s in steps], "safe": job.recipe.safe}
        )
        return
    needs = "exists: will be replaced" if job.force else "exists: needs --force"
    for job, exists in zip(todo, there, strict=True):
        typer.echo(f"{job.source} -> {job.target}{f' ({needs})' if exists else ''}")
    for number, step in enumerate(steps, start=1):
        typer.echo(f"  {number}. {_described(step)}")
    if job.goal:
        where = ", before these" if steps else ""
        typer.echo(f"  moved ({job.goal.name}): by steps that depend on the clip{where}")
    elif not steps:
        typer.echo("  nothing is changed")
    elif job.recipe.safe:
        typer.echo("  then what breaks the body is mended or taken back (--no-safe leaves that out)")


def _described(step: "Step") -> str:
    """Return a step in one line: what is not at its default, and how strongly, where and when it is done."""
    from ..curve import shown
    from ..edits.registry import EDITS

    known = EDITS[step.edit].parameters
    values = [f"{key}={_shown(v)}" for key, v in step.parameters.items() if v != known[key].default]
    limits = [f"strength {shown(step.strength)}"] if EDITS[step.edit].kind in ("pose", "rhythm") else []
    limits += [f"parts {','.join(step.parts)}"] if step.parts else []
    limits += [f"{step.span[0]:g} to {step.span[1]:g} s, ease {step.ease:g} s"] if step.span else []
    return "; ".join([" ".join([step.edit, *values]), *limits])


def _shown(value: Any) -> str:
    from ..curve import shown

    if not isinstance(value, tuple):
        return str(value)
    return ",".join(value) if all(isinstance(item, str) for item in value) else shown(value)


def _report(done: "Sequence[Outcome]", as_json: bool) -> None:
    """Say what was written, and end with the exit code."""
    if as_json:
        show_json([_as_data(outcome) for outcome in done])
    for outcome in done:
        for doubt in outcome.notes:
            _doubt(outcome.job, doubt)
        if outcome.error:
            complain(located(outcome.job.source, outcome.error))
        elif not as_json:
            typer.echo(str(outcome.job.target))
    failed = [outcome for outcome in done if outcome.error]
    if not failed:
        return
    if len(done) > 1:
        note(f"{len(done) - len(failed)} of {len(done)} clips written, {len(failed)} failed")
    bad_input = len(failed) == len(done) and not any(outcome.unexpected for outcome in failed)
    raise typer.Exit(2 if bad_input else 1)


def _doubt(job: "Job", text: str) -> None:
    note(f"mien: note: {located(job.source, text)}")


def _as_data(outcome: "Outcome") -> dict[str, Any]:
    files = {"input": str(outcome.job.source), "output": str(outcome.job.target)}
    if outcome.error:
        return files | {"error": outcome.error}
    made = {"frames": outcome.frames, "seconds": outcome.duration, "steps": list(outcome.steps)}
    return files | made | {"notes": list(outcome.notes)}
