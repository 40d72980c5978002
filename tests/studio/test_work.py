"""How far work is can be asked while it is done, and work that nobody waits for ends."""

import json
import subprocess
import sys
import time
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import closing
from http.client import HTTPConnection
from pathlib import Path
from threading import Event, Thread
from typing import Any
from urllib.parse import urlsplit

import pytest
from starlette.testclient import TestClient

from mien.errors import MienError
from mien.formats import bvh
from mien.samples import walk
from mien.studio.messages import EditRequest, Stack, WorkInfo
from mien.studio.session import Session, SupersededError
from mien.studio.work import StoppedError, Works

SAD = {"layers": [{"id": "a", "kind": "emotion", "name": "sad"}]}


def test_work_is_told_until_it_ends() -> None:
    works = Works()
    with works.begun("page", "edit") as tell, works.begun("other", "edit"):
        (waiting,) = works.of("page")
        assert (waiting.what, waiting.share) == ("waiting for the work before it", None)
        tell("posture", 0.25)
        with works.begun("page", "export"):
            first, second = works.of("page")
        assert (first.kind, first.what, first.share) == ("edit", "posture", 0.25)
        assert (second.kind, second.what) == ("export", "waiting for the work before it")
        assert first.seconds >= 0.0
        assert works.of("page") == [WorkInfo("edit", "posture", 0.25, works.of("page")[0].seconds)]
    assert works.of("page") == works.of("other") == []


def test_work_that_fails_or_that_nobody_waits_for_ends() -> None:
    works, gone = Works(), Event()
    with pytest.raises(MienError, match="no"), works.begun("page", "edit"):
        raise MienError("no")
    with works.begun("page", "export", gone=gone) as tell:
        tell("drawing", 0.0)
        gone.set()
        with pytest.raises(StoppedError):
            tell("drawing", 0.1)
    assert works.of("page") == []


def test_a_newer_request_ends_the_work_of_an_older_one(session: Session) -> None:
    def newer() -> None:
        with session.turn(EditRequest("x", Stack(), client="page", turn=2), "edit"):
            done.append("newer")

    done: list[str] = []
    with session.turn(EditRequest("x", Stack(), client="page", turn=1), "edit") as tell:
        tell("posture", 0.1)
        thread = Thread(target=newer)
        thread.start()
        until(lambda: len(session.works.of("page")) == 2)
        with pytest.raises(SupersededError):
            tell("timing", 0.2)
        assert done == []
    thread.join(10.0)
    assert done == ["newer"]


def test_an_edit_says_what_it_does(client: TestClient, clip: str, session: Session) -> None:
    told: list[tuple[str, float | None]] = []
    after = session.edited(clip, stack(), progress=lambda what, share: told.append((what, share)))
    shares = [share for _, share in told if share is not None]
    assert shares == sorted(shares)
    assert (shares[0], max(shares) < 1.0) == (0.0, True)
    steps = [step.edit for step in after.history if step.edit not in ("repair", "restore")]
    assert [what for what, _ in told][: len(steps)] == steps
    assert "checking" in [what for what, _ in told]
    assert client.get("/api/progress", params={"client": "nobody"}).json() == []


def stack() -> Stack:
    from pydantic import TypeAdapter

    return TypeAdapter(Stack).validate_python(SAD)


@pytest.fixture
def running(tmp_path: Path) -> Iterator[Callable[..., Any]]:
    """Ask a studio that runs in a process of its own, as its page does; what is not read is closed."""
    (tmp_path / "walk.bvh").write_bytes(bvh.render(walk(seconds=20.0, fps=30.0).motion))
    command = [sys.executable, "-m", "mien", "studio", "walk.bvh", "--no-browser", "--workspace", "w"]
    child = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    try:
        base, token = child.stdout.readline().strip().split("/#token=")
        header = {"Authorization": f"Bearer {token}", "Content-Type": "application/json"}

        def ask(path: str, message: dict | None = None) -> Any:
            if message is None:
                with urllib.request.urlopen(
                    urllib.request.Request(f"{base}/api/{path}", headers=header), timeout=30
                ) as answer:
                    return json.load(answer)
            line = HTTPConnection(urlsplit(base).netloc, timeout=120)
            line.request("POST", f"/api/{path}", json.dumps(message), header)
            return line

        yield ask
    finally:
        child.kill()
        child.communicate()


def until(true: Callable[[], bool], seconds: float = 30.0) -> None:
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end, "it never became true"
        time.sleep(0.02)


def test_a_film_ends_when_nobody_waits_for_it(running: Callable[..., Any]) -> None:
    clip = running("hello")["clips"][0]["id"]
    message = {"clip": clip, "stack": {"layers": []}, "kind": "gif", "client": "page"}
    line = running("export", message | {"options": {"height": 480}})
    shares: list[float] = []

    def drawing() -> bool:
        shares.extend(w["share"] for w in running("progress?client=page") if w["what"] == "drawing")
        return len(set(shares)) >= 3

    until(drawing)
    assert shares == sorted(shares)
    assert max(shares) < 0.5, "it is far from its end, so that it does not end by itself"
    assert running("progress?client=other") == []
    line.close()
    until(lambda: running("progress?client=page") == [], seconds=5.0)
    with closing(running("export", message | {"kind": "bvh"})) as again:
        assert again.getresponse().read().startswith(b"HIERARCHY"), "and the next one is made"
