"""What ``mien edit`` says: what would be done, or what was written and what is doubtful about it."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import typer

from ..batch import Job, Outcome
from ..curve import shown
from ..edits import pipeline
from ..edits.registry import EDITS
from ..recipe import Step
from .report import complain, end, located, note, show_json


def tell_plan(todo: Sequence[Job], as_json: bool) -> None:
    """Say what would be written and the steps as they would be done, without reading a clip."""
    job = todo[0]
    steps = pipeline.plan(job.recipe, strength=job.strength, parts=job.parts, span=job.span)
    there = [any(file.exists() for file in job.files) for job in todo]
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


def _described(step: Step) -> str:
    """Return a step in one line: what is not at its default, and how strongly, where and when it is done."""
    known = EDITS[step.edit].parameters
    values = [f"{key}={_shown(v)}" for key, v in step.parameters.items() if v != known[key].default]
    limits = [f"strength {shown(step.strength)}"] if EDITS[step.edit].kind in ("pose", "rhythm") else []
    limits += [f"parts {','.join(step.parts)}"] if step.parts else []
    limits += [f"{step.span[0]:g} to {step.span[1]:g} s, ease {step.ease:g} s"] if step.span else []
    return "; ".join([" ".join([step.edit, *values]), *limits])


def _shown(value: Any) -> str:
    if not isinstance(value, tuple):
        return str(value)
    return ",".join(value) if all(isinstance(item, str) for item in value) else shown(value)


def tell_outcomes(done: Sequence[Outcome], as_json: bool) -> None:
    """Say what was written, and end with the exit code."""
    if as_json:
        show_json([_as_data(outcome) for outcome in done])
    for outcome in done:
        tell_doubts(outcome.job, outcome.notes)
        if outcome.error:
            complain(located(outcome.job.source, outcome.error))
        elif not as_json:
            typer.echo(str(outcome.job.target))
    end(len(done), [outcome.unexpected for outcome in done if outcome.error], done="written")


def tell_doubts(job: Job, doubts: Sequence[str]) -> None:
    """Say what makes the result of a job doubtful."""
    for doubt in doubts:
        note(f"mien: note: {located(job.source, doubt)}")


def _as_data(outcome: Outcome) -> dict[str, Any]:
    files = {"input": str(outcome.job.source), "output": str(outcome.job.target)}
    if outcome.error:
        return files | {"error": outcome.error}
    made = {"frames": outcome.frames, "seconds": outcome.duration, "steps": list(outcome.steps)}
    return files | made | {"notes": list(outcome.notes)}
