"""What clips express, and their features, as columns of a table and as data for programs."""

from collections.abc import Sequence
from typing import Any

from ..analysis.laban import Features
from ..analysis.laban_table import FEATURES, SELECTED
from ..batch import Analysis
from ..errors import MienError


def _rows(analysis: Analysis, per: str) -> dict[str, list[Any]]:
    """Return the columns of one clip: the file, the seconds, what a whole clip expresses, the features.

    ``per`` is a line for what; without it there are no features.
    """
    if not per:
        read = {"file": str(analysis.source), "duration": analysis.duration, **_read_columns(analysis)}
        return {name: [value] for name, value in read.items()}
    found = features_of(analysis)
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


def columns(good: Sequence[Analysis], per: str) -> dict[str, list[Any]]:
    """Return the columns of all clips, one below the other."""
    parts = [_rows(analysis, per) for analysis in good]
    return {name: [value for part in parts for value in part[name]] for name in parts[0]}


def _read_columns(analysis: Analysis) -> dict[str, Any]:
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


def as_data(analysis: Analysis, every: bool, per: str) -> dict[str, Any]:
    """Return what was found in one clip, with ``every`` feature or those that tell emotions apart."""
    found = features_of(analysis)
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
    return about | {"features": {name: found[name] for name in names}, "effort": effort_of(analysis)}


def features_of(analysis: Analysis) -> Features:
    """Return the features of a clip; raise ``MienError`` where it has none."""
    if analysis.features is None:
        raise MienError(analysis.error)
    return analysis.features


def effort_of(analysis: Analysis) -> dict[str, float]:
    """Return the Effort factors of a whole clip by name."""
    found = analysis.effort
    return dict(zip(found.names, found.clip.tolist(), strict=True)) if found else {}
