"""``mien analyze``: what clips express and why, and what their movement is like in the terms of Laban."""

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import MienError, unknown
from . import arguments as a
from .report import complain, located, note, progress, show_json, show_table

if TYPE_CHECKING:
    from ..analysis.laban import Features
    from ..batch import Analysis, Subject

PER = ("clip", "window", "frame")
SHORT = 0.5  # seconds; in less nobody has moved to and fro
GUESSED = "against how people usually move: a guess, --neutral makes it sure"
BESIDE = 4  # clips in one table for a person


Neutral = Annotated[
    Path | None,
    typer.Option(
        help="A clip of the same person, best of the same action, to read the difference from; with --labels "
        "the label of such clips.",
    ),
]
Labels = Annotated[
    str,
    typer.Option(
        help="How each clip finds its own neutral one, of the same content and performer: a table (.csv) or "
        "a pattern for file names, as for mien learn.",
    ),
]
Jobs = Annotated[
    int, typer.Option("--jobs", "-j", min=0, help="Processes to share the clips; 0 takes every core.")
]


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
    neutral: Neutral = None,
    labels: Labels = "",
    model: Annotated[
        Path | None, typer.Option(help="A model that mien learn wrote, in place of the shipped one.")
    ] = None,
    laban: Annotated[
        bool, typer.Option("--laban", help="Also the 31 Laban features that tell emotions apart, as a table.")
    ] = False,
    plot: Annotated[Path | None, typer.Option(help="A .png picture of the features over time.")] = None,
    disc: Annotated[
        Path | None,
        typer.Option(help="A .html page or .png picture of all clips on the disc of emotion words."),
    ] = None,
    jobs: Jobs = 0,
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
    if plot and good:
        _draw(good[0], plot)
    if disc and good:
        _draw_disc(good, disc)
    if good or as_json:
        _say(good, features, laban, per, out, as_json, bool(plot or disc))
    if good and not as_json:
        for picture in filter(None, (plot, disc)):
            typer.echo(str(picture))
    end(done)


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


def _draw(analysis: "Analysis", target: Path) -> None:
    from ..analysis.laban_table import FEATURES
    from ..render.curves import Curve, curves
    from .render import save_picture

    found = _features(analysis)
    columns = zip(FEATURES, found.frames.T, strict=True)
    panels = [(f.component, Curve(f.name.replace("_", " "), f.unit, values)) for f, values in columns]
    groups = {name: [curve for group, curve in panels if group == name] for name, _ in panels}
    target.parent.mkdir(parents=True, exist_ok=True)
    save_picture(curves(found.times, groups, title=analysis.source.name), target)


def _draw_disc(good: Sequence["Analysis"], target: Path) -> None:
    from ..formats import files
    from ..render.disc import Dot, disc, disc_page
    from .render import save_picture

    read = zip(_short_names([analysis.source for analysis in good]), good, strict=True)
    dots = [Dot.of(name, analysis.reading) for name, analysis in read if analysis.reading]
    target.parent.mkdir(parents=True, exist_ok=True)
    if target.suffix.lower() == ".png":
        save_picture(disc(dots), target)
    else:
        files.write(target, disc_page(dots).encode(errors="replace"))


def _short_names(paths: Sequence[Path]) -> list[str]:
    """Return the names of clips below the folder that all lie in."""
    whole = [path.resolve() for path in paths]
    try:
        top = os.path.commonpath([path.parent for path in whole])
    except ValueError:  # on different drives
        return [str(path) for path in paths]
    return [path.relative_to(top).as_posix() for path in whole]


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
    from .tables import as_csv, write_table

    if out:
        write_table(out, _columns(good, per if every else ""))
        typer.echo(str(out))
    elif as_json:
        show_json([_as_data(analysis, every, per) for analysis in good])
    elif every:
        typer.echo(as_csv(_columns(good, per)), nl=False)
    elif laban or not drawn:
        for analysis in good:
            _read_out(analysis)
        for start in range(0, len(good) if laban else 0, BESIDE):
            typer.echo("")
            _show(good[start : start + BESIDE])


def _read_out(analysis: "Analysis") -> None:
    """Print what a clip expresses, and why."""
    found = analysis.reading
    if found is None:
        return
    how = f"against {analysis.neutral}" if analysis.neutral else GUESSED
    typer.echo(f"{analysis.source}, {how}")
    if analysis.duration < SHORT:
        typer.echo(f"  only {analysis.duration:.2f} s long: too short to say how somebody moves")
    for line in found.lines():
        typer.echo(f"  {line}")


def _features(analysis: "Analysis") -> "Features":
    if analysis.features is None:
        raise MienError(analysis.error)
    return analysis.features


def _rows(analysis: "Analysis", per: str) -> dict[str, list[Any]]:
    """Return the columns of one clip: the file, the seconds, what a whole clip expresses, the features.

    ``per`` is a line for what; without it there are no features.
    """
    from ..analysis.laban_table import FEATURES

    if not per:
        read = {"file": str(analysis.source), "duration": analysis.duration, **_read_columns(analysis)}
        return {name: [value] for name, value in read.items()}
    found = _features(analysis)
    if per == "clip":
        names, values, times = found.names, found.clip[None], [analysis.duration]
    elif per == "window":
        names, values, times = found.names, found.windows(), found.window_times().tolist()
    else:
        names, values, times = tuple(f.name for f in FEATURES), found.frames, found.times.tolist()
    first: dict[str, list[Any]] = {"file": [str(analysis.source)] * len(times)}
    first |= {"duration" if per == "clip" else "time": times}
    if per == "clip":
        first |= {name: [value] for name, value in _read_columns(analysis).items()}
    return first | dict(zip(names, values.T.tolist(), strict=True))


def _read_columns(analysis: "Analysis") -> dict[str, Any]:
    """Return what a clip expresses as columns of a table."""
    reading = analysis.reading
    if reading is None:
        raise MienError(analysis.error)
    label, probability = next(iter(reading.labels.items()))
    return {
        **reading.place._asdict(),
        "quadrant": reading.quadrant,
        "label": label,
        "probability": probability,
        "placed": reading.placed,
        "against": reading.against,
        "neutral": str(analysis.neutral or ""),
        "because": "; ".join(map(str, reading.why)),
    }


def _columns(good: Sequence["Analysis"], per: str) -> dict[str, list[Any]]:
    """Return the columns of all clips, one below the other."""
    parts = [_rows(analysis, per) for analysis in good]
    return {name: [value for part in parts for value in part[name]] for name in parts[0]}


def _as_data(analysis: "Analysis", every: bool, per: str) -> dict[str, Any]:
    from ..analysis.laban_table import SELECTED

    found = _features(analysis)
    about: dict[str, Any] = {
        "file": str(analysis.source),
        "frames": analysis.frames,
        "seconds": analysis.duration,
    }
    about |= {"neutral": str(analysis.neutral)} if analysis.neutral else {}
    about |= {"reading": analysis.reading.as_data()} if analysis.reading else {}
    if every and per != "clip":
        rows = _rows(analysis, per)
        return about | {"times": rows.pop("time"), "features": {k: v for k, v in rows.items() if k != "file"}}
    names = found.names if every else [d.name for d in SELECTED]
    return about | {"features": {name: found[name] for name in names}, "effort": _effort(analysis)}


def _effort(analysis: "Analysis") -> dict[str, float]:
    found = analysis.effort
    return dict(zip(found.names, found.clip.tolist(), strict=True)) if found else {}


def _show(good: Sequence["Analysis"]) -> None:
    """Print the selected features, and the Effort factors, of a few clips beside each other."""
    from ..analysis.effort import EFFORT
    from ..analysis.laban_table import COMPONENTS, SELECTED

    rows: list[tuple[str, ...]] = []
    for component in COMPONENTS:
        rows.append((component.upper(), "", *[""] * len(good)))
        for d in (d for d in SELECTED if d.feature.component == component):
            values = [_short(_features(analysis)[d.name]) for analysis in good]
            rows.append((f"  {d.name.replace('_', ' ')}", d.feature.unit, *values))
        rows.append(("", "", *[""] * len(good)))
    rows.append(("EFFORT OF THE WHOLE BODY", "", *[""] * len(good)))
    for name, (said, unit) in EFFORT.items():
        rows.append((f"  {name}: {said}", unit, *[_short(_effort(analysis)[name]) for analysis in good]))
    show_table(("feature", "unit", *[analysis.source.name for analysis in good]), rows, numbers=2)


def _short(value: float) -> str:
    """Return a number with three digits that count."""
    return f"{value:.3g}" if abs(value) < 1000.0 else f"{value:.0f}"


def end(done: Sequence["Analysis"]) -> None:
    """Complain of what failed, and end with the exit code."""
    failed = [analysis for analysis in done if analysis.error]
    for analysis in failed:
        complain(located(analysis.source, analysis.error))
    if not failed:
        return
    if len(done) > 1:
        note(f"{len(done) - len(failed)} of {len(done)} clips analysed, {len(failed)} failed")
    raise typer.Exit(2 if len(failed) == len(done) and not any(f.unexpected for f in failed) else 1)
