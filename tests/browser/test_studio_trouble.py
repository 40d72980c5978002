"""What may go wrong around the page: said clearly, and nothing is lost."""

import os
import re
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from .driving import Server, Studio

Visit = Callable[..., Studio]
LOST = ("ERR_CONNECTION_REFUSED", "ERR_CONNECTION_RESET", "ERR_EMPTY_RESPONSE", "ERR_SOCKET")


@pytest.fixture
def own(browser: Any, built: None, tmp_path: Path) -> Iterator[Server]:
    """A server that a test may kill."""
    server = Server(tmp_path / "studio")
    yield server
    server.stop()


def test_killed_in_mid_edit(visit: Visit, own: Server, clips: Path) -> None:
    studio = visit(own)
    studio.expected += LOST
    studio.open(clips / "walk.bvh")
    studio.mood("sad")
    alone = studio.pixels()
    own.kill()
    studio.type_only("Overall, typed", "0.7")
    alert = studio.page.get_by_role("alert")
    alert.get_by_text("The connection to mien is lost; your work is kept.").wait_for()
    studio.add_only("Posture")
    assert studio.layers() == ["Sad", "Posture"]
    assert studio.colours() > 500, "the figure stays"
    own.start()
    alert.wait_for(state="hidden")
    studio.settle()
    assert "saved" in studio.page.get_by_role("banner").inner_text()
    assert (studio.layers(), studio.typed("Overall, typed").input_value()) == (["Sad", "Posture"], "0.70")
    assert studio.pixels() != alone
    done = studio.export()
    studio.page.reload()
    studio.settle()
    assert (studio.layers(), studio.typed("Overall, typed").input_value()) == (["Sad", "Posture"], "0.70")
    assert studio.export() == done


def test_gone_and_the_page_too(visit: Visit, own: Server, clips: Path) -> None:
    """The server dies, work goes on, the tab is closed; later both come back."""
    studio = visit(own)
    studio.expected += LOST
    studio.open(clips / "walk.bvh")
    studio.mood("sad")
    own.kill()
    studio.add_only("Posture")
    studio.page.get_by_role("alert").wait_for()
    context = studio.page.context
    studio.page.close()
    own.start()
    again = visit(own, context)
    assert again.layers() == ["Sad", "Posture"]


def test_started_again_with_another_key(visit: Visit, own: Server, clips: Path) -> None:
    studio = visit(own)
    studio.expected += (*LOST, "status of 401")
    studio.open(clips / "walk.bvh")
    studio.mood("sad")
    own.kill()
    (own.folder / "token").unlink()
    own.start()
    studio.type_only("Overall, typed", "0.5")
    alert = studio.page.get_by_role("alert").filter(has_text="another key")
    alert.wait_for()
    assert "Open the address that mien studio printed" in " ".join(alert.inner_text().split())
    studio.go()
    assert (studio.layers(), studio.typed("Overall, typed").input_value()) == (["Sad"], "0.50")


def test_a_page_without_the_key(visit: Visit, server: Server, browser: Any) -> None:
    context = browser.new_context()
    page = context.new_page()
    page.goto(server.base)
    page.get_by_text("open the address that mien studio printed").wait_for()
    context.close()


def test_a_second_tab(walking: Studio, visit: Visit) -> None:
    walking.mood("sad")
    other = visit(walking.server, walking.page.context)
    said = other.page.get_by_role("alert").filter(has_text="open in another tab")
    said.wait_for()
    assert other.layers() == ["Sad"]
    other.mood("tired")
    walking.page.reload()
    walking.settle()
    assert walking.layers() == ["Sad"], "what the second tab does is not kept"
    assert walking.page.get_by_role("alert").count() == 0, "who is there again goes on"
    said.wait_for()
    said.get_by_role("button", name="Go on here instead").click()
    walking.page.get_by_role("alert").filter(has_text="open in another tab").wait_for()
    other.mood("proud")
    other.page.reload()
    other.settle()
    assert other.layers() == ["Proud"], "now this one keeps the work"


def test_the_working_tab_is_closed(walking: Studio, visit: Visit) -> None:
    """One of those that wait goes on with its work, and only one."""
    others = [visit(walking.server, walking.page.context) for _ in range(2)]
    looks = [other.page.get_by_role("alert").filter(has_text="open in another tab") for other in others]
    for look in looks:
        look.wait_for()
    others[0].mood("tired")
    walking.mood("sad")
    walking.page.close()
    looks[0].wait_for(state="hidden")
    others[0].settle()
    assert looks[1].is_visible(), "nobody else keeps it"
    assert others[0].layers() == ["Sad"], "what was kept, not what was done where it was not"
    assert others[0].undo_name() == "Undo what the other tab did"
    others[0].press("Control+z")
    assert others[0].layers() == ["Tired"]
    others[0].mood("proud")
    others[0].page.close()
    looks[1].wait_for(state="hidden")
    others[1].settle()
    assert others[1].layers() == ["Proud"]
    others[1].add("Posture")
    others[1].page.reload()
    others[1].settle()
    assert others[1].layers() == ["Proud", "Posture"]
    assert others[1].page.get_by_role("alert").count() == 0


@pytest.fixture
def small(tmp_path: Path) -> Iterator[Path]:
    """A disk of 400 kB."""
    place = tmp_path / "disk"
    place.mkdir()
    made = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=400k", "tmpfs", str(place)], capture_output=True, text=True
    )
    if made.returncode:
        pytest.skip(f"no small disk can be made here ({made.stderr.strip()})")
    yield place
    subprocess.run(["umount", "-l", str(place)], check=True)


@pytest.mark.skipif(os.name != "posix", reason="needs mount")
def test_a_full_disk(visit: Visit, small: Path, clips: Path) -> None:
    """A clip that does not fit is said not to, and neither is the work; what was kept stays."""
    server = Server(small / "studio")
    try:
        studio = visit(server)
        studio.expected += ("status of 500", "status of 422", "status of 507")
        studio.open(clips / "walk.bvh")
        studio.mood("sad")
        free = os.statvfs(small)
        (small / "full").write_bytes(b"x" * (free.f_bavail * free.f_frsize))
        studio.open(clips / "wave.bvh")
        alert = studio.page.get_by_role("alert").first
        assert re.search(r"wave\.bvh.*(full|No space left)", alert.inner_text())
        studio.mood("tired")
        assert studio.layers() == ["Tired"]
        assert "not saved" in studio.page.get_by_role("banner").inner_text()
        assert any("Not kept" in text for text in studio.page.get_by_role("alert").all_inner_texts())
        (small / "full").unlink()
        studio.mood("proud")
        assert "not saved" not in studio.page.get_by_role("banner").inner_text()
        server.kill()
        server.start()
        studio.go()
        assert studio.layers() == ["Proud"]
    finally:
        server.stop()


def test_a_slow_answer_is_overtaken(walking: Studio) -> None:
    """While an answer is on its way the page goes on; the last one asked is the one that is shown."""
    walking.mood("sad")
    held: list[Any] = []
    slow = True
    walking.page.route("**/api/edit", lambda route: held.append(route) if slow else route.continue_())
    walking.moods.get_by_role("button", name="excited", exact=True).click()
    walking.page.get_by_text("Working it out…").wait_for()
    walking.press("Space")
    walking.until("window.__viewer.playback.time > 0.1")
    walking.press("k", "Home")
    walking.moods.get_by_role("button", name="tired", exact=True).click()
    slow = False
    for route in held:
        route.continue_()
    walking.settle()
    assert len(held) == 1
    shown = walking.pixels()
    walking.press("Control+z", "Control+Shift+Z")
    walking.settle()
    assert walking.layers() == ["Tired"]
    assert walking.pixels() == shown


@pytest.mark.parametrize("dialog", ["?", "Control+e", "Control+k"])
def test_a_key_right_after_a_dialog(walking: Studio, dialog: str) -> None:
    """What is pressed in the moment in which Escape closes a dialog is done, whatever was open."""
    ghost = walking.page.get_by_role("radio", name="Ghost")
    for _ in range(4):
        before = ghost.is_checked()
        walking.press(dialog)
        walking.page.get_by_role("dialog").wait_for()
        walking.press("Escape", "g")
        walking.page.locator("dialog").wait_for(state="detached")
        assert ghost.is_checked() is not before
