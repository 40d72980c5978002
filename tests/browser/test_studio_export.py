"""What is given away: the same bytes by every way out, and the same motion when it comes in again."""

import os
import re
import subprocess
import sys
import tomllib
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien import edit, load
from mien.formats import bvh
from mien.kinematics.fk import world

from .driving import Studio, V


def copied(studio: Studio, what: str, name: str) -> str:
    """Press a button that copies an edit into a file of that name; returns what is in the clipboard then."""
    studio.page.context.grant_permissions(["clipboard-read", "clipboard-write"], origin=studio.server.base)
    studio.button("Export").click()
    dialog = studio.page.get_by_role("dialog")
    field = dialog.get_by_role("textbox", name="File name")
    field.fill(name)
    field.press("Tab")
    studio.settle()
    dialog.get_by_role("button", name=what, exact=True).click()
    dialog.get_by_role("status").get_by_text("was copied").wait_for()
    text = str(studio.page.evaluate("navigator.clipboard.readText()"))
    studio.close_dialog()
    return text


def run(command: list[str], folder: Path, text: str | None = None) -> None:
    """Run something as a person would who has mien installed."""
    tools = folder / "bin"
    tools.mkdir(exist_ok=True)
    script = tools / "mien"
    script.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m mien "$@"\n', encoding="utf-8")
    script.chmod(0o755)
    where = {**os.environ, "PATH": f"{tools}{os.pathsep}{os.environ['PATH']}"}
    done = subprocess.run(command, cwd=folder, input=text, text=True, capture_output=True, env=where)
    assert done.returncode == 0, done.stderr


def do_much(studio: Studio) -> None:
    """Two layers with strength, parts and a stretch of time."""
    studio.mood("tired")
    studio.type("Strength, typed", "0.7")
    studio.add("Posture")
    studio.tab("Body")
    studio.page.get_by_role("region", name=re.compile("^Posture")).get_by_role(
        "spinbutton", name="head, typed"
    ).fill("20")
    studio.press("Enter")
    studio.settle()
    studio.type("Time: start", "0.5")
    studio.type("Overall, typed", "0.9")


def test_the_input_at_strength_0(walking: Studio, clips: Path) -> None:
    source = (clips / "walk.bvh").read_bytes()
    assert walking.export() == source, "nothing done yet"
    walking.mood("sad")
    assert walking.export() != source
    walking.type("Overall, typed", "0")
    assert walking.export() == source
    walking.type("Overall, typed", "1")
    walking.type("Strength, typed", "0")
    assert walking.export() == source


def test_it_is_what_python_makes(walking: Studio, clips: Path) -> None:
    walking.mood("sad")
    assert walking.export() == bvh.render(edit(load(clips / "walk.bvh"), "sad"))


def test_in_again(walking: Studio, clips: Path, tmp_path: Path) -> None:
    """The exported file, opened again, stands as the edit stood: on the screen and in numbers."""
    walking.mood("excited")
    walking.page.evaluate(f"{V}.playback.set({{ time: 0.9 }})")
    walking.page.get_by_text("Edited", exact=True).click()
    before = walking.page.evaluate(f"{V}.jointsOnScreen()")
    file = tmp_path / "again.bvh"
    file.write_bytes(walking.export())
    walking.open(file)
    walking.page.evaluate(f"{V}.playback.set({{ time: 0.9 }})")
    after = walking.page.evaluate(f"{V}.jointsOnScreen()")
    shape = [np.array([places[n] for n in before]) - places["Hips"] for places in (before, after)]
    assert np.abs(shape[0]).max() > 100
    size = [np.ptp(one[:, 1]) for one in shape]
    np.testing.assert_allclose(shape[0] / size[0], shape[1] / size[1], atol=0.02)
    assert walking.export() == file.read_bytes(), "and it goes out as it came in"
    expected = edit(load(clips / "walk.bvh"), "excited")
    np.testing.assert_allclose(world(load(file))[1], world(expected)[1], atol=1e-3)


@pytest.mark.parametrize("much", [False, True])
def test_copied_they_make_the_same_bytes(walking: Studio, clips: Path, tmp_path: Path, much: bool) -> None:
    if much:
        do_much(walking)
    else:
        walking.mood("sad")
        walking.page.get_by_role("group", name="Parts").get_by_text("arms", exact=True).click()
        walking.settle()
    (tmp_path / "walk.bvh").write_bytes((clips / "walk.bvh").read_bytes())
    name = "so viel" if much else "walk_edited"
    exported, made = walking.export(), tmp_path / f"{name}.bvh"
    assert exported != (clips / "walk.bvh").read_bytes()
    command = copied(walking, "Copy as command", name)
    assert command.startswith("cat > " if much else "mien edit walk.bvh --emotion sad --parts arms")
    run(["sh", "-eu"], tmp_path, command)
    assert made.read_bytes() == exported
    made.unlink()
    run([sys.executable, "-"], tmp_path, copied(walking, "Copy as Python", name))
    assert made.read_bytes() == exported


def test_every_kind_of_file(walking: Studio, clips: Path, tmp_path: Path) -> None:
    do_much(walking)
    exported = walking.export()
    (tmp_path / "walk.bvh").write_bytes((clips / "walk.bvh").read_bytes())
    (tmp_path / "recipe.toml").write_bytes(walking.export("Recipe"))
    tomllib.loads((tmp_path / "recipe.toml").read_text(encoding="utf-8"))
    run(["mien", "edit", "walk.bvh", "--recipe", "recipe.toml", "-o", "out.bvh"], tmp_path)
    assert (tmp_path / "out.bvh").read_bytes() == exported
    with Image.open(BytesIO(walking.export("Picture"))) as picture:
        assert picture.format == "PNG"
        assert picture.width == 1600
    page = walking.export("Page (HTML)").decode()
    assert page.startswith("<!doctype html>")
    assert "walk" in page
    assert b"mien_project" in walking.export("Project")
    walking.button("Export").click()
    walking.page.get_by_role("radio", name="Film (GIF)").check()
    walking.type("Height", "120")
    with walking.page.expect_download(timeout=60_000) as given:
        walking.page.get_by_role("dialog").get_by_role("button", name="Export", exact=True).click()
    with Image.open(given.value.path()) as film:
        assert film.n_frames > 5


def test_a_film(walking: Studio, tmp_path: Path) -> None:
    av = pytest.importorskip("av", reason="MP4 needs PyAV, which is not installed")
    walking.mood("sad")
    walking.button("Export").click()
    walking.page.get_by_role("radio", name="Film (MP4)").check()
    walking.type("Height", "240")
    with walking.page.expect_download(timeout=120_000) as given:
        walking.page.get_by_role("dialog").get_by_role("button", name="Export", exact=True).click()
    assert given.value.suggested_filename == "walk_edited.mp4"
    with av.open(str(given.value.path())) as film:
        pictures = [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]
        seconds = float(len(pictures) / film.streams.video[0].average_rate)
    assert seconds == pytest.approx(walking.playback("duration"), abs=0.1)
    assert pictures[0].shape[0] == 240
    left, right = np.split(pictures[len(pictures) // 2], 2, axis=1)
    assert np.ptp(left) > 100, "original and edit stand beside each other"
    assert np.ptp(right) > 100


def test_by_a_name_of_ones_own(walking: Studio) -> None:
    walking.mood("sad")
    walking.button("Export").click()
    dialog = walking.page.get_by_role("dialog")
    name = dialog.get_by_role("textbox", name="File name")

    def exported(kind: str) -> str:
        if not dialog.is_visible():
            walking.button("Export").click()
        dialog.get_by_role("radio", name=kind).check()
        if typed is not None:
            name.fill(typed)
        with walking.page.expect_download() as given:
            dialog.get_by_role("button", name="Export", exact=True).click()
        dialog.wait_for(state="hidden")
        assert Path(given.value.path()).read_bytes()
        return str(given.value.suggested_filename)

    name.fill("other")
    name.press("Escape")
    assert name.input_value() == "walk_edited", "Escape gives the text back, and the dialog stays"
    typed = None
    assert (exported("Motion"), exported("Recipe")) == ("walk_edited.bvh", "walk_edited.toml")
    assert exported("Project") == "walk.mien.json"
    typed = "Gang, müde.bvh"
    assert (exported("Motion"), exported("Project")) == ("Gang, müde.bvh", "Gang, müde.bvh.mien.json")
    typed = " ../../etc/pass:wd. "
    assert exported("Motion") == "etc_pass_wd.bvh"
    assert "etc_pass_wd.bvh was saved" in walking.messages()
    typed = "/"
    assert exported("Recipe") == "walk_edited.toml"


def test_a_picture_of_the_viewport(walking: Studio) -> None:
    walking.button("File").click()
    with walking.page.expect_download() as given:
        walking.page.get_by_role("menuitem", name="Save a picture of the viewport").click()
    with Image.open(given.value.path()) as picture:
        assert len(picture.convert("RGB").getcolors(10**6)) > 500


class TestChecks:
    @pytest.fixture
    def broken(self, walking: Studio) -> Studio:
        """A walk bent until a check fails, with nothing that would prevent it."""
        walking.page.get_by_role("checkbox", name="Safe", exact=True).uncheck()
        walking.page.get_by_role("checkbox", name="Feet on the floor").uncheck()
        walking.add("Path length")
        walking.tab("Body")
        section = walking.page.get_by_role("region", name=re.compile("^Path length"))
        section.get_by_role("button", name=re.compile("^Path length")).click()
        field = section.get_by_role("spinbutton", name="mid, typed")
        field.fill("0.3")
        field.press("Enter")
        walking.settle()
        walking.tab("Checks")
        return walking

    def test_a_failing_check_is_shown_and_led_to(self, broken: Studio) -> None:
        tab = broken.page.get_by_role("tab", name=re.compile("^Checks"))
        assert re.search(r"[1-9]\d* failing", tab.inner_text())
        table = broken.page.get_by_role("table")
        row = table.get_by_role("row").filter(has_text="fails").filter(has=broken.page.get_by_role("button"))
        label = row.first.get_by_role("button").inner_text()
        cells = row.first.get_by_role("cell").all_inner_texts()
        assert float(cells[1]) > float(re.findall(r"[\d.]+", cells[2])[0]), "more than is allowed"
        assert broken.playback("time") == 0
        row.first.get_by_role("button").click()
        there = broken.playback("time")
        mark = broken.page.get_by_role("region", name="Timeline", exact=True).get_by_role(
            "button", name=re.compile(f"^{re.escape(label)}: ")
        )
        worst = {re.search(r"worst at ([\d:.]+)", one.get_attribute("aria-label"))[1] for one in mark.all()}
        assert there > 0
        assert broken.page.get_by_role("textbox", name="Time", exact=True).input_value() in worst
        broken.press("Home")
        mark.last.click()
        assert broken.playback("time") > 0

    def test_what_fails_is_red(self, broken: Studio) -> None:
        table = broken.page.get_by_role("table")
        row = table.get_by_role("row").filter(has_text="fails").filter(has=broken.page.get_by_role("button"))
        row.first.get_by_role("button").click()
        red = broken.pixels()
        broken.page.evaluate(f"{V}.setMarks([])")
        assert broken.pixels() != red

    def test_make_safe_mends(self, broken: Studio) -> None:
        broken.button("Make safe").click()
        broken.settle()
        assert broken.page.get_by_role("tab", name="Checks all pass").is_visible()
        assert "Everything that is checked is right." in broken.page.get_by_role("tabpanel").inner_text()
        assert broken.page.get_by_role("checkbox", name="Safe", exact=True).is_checked()
        broken.press("Control+z")
        broken.settle()
        assert re.search("failing", broken.page.get_by_role("tab", name=re.compile("^Checks")).inner_text())


def test_a_film_says_how_far_it_is_and_can_be_cancelled(walking: Studio) -> None:
    walking.button("Export").click()
    dialog = walking.page.get_by_role("dialog")
    dialog.get_by_role("radio", name="Film (GIF)").check()
    walking.type_only("Height", "1080")
    make = dialog.get_by_role("button", name="Export", exact=True)
    make.click()
    bar = dialog.get_by_role("progressbar", name="How far the export is")
    bar.wait_for()
    walking.until("document.querySelector('dialog progress').position > 0.01")
    first = bar.evaluate("bar => bar.position")
    walking.until(f"document.querySelector('dialog progress').position > {first}")
    assert dialog.get_by_text("drawing").is_visible()
    dialog.get_by_role("button", name="Cancel").click()
    bar.wait_for(state="detached")
    assert make.is_enabled()
    assert walking.page.get_by_role("alert").count() == 0, "who cancels knows it"
    walking.close_dialog()
    assert walking.export().startswith(b"HIERARCHY"), "the server has stopped, and does the next thing"


def test_it_says_what_solo_leaves_out(walking: Studio) -> None:
    walking.add("tired")
    walking.add("Posture")
    walking.button("Export").click()
    dialog = walking.page.get_by_role("dialog")
    assert "Without what is off" not in dialog.inner_text()
    walking.close_dialog()
    walking.press("b")  # bypass the selected layer
    walking.settle()
    walking.button("Export").click()
    assert "Without what is off or not solo: posture." in dialog.inner_text()
    dialog.get_by_role("radio", name="Project").check()
    assert "Without what is off" not in dialog.inner_text(), "a project has all layers"
