"""A real browser for what is drawn; skipped, with the reason, where there is none."""

import functools
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import mien
from mien import samples
from mien.formats import bvh

from .driving import Server, Studio

STATIC = Path(mien.__file__).parent / "studio" / "static"
FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


@functools.cache
def chromium() -> str | None:
    """Return where a Chromium is, or None."""
    return next(
        (
            found
            for name in ("chromium", "chromium-browser", "google-chrome")
            if (found := shutil.which(name))
        ),
        None,
    )


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if chromium() is None:
        pytest.skip("there is no chromium")
    with sync_api.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=chromium(), args=FLAGS)
        yield started
        started.close()


@pytest.fixture
def opened(browser: Any) -> Iterator[Callable[..., Any]]:
    """Open an address; at the end, no error may have been said, and nothing fetched from a network."""
    said: list[str] = []
    pages = []

    def go(address: str, **options: Any) -> Any:
        page = browser.new_page(viewport={"width": 640, "height": 480}, reduced_motion="reduce", **options)
        page.on("console", lambda m: said.append(m.text) if m.type in ("error", "warning") else None)
        page.on("pageerror", lambda e: said.append(str(e)))
        page.on("request", lambda r: said.append(r.url) if r.url.startswith("http") else None)
        page.goto(address)
        pages.append(page)
        return page

    yield go
    for page in pages:
        page.close()
    # The software renderer is slow at reading pixels back, and says so.
    assert not [line for line in said if "ReadPixels" not in line]


@pytest.fixture(scope="session")
def built() -> None:
    """Skip, with the reason, where the studio cannot be started or has no page."""
    for package in ("fastapi", "uvicorn", "platformdirs"):
        pytest.importorskip(package, reason=f"the studio's packages are not installed ({package})")
    if not (STATIC / "index.html").is_file():
        pytest.skip("the studio's page was not built (in frontend: npm run build)")


@pytest.fixture(scope="module")
def running(browser: Any, built: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """A studio for the tests of a file; each begins in an empty workspace."""
    server = Server(tmp_path_factory.mktemp("studio"))
    yield server
    server.stop()


@pytest.fixture
def server(running: Server) -> Server:
    running.forget()
    return running


@pytest.fixture
def visit(browser: Any) -> Iterator[Callable[..., Studio]]:
    """Open studios; at the end nothing may have gone wrong on a page, nor been asked of another host."""
    seen: list[Studio] = []
    contexts = []

    def go(
        server: Server, context: Any = None, query: str = "", pictures: bool = False, **options: Any
    ) -> Studio:
        if context is None:
            room = {"viewport": {"width": 1280, "height": 800}, "reduced_motion": "reduce", **options}
            context = browser.new_context(**room)
            contexts.append(context)
        seen.append(Studio(context, server, query, pictures=pictures))
        return seen[-1]

    yield go
    problems = [problem for studio in seen for problem in studio.problems()]
    for studio in seen:
        studio.rest()
    for context in contexts:
        context.close()
    assert problems == []


@pytest.fixture
def studio(visit: Callable[..., Studio], server: Server) -> Studio:
    """The page, with nothing open."""
    return visit(server)


@pytest.fixture(scope="session")
def clips(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with ``walk.bvh`` and ``wave.bvh``, short ones."""
    folder = tmp_path_factory.mktemp("clips")
    for name, make in (("walk", samples.walk), ("wave", samples.wave)):
        (folder / f"{name}.bvh").write_bytes(bvh.render(make(seconds=2.5, fps=30.0).motion))
    return folder


@pytest.fixture
def walking(studio: Studio, clips: Path) -> Studio:
    """The page with a walk, nothing done to it yet."""
    studio.open(clips / "walk.bvh")
    return studio
