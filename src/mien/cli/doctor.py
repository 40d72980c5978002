"""``mien doctor``: whether everything is here and works."""

import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass

import typer

from . import arguments as a
from .report import show_json, show_table

NEEDED = ("numpy", "scipy", "typer", "rich", "pillow", "tomli-w")
OPTIONAL = {"av": "MP4 films", "pyarrow": "Parquet tables"}


@dataclass(frozen=True)
class Finding:
    """One thing looked at: ``good`` False is a fault, ``advice`` what to do about it."""

    what: str
    found: str
    good: bool = True
    advice: str = ""


def doctor(as_json: a.Json = False) -> None:
    """Show versions and optional parts, and test mien on a clip that comes with it."""
    findings = [*_versions(), *_extras(), *_tests()]
    if as_json:
        show_json([asdict(finding) for finding in findings])
    else:
        show_table(("", "", ""), [(f.what, f.found, f.advice) for f in findings], numbers=3)
    if not all(finding.good for finding in findings):
        raise typer.Exit(1)


def _versions() -> list[Finding]:
    found = [Finding("python", sys.version.split()[0]), Finding("mien", _version("mien"))]
    for package in NEEDED:
        version = _version(package)
        advice = "" if version else f"install it: pip install {package}"
        found.append(Finding(package, version or "missing", bool(version), advice))
    return found


def _extras() -> list[Finding]:
    found = []
    for package, use in OPTIONAL.items():
        version = _version(package)
        advice = "" if version else f"for {use}: pip install {package}"
        found.append(Finding(f"{package} (optional)", version or "not installed", True, advice))
    return found


def _version(package: str) -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def _tests() -> list[Finding]:
    tests: dict[str, Callable[[], str]] = {
        "reads what it writes": _round_trip,
        "an edit of strength 0 changes nothing": _identity,
        "a sad walk hangs its head, feet on the floor": _sad_walk,
    }
    return [_tried(name, test) for name, test in tests.items()]


def _tried(name: str, test: Callable[[], str]) -> Finding:
    """Run a test, which returns what is wrong, if anything; a failure of any kind is a finding."""
    try:
        wrong = test()
    except Exception as error:  # the doctor must report a broken part, not fall over it
        wrong = f"{type(error).__name__}: {error}"
    return Finding(name, wrong or "yes", not wrong, "please report this" if wrong else "")


def _round_trip() -> str:
    from pathlib import Path
    from tempfile import TemporaryDirectory

    import numpy as np

    from .. import samples
    from ..formats import load, save

    walk = samples.walk(seconds=1.0).motion
    with TemporaryDirectory() as folder:
        path = Path(folder) / "walk.bvh"
        save(walk, path)
        again = load(path)
    apart = float(np.abs(again.translations - walk.translations).max())
    return "" if apart < 1e-4 else f"places differ by {apart:g}"


def _identity() -> str:
    from .. import samples
    from ..emotion.resolve import edit

    walk = samples.walk(seconds=1.0).motion
    same = edit(walk, "sad", strength=0.0)
    return "" if (same.rotations == walk.rotations).all() else "it changes something"


def _sad_walk() -> str:
    from .. import samples
    from ..analysis.compare import before_after
    from ..emotion.resolve import edit

    walk = samples.walk().motion
    change = {c.name: c.after - c.before for c in before_after(walk, edit(walk, "sad"))}
    wrong = [] if change["head_pitch"] > 3.0 else ["the head does not go down"]
    wrong += [] if change["foot_slide"] < 0.2 else [f"feet slide by {change['foot_slide']:.1f} cm more"]
    wrong += [] if change["foot_sink"] < 1.0 else [f"feet sink by {change['foot_sink']:.1f} cm"]
    return "; ".join(wrong)
