"""A clip whose joints a person names has a body from then on, wherever it is used."""

import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from starlette.testclient import TestClient

import mien
from mien.formats import bvh
from mien.kinematics.body import Body, read_map
from mien.motion import Motion
from mien.studio.naming import own_roles
from mien.studio.session import Session
from mien.studio.workspace import Workspace

Nameless = tuple[Motion, dict[str, str]]
SAD = {"layers": [{"id": "a", "kind": "emotion", "name": "sad"}]}
MIXED = {
    "layers": [*SAD["layers"], {"id": "b", "kind": "edit", "name": "posture", "parameters": {"arms": 9}}]
}


@pytest.fixture
def unnamed(client: TestClient, nameless: Nameless) -> str:
    """The id of a clip in which no body is found."""
    data = bvh.render(nameless[0])
    return client.post("/api/clips", params={"name": "nameless.bvh"}, content=data).json()["id"]


@pytest.fixture
def named(client: TestClient, unnamed: str, nameless: Nameless) -> str:
    """The id of the same clip, its joints named."""
    answer = client.post(f"/api/clips/{unnamed}/roles", json={"roles": nameless[1]})
    assert (answer.status_code, answer.json()["problem"], answer.json()["roles"]) == (200, "", nameless[1])
    return unnamed


def test_what_is_to_be_chosen(client: TestClient, unnamed: str, clip: str) -> None:
    info = client.get(f"/api/clips/{unnamed}/joints").json()
    assert [info["joints"][0], len(info["joints"]), info["depths"][:6]] == ["j00", 22, [0, 1, 2, 3, 4, 5]]
    left = [(r["role"], r["needed"]) for r in info["roles"] if r["group"] == "left"]
    needed = [True, True, True, True, True, False, False, False]
    assert [need for _, need in left] == needed, "those that are needed come first"
    assert {r["joint"] for r in info["roles"]} == {""}
    known = client.get(f"/api/clips/{clip}/joints").json()
    assert {"left_knee": "LeftLeg", "neck": "Neck"}.items() <= {
        r["role"]: r["joint"] for r in known["roles"]
    }.items()


def test_a_named_clip_is_edited_read_and_checked(
    client: TestClient, named: str, nameless: Nameless, decode: Callable
) -> None:
    head, _ = decode(client.get(f"/api/clips/{named}/motion").content)
    joints = head["joints"]
    assert {role: joints[joint] for role, joint in head["shape"]["roles"].items()} == nameless[1]
    message = {"clip": named, "stack": SAD}
    head, _ = decode(client.post("/api/edit", json=message).content)
    assert "posture" in head["steps"]
    assert client.post("/api/reading", json=message).json()["reached"] is not None
    assert client.post("/api/checks", json=message).json()["checks"]
    curves = client.post("/api/curves", json=message | {"names": ["hand speed"]}).json()
    assert max(curves[0]["before"]) > 0.2
    picture = message | {"kind": "png", "options": {"width": 300, "poses": 2}}
    assert client.post("/api/export", json=picture).content.startswith(b"\x89PNG")


@pytest.mark.parametrize("stack", [SAD, MIXED])
def test_export_command_and_python_give_the_same_bytes(
    client: TestClient, named: str, nameless: Nameless, tmp_path: Path, stack: dict
) -> None:
    exported = client.post("/api/export", json={"clip": named, "stack": stack, "kind": "bvh"}).content
    copied = client.post("/api/copied", json={"clip": named, "stack": stack}).json()
    for name in ("command", "python"):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "nameless.bvh").write_bytes(bvh.render(nameless[0]))
        if name == "python":
            subprocess.run([sys.executable, "-c", copied["python"]], cwd=folder, check=True)
        else:
            line = copied["command"].replace("mien edit", f"{sys.executable} -m mien edit")
            subprocess.run(["bash", "-euc", line], cwd=folder, check=True)
        assert (folder / "nameless_edited.bvh").read_bytes() == exported, name
    sidecar = (tmp_path / "command" / "nameless_edited.bvh.recipe.toml").read_text()
    assert tomllib.loads(sidecar)["provenance"]["roles"] == nameless[1]


def test_recipe_and_map_as_files_do_it_again(
    client: TestClient, named: str, nameless: Nameless, tmp_path: Path
) -> None:
    message = {"clip": named, "stack": MIXED}
    exported = client.post("/api/export", json=message | {"kind": "bvh"}).content
    (tmp_path / "nameless.bvh").write_bytes(bvh.render(nameless[0]))
    for kind, file in (("recipe", "nameless_edited.toml"), ("map", "nameless_map.toml")):
        made = client.post("/api/export", json=message | {"kind": kind})
        assert file in made.headers["content-disposition"]
        (tmp_path / file).write_bytes(made.content)
    assert read_map(tmp_path / "nameless_map.toml") == nameless[1]
    command = [sys.executable, "-m", "mien", "edit", "nameless.bvh", "--recipe", "nameless_edited.toml"]
    subprocess.run([*command, "-o", "again.bvh"], cwd=tmp_path, check=True)
    assert (tmp_path / "again.bvh").read_bytes() == exported
    subprocess.run([*command, "--map", "nameless_map.toml", "-o", "map.bvh"], cwd=tmp_path, check=True)
    assert (tmp_path / "map.bvh").read_bytes() == exported


def test_names_are_there_after_a_restart_and_when_a_clip_comes_back(
    client: TestClient, named: str, workspace: Workspace, nameless: Nameless
) -> None:
    assert Session(workspace).clip(named).info().roles == nameless[1]
    client.delete(f"/api/clips/{named}")
    data = bvh.render(nameless[0])
    again = client.post("/api/clips", params={"name": "nameless.bvh"}, content=data).json()
    assert (again["problem"], again["roles"]) == ("", nameless[1])


def test_another_clip_of_the_skeleton_is_named_alike(
    client: TestClient, named: str, nameless: Nameless, rope: Motion
) -> None:
    edited = client.post("/api/export", json={"clip": named, "stack": SAD, "kind": "bvh"}).content
    other = client.post("/api/clips", params={"name": "other.bvh"}, content=edited).json()
    assert other["id"] != named
    assert (other["problem"], other["roles"]) == ("", nameless[1])
    none = client.post("/api/clips", params={"name": "rope.bvh"}, content=bvh.render(rope)).json()
    assert none["roles"] == {}
    assert "not found in this skeleton of 3 joints" in none["problem"]


def test_a_project_file_brings_them(client: TestClient, unnamed: str, nameless: Nameless) -> None:
    kept = {"id": unnamed, "name": "nameless.bvh", "stack": SAD, "roles": nameless[1]}
    project = {"clips": [kept], "current": unnamed, "view": {}, "mien_project": 1}
    assert client.post("/api/project/open", json=project).status_code == 200
    assert client.get("/api/clips").json()[0]["roles"] == nameless[1]
    wrong = project | {"clips": [kept | {"roles": {"nose": "j01"}}]}
    answer = client.post("/api/project/open", json=wrong)
    assert (answer.status_code, "'nose'" in answer.json()["error"]) == (422, True)
    assert client.get("/api/clips").json()[0]["roles"] == nameless[1]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"left_knee": ""}, "choose a joint for left knee: no body is without"),
        ({"left_knee": "", "hips": ""}, "choose a joint for hips and left knee: no body is without"),
        ({"left_knee": "j19"}, "left_knee and right_knee are both the joint 'j19'"),
        ({"left_knee": "j99"}, "'j99'"),
        ({"nose": "j01"}, "'nose'"),
        ({"left_toe": "j21", "right_toe": "j17"}, "left_toe ('j21') does not hang below left_ankle"),
    ],
)
def test_what_cannot_be_is_one_sentence_and_changes_nothing(
    client: TestClient, unnamed: str, nameless: Nameless, change: dict, said: str
) -> None:
    answer = client.post(f"/api/clips/{unnamed}/roles", json={"roles": nameless[1] | change})
    assert answer.status_code == 422
    assert said in answer.json()["error"]
    assert "\n" not in answer.json()["error"]
    assert client.get("/api/clips").json()[0]["roles"] == {}


def test_an_edit_made_before_is_made_anew(client: TestClient, clip: str) -> None:
    """Of a clip whose body was found, but wrongly."""
    message = {"clip": clip, "stack": MIXED, "kind": "bvh"}
    before = client.post("/api/export", json=message).content
    found = {r["role"]: r["joint"] for r in client.get(f"/api/clips/{clip}/joints").json()["roles"]}
    info = client.post(
        f"/api/clips/{clip}/roles", json={"roles": found | {"neck": "", "head": "Neck"}}
    ).json()
    assert (info["roles"]["neck"], info["roles"]["head"]) == ("", "Neck")
    after = client.post("/api/export", json=message).content
    assert after != before
    back = client.post(f"/api/clips/{clip}/roles", json={"roles": {}}).json()
    assert back["roles"] == {}
    assert client.post("/api/export", json=message).content == before


def test_what_is_found_anyway_is_not_kept() -> None:
    motion = mien.samples.walk(seconds=1.0).motion
    found = {role: motion.skeleton.names[joint] for role, joint in Body.of(motion).roles.items()}
    assert own_roles(motion, found) == {}
