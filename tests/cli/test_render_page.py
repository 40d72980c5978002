"""``mien render -o page.html``: a page that plays."""

from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

import mien

BUILT = Path(mien.__file__).parent / "studio" / "static" / "viewer.html"


@pytest.mark.skipif(not BUILT.is_file(), reason="the front end was not built (in frontend: npm run build)")
def test_a_page_is_written_once(folder: Path, run: Callable[..., Result]) -> None:
    done = run("render", "brisk.bvh", "--against", "walk.bvh", "-o", "walk.html")
    assert done.exit_code == 0, done.output
    text = (folder / "walk.html").read_text(encoding="utf-8")
    assert "<title>walk</title>" in text
    assert text.count('"role": ') == 2
    assert run("render", "walk.bvh", "-o", "walk.html").exit_code == 2


def test_another_ending_is_refused(folder: Path, run: Callable[..., Result]) -> None:
    done = run("render", "walk.bvh", "-o", "walk.htm")
    assert done.exit_code == 2
    assert "a page .html" in done.output
