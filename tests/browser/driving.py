"""A studio in a process of its own, and hands, eyes and a screen reader on its page."""

import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from mien.motion import Motion

# Requests that were begun and whose answers were not read to their end yet.
COUNT_REQUESTS = """(() => {
  const ask = window.fetch.bind(window);
  window.__asked = 0;
  window.fetch = async (...given) => {
    window.__asked += 1;
    try {
      const answer = await ask(...given);
      await answer.clone().arrayBuffer();
      return answer;
    } finally {
      window.__asked -= 1;
    }
  };
})()"""
# A hand that drops files onto the page.
DROP = """([name, text]) => {
  const carried = new DataTransfer();
  carried.items.add(new File([text], name));
  for (const type of ["dragover", "drop"])
    document.querySelector("main").dispatchEvent(
      new DragEvent(type, { dataTransfer: carried, bubbles: true, cancelable: true }));
}"""
# A number for what the viewport shows.
PIXELS = """(() => {
  window.__viewer.draw();
  const gl = window.__viewer.canvas.getContext("webgl2");
  const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return new Uint32Array(pixels.buffer).reduce((sum, one) => Math.imul(sum, 31) + one | 0, 7);
})()"""
PIXEL = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b550000000a49444154789c63"
    "680000008200818dfd2f0f0000000049454e44ae426082"
)
PNG = "image/png"
V = "window.__viewer"


class Server:
    """A studio that runs, can be killed, and can be started again at its address."""

    def __init__(self, folder: Path, *clips: Path) -> None:
        self.folder, self.port, self.complaints = folder, free_port(), ""
        self.start(*clips)

    def start(self, *clips: Path) -> None:
        command = [sys.executable, "-m", "mien", "studio", "--no-browser", "--port", str(self.port)]
        command += ["--workspace", str(self.folder), *map(str, clips)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert self.process.stdout
        self.address = self.process.stdout.readline().strip()
        assert self.address.startswith("http://127.0.0.1:"), self.stop()

    @property
    def base(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    def kill(self) -> None:
        """End it as a crash would."""
        self.process.send_signal(signal.SIGKILL)
        self.stop()

    def stop(self) -> str:
        """End it; returns what it said on the side."""
        self.process.terminate()
        self.complaints += self.process.communicate(timeout=30)[1]
        return self.complaints

    def forget(self) -> None:
        """Make the workspace as new, for the next test; only the key stays."""
        for name in ("clips.json", "project.json", "roles.json"):
            (self.folder / name).unlink(missing_ok=True)
        shutil.rmtree(self.folder / "clips", ignore_errors=True)


def free_port() -> int:
    with socket.socket() as asked:
        asked.bind(("127.0.0.1", 0))
        return int(asked.getsockname()[1])


class Studio:
    """The studio's page. What is used is found by role and name, as a screen reader finds it."""

    def __init__(self, context: Any, server: Server, query: str = "", *, pictures: bool = False) -> None:
        self.server = server
        self.wrong: list[str] = []
        self.asked: list[str] = []
        self.expected: tuple[str, ...] = ("ReadPixels",)  # the software renderer is slow at this, and says so
        context.add_init_script(COUNT_REQUESTS)
        if not pictures:  # making pictures of presets takes longer than most tests
            context.route("**/api/presets/*.png", lambda route: route.fulfill(body=PIXEL, content_type=PNG))
        self.page = context.new_page()
        self.page.set_default_timeout(20_000)
        self.page.on("console", self._heard)
        self.page.on("pageerror", lambda error: self.wrong.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("websocket", lambda socket: self.asked.append(socket.url))
        self.go(query)

    def _heard(self, message: Any) -> None:
        if message.type in ("error", "warning"):
            self.wrong.append(f"{message.text} {message.location.get('url', '')}")

    def go(self, query: str = "") -> None:
        """Open the address that was printed."""
        self.page.goto(self.server.address.replace("/#", f"/?quality=low{query}#"))
        self.settle()

    def problems(self) -> list[str]:
        """Return what went wrong on the page, and what it asked of others than its server."""
        outside = [
            url for url in self.asked if not url.startswith((f"{self.server.base}/", "blob:", "data:"))
        ]
        wrong = [text for text in self.wrong if not any(words in text for words in self.expected)]
        return wrong + outside

    # What is there.

    def button(self, name: str | re.Pattern[str], **options: Any) -> Any:
        return self.page.get_by_role("button", name=name, exact=isinstance(name, str), **options)

    def slider(self, name: str) -> Any:
        return self.page.get_by_role("slider", name=name, exact=True)

    def typed(self, name: str) -> Any:
        return self.page.get_by_role("spinbutton", name=name, exact=True)

    def part(self, name: str) -> Any:
        """Return a region of the page."""
        return self.page.get_by_role("region", name=name, exact=True)

    @property
    def moods(self) -> Any:
        return self.page.get_by_role("complementary", name="Library")

    @property
    def rows(self) -> Any:
        """The layers."""
        return self.page.get_by_role("list", name=re.compile("^Layers")).get_by_role("listitem")

    def layers(self) -> list[str]:
        """Return what the layers are called, in their order."""
        return [row.get_by_role("button").nth(1).inner_text().split("\n")[0] for row in self.rows.all()]

    def messages(self) -> str:
        return str(self.part("Messages").inner_text())

    def tab(self, name: str) -> None:
        self.page.get_by_role("tab", name=re.compile(f"^{name}")).click()

    def undo_name(self) -> str:
        return str(self.button(re.compile("^Undo")).get_attribute("aria-label"))

    # What is done.

    def open(self, *files: Path) -> None:
        """Choose files in the chooser."""
        with self.page.expect_file_chooser() as chooser:
            self.button(re.compile("^Drop .bvh files here")).click()
        chooser.value.set_files(list(files))
        self.settle()

    def drop(self, file: Path) -> None:
        self.page.evaluate(DROP, [file.name, file.read_text(encoding="utf-8")])
        self.settle()

    def mood(self, name: str) -> None:
        self.moods.get_by_role("button", name=name, exact=True).click()
        self.settle()

    def add(self, layer: str) -> None:
        """Add a layer, by the name of its edit or mood."""
        self.add_only(layer)
        self.settle()

    def add_only(self, layer: str) -> None:
        """Add a layer and do not wait for what it does."""
        self.page.get_by_role("combobox", name="Add a layer").select_option(label=layer)

    def type(self, name: str, text: str) -> None:
        """Type a value into a field and take it."""
        self.type_only(name, text)
        self.settle()

    def type_only(self, name: str, text: str) -> None:
        """Type a value and do not wait for what it does."""
        field = self.typed(name)
        field.fill(text)
        field.press("Enter")

    def press(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)

    def close_dialog(self) -> None:
        self.press("Escape")
        self.page.locator("dialog").wait_for(state="detached")

    def drag(self, start: tuple[float, float], *ways: tuple[float, float]) -> None:
        x, y = start
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        for right, down in ways:
            x, y = x + right, y + down
            self.page.mouse.move(x, y)
        self.page.mouse.up()

    def export(self, kind: str = "Motion (BVH)") -> bytes:
        """Export by the dialog; returns the bytes of the file."""
        self.button("Export").click()
        dialog = self.page.get_by_role("dialog")
        dialog.get_by_role("radio", name=kind).check()
        with self.page.expect_download(timeout=60_000) as given:
            dialog.get_by_role("button", name="Export", exact=True).click()
        dialog.wait_for(state="hidden")
        self.settle()
        return Path(given.value.path()).read_bytes()

    # When it is done.

    def until(self, what: str, *, seconds: float = 20.0) -> None:
        """Wait for something to become true; the page's policy forbids what Playwright has for that."""
        end = time.monotonic() + seconds
        while not self.page.evaluate(what):
            assert time.monotonic() < end, f"never became true: {what}"
            self.page.wait_for_timeout(20)

    def settle(self, *, seconds: float = 60.0) -> None:
        """Wait until every answer is there, what is shown is drawn and the work is kept."""
        end, quiet = time.monotonic() + seconds, 0
        while quiet < 3:
            busy = self.page.evaluate(
                "window.__asked > 0"
                " || /(Opening|Working it out|Waiting for mien|saving)…/.test(document.body.innerText)"
            )
            quiet = 0 if busy else quiet + 1
            assert time.monotonic() < end, f"it never settled: {self.page.locator('body').inner_text()}"
            self.page.wait_for_timeout(15)

    def rest(self, *, seconds: float = 3.0) -> None:
        """Wait until the work is kept: what a page sends as it goes would come into the next test."""
        end = time.monotonic() + seconds
        saving = "/saving…/.test(document.body.innerText)"
        while not self.page.is_closed() and self.page.evaluate(saving) and time.monotonic() < end:
            self.page.wait_for_timeout(20)

    def colours(self) -> int:
        return int(self.page.evaluate(f"{V}.colours()"))

    def pixels(self) -> str:
        """Return a number for the picture in the viewport: the same picture, the same number."""
        return str(self.page.evaluate(PIXELS))

    def playback(self, field: str) -> Any:
        return self.page.evaluate(f"{V}.playback.{field}")


def middle(locator: Any) -> tuple[float, float]:
    locator.scroll_into_view_if_needed()
    box = locator.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def thumb(slider: Any) -> tuple[float, float]:
    """Return where the thumb of a slider is."""
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    low, high, now = slider.evaluate("one => [one.min, one.max, one.value].map(Number)")
    return box["x"] + 6 + (box["width"] - 12) * (now - low) / (high - low), box["y"] + box["height"] / 2


def grown(motion: Motion, joints: int) -> Motion:
    """Return a motion with joints that turn hung on hands and arms, as twist bones and fingers are."""
    skeleton = motion.skeleton
    hosts = [n for n, name in enumerate(skeleton.names) if re.search("Arm|Hand", name)]
    names, parents, offsets = list(skeleton.names), list(skeleton.parents), list(skeleton.offsets)
    for number in range(joints - len(names)):
        host = hosts[number % len(hosts)]
        names.append(f"{skeleton.names[host]}Twist{number}")
        parents.append(host)
        offsets.append(np.array([0.01 * number, 1.0, 0.5]))
    made = type(skeleton)(tuple(names), np.array(parents), np.array(offsets))
    more = joints - len(skeleton)
    angle = 0.2 * np.sin(np.linspace(0.0, 12.0, len(motion)))[:, None] * np.ones(more)
    turned = np.stack([np.sin(angle), 0 * angle, 0 * angle, np.cos(angle)], axis=-1)
    rotations = np.concatenate([motion.rotations, turned], axis=1)
    places = np.broadcast_to(made.offsets[len(skeleton) :], (len(motion), more, 3))
    translations = np.concatenate([motion.translations, places], axis=1)
    return Motion(made, rotations, translations, motion.frame_time, name=motion.name)


def numbers(bvh: bytes) -> np.ndarray:
    """Return the channels (T, C) of a BVH file as they are written, by a reader of its own."""
    lines = bvh.decode().split("Frame Time:")[1].splitlines()[1:]
    return np.array([[float(word) for word in line.split()] for line in lines if line.strip()])


def columns(bvh: bytes) -> list[str]:
    """Return the joint that each channel of a BVH file belongs to."""
    found: list[str] = []
    name = ""
    for line in bvh.decode().split("MOTION")[0].splitlines():
        words = line.split()
        if words[:1] in (["ROOT"], ["JOINT"]):
            name = words[1]
        if words[:1] == ["CHANNELS"]:
            found += [name] * int(words[1])
    return found


def told(violations: Iterable[Any]) -> list[str]:
    """Return what axe found, a line for each place."""
    return [
        f"{rule['id']}: {node['html']:.200} {node.get('failureSummary')}"
        for rule in violations
        for node in rule["nodes"]
    ]
