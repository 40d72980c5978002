"""The notebook's view in a real browser, given what anywidget gives it."""

from base64 import b64encode
from collections.abc import Callable
from typing import Any

import pytest

from mien import samples
from mien.render.wire import encode

from .conftest import STATIC

pytestmark = pytest.mark.skipif(
    not (STATIC / "widget.js").is_file(), reason="the widget was not built (in frontend: npm run build)"
)
# The model of anywidget, as far as the widget asks it; bytes come as a view into something larger.
SHOW = """async ([code, data]) => {
  const bytes = Uint8Array.from(atob(data), letter => letter.charCodeAt(0));
  const padded = new Uint8Array(bytes.length + 7);
  padded.set(bytes, 3);
  const fields = {
    edited: new DataView(padded.buffer, 3, bytes.length), original: new DataView(new ArrayBuffer(0)),
    height: 300, quality: "low",
  };
  const model = { get: name => fields[name], on() {}, off() {} };
  const widget = await import(URL.createObjectURL(new Blob([code], { type: "text/javascript" })));
  window.stop = widget.default.render({ model, el: document.body });
}"""


def test_it_shows_a_motion_and_goes(opened: Callable[..., Any]) -> None:
    page = opened("about:blank")
    wave = encode(samples.wave(seconds=1.0, fps=30.0).motion, "wave")
    page.evaluate(SHOW, [(STATIC / "widget.js").read_text(encoding="utf-8"), b64encode(wave).decode()])
    assert page.evaluate("window.__viewer.colours()") > 300
    assert page.locator(".mien-player").bounding_box()["height"] == 300
    page.locator("input[type=range]").focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate("window.__viewer.playback.frame") == 1
    page.evaluate("window.stop()")
    assert page.locator("canvas").count() == 0
