"""Edit or measure many files, in this process or several, each failure kept to its own file."""

import hashlib
import os
import re
import signal
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from .analysis.effort import Effort, effort
from .analysis.laban import Features, features
from .curve import Varying, values
from .edits.order import merged
from .edits.registry import EDITS
from .emotion.circumplex import clamp
from .emotion.files import read_provenance, sidecar_of
from .emotion.model import load_model
from .emotion.reading import Reading, read
from .emotion.recipe_text import format_recipe
from .emotion.resolve import done
from .emotion.toward import Aim, Like
from .errors import FormatError, MienError, RecipeError, sentence
from .formats import FORMATS, files, load, save
from .kinematics.roles import known_roles
from .motion import Motion
from .recipe import Recipe

T = TypeVar("T")
R = TypeVar("R")


@dataclass(frozen=True)
class Job:
    """One file to edit. ``read`` are the options of ``load``; ``sidecar`` writes what was done beside it.

    With a ``goal`` each clip has a recipe of its own, which the steps of ``recipe`` are added to.
    """

    source: Path
    target: Path
    recipe: Recipe
    goal: Aim | Like | None = None
    strength: Varying = 1.0
    parts: tuple[str, ...] = ()
    span: tuple[float, float] | None = None
    read: Mapping[str, Any] = field(default_factory=dict)
    body: Mapping[str, str] = field(default_factory=dict)
    sidecar: bool = True
    force: bool = False

    @property
    def files(self) -> list[Path]:
        """The files that are written: the clip, and what was done where that is asked for."""
        return [self.target, *([sidecar_of(self.target)] if self.sidecar else [])]


@dataclass(frozen=True)
class Outcome:
    """What became of a job: frames, seconds and steps done, or the sentence that says what went wrong.

    ``notes`` say what makes the result doubtful.
    """

    job: Job
    frames: int = 0
    duration: float = 0.0
    steps: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    error: str = ""
    unexpected: bool = False


def edit_files(jobs: Sequence[Job], *, workers: int = 1) -> Iterator[Outcome]:
    """Do the jobs and yield what became of each, in the order given; ``workers`` processes share them."""
    return _shared(edit_file, jobs, workers)


def _shared(work: Callable[[T], R], items: Sequence[T], workers: int) -> Iterator[R]:
    if workers <= 1 or len(items) < 2:
        yield from map(work, items)
        return
    pool = ProcessPoolExecutor(min(workers, len(items)), initializer=_leave_interrupts_to_parent)
    try:
        yield from pool.map(work, items)
    finally:
        pool.shutdown(cancel_futures=True)


def edit_file(job: Job) -> Outcome:
    """Read, edit and write one file."""
    try:
        before, motion = edited(job)
        job.target.parent.mkdir(parents=True, exist_ok=True)
        save(motion, job.target, force=job.force)
        if job.sidecar:
            files.write(sidecar_of(job.target), provenance(job, motion).encode())
        notes = doubts(job, before, motion)
    except (MienError, OSError, MemoryError) as error:
        return Outcome(job, error=sentence(error))
    except Exception as error:
        if os.environ.get("MIEN_DEBUG"):
            raise
        return Outcome(job, error=sentence(error), unexpected=True)
    return Outcome(job, len(motion), motion.duration, tuple(step.edit for step in motion.history), notes)


@dataclass(frozen=True)
class Subject:
    """One file to measure. ``read`` are the options of ``load``, ``body`` the roles of a map file.

    ``neutral`` is a clip to compare it with, ``model`` the file of a learned model. Without a ``neutral``
    clip an edited one is compared with what it was made from, where that is found and ``of_source`` is asked
    for. ``laban`` False leaves out Laban features and Effort.
    """

    source: Path
    read: Mapping[str, Any] = field(default_factory=dict)
    body: Mapping[str, str] = field(default_factory=dict)
    neutral: Path | None = None
    model: Path | None = None
    of_source: bool = True
    laban: bool = True


@dataclass(frozen=True)
class Analysis:
    """What was measured in a file, or the sentence that says what went wrong.

    ``neutral`` is the clip that the reading is against, None where it is a guess.
    """

    source: Path
    frames: int = 0
    duration: float = 0.0
    features: Features | None = None
    effort: Effort | None = None
    reading: Reading | None = None
    neutral: Path | None = None
    error: str = ""
    unexpected: bool = False


def analyse_files(subjects: Sequence[Subject], *, workers: int = 1) -> Iterator[Analysis]:
    """Measure files and yield what was found in each, in the order given, shared by ``workers`` processes."""
    return _shared(analyse_file, subjects, workers)


def analyse_file(subject: Subject) -> Analysis:
    """Read one file and work out what it expresses, its Laban features and Effort factors."""
    try:
        motion = opened(subject.source, body=subject.body, **subject.read)
        before = subject.neutral or (source_of(subject.source) if subject.of_source else None)
        reading = _reading(subject, motion, before)
        laban = features(motion) if subject.laban else None
        factors = effort(motion) if subject.laban else None
    except (MienError, OSError, MemoryError) as error:
        return Analysis(subject.source, error=sentence(error))
    except Exception as error:
        if os.environ.get("MIEN_DEBUG"):
            raise
        return Analysis(subject.source, error=sentence(error), unexpected=True)
    return Analysis(
        subject.source, len(motion), motion.duration, laban, factors, reading, before and _plain(before)
    )


def _plain(path: Path) -> Path:
    """Return a path without steps up and down again, as it is told, where that is the same file."""
    plain = Path(os.path.normpath(path))
    return plain if plain.exists() and plain.samefile(path) else path


def _reading(subject: Subject, motion: Motion, before: Path | None) -> Reading:
    neutral = _rest(before, subject) if before else None
    model = load_model(subject.model) if subject.model else None
    return read(motion, neutral=neutral, model=model)


_LAST: dict[Any, Motion] = {}  # the neutral clip read last: many clips of a folder have the same


def _rest(path: Path, subject: Subject) -> Motion:
    """Return a neutral clip, read once for all the clips that are compared with it one after the other."""
    options = (*sorted(subject.read.items()), *sorted(subject.body.items()))
    key = (path.resolve(), path.stat().st_mtime_ns, options)
    if key not in _LAST:
        _LAST.clear()
        _LAST[key] = opened(path, body=subject.body, **subject.read)
    return _LAST[key]


def edited(job: Job) -> tuple[Motion, Motion]:
    """Return the motion of a job as it is read and as it is edited, without writing it."""
    motion = opened(job.source, body=job.body, **job.read)
    recipe = job.recipe
    if job.goal:
        own = job.goal.recipe(motion)
        recipe = replace(recipe, steps=merged([own.steps, recipe.steps]))
    after = done(motion, recipe, strength=job.strength, parts=job.parts, span=job.span)
    return motion, after


def doubts(job: Job, before: Motion, after: Motion) -> tuple[str, ...]:
    """Return what makes the result of a job doubtful: damage cut away, an odd rate, hips that jump.

    And what of the edit was taken back to keep the body whole, or that there is nothing of it.
    """
    from .analysis.inspect import doubts as odd
    from .emotion.safe import mended

    reached = _reached(job, before, after)
    return (*_damage(job, before), *odd(before), *mended(after), *reached, *_nothing(job, before, after))


def _reached(job: Job, before: Motion, after: Motion) -> list[str]:
    """Return what was asked for, at the strength of the job, and what is read in the result."""
    goal = job.goal
    if not isinstance(goal, Aim):
        return []
    strength = max(values(job.strength))
    way = strength * np.subtract(goal.to, goal.start)
    said = replace(goal, to=clamp(*np.add(goal.start, way).tolist())).reached(before, after)
    some = bool(job.parts or job.span) or not isinstance(job.strength, int | float)
    return [f"{said}; all of the clip is read, where only some of it was to change" if some else said]


def _nothing(job: Job, before: Motion, after: Motion) -> list[str]:
    """Return why nothing moves differently, where that was not asked for."""
    steps = job.recipe.steps
    same = len(before) == len(after) and before.frame_time == after.frame_time
    if not (steps or job.goal) or not same or not any(values(job.strength)):
        return []
    if not all(
        map(np.array_equal, (before.rotations, before.translations), (after.rotations, after.translations))
    ):
        return []
    rhythms = [step.edit for step in steps if EDITS[step.edit].kind == "rhythm"]
    if job.parts and rhythms:
        return [f"nothing moves differently: {' and '.join(rhythms)} cannot be done to some parts only"]
    return ["nothing moves differently: these edits find nothing to do here, or come after the clip ends"]


def _damage(job: Job, motion: Motion) -> list[str]:
    if not job.read.get("salvage"):
        return []
    try:
        load(job.source, fps=job.read.get("fps"))
    except FormatError as error:
        wrong = re.sub(r" \(use --salvage[^)]*\)", "", str(error))
        what = wrong.removeprefix(job.source.name).lstrip(": ")
        return [f"salvaged {len(motion)} frames of a damaged clip ({what})"]
    return []


def opened(path: Path, *, body: Mapping[str, str], fps: float | None = None, salvage: bool = False) -> Motion:
    """Return the motion of a file, with the roles of a map file kept in its skeleton."""
    return load(path, fps=fps, salvage=salvage, roles=body)


def provenance(job: Job, motion: Motion) -> str:
    """Return the text of the sidecar: every step with all its parameters, and what it was done to."""
    about: dict[str, Any] = {
        "input": _relative(job.source, job.target.parent),
        "input_sha256": hashlib.sha256(job.source.read_bytes()).hexdigest(),
        "output": job.target.name,
        "mien": version("mien"),
    }
    about |= {key: value for key, value in job.read.items() if value}
    about |= {"roles": dict(job.body)} if job.body else {}
    recipe = Recipe(job.recipe.name, motion.history, job.recipe.description)
    return format_recipe(recipe, provenance=about)


def how_it_was_read(sidecar: Path) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the options of ``load`` and the roles that a clip was read with, from the file beside it.

    Both are empty for a recipe that came from no clip. Raises ``MienError`` for values that do not fit.
    """
    about = read_provenance(sidecar)
    fps, salvage, roles = about.get("fps"), about.get("salvage", False), about.get("roles", {})
    if isinstance(fps, bool) or not isinstance(fps, int | float | None):
        raise RecipeError(f"{sidecar}: provenance.fps must be a number, got {fps!r}")
    if not isinstance(salvage, bool):
        raise RecipeError(f"{sidecar}: provenance.salvage must be true or false, got {salvage!r}")
    return {"fps": fps, "salvage": salvage}, known_roles(roles, f"{sidecar}: provenance.roles")


def source_of(clip: Path) -> Path | None:
    """Return the clip that ``clip`` was made from, by the recipe file beside it, if both are still there.

    It is looked for where the recipe says, beside the clip, above it and in the working folder. Only if it is
    the very file: one that was changed since is another clip.
    """
    recipe = sidecar_of(clip)
    if not recipe.exists():
        return None
    about = read_provenance(recipe)
    name, digest = about.get("input"), about.get("input_sha256")
    if not isinstance(name, str) or "\0" in name:
        return None
    folders = dict.fromkeys([clip.parent, clip.parent.parent, Path()])
    places = [clip.parent / name, *(folder / Path(name).name for folder in folders)]
    there = (place for place in places if place.suffix.lower() in FORMATS and place.is_file())
    return next((p for p in there if hashlib.sha256(p.read_bytes()).hexdigest() == digest), None)


def _relative(path: Path, folder: Path) -> str:
    """Return the path as it is said in a folder: what is found again where both are moved together."""
    try:
        return Path(os.path.relpath(path.resolve(), folder.resolve())).as_posix()
    except ValueError:  # on another drive
        return path.resolve().as_posix()


def _leave_interrupts_to_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
