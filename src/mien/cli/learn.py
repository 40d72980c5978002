"""``mien learn``: a model of emotion from labelled clips."""

import csv
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import MienError, unknown
from . import arguments as a
from .report import complain, located, note, progress, show_json

if TYPE_CHECKING:
    from ..emotion.circumplex import Point

WHAT = ("emotion",)
COLUMNS = ("file", "label", "content", "performer")


def learn(
    what: Annotated[str, typer.Argument(help="What to learn: emotion.", show_default=False)],
    clips: a.Clips,
    labels: Annotated[
        str,
        typer.Option(
            help="A .csv file with the columns file, label, content, performer (the last may be left out), "
            "or a pattern for file names, such as '(?P<content>.+)_(?P<label>.+)_[0-9]+'.",
        ),
    ] = "(?P<content>.+)_(?P<label>[^_]+)",
    neutral: Annotated[str, typer.Option(help="The label of the neutral takes.")] = "neutral",
    place: Annotated[
        list[str] | None,
        typer.Option(
            metavar="LABEL=VALENCE,AROUSAL",
            help="Where a label stands on the disc, as two numbers or as a word; emotion words "
            "stand there by themselves.",
        ),
    ] = None,
    rename: Annotated[
        list[str] | None,
        typer.Option(metavar="OLD=NEW", help="Take one label for another, as exhausted for tired."),
    ] = None,
    out: Annotated[Path, typer.Option("--out", "-o", help="The .json file to write.")] = Path("model.json"),
    source: Annotated[str, typer.Option(help="Where the clips are from, for the model's card.")] = "unknown",
    licence: Annotated[str, typer.Option(help="The licence of the clips, for the card.")] = "unknown",
    force: a.Force = False,
    as_json: a.Json = False,
) -> None:
    """Learn from labelled clips how emotions look, and say how well it reads contents it has not seen.

    Every content needs a neutral take of the same performer: what is learned is what differs from it. The
    model is used with mien analyze --model and mien edit --model.

    mien learn emotion takes/ --labels labels.csv -o mine.json --source "our own takes"
    """
    from ..emotion.learning import learn as fit
    from ..emotion.learning import measure_takes, scores
    from ..emotion.model import NEUTRAL, format_model
    from ..formats import files
    from .inputs import expand, refuse_existing

    if what not in WHAT:
        raise MienError(unknown("thing to learn", what, WHAT))
    if not force:
        refuse_existing([out])
    files.check_folder(out.parent)
    found = [clip.path for clip in expand(clips)]
    other = dict(item.partition("=")[::2] for item in rename or []) | {neutral: NEUTRAL}
    named = list(_labelled(found, labels, other))
    places = _places(place or [], {label for _, label, _, _ in named})
    takes = measure_takes(_opened(named))
    quality = scores(takes, places)
    card = {
        "source": source,
        "licence": licence,
        "takes": len(takes),
        "labels": sorted({take.label for take in takes}),
        "contents": sorted({take.content for take in takes}),
        "performers": sorted({take.performer for take in takes}),
        "places told": sorted(place or []),
        "scores on contents left out": quality,
        "good for": "reading what differs between two clips of one person; not for judging real people",
    }
    files.write(out, format_model(fit(takes, places, card=card)).encode())
    if as_json:
        show_json({"model": str(out), **card})
        return
    for name, value in quality.items():
        typer.echo(f"{name:<22}{value:g}")
    typer.echo(str(out))


def _labelled(
    found: Sequence[Path], labels: str, other: Mapping[str, str]
) -> Iterator[tuple[Path, str, str, str]]:
    """Yield the clips that have a label: path, label, content, performer; ``other`` renames labels."""
    table = _table(Path(labels)) if labels.lower().endswith(".csv") else _matched(found, labels)
    named = [(path, table[path.name]) for path in found if path.name in table]
    if not named:
        raise MienError(f"--labels {labels} says nothing about any of the {len(found)} clips")
    for path, about in named:
        label, content, performer = (about.get(key) or "" for key in COLUMNS[1:])
        yield path, other.get(label, label), content, performer


def _table(path: Path) -> dict[str, dict[str, str]]:
    from .inputs import existing

    with existing(path).open(encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows or not {"file", "label"} <= set(rows[0]):
        raise MienError(f"{path}: needs a first line with the columns {', '.join(COLUMNS)}")
    return {Path(row["file"]).name: row for row in rows if row["file"]}


def _matched(found: Sequence[Path], pattern: str) -> dict[str, dict[str, str]]:
    try:
        compiled = re.compile(pattern)
    except re.error as error:
        raise MienError(f"--labels: {pattern!r} is no pattern: {error}") from None
    if "label" not in compiled.groupindex:
        raise MienError(f"--labels: {pattern!r} must say where the label is: (?P<label>...)")
    matches = ((path, compiled.search(path.stem)) for path in found)
    return {path.name: match.groupdict() for path, match in matches if match}


def _places(given: Sequence[str], labels: set[str]) -> "Mapping[str, Point]":
    """Return where labels stand: those that are emotion words by themselves, others as told."""
    from ..emotion.circumplex import Point, clamp, point, words

    known = words()
    found: dict[str, Point] = {label: known[label] for label in labels & set(known)}
    for item in given:
        label, _, where = item.partition("=")
        if label not in labels:
            raise MienError("--place: " + unknown("label", label, labels))
        try:
            valence, arousal = (float(v) for v in where.split(","))
            found[label] = clamp(valence, arousal)
        except ValueError:
            found[label] = point(where)
    if len(set(found) - {"neutral"}) < 2:
        raise MienError(
            "two or more labels need a place on the disc: give them with --place LABEL=VALENCE,AROUSAL"
        )
    return found


def _opened(named: Sequence[tuple[Path, str, str, str]]) -> "Iterator":  # type: ignore[type-arg]
    """Yield the motions with their labels; what cannot be read is told and left out."""
    for path, label, content, performer in progress(named, total=len(named), doing="learning"):
        try:
            yield a.opened(path, None, False, None), label, content, performer
        except MienError as error:
            complain(located(path, str(error)))
            note(f"mien: note: {path} is left out")
