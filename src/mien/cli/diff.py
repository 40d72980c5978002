"""``mien diff``: what changed between two clips."""

from typing import TYPE_CHECKING, Annotated

import typer

from . import arguments as a
from .report import number, show_json, show_table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..analysis.compare import Change, Comparison


def diff(
    before: a.Clip,
    after: a.Clip,
    every: Annotated[
        bool, typer.Option("--all", "-a", help="Show every joint, also those that did not change.")
    ] = False,
    as_json: a.Json = False,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
) -> None:
    """Say what changed from one clip to another of the same skeleton, in sum and joint by joint."""
    from ..analysis.compare import compare

    first, second = (a.opened(path, fps, salvage, map_file) for path in (before, after))
    found = compare(first, second)
    if as_json:
        show_json(found.as_data())
        return
    if found.same:
        typer.echo("nothing moves differently")
        return
    show_changes(found.changes)
    typer.echo(
        f"\nhips elsewhere by {number(found.hips_mean * found.centimetres)} cm on average, "
        f"{number(found.hips_max * found.centimetres)} cm at most; compared {found.aligned}\n"
    )
    _show_joints(found, every)


def show_changes(changes: "Sequence[Change]") -> None:
    """Print the table of measures before and after."""
    rows = [
        (f"{c.label}, {c.unit}", number(c.before, c.digits), number(c.after, c.digits), _sign(c))
        for c in changes
        if c.before == c.before or c.after == c.after
    ]
    show_table(("measure", "before", "after", "change"), rows)


def _sign(change: "Change") -> str:
    difference = change.after - change.before
    if difference != difference:
        return "-"
    return f"{difference:+.{change.digits}f}" if abs(difference) >= 0.5 * 10**-change.digits else "0"


def _show_joints(found: "Comparison", every: bool) -> None:
    rows = []
    for i, name in enumerate(found.joints):
        if not every and found.rotation_max[i] < 0.05 and found.distance_max[i] < 0.0005:
            continue
        angles = (number(float(column[i]), 1) for column in (found.rotation_mean, found.rotation_max))
        moved = (
            number(float(column[i]) * found.centimetres, 1)
            for column in (found.distance_mean, found.distance_max)
        )
        rows.append((f"{name} *" if name in found.tips else name, *angles, *moved))
    columns = ("joint", "turned, mean deg", "max", "moved against hips, mean cm", "max")
    show_table(columns, rows)
    typer.echo("* end of a limb")
