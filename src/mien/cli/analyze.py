"""``mien analyze``: what clips express and why, and what their movement is like in the terms of Laban."""

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import MienError, unknown
from . import arguments as a
from .report import complain, end, located, progress, show_json

if TYPE_CHECKING:
    from ..batch import Analysis, Subject

PER = ("clip", "window", "frame")
BESIDE = 4  # clips in one table for a person


def analyze(
    clips: a.Clips,
    features: Annotated[
        bool, typer.Option("--features", help="Every Laban feature, as a table (CSV) for other programs.")
    ] = False,
    per: Annotated[
        str,
        typer.Option(help="One line of the table for each clip, window (of 1.17 seconds) or frame."),
    ] = "clip",
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", "-o", help="A .csv or .parquet file: what each clip expresses, with --features all else."
        ),
    ] = None,
    neutral: a.Neutral = None,
    labels: a.Labels = "",
    model: a.Model = None,
    laban: Annotated[
        bool, typer.Option("--laban", help="Also the 31 Laban features that tell emotions apart, as a table.")
    ] = False,
    plot: Annotated[Path | None, typer.Option(help="A .png picture of the features over time.")] = None,
    disc: Annotated[
        Path | None,
        typer.Option(help="A .html page or .png picture of all clips on the disc of emotion words."),
    ] = None,
    jobs: a.Jobs = 0,
    as_json: a.Json = False,
    force: a.Force = False,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
) -> None:
    """Say what clips express, and why: their place between pleasant and unpleasant, calm and intense.

    An edited clip is compared with its source, any other with --neutral or, as a guess, with how people
    usually move. --laban and --features tell body, effort, shape and space after Laban (Aristidou et al.
    2017).

    mien analyze walk_sad.bvh

    mien analyze angry_wave.bvh --neutral wave.bvh

    mien analyze takes/ -o read.csv --neutral normal --labels '(?P<content>.+)_(?P<label>.+)_[0-9]+'

    mien analyze takes/ --features -o features.csv

    mien analyze takes/ --disc takes.html
    """
    from ..batch import Subject
    from .inputs import expand

    found = [clip.path for clip in expand(clips)]
    features = features or (per != "clip" and out is not None)
    per = _checked(per, features)
    _refuse(found, out, plot, disc, force)
    subject = Subject(Path(), {"fps": fps, "salvage": salvage}, a.read_map(map_file), neutral, model)
    subject = replace(subject, laban=features or laban or as_json or bool(plot))
    done = read_all(found, subject, jobs, map_file, labels=labels)
    good = [analysis for analysis in done if not analysis.error]
    if good:
        _draw(good, plot, disc)
    if good or as_json:
        _say(good, features, laban, per, out, as_json, bool(plot or disc))
    if good and not as_json:
        for picture in filter(None, (plot, disc)):
            typer.echo(str(picture))
    finish(done)


def read_all(
    found: Sequence[Path], like: "Subject", jobs: int, map_file: Path | None, *, labels: str = ""
) -> "list[Analysis]":
    """Return what is found in clips, each measured ``like`` the subject, with a bar.

    With ``labels`` the neutral clip of the subject is the label of such, and each clip has its own. Raises
    ``MienError`` for a neutral clip or a model that cannot be used, before any work is done.
    """
    from ..batch import analyse_files
    from ..emotion.model import load_model
    from .labels import neutral_takes

    own: dict[Path, Path] = {}
    if labels:
        if not like.neutral:
            raise MienError("--labels is how clips find their neutral one: give --neutral LABEL too")
        own = neutral_takes(found, labels, str(like.neutral))
        like = replace(like, neutral=None)
    elif like.neutral:
        if not like.neutral.suffix and not like.neutral.exists():
            raise MienError(
                f"--neutral {like.neutral}: there is no such file; a label needs --labels, which says how "
                "clips are labelled"
            )
        a.with_body(like.neutral, a.opened(like.neutral, like.read["fps"], like.read["salvage"], map_file))
    if like.model:
        load_model(like.model)
    subjects = [replace(like, source=path, neutral=own.get(path, like.neutral)) for path in found]
    work = analyse_files(subjects, workers=jobs or os.cpu_count() or 1)
    return list(progress(work, total=len(found), doing="analysing"))


def _checked(per: str, table: bool) -> str:
    if per not in PER:
        raise MienError("--per: " + unknown("line of a table for each", per, PER))
    if per != "clip" and not table:
        raise MienError(f"--per {per} goes with --features")
    return per


def _refuse(
    found: Sequence[Path], out: Path | None, plot: Path | None, disc: Path | None, force: bool
) -> None:
    """Raise ``MienError`` for a file that cannot or must not be written, before any work is done."""
    from ..formats import files
    from .inputs import refuse_existing
    from .tables import checked_table

    if out:
        checked_table(out)
    if plot:
        if plot.suffix.lower() != ".png":
            raise MienError(f"{plot}: a picture is .png")
        if len(found) > 1:
            raise MienError(f"--plot shows one clip, but there are {len(found)}; name one")
        files.check_folder(plot.parent)
    if disc:
        if disc.suffix.lower() not in (".html", ".png"):
            raise MienError(f"{disc}: a disc is .html or .png")
        files.check_folder(disc.parent)
    if not force:
        refuse_existing([file for file in (out, plot, disc) if file])


def _draw(good: Sequence["Analysis"], plot: Path | None, disc: Path | None) -> None:
    """Write the pictures that are asked for."""
    if not (plot or disc):
        return
    from .analyze_pictures import draw_disc, draw_features

    if plot:
        draw_features(good[0], plot)
    if disc:
        draw_disc(good, disc)


def _say(
    good: Sequence["Analysis"],
    every: bool,
    laban: bool,
    per: str,
    out: Path | None,
    as_json: bool,
    drawn: bool,
) -> None:
    """Write the table to its file or to stdout; without one, say what a person can read."""
    from .analyze_tables import as_data, columns
    from .analyze_text import tell_features, tell_reading
    from .tables import as_csv, write_table

    if out:
        write_table(out, columns(good, per if every else ""))
        typer.echo(str(out))
    elif as_json:
        show_json([as_data(analysis, every, per) for analysis in good])
    elif every:
        typer.echo(as_csv(columns(good, per)), nl=False)
    elif laban or not drawn:
        for analysis in good:
            tell_reading(analysis)
        for start in range(0, len(good) if laban else 0, BESIDE):
            typer.echo("")
            tell_features(good[start : start + BESIDE])


def finish(done: Sequence["Analysis"]) -> None:
    """Complain of what failed, and end with the exit code."""
    for analysis in done:
        if analysis.error:
            complain(located(analysis.source, analysis.error))
    end(len(done), [analysis.unexpected for analysis in done if analysis.error], done="analysed")
