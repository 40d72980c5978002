"""``mien learn``: a model of emotion from labelled clips."""

import csv
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from ..errors import MienError, unknown
from . import arguments as a
from .report import complain, located, note, progress, show_json

if TYPE_CHECKING:
    from ..emotion.circumplex import Point
    from ..emotion.learning import Take
    from ..motion import Motion

WHAT = ("emotion",)
COLUMNS = ("file", "label", "content", "performer")
SCORES = "scores on contents left out"


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
    model is used with mien analyze --model.

    mien learn emotion takes/ --labels labels.csv -o mine.json --source "our own takes"
    """
    from ..emotion.learning import learn as fit
    from ..emotion.learning import measure_takes, scores
    from ..emotion.model import format_model
    from ..formats import files
    from .inputs import expand, refuse_existing

    if what not in WHAT:
        raise MienError(unknown("thing to learn", what, WHAT))
    if not force:
        refuse_existing([out])
    files.check_folder(out.parent)
    found = [clip.path for clip in expand(clips)]
    named = _renamed(list(_labelled(found, labels)), rename or [], neutral)
    places = _places(place or [], {clip.label for clip in named})
    failed: list[Path] = []
    takes = measure_takes(_opened(named, failed))
    card = {"source": source, "licence": licence, **_card(takes, place or [], scores(takes, places))}
    out.parent.mkdir(parents=True, exist_ok=True)
    files.write(out, format_model(fit(takes, places, card=card)).encode())
    if as_json:
        show_json({"model": str(out), **card})
    else:
        for name, value in card[SCORES].items():
            typer.echo(f"{name:<22}{value:g}")
        typer.echo(str(out))
    if failed:
        note(f"{len(named) - len(failed)} of {len(named)} clips learned from, {len(failed)} failed")
        raise typer.Exit(1)


def _card(takes: "Sequence[Take]", told: Sequence[str], quality: Mapping[str, float]) -> dict[str, Any]:
    return {
        "takes": len(takes),
        "labels": sorted({take.label for take in takes}),
        "contents": sorted({take.content for take in takes}),
        "performers": sorted({take.performer for take in takes}),
        "places told": sorted(told),
        SCORES: quality,
        "good for": "reading what differs between two clips of one person; not for judging real people",
    }


class _Named(NamedTuple):
    """A clip and what is said of it."""

    path: Path
    label: str
    content: str
    performer: str


def _labelled(found: Sequence[Path], labels: str) -> Iterator[_Named]:
    """Yield the clips that have a label."""
    says = _table(Path(labels)) if labels.lower().endswith(".csv") else _pattern(labels)
    seen = False
    for path in found:
        about = says(path)
        if about and about.get("label"):
            seen = True
            yield _Named(path, *(about.get(key) or "" for key in COLUMNS[1:]))
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


def _renamed(named: Sequence[_Named], rename: Sequence[str], neutral: str) -> list[_Named]:
    """Return the clips with their labels as told, and the neutral ones called so."""
    from ..emotion.model import NEUTRAL

    labels, other = {clip.label for clip in named}, {}
    for item in rename:
        old, _, new = item.partition("=")
        if not new:
            raise MienError(f"--rename {item!r}: write OLD=NEW")
        if old not in labels:
            raise MienError("--rename: " + unknown("label", old, labels))
        other[old] = new
    called = [clip._replace(label=other.get(clip.label, clip.label)) for clip in named]
    return [clip._replace(label=NEUTRAL) if clip.label == neutral else clip for clip in called]


def _places(given: Sequence[str], labels: set[str]) -> "Mapping[str, Point]":
    """Return where labels stand: those that are emotion words by themselves, others as told."""
    from ..emotion.circumplex import Point, point, words

    known = words()
    found: dict[str, Point] = {label: known[label] for label in sorted(labels & set(known))}
    for item in given:
        label, _, where = item.partition("=")
        if label not in labels:
            raise MienError("--place: " + unknown("label", label, labels))
        found[label] = _coordinates(where) or point(where)
    if len(set(found) - {"neutral"}) < 2:
        raise MienError(
            "two or more labels need a place on the disc: give them with --place LABEL=VALENCE,AROUSAL"
        )
    return found


def _coordinates(text: str) -> "Point | None":
    """Return the point that two numbers name, or None where they are no numbers."""
    from math import isfinite

    from ..emotion.circumplex import clamp

    try:
        numbers = [float(v) for v in text.split(",")]
    except ValueError:
        return None
    if len(numbers) != 2 or not all(map(isfinite, numbers)):
        raise MienError(f"--place: a place is two numbers from -1 to 1, VALENCE,AROUSAL, not {text!r}")
    return clamp(*numbers)


def _opened(named: Sequence[_Named], failed: list[Path]) -> "Iterator[tuple[Motion, str, str, str]]":
    """Yield the motions with what is said of them; what cannot be used is told, and noted in ``failed``."""
    from ..kinematics.body import Body

    for clip in progress(named, total=len(named), doing="learning"):
        try:
            motion = a.opened(clip.path, None, False, None)
            Body.of(motion)
        except MienError as error:
            complain(located(clip.path, str(error)))
            failed.append(clip.path)
        else:
            yield motion, *clip[1:]
