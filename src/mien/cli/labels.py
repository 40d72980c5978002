"""What is said of clips by a table, or by a pattern for their file names: label, content and performer."""

import csv
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from ..errors import MienError, unknown
from .report import note

COLUMNS = ("file", "label", "content", "performer")


class Named(NamedTuple):
    """A clip and what is said of it."""

    path: Path
    label: str
    content: str
    performer: str


def labelled(found: Sequence[Path], labels: str) -> Iterator[Named]:
    """Yield the clips that have a label."""
    says = _table(Path(labels)) if labels.lower().endswith(".csv") else _pattern(labels)
    seen = False
    for path in found:
        about = says(path)
        if about and about.get("label"):
            seen = True
            yield Named(path, *(about.get(key) or "" for key in COLUMNS[1:]))
    if not seen:
        raise MienError(f"--labels {labels} says nothing about any of the {len(found)} clips")


def _table(path: Path) -> Callable[[Path], Mapping[str, str] | None]:
    """Return what finds the line of a clip: that whose file name, with its folders, is the clip's."""
    from .inputs import existing

    try:
        with existing(path).open(encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file))
    except (UnicodeDecodeError, csv.Error) as error:
        raise MienError(f"{path}: is no table of text ({error})") from None
    if not rows or not {"file", "label"} <= set(rows[0]):
        raise MienError(f"{path}: needs a first line with the columns {', '.join(COLUMNS)}")
    named: dict[str, list[tuple[tuple[str, ...], dict[str, str]]]] = {}
    for row in rows:
        parts = Path(row["file"] or "").parts
        if parts:
            named.setdefault(parts[-1], []).append((parts, row))

    def says(clip: Path) -> dict[str, str] | None:
        whole = clip.resolve().parts
        fits = [(len(p), row) for p, row in named.get(clip.name, []) if whole[-len(p) :] == p]
        return max(fits, key=lambda fit: fit[0])[1] if fits else None

    return says


def _pattern(pattern: str) -> Callable[[Path], Mapping[str, str] | None]:
    try:
        compiled = re.compile(pattern)
    except re.error as error:
        raise MienError(f"--labels: {pattern!r} is no pattern: {error}") from None
    if "label" not in compiled.groupindex:
        raise MienError(f"--labels: {pattern!r} must say where the label is: (?P<label>...)")

    def says(clip: Path) -> dict[str, str] | None:
        match = compiled.search(clip.stem)
        return match.groupdict() if match else None

    return says


def neutral_takes(found: Sequence[Path], labels: str, neutral: str) -> dict[Path, Path]:
    """Return clip -> the neutral take of the same content and performer, which is called ``neutral``.

    A neutral take has another one where there is, else itself. Says how many clips have none, and raises
    ``MienError`` where no clip has that label.
    """
    named = list(labelled(found, labels))
    rests: dict[tuple[str, str], list[Path]] = {}
    for clip in named:
        if clip.label == neutral:
            rests.setdefault((clip.content, clip.performer), []).append(clip.path)
    if not rests:
        raise MienError("--neutral: " + unknown("label", neutral, {clip.label for clip in named}))
    own: dict[Path, Path] = {}
    for clip in named:
        takes = rests.get((clip.content, clip.performer), [])
        own |= {clip.path: next((take for take in takes if take != clip.path), clip.path)} if takes else {}
    alone = [path for path in found if path not in own]
    if alone:
        note(
            f"mien: note: {len(alone)} of {len(found)} clips have no neutral take of their content and "
            f"performer, such as {alone[0]}: what is read of them is a guess"
        )
    return own
