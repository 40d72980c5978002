"""All checks of the project, in an environment of their own: ``python3.11 scripts/check.py``.

Makes ``.venv`` (kept for the next time), installs mien with its development tools, runs ruff, mypy and
pytest, builds the documentation and the wheel, installs that in a second, empty environment and runs the
demo there. Needs Python 3.11 and a package registry; nothing else. What is given after the name goes to
pytest.
"""

import shutil
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
OLDEST = (3, 11)
FAILED: list[str] = []  # checks that did not pass; the others go on, so that one run tells all


def python_of(environment: Path) -> Path:
    """Return the Python of a virtual environment."""
    return environment / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")


def run(title: str, *command: object, folder: Path = ROOT, needed: bool = False) -> None:
    """Run a command and say how it ended and after how long; stop everything when a needed one fails."""
    print(f"== {title}", flush=True)
    start = time.monotonic()
    done = subprocess.run([str(c) for c in command], cwd=folder)
    if done.returncode:
        FAILED.append(title)
        print(f"== {title}: FAILED (exit code {done.returncode})", flush=True)
        if needed:
            sys.exit(1)
        return
    print(f"== {title}: {time.monotonic() - start:.0f} s", flush=True)


def environment(path: Path) -> Path:
    """Make a virtual environment where there is none yet, and return its Python."""
    if not python_of(path).exists():
        print(f"== new environment {path.name}", flush=True)
        venv.create(path, with_pip=True)
    return python_of(path)


def check_wheel(python: Path, place: Path) -> None:
    """Build the wheel, install it where nothing of the source tree can be seen, and run the demo."""
    run("build the wheel", python, "-m", "build", "--wheel", "--outdir", place / "dist", needed=True)
    wheel = next((place / "dist").glob("*.whl"))
    clean = environment(place / "clean")
    run(
        "install the wheel in an empty environment",
        clean,
        "-m",
        "pip",
        "install",
        "--quiet",
        wheel,
        needed=True,
    )
    run("the demo, from the wheel", clean, "-m", "mien", "demo", folder=place)
    made = sorted(p.name for p in place.rglob("*") if p.suffix in (".bvh", ".png") and "clean" not in p.parts)
    if not (any(n.endswith(".bvh") for n in made) and any(n.endswith(".png") for n in made)):
        FAILED.append("the demo's files")
        print(f"== the demo should have written a BVH and a picture, found {made}", flush=True)


def main() -> None:
    """Run every check; end with the names of those that failed and an exit code above 0."""
    if sys.version_info < OLDEST:
        sys.exit(f"mien needs Python {'.'.join(map(str, OLDEST))} or newer, this is {sys.version.split()[0]}")
    python = environment(ROOT / ".venv")
    install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    run("pip that knows dependency groups", *install, "--upgrade", "pip>=25.1", needed=True)
    groups = ["--group", "dev", "--group", "docs"]
    run("install mien and its tools", *install, "--editable", ".[video]", *groups, needed=True)
    run("ruff check", python, "-m", "ruff", "check", ".")
    run("ruff format", python, "-m", "ruff", "format", "--check", ".")
    run("mypy", python, "-m", "mypy")
    run("pytest", python, "-m", "pytest", "-n", "2", *sys.argv[1:])
    place = Path(tempfile.mkdtemp(prefix="mien-check-"))
    try:
        run("documentation", python, "-m", "sphinx", "-q", "-W", "--keep-going", "docs", place / "docs")
        check_wheel(python, place)
    finally:
        shutil.rmtree(place, ignore_errors=True)
    sys.exit(f"== FAILED: {', '.join(FAILED)}" if FAILED else None)


if __name__ == "__main__":
    main()
