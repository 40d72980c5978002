"""All checks of the project, in an environment of their own: ``python3.11 scripts/check.py``.

Makes ``.venv`` (kept for the next time), installs mien with its development tools, checks, tests and builds
the front end, runs ruff, mypy and pytest, builds the documentation and the wheel, installs that in a second,
empty environment and runs the demo and the studio there. Needs Python 3.11 and a package registry. Without
npm (Node 20 or newer) the front end is left out, without Chromium the tests in a browser, and it says so.
What is given after the name goes to pytest.
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


def check_front_end(front: Path) -> bool:
    """Check, test and build the pages; returns whether they could be built."""
    npm = shutil.which("npm")
    if npm is None:
        print("== front end: SKIPPED, there is no npm (Node 20 or newer); so are its tests in a browser")
        return False
    run("install the front end's packages", npm, "ci", "--no-audit", "--no-fund", folder=front, needed=True)
    run("types of the front end", npm, "run", "--silent", "check", folder=front)
    run("tests of the front end", npm, "test", "--silent", folder=front)
    run("build the front end", npm, "run", "--silent", "build", folder=front)
    return True


def check_in_browser(python: Path) -> None:
    """Run the tests in a browser, one after the other: each draws with both cores.

    What fails is tried once more by itself, as a loaded machine without a graphics card can be too slow for a
    browser's own time limits; that is said, and a test that fails twice has failed.
    """
    title = "pytest in a browser"
    run(title, python, "-m", "pytest", "tests/browser", "-rs")
    if title in FAILED:
        FAILED.remove(title)
        run(f"{title}, once more what failed", python, "-m", "pytest", "tests/browser", "--last-failed")


def check_wheel(python: Path, place: Path, *, pages: bool) -> None:
    """Build the wheel, install it where nothing of the source tree is seen, run the demo and the studio."""
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
    if pages:
        run("install the studio", clean, "-m", "pip", "install", "--quiet", f"{wheel}[studio]", needed=True)
        run("the studio, from the wheel", clean, ROOT / "scripts" / "try_studio.py", folder=place)


def main() -> None:
    """Run every check; end with the names of those that failed and an exit code above 0."""
    if sys.version_info < OLDEST:
        sys.exit(f"mien needs Python {'.'.join(map(str, OLDEST))} or newer, this is {sys.version.split()[0]}")
    python = environment(ROOT / ".venv")
    install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    run("pip that knows dependency groups", *install, "--upgrade", "pip>=25.1", needed=True)
    groups = ["--group", "dev", "--group", "docs"]
    run("install mien and its tools", *install, "--editable", ".[video,studio]", *groups, needed=True)
    pages = check_front_end(ROOT / "frontend")
    run("ruff check", python, "-m", "ruff", "check", ".")
    run("ruff format", python, "-m", "ruff", "format", "--check", ".")
    run("mypy", python, "-m", "mypy")
    run("pytest", python, "-m", "pytest", "-n", "2", "--ignore=tests/browser", *sys.argv[1:])
    if not sys.argv[1:]:
        check_in_browser(python)
    place = Path(tempfile.mkdtemp(prefix="mien-check-"))
    try:
        run("documentation", python, "-m", "sphinx", "-q", "-W", "--keep-going", "docs", place / "docs")
        check_wheel(python, place, pages=pages)
    finally:
        shutil.rmtree(place, ignore_errors=True)
    sys.exit(f"== FAILED: {', '.join(FAILED)}" if FAILED else None)


if __name__ == "__main__":
    main()
