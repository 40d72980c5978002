"""Make the pictures of the studio's documentation: ``python scripts/studio_pictures.py``.

Starts the studio in a folder of its own, works in it with a real browser as a person would, and writes
``docs/studio/*.png`` with few colours to stay small. Needs Chromium, playwright and the built page.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

from PIL import Image

from mien import samples
from mien.formats import bvh

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "docs" / "studio"
SIZE = {"width": 1360, "height": 820}
FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
BUSY = (
    "/(Opening|Working it out|Waiting for mien|saving|Checking)…/.test(document.body.innerText)"
    " || [...document.images].some(image => image.getBoundingClientRect().top < innerHeight && !image.src)"
)


def settle(page: Any) -> None:
    """Wait until every answer and every picture is there."""
    quiet = 0
    while quiet < 10:
        quiet = 0 if page.evaluate(BUSY) else quiet + 1
        page.wait_for_timeout(100)


def open_walk(page: Any) -> None:
    """Open the clip that most pictures show, at a moment in mid step."""
    page.get_by_label("Clips or a project", exact=True).set_input_files(
        files=[{"name": "walk.bvh", "mimeType": "text/plain", "buffer": bvh.render(samples.walk().motion)}]
    )
    settle(page)


def at(page: Any, seconds: float) -> None:
    """Go to a moment."""
    page.evaluate(f"window.__viewer.playback.set({{ playing: false, time: {seconds} }})")


def mood(page: Any, name: str) -> None:
    """Choose a mood by its picture."""
    page.get_by_role("complementary", name="Library").get_by_role("button", name=name, exact=True).click()
    page.mouse.move(5, 5)
    settle(page)


def empty(page: Any) -> None:
    """Show what a new user meets."""


def editing(page: Any) -> None:
    """Show a tired walk, the arms of it only, over its ghost."""
    open_walk(page)
    mood(page, "tired")
    page.get_by_role("group", name="Parts").get_by_text("arms", exact=True).click()
    settle(page)
    at(page, 1.2)


def dark(page: Any) -> None:
    """Show a proud walk in dark colours."""
    open_walk(page)
    mood(page, "proud")
    at(page, 1.2)


def side(page: Any) -> None:
    """Show the original and an excited walk beside each other, with the trails of hands, feet and head."""
    open_walk(page)
    mood(page, "excited")
    page.get_by_role("radiogroup", name="Compare").get_by_text("Side by side", exact=True).click()
    page.get_by_role("button", name="Trails", exact=True).click()
    page.mouse.move(5, 5)
    at(page, 1.2)


def disc(page: Any) -> None:
    """Show the disc with its three markers."""
    open_walk(page)
    page.get_by_role("spinbutton", name="Valence, typed").fill("0.5")
    page.keyboard.press("Enter")
    page.get_by_role("spinbutton", name="Arousal, typed").fill("0.4")
    page.keyboard.press("Enter")
    settle(page)


def check(page: Any) -> None:
    """Show a check that fails, and where it fails on the timeline."""
    open_walk(page)
    for switch in ("Safe", "Feet on the floor"):
        page.get_by_role("checkbox", name=switch, exact=True).uncheck()
    page.get_by_role("combobox", name="Add a layer").select_option(label="Path length")
    page.get_by_role("group", name="Parts").wait_for()
    page.get_by_role("region", name="Layers").get_by_role("spinbutton", name="mid, typed").fill("0.4")
    page.keyboard.press("Enter")
    page.get_by_role("tab", name=re.compile("^Checks")).click()
    settle(page)
    failing = page.get_by_role("row").filter(has_text="fails").get_by_role("button")
    failing.first.click()


PICTURES: Mapping[str, tuple[Callable[[Any], None], str]] = {
    "empty": (empty, "light"),
    "editing": (editing, "light"),
    "dark": (dark, "dark"),
    "side": (side, "light"),
    "disc": (disc, "light"),
    "check": (check, "light"),
}


def shot(page: Any, name: str) -> Image.Image:
    """Return the picture of the page, or of the disc alone."""
    whole = page.get_by_role("tabpanel") if name == "disc" else page
    picture = Image.open(BytesIO(whole.screenshot()))
    return picture.convert("RGB").quantize(256, dither=Image.Dither.FLOYDSTEINBERG)


def make_all(folder: Path, names: list[str]) -> None:
    """Write pictures into a folder."""
    from playwright.sync_api import sync_playwright

    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as workspace, sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium") or shutil.which("google-chrome"), args=FLAGS
        )
        for name in names:
            make, theme = PICTURES[name]
            command = [sys.executable, "-m", "mien", "studio", "--no-browser", "--workspace", workspace]
            with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
                assert server.stdout
                page = browser.new_page(
                    viewport=SIZE | ({"height": 1180} if name == "disc" else {}),
                    color_scheme=theme,
                    reduced_motion="reduce",
                )
                page.goto(server.stdout.readline().strip())
                page.get_by_role("heading", name="Change the mood of a motion").wait_for()
                settle(page)
                make(page)
                settle(page)
                page.wait_for_timeout(400)
                shot(page, name).save(folder / f"{name}.png", optimize=True)
                page.close()
                server.terminate()
            for kept in ("clips.json", "project.json"):
                Path(workspace, kept).unlink(missing_ok=True)
        browser.close()


if __name__ == "__main__":
    make_all(TARGET, sys.argv[1:] or list(PICTURES))
    size = sum(path.stat().st_size for path in TARGET.glob("*.png"))
    print(f"wrote {TARGET.relative_to(ROOT)}, {size / 1000:.0f} kB in all")
