"""How original and edit are compared, what is drawn, playing, and that nothing is lost by a reload."""

import itertools
import re
from collections.abc import Callable
from difflib import unified_diff
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from mien import load, samples
from mien.formats import bvh
from mien.motion import Motion

from .driving import Server, Studio, V, grown, middle

LINES = ("Height of the timeline", "Height of the layers")
Visit = Callable[..., Studio]


@pytest.fixture
def edited(walking: Studio) -> Studio:
    walking.mood("excited")
    walking.page.evaluate(f"{V}.playback.set({{ time: 0.9 }})")
    return walking


def test_every_way_to_compare_is_another_picture(edited: Studio) -> None:
    pictures = {}
    for mode in ("Edited", "Ghost", "Side by side", "Wipe"):
        edited.page.get_by_role("radiogroup", name="Compare").get_by_text(mode, exact=True).click()
        assert edited.page.get_by_role("radio", name=mode).is_checked()
        assert edited.colours() > 500, mode
        pictures[mode] = edited.pixels()
    assert len(set(pictures.values())) == 4
    edited.press("v")
    assert edited.page.get_by_role("radio", name="Edited").is_checked()
    assert edited.pixels() == pictures["Edited"]
    edited.page.keyboard.down("`")
    assert edited.page.evaluate(f"{V}.mode") == "original"
    assert edited.pixels() not in pictures.values()
    edited.page.keyboard.up("`")
    assert edited.pixels() == pictures["Edited"]


def test_every_switch_of_the_view_is_seen(edited: Studio) -> None:
    for name in ("Trails", "Feet", "Grid", "One colour"):
        switch = edited.page.get_by_role("toolbar", name="View").get_by_role("button", name=name, exact=True)
        was, before = switch.get_attribute("aria-pressed"), edited.pixels()
        switch.click()
        assert switch.get_attribute("aria-pressed") != was
        assert edited.pixels() != before, name
        switch.click()
        assert edited.pixels() == before, name


def test_dark_and_light(edited: Studio) -> None:
    light = edited.pixels()
    edited.button("Dark colours").click()
    dark = edited.pixels()
    assert dark != light
    edited.page.reload()
    edited.settle()
    assert edited.button("Light colours").is_visible(), "it is kept"
    sheet = edited.page.screenshot()
    edited.button("Light colours").click()
    bright = edited.page.screenshot()
    assert level(sheet) < 90
    assert level(bright) > 170


def level(picture: bytes) -> float:
    """Return how bright a picture is, from 0 to 255."""
    from io import BytesIO

    with Image.open(BytesIO(picture)) as opened:
        grey = opened.convert("L").resize((1, 1))
        return float(grey.getpixel((0, 0)))


def test_playing(walking: Studio) -> None:
    assert not walking.playback("playing"), "who wants less motion is asked first"
    walking.press("Space")
    walking.until(f"{V}.playback.time > 0.2")
    walking.press("k")
    assert not walking.playback("playing")
    walking.press("Home", "ArrowRight", "ArrowRight")
    assert walking.playback("frame") == 2
    walking.press("ArrowUp")
    first = walking.playback("time")
    assert first > 2 / 30
    walking.press("i", "Shift+ArrowRight", "o")
    assert walking.playback("range") == [pytest.approx(first), pytest.approx(first + 10 / 30)]
    walking.press("+")
    assert walking.playback("speed") == 2
    walking.press("l")
    walking.until(f"{V}.playback.playing")
    walking.press("Space")


def test_a_t_pose_before_the_action(
    studio: Studio, clips: Path, tmp_path: Path, with_t_pose: Callable[[Motion, int], Motion]
) -> None:
    """It is said, playing begins after it, and it leaves no trails."""
    posed = tmp_path / "posed.bvh"
    posed.write_bytes(bvh.render(with_t_pose(load(clips / "walk.bvh"), 3)))
    view = studio.page.locator(".stage")
    studio.open(clips / "walk.bvh")
    assert "still" not in view.inner_text()
    assert studio.playback("range") is None
    studio.open(posed)
    assert "The first 3 frames are a still before the action: edits leave it as it is" in view.inner_text()
    start, end = studio.playback("range")
    assert start == pytest.approx(3 / 30)
    assert end == studio.playback("duration")
    assert studio.playback("time") == start
    studio.page.evaluate(f"{V}.playback.set({{ time: 0 }})")
    studio.mood("tired")
    assert studio.playback("range")[1] == studio.playback("duration"), "what takes longer plays to its end"
    assert "The first 3 frames" in view.inner_text()
    studio.page.evaluate(f"{V}.playback.set({{ playing: true, speed: 4 }})")
    studio.until(f"{V}.playback.time > 1.5")
    studio.until(f"{V}.playback.time < 1.5")
    assert studio.playback("time") >= start, "the loop does not go back to the T-pose"
    studio.press("k")
    studio.page.get_by_role("button", name=re.compile("^walk")).first.click()
    studio.settle()
    assert studio.playback("range") is None


def test_a_curve_that_runs_out_of_its_lane_says_so(
    walking: Studio, tmp_path: Path, clips: Path, with_t_pose: Callable[[Motion, int], Motion]
) -> None:
    """Four frames are too slow for a still: the hands fly, and the rest of the curve stays readable."""
    timeline = walking.page.locator("section.timeline").last
    assert "up to" not in timeline.text_content()
    posed = tmp_path / "slower.bvh"
    posed.write_bytes(bvh.render(with_t_pose(load(clips / "walk.bvh"), 4)))
    walking.open(posed)
    assert re.search(r"▲ up to \d+\.\d+ m/s", timeline.text_content())


def test_space_plays_after_a_click(walking: Studio) -> None:
    """A button that the mouse has pressed keeps the focus, but Space does not press it again."""
    walking.mood("sad")
    walking.press("Space")
    assert walking.playback("playing")
    walking.press("Space")
    assert not walking.playback("playing")
    walking.press("Tab", "Shift+Tab", "Space")
    assert not walking.playback("playing")
    walking.settle()
    assert walking.layers() == [], "who came by Tab presses the button"


def test_a_joint_is_picked_and_drawn(edited: Studio) -> None:
    view = edited.page.get_by_role("group", name=re.compile("^3D view"))
    box = view.bounding_box()
    x, y = edited.page.evaluate(f"{V}.jointsOnScreen()")["Head"]
    edited.page.mouse.dblclick(box["x"] + x, box["y"] + y)
    edited.settle()
    curves = edited.page.get_by_role("group", name="Curves")
    assert curves.get_by_role("checkbox", name="joint:Head").is_checked()
    assert "joint:Head" in edited.page.get_by_role("region", name="Timeline", exact=True).inner_text()
    menu = edited.page.get_by_role("combobox", name="Speed of a joint")
    assert menu.input_value() == "Head"
    menu.select_option("LeftHand")  # as people do who pick nothing by mouse
    edited.settle()
    assert curves.get_by_role("checkbox", name="joint:LeftHand").is_checked()
    assert not curves.get_by_role("checkbox", name="joint:Head").count(), "one joint at a time"
    assert "joint:LeftHand" in edited.page.get_by_role("region", name="Timeline", exact=True).inner_text()
    curves.get_by_text("valence").click()
    edited.settle()
    assert re.search("valence\n", edited.page.get_by_role("region", name="Timeline", exact=True).inner_text())


def test_a_reload_returns_to_the_same(edited: Studio) -> None:
    edited.page.get_by_text("Side by side", exact=True).click()
    edited.button("Names").click()
    edited.page.get_by_role("group", name="Curves").get_by_text("valence").click()
    edited.type("Overall, typed", "0.6")
    edited.page.evaluate(f"{V}.playback.set({{ time: 0 }})")
    edited.settle()
    state = lambda: edited.page.locator("body").aria_snapshot()  # noqa: E731
    before, picture = state(), edited.pixels()
    edited.page.reload()
    edited.settle()
    after = state()
    # What can be undone is not kept: nothing else may differ.
    fresh = lambda text: [line for line in text.split("\n") if not re.search('- button "(Un|Re)do', line)]  # noqa: E731
    assert list(unified_diff(fresh(before), fresh(after), n=0)) == []
    assert edited.pixels() == picture


def test_changed_and_reloaded_at_once(walking: Studio) -> None:
    """What was done in the last moment before the page went is kept, too."""
    walking.moods.get_by_role("button", name="sad", exact=True).click()
    walking.page.reload()
    walking.settle()
    assert walking.layers() == ["Sad"]


def test_two_clips_have_layers_of_their_own(walking: Studio, clips: Path) -> None:
    walking.mood("sad")
    walking.open(clips / "wave.bvh")
    assert walking.layers() == []
    walking.mood("proud")
    walking.button(re.compile(r"^walk\.bvh .*1 layer")).click()
    walking.settle()
    assert walking.layers() == ["Sad"]
    assert walking.undo_name() == "Undo sad"


def test_columns_can_be_made_higher(visit: Visit, server: Server, clips: Path) -> None:
    walking = visit(server, viewport={"width": 1280, "height": 560})
    walking.open(clips / "walk.bvh")
    walking.add("Posture")
    for name in LINES:
        line = walking.page.get_by_role("separator", name=name)
        place = lambda line=line: (line.bounding_box()["y"], float(line.get_attribute("aria-valuenow")))  # noqa: E731
        before = place()
        line.focus()
        walking.press("ArrowUp", "ArrowUp")
        stepped = place()
        walking.drag(middle(line), (0, -10), (0, -30))
        dragged = place()
        assert stepped[1] == before[1] - 8
        assert dragged[1] < stepped[1]
        assert dragged[0] < stepped[0] - 10 < before[0] - 40, name
        line.dblclick()
        assert place() == before
    assert walking.colours() > 500


def test_a_line_says_where_it_is(visit: Visit, server: Server, clips: Path) -> None:
    """Where there is less to show than there is room for, the line stands lower than it was put."""
    walking = visit(server, viewport={"width": 1280, "height": 1100})
    walking.open(clips / "walk.bvh")
    ends = ((name, "main" if name.endswith("timeline") else "aside[aria-label=Edit]") for name in LINES)
    for name, inside in ends:
        line = walking.page.get_by_role("separator", name=name)

        def seen(line: Any = line, inside: str = inside) -> float:
            """Return where the line is, when it says so: another size is known with the next frame."""
            top, height = (
                walking.page.locator(inside).bounding_box()["y"],
                walking.page.viewport_size["height"],
            )
            where = 100 * (line.bounding_box()["y"] - top) / (height - top)
            line.focus()
            walking.until(f"Math.abs(document.activeElement.ariaValueNow - {where}) < 1")
            low, now, high = (float(line.get_attribute(f"aria-value{end}")) for end in ("min", "now", "max"))
            assert low <= now <= high
            return float(where)

        before = seen()
        walking.press("ArrowDown")
        assert seen() == pytest.approx(before + 4, abs=1), name
        walking.press("ArrowUp")
        assert seen() == pytest.approx(before, abs=1), name
        walking.page.set_viewport_size({"width": 1280, "height": 600})
        assert seen() < before + 1
        walking.page.set_viewport_size({"width": 1280, "height": 1100})
        assert seen() == pytest.approx(before, abs=1), name


def test_full_screen(walking: Studio) -> None:
    """The viewport alone, as large as the screen; keys and dialogs work there."""
    main = walking.page.get_by_role("main")
    before = main.bounding_box()
    walking.press("Shift+F")
    walking.until("document.fullscreenElement === document.querySelector('main')")
    walking.until(f"document.querySelector('main').clientWidth > {before['width']} + 200")
    walking.until(f"{V}.canvas.clientWidth > {before['width']} + 200")
    assert walking.colours() > 500
    ghost = walking.page.get_by_role("radio", name="Ghost")
    was = ghost.is_checked()
    walking.press("g")
    assert ghost.is_checked() is not was
    walking.press("Control+k")
    walking.page.get_by_role("dialog").wait_for()
    assert walking.page.evaluate(
        "document.elementFromPoint(innerWidth / 2, innerHeight / 4).closest('dialog') !== null"
    )
    walking.page.keyboard.type("full screen")
    walking.press("Enter")
    walking.until("document.fullscreenElement === null")
    walking.until(f"document.querySelector('main').clientWidth === {round(before['width'])}")


def test_a_small_window(visit: Visit, server: Server, clips: Path) -> None:
    studio = visit(server, viewport={"width": 900, "height": 600})
    studio.open(clips / "walk.bvh")
    studio.mood("sad")
    assert studio.colours() > 300
    wide = studio.page.evaluate("document.documentElement.scrollWidth")
    assert wide <= 900, "nothing stands outside"
    assert studio.button("Export").bounding_box()["x"] + 40 < 900


def test_names_of_joints_do_not_cover_each_other(studio: Studio, tmp_path: Path) -> None:
    """What people look for comes before twists and fingers, and all of it is read over the figure."""
    file = tmp_path / "many.bvh"
    file.write_bytes(bvh.render(grown(samples.walk(seconds=1.0, fps=30.0).motion, 60)))
    studio.open(file)
    studio.button("Names").click()
    shown = """() => [...document.querySelectorAll("div")].filter((one) =>
      one.style.textShadow && one.style.display !== "none").map((one) => {
        const { left, right, top, bottom } = one.getBoundingClientRect();
        return [one.textContent, left, right, top, bottom];
      })"""
    studio.until(f"({shown})().length > 8")
    names = studio.page.evaluate(shown)
    assert {"Head", "LeftHand", "RightLeg"} <= {name for name, *_ in names}
    for (one, left, right, top, bottom), (two, l2, r2, t2, b2) in itertools.combinations(names, 2):
        assert left >= r2 or l2 >= right or top >= b2 - 1 or t2 >= bottom - 1, (one, two)
