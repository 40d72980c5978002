"""Changing a clip by mouse, and all of it by keyboard alone; one movement of the hand is one step of undo."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mien import edit, load
from mien.emotion.circumplex import words
from mien.emotion.model import shipped_model
from mien.formats import bvh

from .driving import Studio, V, columns, middle, numbers, thumb

KEY = re.compile("^Key")


def strength_of(studio: Studio) -> float:
    return float(studio.slider("Overall").input_value())


def test_a_mood_by_its_picture(walking: Studio) -> None:
    before = walking.pixels()
    walking.mood("sad")
    assert walking.layers() == ["Sad"]
    assert walking.moods.get_by_role("button", name="sad", exact=True).get_attribute("aria-pressed") == "true"
    assert walking.pixels() != before
    assert (
        "reads near"
        in walking.page.get_by_role("complementary", name="Edit").get_by_role("status").last.inner_text()
    )
    walking.mood("tired")
    assert walking.layers() == ["Tired"], "a clip has one mood until more are added on purpose"
    walking.moods.get_by_role("button", name="proud", exact=True).click(modifiers=["Shift"])
    walking.settle()
    assert walking.layers() == ["Tired", "Proud"]
    walking.mood("proud")
    assert walking.layers() == ["Tired"], "the chosen one goes, the other one becomes the mood"


def test_moods_by_keys(walking: Studio) -> None:
    """All pictures are one stop of Tab, and the arrows go among them as they stand."""
    bar = walking.moods.get_by_role("toolbar", name="Moods", exact=True)
    tiles = bar.get_by_role("button")
    names = tiles.all_inner_texts()
    assert len(names) > 12
    assert bar.locator("button[tabindex='0']").all_inner_texts() == names[:1]
    focused = lambda: walking.page.evaluate("document.activeElement.innerText.trim()")  # noqa: E731
    tiles.first.focus()
    tops = tiles.evaluate_all("all => all.map(one => one.offsetTop)")
    columns = tops.count(tops[0])
    assert 1 < columns < len(names)
    ways = (("ArrowRight", 1), ("ArrowDown", 1 + columns), ("ArrowLeft", columns), ("ArrowUp", 0))
    for key, at in (*ways, ("ArrowLeft", 0), ("End", -1), ("ArrowRight", -1), ("Home", 0)):
        walking.press(key)
        assert focused() == names[at], key
    assert walking.playback("time") == 0, "the arrows do nothing else"
    walking.press("ArrowRight", "Enter")
    walking.settle()
    assert walking.layers() == [names[1].capitalize()]
    walking.press("ArrowRight", "Shift+Enter")
    walking.settle()
    assert walking.layers() == [name.capitalize() for name in names[1:3]]
    walking.press("Space")
    walking.settle()
    assert walking.layers() == [names[1].capitalize()], "Space chooses too, and takes back what is chosen"
    walking.press("Tab")
    assert focused() == "As in the thesis"
    walking.press("Shift+Tab")
    assert focused() == names[1], "Tab comes back to the mood that the clip has"


def test_one_drag_is_one_step(walking: Studio) -> None:
    walking.mood("sad")
    walking.drag(thumb(walking.slider("Overall")), *[(-4, 0)] * 8)
    walking.settle()
    weak = strength_of(walking)
    assert 0.1 < weak < 0.8
    assert walking.undo_name() == "Undo overall strength"
    walking.press("Control+z")
    assert strength_of(walking) == 1
    assert walking.undo_name() == "Undo sad"
    walking.press("Control+Shift+Z")
    assert strength_of(walking) == weak
    walking.press("Control+z", "Control+z")
    assert walking.layers() == []
    assert walking.button(re.compile("^Undo")).is_disabled()
    walking.button("Redo sad").click()
    walking.button("Redo overall strength").click()
    walking.settle()
    assert (walking.layers(), strength_of(walking)) == (["Sad"], weak)
    assert walking.button(re.compile("^Redo")).is_disabled()


def test_undone_looks_as_before(walking: Studio) -> None:
    walking.mood("sad")
    sad = walking.pixels()
    walking.mood("excited")
    assert walking.pixels() != sad
    walking.press("Control+z")
    walking.settle()
    assert walking.pixels() == sad


def test_a_slider_brings_its_layer(walking: Studio) -> None:
    walking.tab("Body")
    posture = walking.part("Posture").or_(walking.page.get_by_role("region", name=re.compile("^Posture")))
    head = posture.get_by_role("slider", name="head", exact=True)
    before = walking.pixels()
    walking.drag(thumb(head), (12, 0), (12, 0))
    walking.settle()
    assert walking.layers() == ["Posture"]
    bent = float(head.input_value())
    assert bent > 10
    assert walking.pixels() != before
    given = numbers(walking.export())
    posture.get_by_role("spinbutton", name="head, typed").fill("0")
    posture.get_by_role("spinbutton", name="head, typed").press("Enter")
    walking.settle()
    assert not (numbers(walking.export()) == given).all()
    posture.get_by_role("button", name="Reset posture").click()
    assert walking.layers() == []


def test_by_keyboard_alone(studio: Studio, tmp_path: Path) -> None:
    """From an empty page to an exported file without a pointer."""
    studio.press("Control+k")
    studio.page.keyboard.type("sample wave")
    studio.press("Enter")
    studio.settle()
    studio.press("Control+k")
    studio.page.keyboard.type("make it tired")
    studio.press("Enter")
    studio.settle()
    assert studio.layers() == ["Tired"]
    tab_to(studio, "Strength")
    studio.press("Home", "PageUp", "PageUp")
    amount = float(studio.slider("Strength").input_value())
    assert 0 < amount < 1
    studio.settle()
    tab_to(studio, "left leg", back=False)
    studio.press("Space")
    studio.settle()
    studio.press("Control+z")
    studio.settle()
    studio.press("Control+e")
    studio.page.get_by_role("dialog").wait_for()
    with studio.page.expect_download() as given:
        tab_to(studio, "Export", inside="dialog")
        studio.press("Enter")
    assert given.value.suggested_filename == "wave_edited.bvh"
    studio.settle()
    source = next((studio.server.folder / "clips").iterdir())
    expected = bvh.render(edit(load(source), "tired", strength=amount))
    assert Path(given.value.path()).read_bytes() == expected
    studio.press("g")
    assert studio.page.get_by_role("radio", name="Edited").is_checked(), "keys work after a dialog"


def tab_to(studio: Studio, name: str, *, back: bool = False, inside: str = "body") -> None:
    """Press Tab until a control has the focus."""
    for _ in range(200):
        studio.press("Shift+Tab" if back else "Tab")
        if studio.page.evaluate(
            """([name, inside]) => {
              const here = document.activeElement;
              const label = here.ariaLabel || here.labels?.[0]?.innerText || here.innerText || "";
              if (here.role === "spinbutton") return false;
              return label.split("\\n")[0].trim() === name && here.closest(inside) !== null;
            }""",
            [name, inside],
        ):
            return
    pytest.fail(f"Tab never comes to {name}")


def test_menus_by_keys(walking: Studio) -> None:
    walking.button("Edit").focus()
    walking.press("ArrowDown")
    menu = walking.page.get_by_role("menu", name="Edit")
    assert menu.get_by_role("menuitem", name="Undo").is_disabled()
    focused = lambda: walking.page.evaluate("document.activeElement.innerText.trim()")  # noqa: E731
    assert focused().startswith("Keep feet on the floor")
    walking.press("End")
    assert focused().startswith("Name its joints")
    walking.press("Escape")
    assert menu.count() == 0
    assert focused() == "Edit"
    walking.press("Enter", "k", "Enter")
    walking.settle()
    assert not walking.page.get_by_role("checkbox", name="Feet on the floor").is_checked()
    assert walking.undo_name() == "Undo feet on the floor"


def test_own_keys(walking: Studio) -> None:
    walking.press("?")
    row = walking.button("G, change the key of Ghost of the original")
    row.click()
    walking.press("h")
    assert walking.button("H, change the key of Ghost of the original").is_visible()
    walking.close_dialog()
    ghost = walking.page.get_by_role("radio", name="Ghost")
    assert ghost.is_checked()
    walking.press("g")
    assert ghost.is_checked()
    walking.press("h")
    assert not ghost.is_checked()
    walking.settle()
    walking.page.reload()
    walking.settle()
    assert not ghost.is_checked()
    walking.press("h")
    assert ghost.is_checked(), "they are kept"
    walking.press("?")
    walking.button("Restore all").click()
    assert row.is_visible()


class TestDisc:
    def test_by_mouse(self, walking: Studio) -> None:
        disc = walking.page.get_by_role("group", name="Emotion")
        x, y = middle(disc.locator("svg .rim"))
        radius = disc.locator("svg .rim").bounding_box()["width"] / 2
        walking.drag((x, y), (-radius / 4, 0), (-radius / 4, radius / 2))
        walking.settle()
        valence, arousal = (float(walking.slider(name).input_value()) for name in ("Valence", "Arousal"))
        assert (valence, arousal) == (pytest.approx(-0.5, abs=0.03), pytest.approx(-0.5, abs=0.03))
        assert walking.layers() == [f"Disc −{-valence:.2f}, −{-arousal:.2f}"]
        assert walking.undo_name() == "Undo place on the disc"
        walking.press("Control+z")
        assert walking.layers() == []

    def test_a_mood_that_is_nowhere_on_it(self, walking: Studio) -> None:
        disc = walking.page.get_by_role("group", name="Emotion")
        assert "nothing yet" in disc.inner_text()
        walking.mood("proud")
        assert re.search(r"asked\s+proud, no place on the disc", disc.inner_text())
        assert walking.slider("Valence").get_attribute("aria-valuetext") == "proud, no place on the disc"
        walking.mood("sad")
        assert re.search(r"asked\s+−0\.\d+, −0\.\d+, near sad", disc.inner_text())
        walking.mood("proud")
        disc.get_by_role("button", name="clear").click()
        walking.settle()
        assert walking.layers() == []
        assert "nothing yet" in disc.inner_text()

    @pytest.mark.parametrize("size", [(1280, 720), (1360, 820), (1920, 1080)])
    def test_written_words(self, walking: Studio, size: tuple[int, int]) -> None:
        """They stand still while things are asked for, and a click on one asks for that one."""
        walking.page.set_viewport_size(dict(zip(("width", "height"), size, strict=True)))
        disc = walking.page.get_by_role("group", name="Emotion")
        boxes = """() => Object.fromEntries([...document.querySelectorAll("[data-word]")].map((one) => {
            const { x, y } = one.querySelector("rect").getBoundingClientRect();
            return [one.dataset.word, [x, y]];
        }))"""
        walking.settle()
        first = walking.page.evaluate(boxes)
        assert len(first) >= len(words()) - 3
        for name in ("happy", "neutral", "excited", "sad", "happy"):
            walking.page.mouse.click(*middle(disc.locator(f"[data-word={name}] rect")))
            walking.settle()
            valence, arousal = (math.trunc(100 * x) / 100 for x in words()[name])
            said = f"{valence:+.2f}, {arousal:+.2f}".replace("-", "−").replace("+0.00", "0")
            assert walking.layers()[0].replace("+0.00", "0") == f"Disc {said}"
            now = walking.page.evaluate(boxes)
            assert now.keys() == first.keys()
            assert all(math.dist(now[word], place) <= 7 for word, place in first.items())

    def test_the_list_of_words(self, walking: Studio) -> None:
        """One is chosen as long as it is what is asked for, and can be chosen again after that."""
        walking.page.get_by_text("Words", exact=True).click()
        bored, sad = (walking.page.get_by_role("radio", name=name, exact=True) for name in ("bored", "sad"))
        for _ in range(2):
            bored.check(force=True)
            walking.settle()
            assert walking.layers() == ["Disc −0.66, −0.63"]
            assert (bored.is_checked(), sad.is_checked()) == (True, False)
            assert bored.locator("..").get_attribute("class").count("chosen") == 1
            walking.press("Control+z")
            walking.settle()
            assert walking.layers() == []
            assert not bored.is_checked()
        sad.check(force=True)
        walking.settle()
        walking.slider("Valence").focus()
        walking.press("ArrowLeft")
        walking.settle()
        assert not sad.is_checked(), "the place is another one now"

    def test_where_no_reading_lies(self, walking: Studio) -> None:
        """Hatched is what is further out than all that the model tells apart; nothing is read there."""
        disc = walking.page.get_by_role("group", name="Emotion")
        assert re.search(r"hatched\s+beyond what was learned", disc.inner_text())
        drawn = disc.locator("[fill-rule=evenodd]")
        within = "(one, [v, a]) => { const box = one.ownerSVGElement.getBoundingClientRect();" + (
            "const r = box.width / 2 - 15, at = new DOMPoint(box.width / 2 + v * r, box.width / 2 - a * r);"
            "return one.isPointInFill(at); }"
        )
        hatched = lambda point: drawn.evaluate(within, [*map(float, point)])  # noqa: E731
        places = np.array(list(shipped_model().places.values()))
        assert not any(hatched(0.98 * place) for place in places)
        assert not any(
            hatched(place) for place in np.random.default_rng(3).dirichlet(np.ones(8), 20) @ places
        )
        assert all(hatched(corner) for corner in ((0.69, -0.69), (-0.9, 0.0), (0.0, 0.95), (-0.5, -0.8)))

    def test_through_the_accessibility_tree(self, walking: Studio) -> None:
        """A screen reader meets two sliders that say the whole place, and a status that says the rest."""
        tree = walking.page.get_by_role("group", name="Emotion").aria_snapshot()
        assert '- slider "Valence"' in tree
        assert '- slider "Arousal"' in tree
        valence, arousal = walking.slider("Valence"), walking.slider("Arousal")
        assert valence.get_attribute("aria-valuetext") == "nothing asked for"
        valence.focus()
        for _ in range(6):
            walking.press("ArrowLeft")
        for _ in range(5):
            walking.press("ArrowDown")
        walking.settle()
        near = min(words(), key=lambda word: math.dist(words()[word], (-0.3, -0.25)))
        assert valence.get_attribute("aria-valuetext") == (
            f"valence −0.3 unpleasant, arousal −0.25 calm, near {near}"
        )
        assert arousal.evaluate("one => one === document.activeElement")
        assert walking.layers() == ["Disc −0.30, −0.25"]
        tree = walking.page.get_by_role("group", name="Emotion").aria_snapshot()
        assert re.search(rf"asked\n +- definition: −0.30?, −0.25, near {near}", tree)
        assert re.search(r"reached\n +- definition:\n +- status: [−0-9.]+, [−0-9.]+, near \w+", tree)
        walking.type("Valence, typed", "0.4")
        assert walking.layers() == ["Disc +0.40, −0.25"]
        walking.button("clear").click()
        walking.settle()
        assert walking.layers() == []

    def test_by_other_means(self, walking: Studio) -> None:
        walking.slider("Valence").focus()
        walking.press("PageDown")
        walking.settle()
        first = walking.export("Recipe").decode()
        walking.page.get_by_role("radiogroup", name="By means of").get_by_text("rules").click()
        walking.settle()
        assert walking.export("Recipe").decode() != first
        assert walking.layers()[0].startswith("Disc −0."), "the same place, reached in another way"


class TestSquare:
    def test_by_mouse_and_keys(self, walking: Studio) -> None:
        walking.tab("Body")
        path, timing = walking.slider("Path"), walking.slider("Timing")
        surface = walking.page.get_by_role("region", name=re.compile("^Paths and timing")).locator(
            "svg .ground"
        )
        x, y = middle(surface)
        width = surface.bounding_box()["width"]
        before = walking.pixels()
        walking.drag((x, y), (width / 8, 0), (width / 8, width / 8))
        walking.settle()
        assert float(path.input_value()) == pytest.approx(1.5, abs=0.05)
        assert float(timing.input_value()) == pytest.approx(0.75, abs=0.05)
        assert walking.layers() == ["Paths and timing"]
        assert walking.pixels() != before
        assert walking.undo_name() == "Undo grid path, timing"
        path.focus()
        walking.press("Home")
        walking.settle()
        assert walking.layers() == [], "in the middle stands the original, which needs no layer"

    def test_what_is_shown_on_the_way_is_what_comes(self, studio: Studio, clips: Path) -> None:
        """While the hand is down the page blends the nine; what the server answers looks the same."""
        studio.open(clips / "wave.bvh")
        studio.tab("Body")
        studio.slider("Path").focus()
        studio.settle()  # the nine are here now
        surface = studio.page.get_by_role("region", name=re.compile("^Paths and timing")).locator(
            "svg .ground"
        )
        x, y = middle(surface)
        width = surface.bounding_box()["width"]
        studio.page.evaluate(f"{V}.playback.set({{ time: 1.3 }})")
        original, blended, answered = drag_unanswered(studio, (x, y), x - 0.4 * width)
        assert np.abs(original - answered).max() > 0.01
        np.testing.assert_allclose(blended, answered, atol=0.001)


class TestBlendedInThePage:
    """What a slider asks for is shown while the server has not yet answered, and looks as the answer will."""

    @pytest.mark.parametrize(
        ("section", "name", "to"),
        [("Posture", "trunk", 0.35), ("Posture", "arms forward", 0.3), ("Path length", "mid", -0.2)],
    )
    def test_of_an_edit(self, studio: Studio, clips: Path, section: str, name: str, to: float) -> None:
        studio.open(clips / "wave.bvh")
        studio.tab("Body")
        part = studio.page.get_by_role("region", name=re.compile(f"^{section}"))
        if not part.get_by_role("slider").count():
            part.get_by_role("button", name=section).first.click()
        seen(studio, part.get_by_role("slider", name=name, exact=True), to)
        assert studio.layers() == [section]

    def test_of_the_strength_of_one_of_two_moods(self, studio: Studio, clips: Path) -> None:
        studio.open(clips / "wave.bvh")
        studio.mood("tired")
        studio.add("angry")
        studio.rows.nth(0).get_by_role("button").nth(1).click()
        region = studio.page.get_by_role("region", name=re.compile("^Mood"))
        # Moods change the timing too, and a mean of two timings is not quite that of the mean strength.
        seen(studio, region.get_by_role("slider", name="Strength", exact=True), -0.3, within=0.4)


def seen(studio: Studio, slider: Any, to: float, *, within: float = 0.2) -> None:
    """Drag a slider by a share of its length; what is shown before any answer must be as the answer is.

    ``within`` is how far off it may be, as a share of how far the farthest joint moves.
    """
    studio.page.evaluate(f"{V}.playback.set({{ time: 1.3, playing: false }})")
    x, y = thumb(slider)
    studio.page.mouse.move(x, y)
    studio.until("window.__asked > 0")  # the pointer rests there, and the page gets ready
    studio.settle()
    end = x + to * slider.bounding_box()["width"]
    original, blended, answered = drag_unanswered(studio, (x, y), end)
    changed = np.abs(original - answered).max()
    assert changed > 0.02
    assert np.abs(blended - answered).max() < within * changed


def drag_unanswered(studio: Studio, start: tuple[float, float], x: float) -> tuple[np.ndarray, ...]:
    """Drag sideways; returns where joints are seen before it, before any answer comes, and after it."""
    held: list[Any] = []
    original, slow = places(studio), True
    studio.page.route("**/api/edit", lambda route: held.append(route) if slow else route.continue_())
    studio.page.mouse.move(*start)
    studio.page.mouse.down()
    studio.page.mouse.move(x, start[1])
    studio.until("window.__asked > 0")
    blended, slow = places(studio), False
    for route in held:
        route.continue_()
    studio.page.mouse.up()
    studio.settle()
    return original, blended, places(studio)


def places(studio: Studio) -> np.ndarray:
    """Return where joints are seen from the middle of the viewport, in heights of it: rows may come below."""
    width, height, joints = studio.page.evaluate(
        f"[{V}.canvas.clientWidth, {V}.canvas.clientHeight, Object.values({V}.jointsOnScreen())]"
    )
    return (np.array(joints) - [width / 2, height / 2]) / height


class TestLayers:
    @pytest.fixture
    def three(self, walking: Studio) -> Studio:
        walking.add("tired")
        walking.add("Posture")
        walking.add("Tremor")
        assert walking.layers() == ["Tired", "Posture", "Tremor"]
        return walking

    def test_order_by_keys_and_mouse(self, three: Studio) -> None:
        three.rows.nth(2).get_by_role("button").nth(1).focus()
        three.press("Alt+ArrowUp")
        assert three.layers() == ["Tired", "Tremor", "Posture"]
        three.press("Alt+ArrowUp", "Alt+ArrowUp")
        assert three.layers() == ["Tremor", "Tired", "Posture"], "it stops at the end"
        three.press("ArrowDown")
        assert pressed(three) == ["Tired"]
        while three.undo_name() == "Undo move tremor":  # quick ones in a row are one step
            three.press("Control+z")
        assert three.layers() == ["Tired", "Posture", "Tremor"]
        three.rows.nth(0).drag_to(three.rows.nth(2), target_position={"x": 60, "y": 28})
        three.settle()
        assert three.layers() == ["Posture", "Tremor", "Tired"]
        assert three.undo_name() == "Undo move tired"
        three.rows.nth(2).drag_to(three.rows.nth(0), target_position={"x": 60, "y": 4})
        assert three.layers() == ["Tired", "Posture", "Tremor"]
        three.rows.nth(1).drag_to(three.page.get_by_role("main"))
        assert three.layers() == ["Tired", "Posture", "Tremor"], "let go elsewhere it stays"
        three.rows.nth(1).drag_to(three.rows.nth(2), target_position={"x": 60, "y": 28})
        assert three.layers() == ["Tired", "Tremor", "Posture"]

    def test_bypass_solo_duplicate_delete(self, three: Studio) -> None:
        recipe = lambda: re.findall('edit = "(.+)"', three.export("Recipe").decode())  # noqa: E731
        three.rows.nth(1).get_by_role("button", name="Bypass Posture").click()
        three.settle()
        assert {"posture"} & set(recipe()) == set() or recipe().count(
            "posture"
        ) == 1  # tired has one of its own
        assert recipe()[-2:] == ["tremor", "foot_plant"]
        three.rows.nth(1).get_by_role("button", name="Switch on Posture").click()
        three.rows.nth(2).get_by_role("button", name="Solo Tremor").click()
        three.settle()
        assert recipe() == ["tremor", "foot_plant"]
        three.rows.nth(2).get_by_role("button", name="Solo Tremor").click()
        three.button("Duplicate the layer").click()
        three.settle()
        assert three.layers() == ["Tired", "Posture", "Tremor", "Tremor"]
        assert recipe()[-3:] == ["tremor", "tremor", "foot_plant"]
        three.button("Delete the layer").click()
        assert three.layers() == ["Tired", "Posture", "Tremor"]
        three.button("Delete the layer").click()
        three.button("Delete the layer").click()
        three.button("Delete the layer").click()
        assert three.layers() == []

    def test_arms_only(self, walking: Studio, clips: Path) -> None:
        """A mood of the arms leaves every number of legs, spine and head as it was written."""
        walking.mood("excited")
        walking.page.get_by_role("group", name="Parts").get_by_text("arms", exact=True).click()
        walking.page.get_by_role("checkbox", name="Feet on the floor").uncheck()
        walking.settle()
        before, after = (clips / "walk.bvh").read_bytes(), walking.export()
        assert before.split(b"MOTION")[0] == after.split(b"MOTION")[0]
        first, second = (
            [line.split() for line in data.decode().split("Frame Time:")[1].splitlines()[1:]]
            for data in (before, after)
        )
        changed = {
            joint
            for rows in zip(first, second, strict=True)
            for joint, was, now in zip(columns(before), *rows, strict=True)
            if was != now
        }
        assert changed
        assert all(re.search("Arm|Shoulder|Hand|Collar|Elbow|Wrist", joint) for joint in changed), changed

    def test_span(self, walking: Studio, clips: Path) -> None:
        """Outside its stretch of time a layer changes nothing."""
        walking.mood("excited")
        walking.page.get_by_role("checkbox", name="Feet on the floor").uncheck()
        walking.settle()
        walking.page.get_by_role("combobox", name="Add a layer").select_option(label="Posture")
        walking.button("Delete the layer").click()
        walking.tab("Body")
        head = walking.page.get_by_role("region", name=re.compile("^Posture")).get_by_role(
            "spinbutton", name="head, typed"
        )
        walking.rows.nth(0).get_by_role("button", name="Bypass Excited").click()
        head.fill("25")
        head.press("Enter")
        walking.settle()
        walking.type("Time: start", "1")
        walking.type("Time: end", "1.5")
        assert "1.0–1.5 s" in walking.rows.nth(1).inner_text()
        before, after = numbers((clips / "walk.bvh").read_bytes()), numbers(walking.export())
        differs = (before != after).any(axis=1).nonzero()[0] / 30.0
        assert differs.min() >= 0.99
        assert differs.max() <= 1.51
        grip = walking.slider("Posture: end")
        grip.focus()
        walking.press("Shift+ArrowRight")
        walking.settle()
        assert walking.typed("Time: end").input_value().startswith("1.8")
        walking.drag(middle(walking.slider("Posture: when")), (-30, 0), (-30, 0))
        walking.settle()
        assert float(walking.typed("Time: start").input_value()) < 0.9
        assert walking.undo_name() == "Undo time of a layer"

    @pytest.mark.parametrize(("name", "way"), [("start", 1), ("end", -1)])
    def test_the_ends_of_a_bar_go_along_with_the_hand(self, walking: Studio, name: str, way: int) -> None:
        walking.add("Posture")
        lane = walking.slider("Posture: when").bounding_box()
        grip = walking.slider(f"Posture: {name}")
        before = middle(grip)[0]
        walking.drag(middle(grip), *[(20 * way, 0)] * 15)
        walking.settle()
        frame = lane["width"] / 75.0
        assert way * (middle(grip)[0] - before) == pytest.approx(300.0, abs=frame)
        typed = float(walking.typed(f"Time: {name}").input_value())
        gone = typed if name == "start" else walking.playback("duration") - typed
        assert gone == pytest.approx(300.0 / frame / 30.0, abs=0.05)
        assert walking.undo_name() == "Undo time of a layer"
        walking.press("Control+z")
        walking.settle()
        assert walking.undo_name() == "Undo add posture", "the whole way is one step"

    def test_strength_over_time(self, walking: Studio, clips: Path) -> None:
        """Keys on the timeline: where they say 0 nothing is changed, where they say 1 all of it."""
        walking.tab("Body")
        head = walking.page.get_by_role("region", name=re.compile("^Posture")).get_by_role(
            "spinbutton", name="head, typed"
        )
        head.fill("25")
        head.press("Enter")
        walking.page.get_by_role("checkbox", name="Feet on the floor").uncheck()
        walking.settle()
        whole = numbers(walking.export())
        timeline = walking.page.get_by_role("region", name="Timeline", exact=True)
        for time, value in (("0:01", "0"), ("0:02", "1")):
            moment = walking.page.get_by_label("Time", exact=True).and_(walking.page.get_by_role("textbox"))
            moment.fill(time)
            moment.press("Enter")
            timeline.get_by_role("button", name="Add a key at the playhead").click()
            walking.type("Strength of the key", value)
        assert timeline.get_by_role("slider", name=KEY).count() == 2
        assert "keyed" in walking.rows.first.inner_text()
        before, after = numbers((clips / "walk.bvh").read_bytes()), numbers(walking.export())
        frames = slice(0, 31), slice(60, None)
        assert (after[frames[0]] == before[frames[0]]).all()
        assert abs(after[frames[1]] - whole[frames[1]]).max() < 1e-3
        assert not (after[40:50] == before[40:50]).all()
        key = timeline.get_by_role("slider", name="Key 2 of 2")
        walking.drag(middle(key), (0, 8), (0, 8))
        walking.settle()
        assert walking.undo_name() == "Undo strength over time"
        assert float(key.get_attribute("aria-valuenow")) < 0.9
        walking.press("Control+z")
        assert float(key.get_attribute("aria-valuenow")) == 1


def pressed(studio: Studio) -> list[str]:
    """Return the chosen layers."""
    return [
        row.get_by_role("button").nth(1).inner_text().split("\n")[0]
        for row in studio.rows.all()
        if row.get_by_role("button").nth(1).get_attribute("aria-pressed") == "true"
    ]
