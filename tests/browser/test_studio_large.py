"""Large clips, many clips, and how long a slider waits (told, not judged: this machine is not yours)."""

import json
import re
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

import numpy as np
import pytest

from mien import load, samples
from mien.formats import bvh
from mien.motion import Motion

from .driving import Studio, V, grown, numbers, thumb


def test_five_minutes(studio: Studio, tmp_path: Path) -> None:
    file = tmp_path / "long.bvh"
    file.write_bytes(bvh.render(samples.walk(seconds=300.0, fps=30.0).motion))
    studio.open(file)
    assert studio.playback("duration") == pytest.approx(300.0, abs=0.1)
    assert studio.colours() > 800
    studio.tab("Body")
    head = studio.page.get_by_role("region", name=re.compile("^Posture")).get_by_role(
        "spinbutton", name="head, typed"
    )
    head.fill("20")
    head.press("Enter")
    bar = studio.page.get_by_role("progressbar", name="How far the edit is")
    said = "document.querySelector('progress')?.getAttribute('aria-valuetext') ?? ''"
    studio.until(f"/^(posture|foot plant|checking|mending)/.test({said})")
    studio.settle(seconds=120)
    assert bar.count() == 0
    assert studio.layers() == ["Posture"]
    studio.page.evaluate(f"{V}.playback.set({{ time: 290 }})")
    bent = studio.pixels()
    studio.button(re.compile("^Undo")).click()
    studio.settle()
    assert studio.layers() == []
    assert studio.pixels() != bent


def test_150_joints(studio: Studio, tmp_path: Path) -> None:
    motion = grown(samples.walk(seconds=2.0, fps=30.0).motion, 150)
    file = tmp_path / "fingers.bvh"
    file.write_bytes(bvh.render(motion))
    studio.open(file)
    assert studio.button(re.compile(r"^fingers\.bvh .*150 joints")).is_visible()
    assert len(studio.page.evaluate(f"{V}.jointsOnScreen()")) == 150
    studio.mood("tired")
    made = studio.export()
    assert load_bytes(made, tmp_path).skeleton.names == load(file).skeleton.names
    first, second = numbers(file.read_bytes()), numbers(made)
    assert first.shape[1] == second.shape[1] == 3 * 151
    assert np.isfinite(second).all()


def load_bytes(data: bytes, folder: Path) -> Motion:
    file = folder / "made.bvh"
    file.write_bytes(data)
    return load(file)


def test_twenty_clips(studio: Studio, tmp_path: Path) -> None:
    files = []
    for number in range(20):
        file = tmp_path / f"clip {number:02d}.bvh"
        file.write_bytes(bvh.render(samples.wave(seconds=1.0 + number / 30.0, fps=30.0).motion))
        files.append(file)
    studio.open(*files)
    rows = studio.page.get_by_role("complementary", name="Library").get_by_role("listitem")
    assert rows.count() == 20
    studio.mood("sad")
    studio.button(re.compile(r"^clip 07\.bvh")).click()
    studio.settle()
    assert studio.layers() == []
    assert studio.playback("duration") == pytest.approx(1.0 + 7 / 30, abs=0.05)
    studio.page.reload()
    studio.settle()
    assert rows.count() == 20
    assert studio.page.title().startswith("clip 07.bvh")
    studio.button(re.compile(r"^clip 19\.bvh")).click()
    studio.settle()
    assert studio.layers() == ["Sad"]


Record = Callable[[str, object], None]


def test_how_long_a_slider_waits(studio: Studio, tmp_path: Path, record_property: Record) -> None:
    """The page blends strength at once; a posture slider is answered by the server. Ten seconds of a walk."""
    file = tmp_path / "walk.bvh"
    file.write_bytes(bvh.render(samples.walk(seconds=10.0).motion))
    studio.open(file)
    studio.mood("sad")
    studio.page.evaluate(
        f"""() => {{
          window.__shown = [];
          const viewer = {V}, set = viewer.setEdited.bind(viewer);
          viewer.setEdited = source => {{
            set(source);
            window.__shown.push(performance.now());
          }};
          addEventListener("pointermove", () => (window.__moved ??= []).push(performance.now()), true);
        }}"""
    )
    waits = {}
    studio.tab("Body")
    head = studio.page.get_by_role("region", name=re.compile("^Posture")).get_by_role(
        "slider", name="head", exact=True
    )
    for name, slider in (("strength", studio.slider("Overall")), ("posture", head)):
        x, y = thumb(slider)
        studio.page.mouse.move(x, y)
        studio.page.mouse.down()
        found = []
        for step in range(1, 11):
            studio.page.evaluate("window.__shown = []; window.__moved = []")
            studio.page.mouse.move(x + (3 if name == "posture" else -3) * step, y)
            end = time.monotonic() + 20
            while not studio.page.evaluate("window.__shown.length && window.__asked === 0"):
                assert time.monotonic() < end, f"{name} was never shown"
                studio.page.wait_for_timeout(5)
            moved, shown = studio.page.evaluate("[window.__moved.at(-1), window.__shown[0]]")
            found.append(shown - moved)
        studio.page.mouse.up()
        studio.settle()
        waits[name] = {"median ms": round(median(found), 1), "longest ms": round(max(found), 1)}
    record_property("waits", json.dumps(waits))
    print("from the hand to what is drawn next:", waits)
    assert set(waits) == {"strength", "posture"}
