"""``mien check``: what an edit broke, if anything."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import MienError
from . import arguments as a
from .report import complain, located, note, number, progress, show_json, show_table

if TYPE_CHECKING:
    from ..analysis.checks.report import Finding, Mark, Report
    from ..motion import Motion

STRICT = 4  # exit code where a check failed and --strict was given
SHOWN = 4  # marks of a failed check that are listed
WIDTH = 64


def check(
    clips: a.Clips,
    against: Annotated[
        Path | None,
        typer.Option(
            help="The clip it was made from; without it the one that the recipe file beside the clip names."
        ),
    ] = None,
    strict: Annotated[bool, typer.Option("--strict", help="End with exit code 4 if a check failed.")] = False,
    only: Annotated[str, typer.Option(help="Only these checks, such as foot_slide,collision.")] = "",
    as_json: a.Json = False,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
) -> None:
    """Say whether feet, joints, balance, forces and smoothness of clips are right.

    An edited clip is compared with what it was made from: nothing may be worse than there, beyond a stated
    tolerance. A clip without a source is judged by itself, by limits that 95 of 100 captures pass.

    mien check walk_angry.bvh --against walk.bvh
    """
    from ..analysis.checks.report import CHECKS
    from ..analysis.checks.report import check as measure
    from ..errors import unknown
    from .inputs import expand

    names = [name.strip() for name in only.split(",") if name.strip()]
    for name in names:
        if name not in CHECKS:
            raise MienError("--only: " + unknown("check", name, CHECKS))
    found, reports, failed = [clip.path for clip in expand(clips)], [], 0
    for path in progress(found, total=len(found), doing="checking"):
        try:
            motion = a.opened(path, fps, salvage, map_file)
            source = _source(path, motion, against, fps, salvage, map_file)
            reports.append((path, measure(motion, against=source, only=names)))
        except MienError as error:
            failed += 1
            complain(located(path, str(error)))
    if as_json:
        show_json([{"file": str(path), **report.as_data()} for path, report in reports])
    else:
        for path, report in reports:
            _show(path, report)
    if failed:
        raise typer.Exit(2 if failed == len(found) else 1)
    if strict and not all(report.passed for _, report in reports):
        raise typer.Exit(STRICT)


def _source(
    path: Path,
    motion: "Motion",
    against: Path | None,
    fps: float | None,
    salvage: bool,
    map_file: Path | None,
) -> "Motion | None":
    """Return the motion to compare with, at the same frames where the recipe beside the clip tells how."""
    from ..batch import source_of
    from ..edits.pipeline import apply
    from ..emotion.files import read_recipe, sidecar_of

    recipe = sidecar_of(path)
    before = against or source_of(path)
    if before is None:
        if recipe.exists():
            note(
                f"mien: note: {path} is judged by itself, by wide limits: the clip it was made from was not "
                "found, or is not what it was; --against names it"
            )
        return None
    source = a.opened(before, fps, salvage, map_file)
    if recipe.exists() and len(source) != len(motion):
        made = apply(source, read_recipe(recipe))
        if len(made) == len(motion):
            return made.reference  # the source with the same changes of time
    return source


def _show(path: Path, report: "Report") -> None:
    """Print a table of all checks, and where those that failed did."""
    how = "against its source" if report.against else "by itself"
    rows = [_row(f) for f in report.findings]
    columns = ("check", "", "value", "source", "allowed", "")
    show_table(columns, rows, title=f"{path}, {how}: {_said(report)}", numbers=2)
    failed = [f for f in report.findings if not f.passed]
    if not failed:
        return
    typer.echo()
    lines = report.timeline(width=WIDTH)
    start, end = float(report.times[0]), float(report.times[-1])
    typer.echo(f"{'':<12}{f'{start:.1f} s':<{WIDTH - 8}}{f'{end:.1f} s':>8}")
    for finding in failed:
        typer.echo(f"{finding.check.name:<12}{lines[finding.check.name]}")
    for finding in failed:
        for mark in sorted(finding.marks, key=lambda m: m.start - m.end)[:SHOWN]:
            typer.echo(f"  {finding.check.name}: {_where(mark)}")
        if len(finding.marks) > SHOWN:
            typer.echo(f"  {finding.check.name}: and {len(finding.marks) - SHOWN} more (--json lists all)")


def _said(report: "Report") -> str:
    if report.passed:
        return "all checks passed"
    return f"{len(report.failed)} of {len(report.findings)} checks failed"


def _row(finding: "Finding") -> tuple[str, ...]:
    about = finding.check
    return (
        about.name,
        f"{about.label}{f', {about.unit}' if about.unit else ''}",
        number(finding.value, about.digits),
        number(finding.source, about.digits),
        number(finding.allowed, about.digits),
        _verdict(finding),
    )


def _verdict(finding: "Finding") -> str:
    if not finding.passed:
        return "FAILED"
    return "ok, over it only briefly" if finding.value > finding.allowed else "ok"


def _where(mark: "Mark") -> str:
    parts = ", ".join(mark.parts[:3]) + (", ..." if len(mark.parts) > 3 else "")
    return f"{mark.start:.2f} to {mark.end:.2f} s, worst at {mark.worst:.2f} s: {parts.replace('_', ' ')}"
