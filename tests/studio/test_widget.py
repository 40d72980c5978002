"""The viewer in a notebook, as far as Python goes."""

import sys
from pathlib import Path

import pytest

import mien
from mien import samples
from mien.studio import widget

BUILT = Path(mien.__file__).parent / "studio" / "static" / "widget.js"
WAVE = samples.wave(seconds=0.5).motion


@pytest.fixture(autouse=True)
def _fresh() -> None:
    widget._widget.cache_clear()


@pytest.mark.skipif(not BUILT.is_file(), reason="the front end was not built (frontend: npm run build)")
def test_a_view_holds_its_clips() -> None:
    pytest.importorskip("anywidget", reason="anywidget is an extra")
    view = mien.show(WAVE, against=WAVE, height=300, low=True)
    assert view.edited[:4] == view.original[:4] == b"MIEN"
    assert (view.height, view.quality) == (300, "low")
    assert "render" in str(view._esm)


def test_without_anywidget_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(mien.MienError, match=r"mien\[notebook\]"):
        mien.show(WAVE)
