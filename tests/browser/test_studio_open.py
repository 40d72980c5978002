"""How clips come in: chooser, drop, sample, command line, project; and what is said of those that do not."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image

from mien import samples
from mien.formats import bvh
from mien.motion import Motion

from .driving import Server, Studio

Visit = Callable[..., Studio]


def open_clips(studio: Studio) -> list[str]:
    """Return the names of the clips in the list, the shown one first."""
    rows = studio.part("Clips 1").or_(studio.page.get_by_role("region", name=re.compile("^Clips")))
    found = []
    for row in rows.get_by_role("listitem").all():
        button = row.get_by_role("button").first
        name = button.inner_text().split("\n")[0]
        found.insert(0 if button.get_attribute("aria-current") == "true" else len(found), name)
    return found


def test_empty(studio: Studio) -> None:
    steps = studio.page.get_by_role("main").get_by_role("listitem").all_inner_texts()
    assert [re.findall("[A-Z][a-z ]+", step)[0] for step in steps] == [
        "Open a clip", "Give it a mood", "Compare and export",
    ]  # fmt: skip
    assert studio.button("Export").is_disabled()
    assert studio.moods.get_by_role("button", name="sad", exact=True).is_disabled()
    assert studio.page.title() == "mien studio"
    assert "token" not in studio.page.url
    assert studio.colours() > 100, "the floor is drawn"


def test_by_the_chooser(studio: Studio, clips: Path) -> None:
    studio.open(clips / "walk.bvh", clips / "wave.bvh")
    assert open_clips(studio) == ["wave.bvh", "walk.bvh"]
    assert studio.page.title() == "wave.bvh – mien studio"
    assert studio.colours() > 800
    assert studio.playback("duration") == pytest.approx(2.5, abs=0.05)
    assert not studio.page.get_by_role("heading", name="Change the mood of a motion").is_visible()


def test_by_dropping(studio: Studio, clips: Path) -> None:
    studio.drop(clips / "wave.bvh")
    assert open_clips(studio) == ["wave.bvh"]
    assert studio.colours() > 800


def test_by_dropping_as_the_system_does(studio: Studio, clips: Path, tmp_path: Path) -> None:
    """Files that the browser itself gets from outside: anywhere on the page, several, some no clips."""
    other = tmp_path / "notes.txt"
    other.write_text("no clip", encoding="utf-8")
    files = [str(other), *(str(clips / name) for name in ("walk.bvh", "wave.bvh"))]
    browser = studio.page.context.new_cdp_session(studio.page)

    def carry(kind: str, place: tuple[float, float]) -> None:
        data = {"items": [], "files": files, "dragOperationsMask": 1}
        browser.send("Input.dispatchDragEvent", {"type": kind, "x": place[0], "y": place[1], "data": data})

    hint = studio.page.get_by_text("Drop to open", exact=True)
    carry("dragEnter", (640.0, 300.0))
    for place in ((640.0, 300.0), (100.0, 500.0)):
        carry("dragOver", place)
        hint.wait_for()
    assert open_clips(studio) == []
    carry("drop", (100.0, 500.0))
    hint.wait_for(state="detached")
    studio.page.get_by_role("alert").filter(has_text="notes.txt is neither").wait_for()
    studio.until("document.title.startsWith('wave.bvh')")
    studio.settle()
    assert open_clips(studio) == ["wave.bvh", "walk.bvh"]
    assert studio.page.url.startswith(studio.server.base), "the browser did not go to the file"


def test_a_sample(studio: Studio) -> None:
    studio.page.get_by_role("main").get_by_role("button", name=re.compile("^wave")).click()
    studio.settle()
    assert open_clips(studio) == ["wave.bvh"]
    assert studio.colours() > 800


def test_the_same_clip_twice_is_one(studio: Studio, clips: Path) -> None:
    studio.open(clips / "walk.bvh")
    studio.mood("sad")
    studio.open(clips / "walk.bvh")
    assert open_clips(studio) == ["walk.bvh"]
    assert studio.layers() == ["Sad"]


def test_on_the_command_line(built: None, visit: Visit, clips: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.bvh"
    broken.write_text("HIERARCHY\nROOT", encoding="utf-8")
    server = Server(tmp_path / "studio", clips / "wave.bvh", broken, clips / "walk.bvh")
    try:
        assert open_clips(visit(server)) == ["wave.bvh", "walk.bvh"]
    finally:
        said = server.stop()
    assert "broken.bvh" in said
    assert "Traceback" not in said


def test_a_broken_file_is_said_and_nothing_lost(studio: Studio, clips: Path, tmp_path: Path) -> None:
    studio.expected += ("status of 422",)
    studio.open(clips / "walk.bvh")
    studio.mood("sad")
    broken, empty = tmp_path / "broken.bvh", tmp_path / "empty.bvh"
    cut = (clips / "wave.bvh").read_text(encoding="utf-8").rsplit("\n", 3)[0] + "\n1.0 2.0"
    broken.write_text(cut, encoding="utf-8")
    empty.write_bytes(b"")
    studio.open(broken, empty)
    alerts = studio.page.get_by_role("alert").all_inner_texts()
    assert len(alerts) == 2
    assert re.search(r"broken\.bvh.*line \d+", alerts[0]), "it says which file, and where"
    assert "empty.bvh is empty" in alerts[1]
    assert (open_clips(studio), studio.layers()) == (["walk.bvh"], ["Sad"])
    studio.button("Close the message").first.click()
    studio.button("Close the message").first.click()
    assert studio.page.get_by_role("alert").count() == 0


def test_what_has_no_body_is_looked_at(studio: Studio, rope: Motion, tmp_path: Path) -> None:
    file = tmp_path / "rope.bvh"
    file.write_bytes(bvh.render(rope))
    studio.open(file)
    assert "can be looked at, not edited" in studio.messages()
    assert studio.colours() > 100
    assert studio.moods.get_by_role("button", name="sad", exact=True).is_disabled()
    assert studio.slider("Valence").is_disabled()
    layers = studio.part("Layers").inner_text()
    assert "No body was found in this clip: it can only be looked at" in layers
    assert "disc" not in layers, "nothing is offered that cannot be done"


def test_closed_and_opened_again(studio: Studio, clips: Path) -> None:
    studio.open(clips / "walk.bvh", clips / "wave.bvh")
    studio.mood("sad")
    studio.button("Close wave.bvh").click()
    studio.settle()
    assert open_clips(studio) == ["walk.bvh"]
    studio.part("Messages").get_by_role("button", name="Open again").click()
    studio.settle()
    assert open_clips(studio) == ["wave.bvh", "walk.bvh"]
    assert studio.layers() == ["Sad"], "its layers have come back with it"


def test_many_clips(studio: Studio, tmp_path: Path) -> None:
    """They leave room for the moods, are one stop of Tab, and the shown one is in sight."""
    walk = samples.walk(seconds=1.0, fps=10.0).motion
    files = [tmp_path / f"walk{number:02}.bvh" for number in range(20)]
    for number, file in enumerate(files):
        file.write_bytes(bvh.render(walk.with_(frame_time=0.1 + number / 100)))
    studio.open(*files)
    rows = studio.moods.get_by_role("region", name=re.compile("^Clips")).get_by_role("listitem")
    assert rows.count() == 20
    clips = rows.get_by_role("button", name=re.compile("^walk"))
    whole = rows.first.locator("..").bounding_box()
    assert 6 < whole["height"] / rows.first.bounding_box()["height"] < 10

    def in_sight(number: int) -> bool:
        box = rows.nth(number).bounding_box()
        return whole["y"] - 1 <= box["y"] and box["y"] + box["height"] <= whole["y"] + whole["height"] + 1

    clips.nth(17).click()
    studio.settle()
    studio.page.reload()
    studio.settle()
    assert clips.nth(17).get_attribute("aria-current") == "true"
    assert in_sight(17)
    assert not in_sight(0)
    stops = rows.locator("button[tabindex='0'], button:not([tabindex])")
    assert [text.split("\n")[0] for text in stops.all_inner_texts()] == ["walk17.bvh"]
    focused = lambda: studio.page.evaluate("document.activeElement.innerText.split('\\n')[0]")  # noqa: E731
    stops.focus()
    studio.press("ArrowUp", "ArrowUp")
    assert focused() == "walk15.bvh"
    studio.press("Home", "ArrowDown", "Enter")
    studio.settle()
    assert clips.nth(1).get_attribute("aria-current") == "true"
    assert in_sight(1)
    studio.press("Delete")
    studio.settle()
    assert rows.count() == 19
    studio.until("document.activeElement.innerText.startsWith('walk02')")
    assert studio.button("Close walk05.bvh").count() == 1, "a screen reader finds the way to close"


def test_a_project_as_a_file(
    studio: Studio, visit: Visit, server: Server, clips: Path, tmp_path: Path
) -> None:
    studio.open(clips / "walk.bvh")
    studio.mood("tired")
    studio.type("Overall, typed", "0.8")
    with studio.page.expect_download() as given:
        studio.press("Control+s")
    file = tmp_path / given.value.suggested_filename
    file.write_bytes(Path(given.value.path()).read_bytes())
    assert file.name == "walk.mien.json"
    project = json.loads(file.read_text(encoding="utf-8"))
    assert [clip["name"] for clip in project["clips"]] == ["walk.bvh"]
    studio.page.close()
    server.forget()

    other = visit(server)
    other.open(file)
    assert "The project also uses walk.bvh" in other.messages()
    other.open(clips / "walk.bvh")
    assert other.layers() == ["Tired"]
    assert other.typed("Overall, typed").input_value() == "0.80"
    other.expected += ("status of 422",)
    file.write_text('{"clips": 3}', encoding="utf-8")
    other.open(file)
    assert "no project file of mien studio" in other.messages()
    assert other.layers() == ["Tired"]


def test_pictures_of_moods(server: Server, visit: Visit) -> None:
    studio = visit(server, pictures=True)
    image = studio.moods.get_by_role("button", name="afraid", exact=True).locator("img")
    for _ in range(400):
        if image.evaluate("one => one.complete && one.naturalWidth") > 1:
            break
        studio.page.wait_for_timeout(50)
    size = image.evaluate("one => [one.naturalWidth, one.naturalHeight]")
    made = [Image.open(path) for path in (server.folder / "pictures").rglob("*.png")]
    assert size in [list(picture.size) for picture in made]
    assert all(len(picture.convert("RGB").getcolors(100_000)) > 50 for picture in made)


def test_no_name_of_a_mood_is_broken(studio: Studio) -> None:
    """Not even in tiles as narrow as they get, beside a scroll bar in a low window."""
    studio.page.set_viewport_size({"width": 1280, "height": 720})
    broken = """(width) => [...document.querySelectorAll("[role=toolbar] .name")].flatMap((name) => {
      name.closest("[role=toolbar]").style.width = `${width}px`;
      const text = name.firstChild;
      return [...text.data.matchAll(/\\S+/g)].filter((word) => {
        const range = document.createRange();
        range.setStart(text, word.index);
        range.setEnd(text, word.index + word[0].length);
        const box = range.getBoundingClientRect();
        const within = name.getBoundingClientRect();
        return range.getClientRects().length > 1 || box.left < within.left || box.right > within.right;
      }).map(String);
    })"""
    assert studio.page.locator("[role=toolbar] .name").count() > 12
    for width in (158, 174, 200):
        assert studio.page.evaluate(broken, width) == []
