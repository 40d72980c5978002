"""What commands say: data to stdout (a table or JSON), everything else to stderr."""

import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from shutil import get_terminal_size
from typing import Any, TypeVar

import typer

T = TypeVar("T")
WHOLE = 10_000  # columns: more than any name of a file
PIPE_WIDTH = 100  # columns of a table where neither a terminal nor COLUMNS says how wide


def complain(message: str) -> None:
    """Say what went wrong."""
    note(f"mien: {message}")


def note(message: str) -> None:
    """Say something beside the data."""
    typer.echo(message, err=True)


def end(total: int, unexpected: Sequence[bool], *, done: str) -> None:
    """Say how many of the clips failed, and end with the exit code; do nothing where none did.

    ``unexpected`` says of each that failed whether the fault is the program's own, ``done`` what became of
    the others. The code is 2 where all failed by what was given, else 1.
    """
    failed = len(unexpected)
    if not failed:
        return
    if total > 1:
        note(f"{total - failed} of {total} clips {done}, {failed} failed")
    raise typer.Exit(2 if failed == total and not any(unexpected) else 1)


def located(path: Path, error: str) -> str:
    """Return what went wrong with the clip in front, by the path that was given."""
    if error.startswith(str(path)):
        return error
    rest = error.removeprefix(path.name)
    return f"{path}{rest}" if rest != error and rest[:1] in (":", " ") else f"{path}: {error}"


def show_json(data: Any) -> None:
    """Print data for a program; what is not a number (no such measure) becomes null."""
    typer.echo(json.dumps(_finite(data), indent=2, ensure_ascii=False, allow_nan=False))


def show_table(
    columns: Sequence[str],
    rows: Iterable[Sequence[str]],
    *,
    title: str = "",
    numbers: int = 1,
    whole: bool = False,
) -> None:
    """Print a table for a person; columns from ``numbers`` on are right-aligned.

    ``whole`` leaves lines as long as they are, so that names of files can be copied.
    """
    from rich.console import Console
    from rich.table import Table

    table = Table(
        title=title or None,
        title_justify="left",
        box=None,
        pad_edge=False,
        padding=(0, 2, 0, 0),
        show_header=any(columns),
    )
    for index, column in enumerate(columns):
        table.add_column(column, justify="right" if index >= numbers else "left", overflow="fold")
    for row in rows:
        table.add_row(*row)
    width = WHOLE if whole else get_terminal_size((PIPE_WIDTH, 24)).columns
    console = Console(width=width, highlight=False, markup=False)
    with console.capture() as shown:
        console.print(table)
    for line in shown.get().splitlines():
        typer.echo(line.rstrip())


def number(value: float, digits: int = 2) -> str:
    """Return a number as a person reads it; what could not be measured is a dash."""
    return f"{value:.{digits}f}" if value == value else "-"


def progress(items: Iterable[T], *, total: int, doing: str) -> Iterator[T]:
    """Pass items on and show a bar on stderr, if it is a terminal and there is more than one item."""
    if total < 2 or not sys.stderr.isatty():
        yield from items
        return
    from rich.console import Console
    from rich.progress import track

    yield from track(items, description=doing, total=total, console=Console(stderr=True), transient=True)


def _finite(data: Any) -> Any:
    if isinstance(data, dict):
        return {str(key): _finite(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_finite(value) for value in data]
    if isinstance(data, float) and (data != data or abs(data) == float("inf")):
        return None
    return data
