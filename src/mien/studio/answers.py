"""What was read, checked and measured in a clip and its edit, as messages."""

from math import isfinite

from ..analysis.checks.report import Finding, Report, check
from ..analysis.curves import curve
from ..emotion.course import course
from ..emotion.reading import Reading, read
from ..kinematics.body import Body
from ..motion import Motion
from ..typing import Array
from .messages import CheckInfo, Checks, Curve, MarkInfo, Place, ReadingInfo, Readings, Why
from .stack import place

LABELS = 6  # the likeliest are told
EMOTION = ("valence", "arousal")
MOST_POINTS = 2000  # of a curve; more cannot be seen


def readings(before: Motion, after: Motion, asked: Place | None) -> Readings:
    """Return what the clip expresses, what was asked for and what the edit reached."""
    changed = after.reference is not None
    return Readings(_reading(read(before)), asked, _reading(read(after)) if changed else None)


def checks(before: Motion, after: Motion) -> Checks:
    """Return all checks of an edited motion against its clip, or of the clip by itself."""
    report: Report = check(after if after.reference is not None else before)
    return Checks(report.passed, [_finding(finding) for finding in report.findings])


def curves(before: Motion, after: Motion, names: list[str]) -> list[Curve]:
    """Return curves of the clip and of its edit, by the measures of the clip's body."""
    body = Body.of(before)
    found = []
    for name in names:
        unit, *lines = _emotion(before, after, name) if name in EMOTION else _plain(before, after, name, body)
        found.append(Curve(name, unit, *(_thinned(line) for line in lines)))
    return found


def _plain(before: Motion, after: Motion, name: str, body: Body) -> tuple[str, Array, Array, Array, Array]:
    unit, first = curve(before, name, body=body)
    return unit, before.times, first, after.times, curve(after, name, body=body)[1]


def _emotion(before: Motion, after: Motion, name: str) -> tuple[str, Array, Array, Array, Array]:
    axis = EMOTION.index(name)
    times, first = course(before)
    later, second = course(after) if after.reference is not None else (times, first)
    return "", times, first[:, axis], later, second[:, axis]


def _thinned(values: Array) -> list[float]:
    step = -(-len(values) // MOST_POINTS)
    return [round(float(value), 4) for value in values[::step]]


def _reading(reading: Reading) -> ReadingInfo:
    labels = [(label, round(share, 4)) for label, share in list(reading.labels.items())[:LABELS]]
    why = [Why(r.what, r.how_much, round(r.pull, 3)) for r in reading.why]
    return ReadingInfo(place(reading.place), labels, why, reading.against, round(reading.placed, 3))


def _finding(finding: Finding) -> CheckInfo:
    about = finding.check
    numbers = (finding.value, finding.source, finding.allowed)
    value, source, allowed = (number if isfinite(number) else None for number in numbers)
    marks = [MarkInfo(m.start, m.end, m.worst, list(m.parts)) for m in finding.marks]
    return CheckInfo(
        about.name, about.label, about.unit, about.digits, value, source, allowed, finding.passed, marks
    )
