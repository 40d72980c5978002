"""The server: edits are those of Python, strangers are refused, every failure is a sentence."""

import json
import subprocess
import sys
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from starlette.testclient import TestClient

import mien
from mien.emotion.model import shipped_model
from mien.formats import bvh
from mien.kinematics.parts import PARTS
from mien.motion import Motion
from mien.samples import walk
from mien.studio import server
from mien.studio.messages import EditRequest, Stack
from mien.studio.session import Session, SupersededError

SAD = {"layers": [{"id": "a", "kind": "emotion", "name": "sad"}]}
MIXED = {
    "layers": [
        {"id": "a", "kind": "emotion", "name": "sad", "strength": [[0, 0], [1.5, 1]], "parts": ["arms"]},
        {"id": "b", "kind": "edit", "name": "posture", "parameters": {"head": 12.5}, "span": [0.2, 1.4]},
        {"id": "c", "kind": "place", "name": "recipe", "parameters": {"valence": 0.3, "arousal": 0.4}},
    ],
    "strength": 0.8,
    "safe": False,
}


def test_what_the_page_needs_to_begin(client: TestClient, clip: str) -> None:
    answer = client.get("/api/hello")
    assert answer.status_code == 200, answer.text
    hello = answer.json()
    assert [c["id"] for c in hello["clips"]] == [clip]
    assert {p["name"] for p in hello["presets"]} == set(mien.PRESETS)
    assert {name: tuple(of) for name, of in hello["parts"].items()} == PARTS
    model = shipped_model()
    assert {w["name"]: (w["valence"], w["arousal"]) for w in hello["learned"]} == model.places
    posture = next(e for e in hello["edits"] if e["name"] == "posture")
    head = next(p for p in posture["parameters"] if p["name"] == "head")
    assert (head["kind"], head["unit"], head["neutral"]) == ("number", "degrees", 0.0)
    assert head["low"] < 0 < head["high"]


def test_an_edit_is_that_of_python(client: TestClient, clip: str, decode: Callable) -> None:
    motion = walk(seconds=2.5).motion
    source = bvh.parse(bvh.render(motion), "walk.bvh", fps=None, salvage=False)
    for live in (True, False):
        answer = client.post("/api/edit", json={"clip": clip, "stack": SAD, "live": live})
        head, arrays = decode(answer.content)
        want = mien.edit(source, "sad", safe=not live)
        assert np.array_equal(arrays["rotations"], want.rotations.astype("<f4"))
        assert head["steps"] == [step.edit for step in want.history]
        assert head["seconds"] > 0


def test_the_original_comes_as_it_is(client: TestClient, clip: str, decode: Callable) -> None:
    head, arrays = decode(client.get(f"/api/clips/{clip}/motion").content)
    assert head["frames"] == 151
    assert arrays["rotations"].shape == (151, 22, 4)


@pytest.mark.parametrize("stack", [SAD, MIXED, {"layers": [SAD["layers"][0] | {"strength": 0.7}]}])
def test_export_command_and_python_give_the_same_bytes(
    client: TestClient, clip: str, tmp_path: Path, stack: dict
) -> None:
    exported = client.post("/api/export", json={"clip": clip, "stack": stack, "kind": "bvh"})
    assert "walk_edited.bvh" in exported.headers["content-disposition"]
    copied = client.post("/api/copied", json={"clip": clip, "stack": stack}).json()
    data = bvh.render(walk(seconds=2.5).motion)
    for name in ("command", "python"):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "walk.bvh").write_bytes(data)
        if name == "python":
            subprocess.run([sys.executable, "-c", copied["python"]], cwd=folder, check=True)
        else:
            line = copied["command"].replace("mien edit", f"{sys.executable} -m mien edit")
            subprocess.run(["bash", "-euc", line], cwd=folder, check=True)
        assert (folder / "walk_edited.bvh").read_bytes() == exported.content, name


def test_the_exported_recipe_makes_the_same_motion(client: TestClient, clip: str, tmp_path: Path) -> None:
    text = client.post("/api/export", json={"clip": clip, "stack": MIXED, "kind": "recipe"}).text
    (tmp_path / "r.toml").write_text(text)
    source = bvh.parse(bvh.render(walk(seconds=2.5).motion), "walk.bvh", fps=None, salvage=False)
    after = mien.edit(source, tmp_path / "r.toml")
    exported = client.post("/api/export", json={"clip": clip, "stack": MIXED, "kind": "bvh"}).content
    assert bvh.render(after) == exported


def test_pictures_can_be_had(client: TestClient, clip: str) -> None:
    options = {"width": 400, "poses": 2}
    message = {"clip": clip, "stack": SAD, "kind": "png", "options": options}
    assert client.post("/api/export", json=message).content.startswith(b"\x89PNG")
    assert client.get("/api/presets/sad.png").content.startswith(b"\x89PNG")
    assert client.get("/api/presets/s0/sad.png").content.startswith(b"\x89PNG")
    wrong = client.post("/api/export", json=message | {"options": {"width": 1e9}})
    assert (wrong.status_code, "width must be" in wrong.json()["error"]) == (422, True)


def test_pictures_of_presets_have_a_clear_ground(client: TestClient, session: Session) -> None:
    """Only the figure and its shadow are there, whole, and they are made once."""
    kept = session.workspace.folder / "pictures"
    for name in ("sad", "s0/sad"):
        picture = Image.open(BytesIO(client.get(f"/api/presets/{name}.png").content))
        assert picture.mode == "RGBA"
        colour, cover = np.split(np.asarray(picture, float), [3], axis=2)
        assert not cover[[0, -1]].any(), "nothing is cut off above and below"
        assert not cover[:, [0, -1]].any(), "nor at the sides"
        assert 0.1 < (cover == 255).mean() < 0.4
        limbs = colour[cover[..., 0] == 255]
        assert (limbs[:, 2] - limbs[:, 0] > 60).sum() > 200, "a blue side"
        assert (limbs[:, 0] - limbs[:, 2] > 60).sum() > 200, "and an orange one"
    files = {path: path.stat().st_mtime_ns for path in kept.iterdir()}
    client.get("/api/presets/sad.png")
    assert {path: path.stat().st_mtime_ns for path in kept.iterdir()} == files


def test_reading_checks_and_curves(client: TestClient, clip: str) -> None:
    readings = client.post("/api/reading", json={"clip": clip, "stack": SAD}).json()
    assert readings["asked"]["word"] == "sad"
    assert readings["reached"]["place"]["valence"] < 0
    alone = client.post("/api/reading", json={"clip": clip, "stack": {}}).json()
    assert alone["asked"] is None
    assert alone["reached"] is None
    checks = client.post("/api/checks", json={"clip": clip, "stack": SAD}).json()
    report = mien.check(mien.edit(walk(seconds=2.5).motion, "sad"))
    assert [c["name"] for c in checks["checks"]] == [f.check.name for f in report.findings]
    assert checks["passed"]
    names = ["hips height", "hand speed", "joint:Head", "arousal"]
    curves = client.post("/api/curves", json={"clip": clip, "stack": SAD, "names": names}).json()
    assert [c["name"] for c in curves] == names
    height = curves[0]
    assert len(height["before"]) == len(height["before_times"]) == 151
    assert len(height["after"]) == len(height["after_times"]) > 151, "a sad walk takes longer"
    assert 80 < np.mean(height["before"]) < 110


def test_a_clip_without_a_body_can_be_looked_at(client: TestClient, rope: Motion) -> None:
    data = bvh.render(rope)
    info = client.post("/api/clips", params={"name": "rope.bvh"}, content=data).json()
    assert info["problem"]
    assert client.get(f"/api/clips/{info['id']}/motion").status_code == 200
    failed = client.post("/api/edit", json={"clip": info["id"], "stack": SAD})
    assert failed.status_code == 422
    assert failed.json()["error"]


def test_a_broken_file_is_a_sentence_and_leaves_nothing(client: TestClient, session: Session) -> None:
    failed = client.post("/api/clips", params={"name": "../../x.bvh"}, content=b"rubbish")
    assert failed.status_code == 422
    assert failed.json()["error"].startswith("x.bvh: not a BVH file")
    assert session.workspace.names() == {}
    assert not list((session.workspace.folder / "clips").iterdir())


def test_what_is_open_and_the_project_are_there_after_a_restart(
    client: TestClient, clip: str, session: Session
) -> None:
    assert client.get("/api/project").json() is None
    project = {"clips": [{"id": clip, "name": "walk.bvh", "stack": SAD}], "current": clip, "view": {"t": 1}}
    assert client.put("/api/project", json=project).status_code == 200
    again = Session(session.workspace)
    assert [info.name for info in again.infos()] == ["walk.bvh"]
    kept = client.get("/api/project").json()
    assert kept["view"] == {"t": 1}
    assert kept["clips"][0]["stack"]["layers"][0]["name"] == "sad"
    opened = client.post("/api/project/open", content=json.dumps(kept).encode())
    assert opened.json() == kept
    assert "no project file" in client.post("/api/project/open", content=b"[1]").json()["error"]
    client.delete(f"/api/clips/{clip}")
    assert client.get("/api/clips").json() == []


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({"Authorization": ""}, 401),
        ({"Authorization": "Bearer wrong"}, 401),
        ({"Authorization": "Bearer é".encode()}, 401),
        ({"Host": "evil.example:8765"}, 421),
        ({"Host": "127.0.0.1:9999"}, 421),
        ({"Origin": "http://evil.example"}, 403),
        ({"Origin": "null"}, 403),
        ({"Sec-Fetch-Site": "cross-site"}, 403),
        ({"Origin": "http://localhost:8765", "Host": "localhost:8765"}, 200),
    ],
)
def test_strangers_are_refused(client: TestClient, headers: dict, status: int) -> None:
    answer = client.get("/api/hello", headers=headers)
    assert answer.status_code == status
    assert "default-src 'none'" in answer.headers["content-security-policy"]
    if status != 200:
        assert answer.json()["error"]


@pytest.mark.parametrize("path", ["/../token", "/%2e%2e/token", "/..%2ftoken", "/static/../../server.py"])
def test_nothing_beside_the_page_is_served(client: TestClient, path: str) -> None:
    answer = client.get(path)
    assert answer.status_code in (404, 503)


def test_messages_that_are_too_long_or_do_not_fit(client: TestClient, clip: str) -> None:
    long = client.post("/api/edit", content=b" " * (5 * 2**20), headers={"Content-Type": "application/json"})
    assert long.status_code == 413

    def endless():
        yield b"{}"

    assert client.post("/api/edit", content=endless()).status_code == 411
    for stack in ({"layers": 3}, {"layers": [{"id": "a"}]}, {"strength": "much"}, 7):
        answer = client.post("/api/edit", json={"clip": clip, "stack": stack})
        assert answer.status_code == 422
        assert "does not fit" in answer.json()["error"]
    assert client.post("/api/edit", json={"clip": "0" * 64, "stack": SAD}).status_code == 422
    assert (
        client.post("/api/clips", content=b"x" * 10, headers={"Content-Length": "9999999999"}).status_code
        == 413
    )


def test_newer_requests_of_a_page_count(session: Session) -> None:
    newer = EditRequest("x", Stack(), client="page", turn=5)
    older = EditRequest("x", Stack(), client="page", turn=4)
    with session.turn(newer, "edit"):
        pass
    with pytest.raises(SupersededError), session.turn(older, "edit"):
        pass
    with session.turn(older, "checks"), pytest.raises(AssertionError):
        raise AssertionError("other kinds and pages are not touched")
    with session.turn(EditRequest("x", Stack(), client="other", turn=1), "edit"):
        pass


def test_without_the_built_page_it_says_how_to_build_it(
    session: Session, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(server, "STATIC", tmp_path)
    app = server.make_app(session, token="t", hosts=frozenset({"testserver"}))
    answer = TestClient(app).get("/")
    assert answer.status_code == 503
    assert "npm ci" in answer.text


def test_the_command_serves_and_ends(tmp_path: Path) -> None:
    import signal
    import urllib.request

    data = bvh.render(walk(seconds=1.0).motion)
    (tmp_path / "walk.bvh").write_bytes(data)
    command = [sys.executable, "-m", "mien", "studio", "walk.bvh", "--no-browser", "--workspace", "w"]
    child = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        address = child.stdout.readline().strip()
        base, token = address.split("/#token=")
        request = urllib.request.Request(f"{base}/api/hello", headers={"Authorization": f"Bearer {token}"})
        with urllib.request.urlopen(request, timeout=30) as answer:
            assert [c["name"] for c in json.load(answer)["clips"]] == ["walk.bvh"]
        child.send_signal(signal.SIGINT)
        _, said = child.communicate(timeout=30)
    finally:
        child.kill()
    assert child.returncode in (0, 130)
    assert "Traceback" not in said


def test_the_page_is_answered_while_an_edit_is_worked_out(
    client: TestClient, clip: str, session: Session
) -> None:
    with session.alone():
        assert client.get("/api/hello").json()["clips"][0]["id"] == clip
        assert client.get(f"/api/clips/{clip}/motion").status_code == 200
        assert client.post("/api/samples/wave").json()["name"] == "wave.bvh"
