"""Takes and edits as features, computed in several processes and kept on disk between runs.

What is kept lies in a folder of the system's temporary ones and is valid for the very source files and clips
that it was made from.
"""

import hashlib
import pickle
import tempfile
from collections.abc import Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from acted import NEUTRAL, Take
from clip_features import FAMILIES, Feature, View
from methods import METHODS, Edit

import mien
from mien.analysis.checks.report import check
from mien.errors import MienError

Features = dict[str, tuple[float, Feature]]
STORE = Path(tempfile.gettempdir()) / "mien-effect"
CUTS = ((0.0, 0.85), (0.15, 1.0))  # parts of a neutral take that are as neutral as the whole


@dataclass(frozen=True)
class Look:
    """Family -> features of a clip; of neutral takes also of ``cuts``, of edits the ``failed`` checks."""

    whole: dict[str, Features]
    seconds: float
    cuts: tuple[dict[str, Features], ...] = ()
    failed: tuple[str, ...] = ()


@dataclass(frozen=True)
class Job:
    """A take as it is, or edited by a ``method`` asked for ``word``, which learned from ``contents``."""

    take: Take
    method: str = ""
    word: str = ""
    contents: tuple[str, ...] = ()


def look_at(jobs: Iterable[Job], training: Sequence[tuple[Take, Take]]) -> dict[Job, Look]:
    """Return the look of every job."""
    wanted = sorted(set(jobs), key=lambda j: (j.method, j.contents, j.word, str(j.take.path)))
    STORE.mkdir(exist_ok=True)
    with ProcessPoolExecutor(initializer=_learners_from, initargs=(tuple(training),)) as pool:
        return dict(zip(wanted, pool.map(_kept, wanted, chunksize=2), strict=True))


_TRAINING: list[tuple[Take, Take]] = []


def _learners_from(training: tuple[tuple[Take, Take], ...]) -> None:
    _TRAINING[:] = training


def _kept(job: Job) -> Look:
    """Return the look of a job, from disk if it is there."""
    here = Path(__file__).parent
    sources = _digest(here / "clip_features.py", here / "acted.py", here / "looks.py", job.take.path)
    if job.method:
        package = Path(mien.__file__).parent
        sources += _digest(*sorted(f for f in package.rglob("*") if f.suffix in (".py", ".toml", ".json")))
        sources += _digest(*sorted(here.glob("*.py"))) if METHODS[job.method].learn else ""
    place = STORE / hashlib.sha256(repr((job, sources)).encode()).hexdigest()[:32]
    if not place.exists():
        part = place.with_suffix(f".{id(job)}")
        part.write_bytes(pickle.dumps(_look(job)))
        part.replace(place)
    look: Look = pickle.loads(place.read_bytes())
    return look


@cache
def _digest(*files: Path) -> str:
    total = hashlib.sha256()
    for file in files:
        total.update(file.read_bytes())
    return total.hexdigest()


def _look(job: Job) -> Look:
    motion = job.take.load()
    if not job.method:
        view = View.of(motion, like=mien.load(job.take.neutral) if job.take.neutral else None)
        parts = CUTS if job.take.style == NEUTRAL else ()
        return Look(_features(view), motion.duration, tuple(_features(view.cut(*part)) for part in parts))
    try:
        done = _editor(job.method, job.contents)(motion, job.word)
        failed = check(done).failed if done is not motion else ()
    except MienError as error:
        return Look({}, motion.duration, failed=(f"error: {error}"[:120],))
    return Look(_features(View.of(done)), done.duration, failed=tuple(failed))


def _features(view: View) -> dict[str, Features]:
    return {name: family(view) for name, family in FAMILIES.items()}


@cache
def _editor(name: str, contents: tuple[str, ...]) -> Edit:
    method = METHODS[name]
    if method.learn is not None:
        return method.learn([pair for pair in _TRAINING if pair[0].content in contents])
    if method.edit is None:
        raise SystemExit(f"method {name} has neither edit nor learn")
    return method.edit
