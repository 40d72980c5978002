"""The page without a server: what is written into it, and what is said where it was not built."""

import json
import re
from base64 import b64decode
from importlib import import_module
from pathlib import Path

import pytest

import mien
from mien import samples
from mien.errors import MienError
from mien.render import page as make_page

BUILT = Path(mien.__file__).parent / "studio" / "static" / "viewer.html"
WALK = samples.walk(seconds=0.5).motion
needs_build = pytest.mark.skipif(
    not BUILT.is_file(), reason="the front end was not built (frontend: npm run build)"
)


def clips(text: str) -> list[dict[str, str]]:
    found = re.search(r'<script type="application/json" id="mien-clips">(.*?)</script>', text, re.DOTALL)
    return json.loads(found[1])


@needs_build
def test_a_page_holds_its_clips() -> None:
    text = make_page(WALK, against=WALK, title="A & B")
    assert [clip["role"] for clip in clips(text)] == ["original", "edited"]
    assert all(b64decode(clip["data"])[:4] == b"MIEN" for clip in clips(text))
    assert "<title>A &amp; B</title>" in text


@needs_build
def test_no_name_breaks_out_of_the_page() -> None:
    named = WALK.with_(name="</script><script>alert(1)</script>")
    text = make_page(named)
    assert "alert(1)</script>" not in text
    assert clips(text)[0]["name"] == named.name


@needs_build
def test_a_page_asks_nobody() -> None:
    text = make_page(WALK)
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]+)"', text)[1]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert len(text) < 900_000


def test_where_it_was_not_built_it_says_how(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    module = import_module("mien.render.page")
    monkeypatch.setattr(module, "__file__", str(tmp_path / "mien" / "render" / "page.py"))
    with pytest.raises(MienError, match="npm ci && npm run build"):
        module.built("viewer.html")
