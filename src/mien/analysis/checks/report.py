"""All checks of one motion, with what its source shows, and where anything is too much."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...errors import MienError
from ...kinematics.contacts import spans
from ...motion import Motion, require_motion
from ...typing import Array, Mask
from . import (
    balance,
    bones,
    collision,
    content,
    flight,
    floor,
    foot_slide,
    ground,
    jitter,
    limits,
    popping,
    torque,
)
from .check import Check, Measured
from .scene import Scene

NAN = float("nan")
CHECKS: Mapping[str, Check] = {
    module.CHECK.name: module.CHECK
    for module in (
        foot_slide,
        floor,
        bones,
        limits,
        collision,
        balance,
        torque,
        ground,
        flight,
        jitter,
        popping,
        content,
    )
}


@dataclass(frozen=True, eq=False)
class Mark:
    """A stretch of time, in seconds, in which ``parts`` are too far; ``worst`` is the moment of the most."""

    start: float
    end: float
    worst: float
    parts: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Finding:
    """What one check found.

    ``value`` is the largest that lasts long enough to count (of an overall check the largest mean), where
    something is too much that which is most so; ``allowed`` is what was allowed there. ``source`` is the
    largest of the source, not a number without one. ``over`` (T, P) is by how much each value of the
    ``parts`` is too large, below 0 where it is not.
    """

    check: Check
    value: float
    source: float
    allowed: float
    passed: bool
    over: Array
    parts: tuple[str, ...]
    facts: Mapping[str, tuple[float, float]]
    marks: tuple[Mark, ...]


@dataclass(frozen=True, eq=False)
class Report:
    """The findings of all checks, in their order; ``times`` (T,) of the frames looked at, in seconds."""

    name: str
    times: Array
    findings: tuple[Finding, ...]
    against: bool

    @property
    def passed(self) -> bool:
        """Whether every check passed."""
        return all(f.passed for f in self.findings)

    @property
    def failed(self) -> tuple[str, ...]:
        """The names of the checks that did not."""
        return tuple(f.check.name for f in self.findings if not f.passed)

    def __getitem__(self, name: str) -> Finding:
        return next(f for f in self.findings if f.check.name == name)

    def __repr__(self) -> str:
        said = f"failed: {', '.join(self.failed)}" if self.failed else "all passed"
        kind = "against its source" if self.against else "by itself"
        return f"Report({self.name!r} {kind}, {len(self.findings)} checks: {said})"

    def timeline(self, *, width: int = 60) -> dict[str, str]:
        """Return check -> a line of ``width`` signs over the clip: ``!`` too much, ``.`` not."""
        out = {}
        for finding in self.findings:
            bad = np.asarray((finding.over > 0.0).any(axis=1))
            share = np.array_split(bad, width) if len(bad) >= width else [bad[[i]] for i in range(len(bad))]
            out[finding.check.name] = "".join("!" if part.any() else "." for part in share)
        return out

    def as_data(self) -> dict[str, Any]:
        """Return everything but the arrays as plain data, for JSON."""
        return {
            "clip": self.name,
            "against": self.against,
            "passed": self.passed,
            "checks": [_as_data(f) for f in self.findings],
        }


def check(motion: Motion, *, against: Motion | None = None, only: Sequence[str] = ()) -> Report:
    """Return what is wrong with a motion, compared with the clip it was made from.

    Without ``against`` that is the motion before its edits; a motion without edits is judged by itself, by
    limits that 95 of 100 captures pass. ``only`` names the checks to do (``CHECKS``). Raises ``MienError``
    for what is no motion, ``BodyError`` where no body is found.
    """
    source = require_motion(against) if against is not None else require_motion(motion).reference
    if source is not None:
        _require_same_joints(motion, source)
    before = Scene.of(source) if source is not None else None
    return compare_scenes(Scene.of(motion, source=before), before, only=only)


def _require_same_joints(motion: Motion, source: Motion) -> None:
    here, there = motion.skeleton.names, source.skeleton.names
    if here != there:
        other = sorted(set(here) ^ set(there)) or [
            f"{a} for {b}" for a, b in zip(here, there, strict=True) if a != b
        ]
        raise MienError(
            f"the clip and its source have different skeletons: {len(other)} joints are not the same "
            f"({', '.join(other[:6])}); compare with the clip it was made from"
        )


def measured(source: Scene) -> dict[str, Measured]:
    """Return what every check measures of a source, to compare several edits with."""
    return {name: check.measure(source) for name, check in CHECKS.items()}


def compare_scenes(
    scene: Scene,
    source: Scene | None,
    *,
    only: Sequence[str] = (),
    known: Mapping[str, Measured] | None = None,
) -> Report:
    """Return the report of a scene and that of its source, which ``known`` says if it was ``measured``."""
    wanted = [c for name, c in CHECKS.items() if not only or name in only]
    wanted = [c for c in wanted if source is not None or not c.needs_source]
    if source is not None and known is None:
        known = {c.name: c.measure(source) for c in wanted}
    findings = tuple(_find(c, scene, known[c.name] if known else None) for c in wanted)
    return Report(scene.motion.name, scene.times, findings, source is not None)


def _find(check: Check, scene: Scene, before: Measured | None) -> Finding:
    found = check.measure(scene)
    allowed = np.broadcast_to(check.allowed(before, scene), found.values.shape)
    over = check.excess(found, before, scene)
    bad = over > 0.0
    too_often = bad.any(axis=1).mean() > (check.share if before is None and not check.overall else 0.0)
    shown = np.broadcast_to(found.values.mean(axis=0), over.shape) if check.overall else found.values
    # What stands in the table: where it is most too much, or where there is most if nothing is too much; of
    # that what lasts long enough to count, so that a check that passes shows no more than is allowed.
    shown = shown if bad.any() else allowed + over
    score = np.where(bad, shown - allowed, -np.inf) if bad.any() else shown
    at = np.unravel_index(int(np.argmax(score)), score.shape) if score.size else None
    return Finding(
        check=check,
        value=float(shown[at]) if at else 0.0,
        source=_most(check, before, scene.motion.frame_time) if before else NAN,
        allowed=float(allowed[at]) if at else NAN,
        passed=not too_often,
        over=over,
        parts=found.parts,
        facts={name: (before.facts.get(name, NAN) if before else NAN, x) for name, x in found.facts.items()},
        marks=_marks(bad, over, found.parts, scene),
    )


def _most(check: Check, found: Measured, frame_time: float) -> float:
    """Return the largest value that lasts long enough; of an overall check, of the means over time."""
    values = found.values.mean(axis=0) if check.overall else check.lasting_values(found, frame_time)
    return float(values.max()) if values.size else 0.0


def _marks(bad: Mask, over: Array, parts: tuple[str, ...], scene: Scene) -> tuple[Mark, ...]:
    times, half = scene.times, 0.5 * scene.motion.frame_time
    out = []
    for start, stop in spans(np.asarray(bad.any(axis=1))):
        some = np.flatnonzero(bad[start:stop].any(axis=0))
        worst = start + int(np.argmax(over[start:stop].max(axis=1)))
        names = tuple(parts[i] for i in some[np.argsort(-over[start:stop, some].max(axis=0))])
        begin, end = max(float(times[start] - half), float(times[0])), float(times[stop - 1] + half)
        out.append(Mark(begin, min(end, float(times[-1])), float(times[worst]), names))
    return tuple(out)


def _as_data(finding: Finding) -> dict[str, Any]:
    about = finding.check
    return {
        "check": about.name,
        "label": about.label,
        "unit": about.unit,
        "passed": finding.passed,
        "value": finding.value,
        "source": finding.source,
        "allowed": finding.allowed,
        "facts": {name: {"source": a, "value": b} for name, (a, b) in finding.facts.items()},
        "marks": [
            {"start": m.start, "end": m.end, "worst": m.worst, "parts": list(m.parts)} for m in finding.marks
        ],
    }
