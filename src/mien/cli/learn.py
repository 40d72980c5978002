"""``mien learn``: a model of emotion from labelled clips."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import MienError, unknown
from . import arguments as a
from .labels import Named, labelled
from .report import complain, located, note, number, progress, show_json, show_table

if TYPE_CHECKING:
    from ..emotion.circumplex import Point
    from ..emotion.learning import Take
    from ..motion import Motion

WHAT = ("emotion",)
SCORES = "scores on contents left out"
SAID = {
    "top-1": "takes whose label is the likeliest",
    "top-1, acted": "  without the neutral takes",
    "quadrant": "takes in the right quadrant, of labels with a place",
    "distance": "mean distance on the disc, of labels with a place",
}
WAYS = {"change": "with a neutral clip", "alone": "without one", "laban": "Laban features"}


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
    named = _renamed(list(labelled(found, labels)), rename or [], neutral)
    _check(named, neutral)
    places = _places(place or [], {clip.label for clip in named})
    _check_contents(named, places)
    failed: list[Path] = []
    takes = measure_takes(_opened(named, failed))
    card = {"source": source, "licence": licence, **_card(takes, place or [], scores(takes, places))}
    out.parent.mkdir(parents=True, exist_ok=True)
    files.write(out, format_model(fit(takes, places, card=card)).encode())
    if as_json:
        show_json({"model": str(out), **card})
    else:
        _say(card, {"neutral"} | set(places))
        typer.echo(str(out))
    if failed:
        note(f"{len(named) - len(failed)} of {len(named)} clips learned from, {len(failed)} failed")
        raise typer.Exit(1)


def _say(card: Mapping[str, Any], placed: set[str]) -> None:
    """Print what was learned from, and how well contents are read that were not seen."""
    found = card[SCORES]
    labels = [label if label in placed else f"{label} (no place)" for label in card["labels"]]
    typer.echo(f"{card['takes']} takes of {', '.join(card['contents'])}")
    typer.echo(f"labels: {', '.join(labels)}")
    rows = [
        (said, *[number(found[f"{way} {score}"]) if f"{way} {score}" in found else "" for way in WAYS])
        for score, said in SAID.items()
    ]
    show_table((SCORES, *WAYS.values()), [row for row in rows if any(row[1:])], whole=True)
    typer.echo(f"guessing a label would be right in {found['chance']:.2f}")


def _check(named: Sequence[Named], neutral: str) -> None:
    """Raise ``MienError`` where there is too little to learn from, before any clip is read.

    Says which contents have no neutral take, and so teach nothing.
    """
    from ..emotion.model import NEUTRAL

    labels = sorted({clip.label for clip in named})
    if NEUTRAL not in labels:
        raise MienError(f"--neutral: no clip is labelled {neutral!r} (labels found: {', '.join(labels)})")
    rested = {(clip.content, clip.performer) for clip in named if clip.label == NEUTRAL}
    usable = [clip for clip in named if (clip.content, clip.performer) in rested]
    has, gone = (
        sorted({clip.content or "(no content)" for clip in named if (clip in usable) is there})
        for there in (True, False)
    )
    if len({clip.label for clip in usable} - {NEUTRAL}) < 2:
        without = f"; without one: {', '.join(gone)}" if gone else ""
        raise MienError(
            "to learn takes two or more labels besides the neutral one, with a neutral take of the same "
            f"content and performer for each; contents with one: {', '.join(has)}{without}; "
            f"labels: {', '.join(labels)}"
        )
    if gone:
        note(f"mien: note: left out, as there is no neutral take: {', '.join(gone)}")


def _check_contents(named: Sequence[Named], places: "Mapping[str, Point]") -> None:
    """Raise ``MienError`` unless what one content teaches can be tried on another."""
    from ..emotion.model import NEUTRAL

    rested = {(clip.content, clip.performer) for clip in named if clip.label == NEUTRAL}
    acted = {c.content for c in named if c.label in set(places) - {NEUTRAL} and c[2:] in rested}
    if len(acted) < 2:
        raise MienError(
            "how well contents are read that were not seen needs two or more contents with a neutral take "
            f"and takes of labels with a place; there is {', '.join(sorted(acted)) or 'none'}"
        )


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


def _renamed(named: Sequence[Named], rename: Sequence[str], neutral: str) -> list[Named]:
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
        none = ", ".join(sorted(labels - set(found)))
        raise MienError(
            "two or more labels besides the neutral one need a place on the disc: give them with "
            f"--place LABEL=VALENCE,AROUSAL or --place LABEL=WORD (no place yet: {none})"
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


def _opened(named: Sequence[Named], failed: list[Path]) -> "Iterator[tuple[Motion, str, str, str]]":
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
