"""Edit many files: one job a file, in this process or several, each failure kept to its own file."""

import hashlib
import os
import signal
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

from .edits import pipeline
from .emotion.files import format_recipe
from .errors import MienError, sentence
from .formats import files, load, save
from .motion import Motion
from .recipe import Recipe

SIDECAR = ".recipe.toml"


@dataclass(frozen=True)
class Job:
    """One file to edit. ``read`` are the options of ``load``; ``sidecar`` writes what was done beside it."""

    source: Path
    target: Path
    recipe: Recipe
    strength: float = 1.0
    parts: tuple[str, ...] = ()
    span: tuple[float, float] | None = None
    read: Mapping[str, Any] = field(default_factory=dict)
    body: Mapping[str, str] = field(default_factory=dict)
    sidecar: bool = True
    force: bool = False


@dataclass(frozen=True)
class Outcome:
    """What became of a job: frames, seconds and steps done, or the sentence that says what went wrong."""

    job: Job
    frames: int = 0
    duration: float = 0.0
    steps: tuple[str, ...] = ()
    error: str = ""
    unexpected: bool = False


def edit_files(jobs: Sequence[Job], *, workers: int = 1) -> Iterator[Outcome]:
    """Do the jobs and yield what became of each, in the order given; ``workers`` processes share them."""
    if workers <= 1 or len(jobs) < 2:
        yield from map(edit_file, jobs)
        return
    pool = ProcessPoolExecutor(min(workers, len(jobs)), initializer=_leave_interrupts_to_parent)
    try:
        yield from pool.map(edit_file, jobs)
    finally:
        pool.shutdown(cancel_futures=True)


def edit_file(job: Job) -> Outcome:
    """Read, edit and write one file."""
    try:
        motion = edited(job)
        job.target.parent.mkdir(parents=True, exist_ok=True)
        save(motion, job.target, force=job.force)
        if job.sidecar:
            files.write(sidecar_of(job.target), provenance(job, motion).encode())
    except (MienError, OSError, MemoryError) as error:
        return Outcome(job, error=sentence(error))
    except Exception as error:
        if os.environ.get("MIEN_DEBUG"):
            raise
        return Outcome(job, error=sentence(error), unexpected=True)
    return Outcome(job, len(motion), motion.duration, tuple(step.edit for step in motion.history))


def edited(job: Job) -> Motion:
    """Return the edited motion of a job, without writing it."""
    motion = opened(job.source, body=job.body, **job.read)
    return pipeline.apply(motion, job.recipe, strength=job.strength, parts=job.parts, span=job.span)


def opened(path: Path, *, body: Mapping[str, str], fps: float | None = None, salvage: bool = False) -> Motion:
    """Return the motion of a file, with the roles of a map file kept in its skeleton."""
    motion = load(path, fps=fps, salvage=salvage)
    return motion.with_(skeleton=replace(motion.skeleton, roles=body)) if body else motion


def sidecar_of(target: Path) -> Path:
    """Return the file that says how ``target`` was made; it is a recipe, and replays to the same clip."""
    return target.with_name(target.name + SIDECAR)


def provenance(job: Job, motion: Motion) -> str:
    """Return the text of the sidecar: every step with all its parameters, and what it was done to."""
    about: dict[str, Any] = {
        "input": job.source.name,
        "input_sha256": hashlib.sha256(job.source.read_bytes()).hexdigest(),
        "output": job.target.name,
        "mien": version("mien"),
    }
    about |= {key: value for key, value in job.read.items() if value}
    about |= {"roles": dict(job.body)} if job.body else {}
    recipe = Recipe(job.recipe.name, motion.history, job.recipe.description)
    return format_recipe(recipe, provenance=about)


def _leave_interrupts_to_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
