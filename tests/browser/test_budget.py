"""How much a browser has to load, compressed: the studio's page, and what is given away alone."""

import gzip
import re

import pytest

from .conftest import STATIC

MOST = {"studio": 350_000, "viewer.html": 200_000, "widget.js": 200_000}
pytestmark = pytest.mark.skipif(
    not (STATIC / "index.html").is_file(), reason="the pages were not built (in frontend: npm run build)"
)


def weight(*names: str) -> int:
    return sum(len(gzip.compress((STATIC / name).read_bytes(), 9)) for name in names)


def test_the_studio() -> None:
    page = (STATIC / "index.html").read_text(encoding="utf-8")
    parts = re.findall(r'(?:src|href)="\./(assets/[^"]+)"', page)
    assert {name.rsplit(".", 1)[1] for name in parts} == {"js", "css"}
    assert set(parts) == {f"assets/{path.name}" for path in (STATIC / "assets").iterdir()}, "all is loaded"
    assert 100_000 < weight(*parts) <= MOST["studio"]


@pytest.mark.parametrize("name", ["viewer.html", "widget.js"])
def test_what_stands_alone(name: str) -> None:
    assert 100_000 < weight(name) <= MOST[name]
