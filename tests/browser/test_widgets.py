"""The page's widgets in a real browser, by mouse, by keyboard and by touch, under its own strict policy.

They are driven on ``frontend/demo.html``, which is built for these tests and never shipped. What a widget
says to its owner stands on that page as JSON.
"""

import functools
import json
import shutil
import subprocess
import threading
from collections.abc import Iterator
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest

FRONTEND = Path(__file__).resolve().parents[2] / "frontend"
POLICY = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'"
Page = Any


class Handler(SimpleHTTPRequestHandler):
    """Files of the built page, under the policy that the studio sends."""

    def log_message(self, *_: object) -> None:
        """Say nothing."""

    def end_headers(self) -> None:
        self.send_header("Content-Security-Policy", POLICY)
        super().end_headers()

    def do_GET(self) -> None:
        if self.path != "/favicon.ico":
            return super().do_GET()
        self.send_response(204)
        return self.end_headers()


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Build the page with all widgets and serve it."""
    if not (FRONTEND / "node_modules").exists() or not shutil.which("npx"):
        pytest.skip("no node_modules: run `npm ci` in frontend")
    folder = tmp_path_factory.mktemp("widgets")
    command = ["npx", "vite", "build", "--config", "vite.demo.ts", "--outDir", str(folder), "--emptyOutDir"]
    done = subprocess.run(command, cwd=FRONTEND, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    server = ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/demo.html"
    server.shutdown()
    server.server_close()


def on_page(browser: Any, address: str, **options: Any) -> tuple[Page, list[str]]:
    """Open the page; the list gathers everything that goes wrong on it."""
    page = browser.new_page(viewport={"width": 1280, "height": 1000}, **options)
    wrong: list[str] = []
    page.on("console", lambda m: wrong.append(m.text) if m.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.set_default_timeout(8000)
    page.goto(address)
    page.wait_for_selector(".timeline")
    return page, wrong


@pytest.fixture
def page(browser: Any, address: str) -> Iterator[Page]:
    """Give a fresh page, on which nothing may go wrong, the policy's violations included."""
    page, wrong = on_page(browser, address)
    yield page
    page.close()
    assert wrong == []


def said(page: Page) -> list[Any]:
    """Return what a widget said last."""
    return json.loads(page.locator("output").inner_text())


def playback(page: Page, field: str) -> Any:
    return page.evaluate(f"playback.{field}")


def drag(page: Page, start: tuple[float, float], *ways: tuple[float, float], keys: str = "") -> list[Any]:
    """Press at a place, move by each of the ways, and let go; return what was said before that."""
    x, y = start
    if keys:
        page.keyboard.down(keys)
    page.mouse.move(x, y)
    page.mouse.down()
    for right, down in ways:
        x, y = x + right, y + down
        page.mouse.move(x, y)
    before = said(page)
    page.mouse.up()
    if keys:
        page.keyboard.up(keys)
    return before


def middle(locator: Any) -> tuple[float, float]:
    box = locator.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


class TestSlider:
    @pytest.mark.parametrize(
        ("key", "value"),
        [
            ("ArrowRight", 13), ("ArrowLeft", 11), ("PageUp", 22), ("PageDown", 2), ("Home", -60),
            ("End", 60), ("Shift+ArrowRight", 12.2), ("Backspace", 0), ("Delete", 0),
        ],
    )  # fmt: skip
    def test_keys(self, page: Page, key: str, value: float) -> None:
        slider = page.get_by_role("slider", name="head", exact=True)
        slider.focus()
        page.keyboard.press(key)
        assert said(page) == ["head", value, True]
        unit = "degrees, neutral" if value == 0 else "degrees"
        assert slider.get_attribute("aria-valuetext").endswith(unit)

    def test_drag_is_done_when_let_go(self, page: Page) -> None:
        slider = page.get_by_role("slider", name="head", exact=True)
        x, y = middle(slider)
        before = drag(page, (x, y), (20, 0), (20, 0))
        after = said(page)
        assert before[0] == after[0] == "head"
        assert (before[2], after[2]) == (False, True)
        assert before[1] == after[1] > 12

    def test_slow_with_alt_or_shift_at_any_moment(self, page: Page) -> None:
        slider = page.get_by_role("slider", name="head", exact=True)
        box = slider.bounding_box()
        thumb = box["x"] + 6 + (box["width"] - 12) * 72 / 120, box["y"] + box["height"] / 2
        drag(page, thumb, (40, 0))
        fast = said(page)[1] - 12
        page.get_by_label("head, typed").fill("12")
        page.keyboard.press("Enter")
        drag(page, thumb, (40, 0), keys="Alt")
        assert said(page)[1] - 12 == pytest.approx(fast / 5, abs=0.5)

    def test_double_click_resets(self, page: Page) -> None:
        page.locator("label", has_text="head").first.dblclick()
        assert said(page) == ["head", 0, True]
        page.get_by_label("head, typed").fill("30")
        page.keyboard.press("Enter")
        page.mouse.dblclick(*middle(page.get_by_role("slider", name="head", exact=True)))
        assert said(page) == ["head", 0, True]

    def test_typing(self, page: Page) -> None:
        field = page.get_by_label("head, typed")
        field.fill("−7,5°")
        field.press("Enter")
        assert said(page) == ["head", -7.5, True]
        field.fill("61")
        field.press("Enter")
        assert page.get_by_role("alert").inner_text() == "From −60 to 60 degrees."
        assert said(page) == ["head", -7.5, True], "a value out of range was taken"
        field.press("Escape")
        assert field.input_value() == "-7.5"
        assert page.get_by_role("alert").count() == 0

    def test_touch(self, browser: Any, address: str) -> None:
        page, wrong = on_page(browser, address, has_touch=True)
        box = page.get_by_role("slider", name="head", exact=True).bounding_box()
        page.touchscreen.tap(box["x"] + box["width"] / 4, box["y"] + box["height"] / 2)
        name, value, done = said(page)
        page.close()
        assert (name, done, wrong) == ("head", True, [])
        assert value == pytest.approx(-31, abs=3)

    def test_disabled(self, page: Page) -> None:
        slider = page.get_by_role("slider", name="trunk")
        page.mouse.click(*middle(slider))
        assert slider.is_disabled()
        assert said(page) == []


class TestControls:
    def test_switch(self, page: Page) -> None:
        switch = page.get_by_role("switch", name="keep feet")
        switch.focus()
        page.keyboard.press("Space")
        assert said(page) == ["on", False, True]
        assert switch.get_attribute("aria-checked") == "false"

    def test_choice_by_arrows(self, page: Page) -> None:
        page.get_by_role("radiogroup", name="loop").get_by_role("radio", name="all").focus()
        page.keyboard.press("ArrowRight")
        assert said(page) == ["loop", "range", True]
        page.get_by_label("method").select_option("body_fixed")
        assert said(page) == ["method", "body_fixed", True]

    def test_chips(self, page: Page) -> None:
        group = page.get_by_role("group", name="parts")
        group.get_by_text("left arm").click()
        assert said(page) == ["parts", ["head", "left_arm"], True]
        group.get_by_role("checkbox", name="head").focus()
        page.keyboard.press("Space")
        assert said(page) == ["parts", ["left_arm"], True]

    def test_span_keeps_its_order(self, page: Page) -> None:
        start = page.get_by_label("when: start")
        start.fill("5")
        start.press("Enter")
        assert page.get_by_role("alert").inner_text() == "The start must be before the end."
        start.fill("2")
        start.press("Enter")
        assert said(page) == ["span", [2, 4.5], 0.5, True]
        page.get_by_role("button", name="all", exact=True).click()
        assert said(page) == ["span", None, 0.5, True]

    def test_parameters(self, page: Page) -> None:
        whole = page.get_by_role("spinbutton", name="seed")
        whole.fill("1.5")
        whole.press("Enter")
        assert page.get_by_role("alert").inner_text() == "A whole number."
        whole.fill("7")
        whole.press("Enter")
        assert said(page) == ["seed", 7, True]
        optional = page.get_by_role("spinbutton", name="fps")
        optional.fill("30")
        optional.press("Enter")
        assert said(page) == ["fps", 30, True]
        optional.fill("")
        optional.press("Enter")
        assert said(page) == ["fps", None, True]
        keyed = page.get_by_label("amount (keyed)")
        keyed.fill("0:0, 2:1")
        keyed.press("Enter")
        assert said(page) == ["amount", [[0, 0], [2, 1]], True]
        page.get_by_role("group", name="limbs").get_by_text("head").click()
        assert said(page) == ["limbs", ["head"], True]

    def test_hint(self, page: Page) -> None:
        page.get_by_role("button", name="Undo").hover()
        page.wait_for_selector(".tip")
        assert page.locator(".tip").inner_text() == "UndoCtrl+Z"
        page.keyboard.press("Escape")
        page.mouse.move(5, 5)
        assert page.locator(".tip").count() == 0


class TestDisc:
    @pytest.fixture
    def disc(self, page: Page) -> tuple[float, float, float]:
        """Return the centre of the disc and its radius on the page."""
        rim = page.locator(".rim")
        return *middle(rim), rim.bounding_box()["width"] / 2

    def test_press_and_drag(self, page: Page, disc: tuple[float, float, float]) -> None:
        x, y, radius = disc
        before = drag(page, (x, y), (-radius / 4, 0), (-radius / 4, -radius / 2))
        name, valence, arousal, done = said(page)
        assert (name, before[3], done) == ("ask", False, True)
        assert (valence, arousal) == (pytest.approx(-0.5, abs=0.02), pytest.approx(0.5, abs=0.02))

    def test_only_the_inside_answers(self, page: Page, disc: tuple[float, float, float]) -> None:
        x, y, radius = disc
        page.mouse.click(x + 0.8 * radius, y + 0.8 * radius)
        assert said(page) == []

    def test_a_drag_stays_on_the_disc(self, page: Page, disc: tuple[float, float, float]) -> None:
        x, y, radius = disc
        drag(page, (x, y), (3 * radius, 0))
        assert said(page) == ["ask", 1, 0, True]

    def test_double_click_is_neutral(self, page: Page, disc: tuple[float, float, float]) -> None:
        x, y, radius = disc
        page.mouse.dblclick(x + radius / 3, y)
        assert said(page) == ["ask", 0, 0, True]

    def test_keys(self, page: Page) -> None:
        page.get_by_role("slider", name="Valence").focus()
        arousal = page.get_by_role("slider", name="Arousal")
        page.keyboard.press("ArrowRight")
        assert said(page) == ["ask", 0.65, -0.3, True]
        page.keyboard.press("ArrowUp")
        assert said(page) == ["ask", 0.65, -0.25, True]
        assert arousal.evaluate("one => one === document.activeElement"), "what has moved is to be heard"
        page.keyboard.press("Shift+ArrowDown")
        assert said(page) == ["ask", 0.65, -0.26, True]
        assert arousal.get_attribute("aria-valuetext") == (
            "valence 0.65 pleasant, arousal −0.26 calm, near at ease"
        )
        assert page.locator("svg .focus").count() == 1
        page.keyboard.press("Home")
        assert said(page) == ["ask", 0, 0, True]

    def test_typing(self, page: Page) -> None:
        field = page.get_by_label("Valence, typed")
        field.fill("0.99")
        field.press("Enter")
        assert page.get_by_role("alert").inner_text() == "Outside the disc: with arousal −0.30 at most ±0.95."
        field.fill("0.9")
        field.press("Enter")
        assert said(page) == ["ask", 0.9, -0.3, True]

    def test_words_and_clearing(self, page: Page) -> None:
        page.get_by_text("Words", exact=True).click()
        page.get_by_role("radio", name="sad", exact=True).check(force=True)
        assert said(page) == ["ask", -0.648, -0.267, True]
        assert "−0.65, −0.27, near sad" in page.locator(".legend").inner_text()
        page.get_by_role("button", name="clear").click()
        assert said(page) == ["clear"]
        valence = page.get_by_role("slider", name="Valence")
        assert valence.get_attribute("aria-valuetext") == "nothing asked for"

    def test_touch(self, browser: Any, address: str) -> None:
        page, wrong = on_page(browser, address, has_touch=True)
        x, y = middle(page.locator(".rim"))
        page.touchscreen.tap(x - 20, y)
        name, valence, arousal, done = said(page)
        page.touchscreen.tap(x + 20, y)  # where "neutral" is written
        word = said(page)
        page.close()
        assert (name, arousal, done, wrong) == ("ask", 0, True, [])
        assert -0.2 < valence < -0.1
        assert word == ["ask", 0, 0, True]


class TestSquare:
    def test_press_is_caught_by_the_nine(self, page: Page) -> None:
        box = page.locator(".ground").bounding_box()
        page.mouse.click(box["x"] + box["width"] - 3, box["y"] + 3)
        assert said(page) == ["square", 2, 2, True]
        drag(page, middle(page.locator(".ground")), (box["width"] / 4, 0))
        assert said(page)[1:] == [pytest.approx(1.5, abs=0.02), 1, True]

    def test_keys(self, page: Page) -> None:
        page.get_by_role("slider", name="Path", exact=True).focus()
        page.keyboard.press("ArrowRight")
        assert said(page) == ["square", 1.45, 0.5, True]
        page.keyboard.press("ArrowDown")
        assert said(page) == ["square", 1.45, 0.45, True]
        page.keyboard.press("Home")
        assert said(page) == ["square", 1, 1, True]

    def test_typing_and_letters(self, page: Page) -> None:
        page.get_by_label("Timing, typed").fill("1.75")
        page.keyboard.press("Enter")
        assert said(page) == ["square", 1.4, 1.75, True]
        page.get_by_role("radio", name="G: short paths, added acceleration").check(force=True)
        assert said(page) == ["square", 0, 0, True]


class TestTimeline:
    @staticmethod
    def at(page: Page, seconds: float) -> tuple[float, float]:
        """Return where a moment stands on the ruler while all is seen."""
        box = page.get_by_role("slider", name="Playhead").bounding_box()
        room = 0.015 * 7.5
        return box["x"] + box["width"] * (seconds + room) / (7.5 + 2 * room), box["y"] + 8

    def test_scrub(self, page: Page) -> None:
        page.evaluate("playback.set({playing: true})")
        drag(page, self.at(page, 1), (60, 0), (60, 0))
        time = playback(page, "time")
        assert not playback(page, "playing")
        assert time > 1.5
        assert time * 60 == pytest.approx(round(time * 60), abs=1e-6), "between two frames"
        assert page.get_by_label("Time", exact=True).input_value().startswith("00:0")

    def test_playhead_keys(self, page: Page) -> None:
        playhead = page.get_by_role("slider", name="Playhead")
        playhead.focus()
        for key, frame in {
            "ArrowRight": 1, "Shift+ArrowRight": 11, "PageUp": 71, "ArrowLeft": 70, "End": 450, "Home": 0,
        }.items():  # fmt: skip
            page.keyboard.press(key)
            assert playback(page, "frame") == frame, key
        assert playhead.get_attribute("aria-valuetext") == "00:00.00, frame 0 of 450"

    def test_range_by_hand_and_by_keys(self, page: Page) -> None:
        start, end = self.at(page, 2), self.at(page, 4)
        drag(page, start, (end[0] - start[0], 0), keys="Shift")
        assert playback(page, "range") == [pytest.approx(2, abs=0.02), pytest.approx(4, abs=0.02)]
        assert playback(page, "loop") == "range"
        grip = page.get_by_role("slider", name="End of the range")
        grip.focus()
        page.keyboard.press("Shift+ArrowRight")
        assert playback(page, "range")[1] == pytest.approx(4 + 10 / 60, abs=0.02)
        drag(page, middle(grip), (-80, 0))
        assert playback(page, "range")[1] < 3.9
        page.get_by_role("slider", name="Start of the range").focus()
        page.keyboard.press("Delete")
        assert playback(page, "range") is None

    def test_wheel_zooms_about_the_pointer_and_shift_pans(self, page: Page) -> None:
        x, y = self.at(page, 3)
        page.mouse.move(x, y)
        page.mouse.wheel(0, -1200)
        page.wait_for_selector(".ruler .bar")
        page.mouse.click(x, y)
        assert playback(page, "time") == pytest.approx(3, abs=0.02)
        page.keyboard.down("Shift")
        page.mouse.wheel(0, 300)
        page.keyboard.up("Shift")
        page.wait_for_timeout(100)
        page.mouse.click(x, y)
        assert playback(page, "time") > 3.2
        page.get_by_role("button", name="See the whole clip").click()
        assert page.locator(".ruler .bar").count() == 0

    def test_transport(self, page: Page) -> None:
        press = lambda name: page.get_by_role("button", name=name, exact=True).click()  # noqa: E731
        press("A frame on")
        assert playback(page, "frame") == 1
        press("To the end")
        assert playback(page, "frame") == 450
        press("A frame back")
        assert playback(page, "frame") == 449
        press("To the start")
        press("Play")
        assert playback(page, "playing")
        press("Pause")
        press("Play backwards")
        assert playback(page, "direction") == -1
        press("Pause")
        press("Faster")
        assert playback(page, "speed") == 2
        press("Loop: the whole clip")
        assert playback(page, "loop") == "range"

    def test_typed_moments(self, page: Page) -> None:
        time = page.get_by_label("Time", exact=True)
        time.fill("0:01.5")
        time.press("Enter")
        assert playback(page, "time") == pytest.approx(1.5)
        assert time.evaluate("field => field !== document.activeElement"), "the keyboard is given back"
        frame = page.get_by_label("Frame", exact=True)
        frame.fill("300")
        frame.press("Enter")
        assert playback(page, "frame") == 300
        frame.fill("451")
        frame.press("Enter")
        assert page.get_by_role("alert").inner_text() == "After the end of the clip."
        assert playback(page, "frame") == 300

    def test_marks(self, page: Page) -> None:
        marks = page.get_by_role("button", name="foot slide")
        assert marks.count() == 2
        marks.nth(1).focus()
        page.keyboard.press("Enter")
        assert said(page) == ["mark", "slide", 6]
        assert playback(page, "time") == 6
        marks.first.click()
        assert said(page) == ["mark", "slide", 1.35]

    def test_layers_by_hand(self, page: Page) -> None:
        drag(page, middle(page.get_by_role("slider", name="posture: when")), (100, 0))
        _, layer, (start, end), ease, done = said(page)
        assert (layer, end - start, ease, done) == ("b", pytest.approx(3.5, abs=0.02), 0.5, True)
        assert start > 1.3
        drag(page, middle(page.get_by_role("slider", name="posture: end")), (-2000, 0))
        assert said(page)[2] == [start, pytest.approx(start + 1 / 60, abs=1e-3)]
        drag(page, middle(page.get_by_role("slider", name="path_length: ease")), (40, 0))
        assert said(page)[1] == "c"
        assert said(page)[3] > 0.4

    def test_layers_by_keys_and_typing(self, page: Page) -> None:
        page.get_by_role("slider", name="tired: start").focus()
        page.keyboard.press("Shift+ArrowRight")
        assert said(page) == ["layer", "a", [pytest.approx(0.1667, abs=1e-3), 7.5], 0.25, True]
        page.get_by_role("button", name="posture").click()
        page.get_by_label("posture: when: end").fill("3")
        page.keyboard.press("Enter")
        assert said(page) == ["layer", "b", [1, 3], 0.5, True]
        page.get_by_role("slider", name="posture: when").focus()
        page.keyboard.press("Delete")
        assert said(page) == ["layer", "b", None, 0.5, True]

    def test_strength_by_hand(self, page: Page) -> None:
        lane = page.locator(".lane .lane")
        box = lane.bounding_box()
        page.mouse.dblclick(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        name, curve, done = said(page)
        assert (name, len(curve), done) == ("strength", 4, True)
        assert curve[2] == [pytest.approx(3.75, abs=0.03), pytest.approx(1, abs=0.05)]
        before = drag(page, middle(page.get_by_role("slider", name="Key 3 of 4")), (30, 10))
        assert (before[2], said(page)[2]) == (False, True)
        assert said(page)[1][2][0] > 3.8
        assert said(page)[1][2][1] < 0.9

    def test_strength_by_keys_and_typing(self, page: Page) -> None:
        page.get_by_role("slider", name="Key 2 of 3").focus()
        page.keyboard.press("ArrowUp")
        assert said(page) == ["strength", [[0.5, 0.2], [2, 1.25], [5, 0.8]], True]
        page.get_by_label("Time of the key").fill("0.4")
        page.keyboard.press("Enter")
        assert page.get_by_role("alert").inner_text() == "Between the keys beside it, please."
        page.get_by_label("Strength of the key").fill("0.5")
        page.keyboard.press("Enter")
        assert said(page)[1][1] == [2, 0.5]
        page.evaluate("playback.set({time: 3})")
        page.get_by_role("button", name="Add a key at the playhead").click()
        assert said(page)[1][2][0] == 3
        for left in (3, 2, 1):
            page.get_by_role("slider", name="Key 1 of").focus()
            page.keyboard.press("Delete")
            assert len(said(page)[1]) == left
        page.get_by_role("slider", name="Key 1 of 1").focus()
        page.keyboard.press("Delete")
        assert said(page) == ["strength", 0.8, True], "the last key leaves its value"
        page.get_by_role("spinbutton", name="Strength", exact=True).fill("1.1")
        page.keyboard.press("Enter")
        assert said(page) == ["strength", 1.1, True]


def test_five_minutes_are_drawn_by_pixels(browser: Any, address: str) -> None:
    """36,000 frames: what is drawn depends on how wide the page is, not on how long the clip is."""
    page, wrong = on_page(browser, f"{address}?frames=36000")
    paths = page.locator(".timeline path")
    drawn = paths.evaluate_all("paths => paths.map(path => path.getAttribute('d').length)")
    assert max(drawn) < 80_000
    assert page.evaluate("document.querySelectorAll('.timeline *').length") < 3000
    page.evaluate("playback.set({time: 200})")
    assert "frame 24000" in page.get_by_role("slider", name="Playhead").get_attribute("aria-valuetext")
    page.close()
    assert wrong == []


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_axe(browser: Any, address: str, theme: str) -> None:
    """No violation of the rules of WCAG that a machine can check, in either theme, with everything opened."""
    axe = FRONTEND / "node_modules" / "axe-core" / "axe.min.js"
    if not axe.exists():
        pytest.skip("axe-core is not installed: run `npm ci` in frontend")
    page, wrong = on_page(browser, f"{address}?theme={theme}")
    page.get_by_text("Words", exact=True).click()
    page.get_by_role("button", name="posture").click()
    page.get_by_role("slider", name="Key 2 of 3").focus()
    page.evaluate("playback.set({range: [1, 6], time: 2})")
    page.evaluate(axe.read_text(encoding="utf-8"))
    found = page.evaluate("axe.run()")
    page.close()
    told = [
        f"{rule['id']}: {node['html']:.200} {node.get('failureSummary')}"
        for rule in found["violations"]
        for node in rule["nodes"]
    ]
    assert told == []
    assert wrong == []


def test_focus_is_seen_everywhere(page: Page) -> None:
    """Tab goes through all controls, and what has the focus shows it: itself, its label or its drawing."""
    seen = 0
    for _ in range(200):
        page.keyboard.press("Tab")
        here = page.evaluate(
            """() => {
              const here = document.activeElement;
              if (here === document.body || here.dataset.seen) return null;
              here.dataset.seen = "yes";
              const ring = (one) => one && getComputedStyle(one).outlineStyle !== "none";
              const shown = ring(here) || ring(here.closest("label")) || ring(here.closest(".field"))
                || here.closest(".pad")?.querySelector("svg .focus");
              const name = here.getAttribute("aria-label") ?? here.innerText ?? here.id;
              return [`${here.tagName} ${here.type ?? ""} ${name || here.id}`, Boolean(shown)];
            }"""
        )
        if here is None:
            break
        seen += 1
        assert here[1], f"no focus to be seen on {here[0]}"
    assert seen > 60
