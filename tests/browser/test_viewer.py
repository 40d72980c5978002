"""The page without a server, in a real browser: what is drawn, where the joints are, keys, a lost context."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mien
from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.render import page as make_page

from .conftest import STATIC

pytestmark = pytest.mark.skipif(
    not (STATIC / "viewer.html").is_file(), reason="the viewer was not built (in frontend: npm run build)"
)
MOTIONS = {
    "walk": lambda: samples.walk(seconds=1.5, fps=30.0).motion,
    "wave in inches, Z up": lambda: (
        samples.wave(seconds=1.5, fps=30.0, skeleton="capture31", unit="inch", up="z", heading=1.0).motion
    ),
}
V = "window.__viewer"
Open = Callable[..., Any]


@pytest.fixture(scope="module")
def walk() -> Motion:
    return MOTIONS["walk"]()


@pytest.fixture(scope="module")
def address(walk: Motion, tmp_path_factory: pytest.TempPathFactory) -> str:
    """A page with a walk and what it was made from, at 0.5 s, waiting."""
    file = tmp_path_factory.mktemp("page") / "page.html"
    file.write_text(make_page(mien.edit(walk, "sad"), against=walk), encoding="utf-8")
    return f"{file.as_uri()}?quality=low&theme=light&time=0.5"


@pytest.mark.parametrize("mode", ["edited", "original", "overlay", "side", "wipe"])
def test_something_is_drawn_in_every_mode(opened: Open, address: str, mode: str) -> None:
    page = opened(address)
    page.evaluate(f"{V}.mode = '{mode}'")
    assert page.evaluate(f"{V}.colours()") > 300
    assert page.locator("text=original").count() >= (mode in ("side", "wipe"))


@pytest.mark.parametrize("name", MOTIONS)
def test_joints_are_seen_where_python_has_them(opened: Open, tmp_path: Path, name: str) -> None:
    motion, frame = MOTIONS[name](), 20
    file = tmp_path / "page.html"
    file.write_text(make_page(motion), encoding="utf-8")
    page = opened(f"{file.as_uri()}?quality=low&time={frame * motion.frame_time}")
    seen = page.evaluate(f"{V}.jointsOnScreen()")
    state, anchor = page.evaluate(f"{V}.camera.state"), page.evaluate(f"{V}.camera.anchor.toArray()")
    size = page.evaluate(f"[{V}.canvas.clientWidth, {V}.canvas.clientHeight]")
    field = page.evaluate(f"{V}.camera.camera.fov")
    expected = projected(in_room(motion)[frame], np.array(state), np.array(anchor), size, field)
    found = np.array([seen[joint] for joint in motion.skeleton.names])
    np.testing.assert_allclose(found, expected, atol=0.05)
    assert np.ptp(found[:, 1]) > 0.5 * size[1]  # the figure fills the picture


def in_room(motion: Motion) -> np.ndarray:
    """Return where the joints are (T, J, 3) in metres: left, up from the floor, forward."""
    body = Body.of(motion)
    axes = np.array([body.left, body.up, body.forward])
    places = world(motion)[1] @ axes.T
    places[..., 1] -= body.floor
    return places * (body.metres_per_unit or 0.87 / body.leg_length)


def projected(
    points: np.ndarray, state: np.ndarray, anchor: np.ndarray, size: list[float], field: float
) -> np.ndarray:
    """Return the pixels (J, 2) at which a camera that turns about a point sees points (J, 3)."""
    yaw, pitch, distance, *pan = state
    level = math.cos(pitch)
    toward = np.array([math.sin(yaw) * level, math.sin(pitch), math.cos(yaw) * level])
    eye = anchor + pan + distance * toward
    right = np.cross([0.0, 1.0, 0.0], toward)
    right /= np.linalg.norm(right)
    seen = (points - eye) @ np.stack([right, np.cross(toward, right), toward]).T
    focal = 0.5 * size[1] / math.tan(math.radians(field) / 2.0)
    flat = focal * seen[:, :2] / -seen[:, 2:]
    return np.array(size) / 2.0 + flat * [1.0, -1.0]


def test_the_same_page_gives_the_same_pixels(opened: Open, address: str) -> None:
    pictures = [opened(address).locator(".mien-view").screenshot() for _ in range(2)]
    assert pictures[0] == pictures[1]


def test_keys(opened: Open, address: str) -> None:
    page = opened(address)
    state = f"[{V}.playback.playing, {V}.playback.frame, {V}.mode, {V}.treadmill]"
    assert page.evaluate(state) == [False, 15, "overlay", False]
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft", "Shift+ArrowRight", "g", "y"):
        page.keyboard.press(key)
    assert page.evaluate(state) == [False, 26, "edited", True]
    page.keyboard.press("v")
    page.keyboard.press("Home")
    assert page.evaluate(state) == [False, 0, "original", True]
    page.keyboard.press(" ")
    assert page.evaluate(f"{V}.playback.playing")
    until(page, f"{V}.playback.time > 0.1")
    page.keyboard.press("k")
    assert not page.evaluate(f"{V}.playback.playing")


def until(page: Any, what: str) -> None:
    """Wait for something to become true; the page's own policy forbids what Playwright has for that."""
    for _ in range(100):
        if page.evaluate(what):
            return
        page.wait_for_timeout(50)
    pytest.fail(f"never became true: {what}")


def test_views_turn_the_camera(opened: Open, address: str) -> None:
    page = opened(address)
    yaws = {}
    for key in "1357":
        page.keyboard.press(key)
        yaws[key] = page.evaluate(f"{V}.camera.state")[:2]
    assert yaws["1"][0] - yaws["3"][0] == pytest.approx(math.pi / 2, abs=1e-6)
    assert yaws["7"][1] == pytest.approx(math.pi / 2, abs=0.01)


def test_the_mouse_turns_slides_and_comes_nearer(opened: Open, address: str) -> None:
    page = opened(address)
    before = page.evaluate(f"{V}.camera.state")
    page.mouse.move(300, 150)
    page.mouse.down()
    page.mouse.move(360, 150)
    page.mouse.up()
    turned = page.evaluate(f"{V}.camera.state")
    assert turned[0] < before[0] - 0.2
    assert turned[2:] == before[2:]
    page.mouse.down(button="right")
    page.mouse.move(300, 120)
    page.mouse.up(button="right")
    slid = page.evaluate(f"{V}.camera.state")
    assert slid[:3] == turned[:3]
    assert slid[3:] != turned[3:]
    joints = page.evaluate(f"{V}.jointsOnScreen()")
    x, y = joints["Head"]
    page.mouse.move(x, y)
    page.mouse.wheel(0, -300)
    until(page, f"{V}.camera.distance < {before[2]} - 0.5")
    near = page.evaluate(f"{V}.jointsOnScreen()")["Head"]
    assert near == pytest.approx([x, y], abs=25)  # what is under the cursor stays there


def test_the_wipe_is_drawn_along_by_mouse_and_keys(opened: Open, address: str) -> None:
    page = opened(address)
    page.evaluate(f"{V}.mode = 'wipe'")
    handle = page.get_by_role("slider", name="Share of the original")
    box = handle.bounding_box()
    page.mouse.move(box["x"] + 9, 200)
    page.mouse.down()
    page.mouse.move(0.25 * 640, 200)
    page.mouse.up()
    assert page.evaluate(f"{V}.wipe") == pytest.approx(0.25, abs=0.01)
    handle.focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate(f"{V}.wipe") == pytest.approx(0.27, abs=0.01)
    assert page.evaluate(f"{V}.playback.frame") == 15  # the arrow did not step the motion as well


def test_two_fingers_come_nearer_and_one_turns(opened: Open, address: str) -> None:
    page = opened(address, has_touch=True)
    before = page.evaluate(f"{V}.camera.state")
    session = page.context.new_cdp_session(page)

    def touch(kind: str, *points: tuple[int, int]) -> None:
        fingers = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

    touch("touchStart", (250, 150), (350, 150))
    touch("touchMove", (200, 150), (400, 150))
    touch("touchEnd")
    near = page.evaluate(f"{V}.camera.state")
    assert near[2] < 0.7 * before[2]
    assert near[:2] == before[:2]
    touch("touchStart", (250, 150))
    touch("touchMove", (300, 150))
    touch("touchEnd")
    assert page.evaluate(f"{V}.camera.state")[0] < near[0] - 0.1


@pytest.mark.parametrize(("wish", "plays"), [("reduce", False), ("no-preference", True)])
def test_it_plays_by_itself_unless_less_motion_is_asked_for(
    browser: Any, address: str, wish: str, plays: bool
) -> None:
    page = browser.new_page(reduced_motion=wish)
    page.goto(address.replace("&time=0.5", ""))
    assert page.evaluate(f"{V}.playback.playing") == plays
    page.close()


def test_a_double_click_picks_a_joint(opened: Open, address: str) -> None:
    page = opened(address)
    box = page.locator("canvas").bounding_box()
    x, y = page.evaluate(f"{V}.jointsOnScreen()")["Head"]
    page.mouse.dblclick(box["x"] + x + 2, box["y"] + y)
    assert page.evaluate(f"{V}.selected") == "Head"
    page.mouse.dblclick(box["x"] + 5, box["y"] + 5)
    assert page.evaluate(f"{V}.selected") is None


def test_in_place_the_figure_stays(opened: Open, address: str) -> None:
    page = opened(address)
    page.evaluate(f"{V}.follow = false")
    free, kept = [], []
    for on, places in ((False, free), (True, kept)):
        page.evaluate(f"{V}.treadmill = {str(on).lower()}")
        for time in (0.1, 1.3):
            page.evaluate(f"{V}.playback.set({{ time: {time} }})")
            places.append(page.evaluate(f"{V}.jointsOnScreen()")["Hips"])
    away = [math.dist(*places) for places in (free, kept)]
    assert away[0] > 100
    assert away[1] < 30


def test_marks_tint_the_figure_red(opened: Open, address: str) -> None:
    page = opened(address)
    page.evaluate(f"{V}.mode = 'edited'")
    plain = page.locator(".mien-view").screenshot()
    page.evaluate(f"{V}.setMarks([{{ start: 0.4, end: 0.6, parts: ['left_leg', 'head'] }}])")
    page.wait_for_timeout(100)
    marked = page.locator(".mien-view").screenshot()
    assert marked != plain
    page.evaluate(f"{V}.setMarks([{{ start: 0.7, end: 0.8, parts: [] }}])")
    page.wait_for_timeout(100)
    assert page.locator(".mien-view").screenshot() == plain


def test_a_lost_context_comes_back(opened: Open, address: str) -> None:
    page = opened(address)
    before = page.evaluate(f"{V}.colours()")
    page.evaluate(f"window.loss = {V}.canvas.getContext('webgl2').getExtension('WEBGL_lose_context')")
    page.evaluate("loss.loseContext()")
    page.wait_for_selector("text=The graphics card was taken away")
    page.evaluate("loss.restoreContext()")
    page.wait_for_selector("text=The graphics card was taken away", state="hidden")
    page.wait_for_timeout(200)
    assert page.evaluate(f"{V}.colours()") == before


def test_nothing_is_left_after_disposal(opened: Open, address: str) -> None:
    page = opened(address)
    page.evaluate(f"{V}.dispose()")
    assert page.locator("canvas").count() == 0
    page.wait_for_timeout(100)


def test_controls_have_names(opened: Open, address: str) -> None:
    page = opened(address)
    names = page.evaluate(
        "[...document.querySelectorAll('button, select, input, [role=slider]')]"
        ".map(e => e.ariaLabel || e.textContent.trim())"
    )
    assert len(names) > 12
    assert all(names)


def test_a_page_without_clips_says_so(opened: Open) -> None:
    page = opened((STATIC / "viewer.html").as_uri())
    assert "mien render" in page.locator("#viewer").inner_text()
