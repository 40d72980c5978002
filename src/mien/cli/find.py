"""``mien find``: the clips of a library that are nearest to a word, a place or another clip."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import MienError
from . import arguments as a
from .analyze import finish, read_all
from .report import located, number, show_json, show_table

if TYPE_CHECKING:
    from ..batch import Analysis, Subject
    from ..emotion.library import Match
    from ..emotion.reading import Reading


def find(
    clips: a.Clips,
    like: Annotated[
        str | None, typer.Option(help="An emotion word, a label of the model, or a clip.", show_default=False)
    ] = None,
    valence: Annotated[
        float | None, typer.Option(min=-1.0, max=1.0, help="Or a place: unpleasant -1 to pleasant 1.")
    ] = None,
    arousal: Annotated[
        float | None, typer.Option(min=-1.0, max=1.0, help="And calm -1 to intense 1.")
    ] = None,
    top: Annotated[int, typer.Option(min=1, help="How many clips to name.")] = 10,
    neutral: a.Neutral = None,
    labels: a.Labels = "",
    model: a.Model = None,
    jobs: a.Jobs = 0,
    as_json: a.Json = False,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
) -> None:
    """Find the clips that express something: nearest to a word, to a place on the disc, or to a clip.

    By a word or place, distances are those on the disc, to which a label adds what its probability lacks to
    1, and a place the share of a reading that has no place. By a clip, they tell how much the manner differs:
    0 is the same, near 1 has nothing in common.

    mien find takes/ --like tired --top 5

    mien find takes/ --valence 0.5 --arousal -0.5

    mien find takes/ --like slow_walk.bvh
    """
    from ..batch import Subject
    from ..emotion.circumplex import clamp
    from ..emotion.library import by_example, by_place, by_word
    from ..emotion.model import load_model, shipped_model
    from .inputs import expand

    example = _example(like, valence, arousal)
    found = [clip.path for clip in expand(clips)]
    subject = Subject(
        Path(), {"fps": fps, "salvage": salvage}, a.read_map(map_file), neutral, model, laban=False
    )
    if example:
        done = _with_example(found, example, replace(subject, of_source=False), jobs, map_file, labels)
        library = _library(done[1:])
        matches = by_example(library, _reading(done[0]))
    elif like is not None:
        learned = load_model(model) if model else shipped_model()
        by_word({}, like, model=learned)  # a slip shows before any work is done
        done = read_all(found, subject, jobs, map_file, labels=labels)
        matches = by_word(_library(done), like, model=learned)
    else:
        done = read_all(found, subject, jobs, map_file, labels=labels)
        matches = by_place(_library(done), clamp(valence or 0.0, arousal or 0.0))
    _show(matches[:top], as_json)
    finish(done)


def _example(like: str | None, valence: float | None, arousal: float | None) -> Path | None:
    """Return the clip that others are compared with, None for a word or a place.

    Raises ``MienError`` unless exactly one thing is asked for.
    """
    from ..formats import FORMATS
    from .inputs import existing

    place = valence is not None, arousal is not None
    if any(place) and like is not None:
        raise MienError("say what to find by --like or by --valence and --arousal, not both")
    if any(place) != all(place):
        raise MienError("a place to find needs both numbers: --valence and --arousal")
    if not any(place) and like is None:
        raise MienError("say what to find: --like WORD, --like CLIP, or --valence and --arousal")
    path = Path(like or "")
    if like is None or not (path.suffix.lower() in FORMATS or path.is_file()):
        return None
    return existing(path)


def _with_example(
    found: Sequence[Path], example: Path, subject: "Subject", jobs: int, map_file: Path | None, labels: str
) -> "list[Analysis]":
    """Return what is found in the example, which comes first, and in all other clips."""
    others = [path for path in found if path.resolve() != example.resolve()]
    if not others:
        raise MienError(f"there is nothing but {example} to find; name other clips")
    done = read_all([example, *others], subject, jobs, map_file, labels=labels)
    if done[0].error:
        raise MienError(located(example, done[0].error))
    return done


def _library(done: "Sequence[Analysis]") -> "dict[str, Reading]":
    return {str(analysis.source): _reading(analysis) for analysis in done if not analysis.error}


def _reading(analysis: "Analysis") -> "Reading":
    if analysis.reading is None:
        raise MienError(analysis.error)
    return analysis.reading


def _show(matches: "Sequence[Match]", as_json: bool) -> None:
    if as_json:
        show_json([match.as_data() for match in matches])
        return
    rows = []
    for match in matches:
        place, (label, p) = match.reading.place, next(iter(match.reading.labels.items()))
        guess = "" if match.reading.against == "neutral" else "a guess"
        numbers = number(match.distance), f"{place.valence:+.2f}", f"{place.arousal:+.2f}"
        rows.append((*numbers, f"{label} {100 * p:.0f} %", guess, match.name))
    if rows:
        show_table(("distance", "valence", "arousal", "acted like", "", "clip"), rows, numbers=6, whole=True)
