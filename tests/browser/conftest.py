"""A real browser for what is drawn; skipped, with the reason, where there is none."""

import functools
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import mien

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
