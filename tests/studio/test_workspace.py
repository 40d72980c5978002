"""The studio's folder: names are never paths, damage is survived, the token is kept and private."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.errors import FormatError
from mien.studio.workspace import Workspace, plain_name


@given(st.text(max_size=300))
def test_a_name_is_never_a_path(name: str) -> None:
    plain = plain_name(name)
    assert Path(plain).name == plain
    assert plain.endswith(".bvh")
    assert plain not in (".", "..", ".bvh")
    assert len(plain) < 130
    assert plain_name(plain) == plain


@pytest.mark.parametrize(
    ("name", "plain"),
    [
        ("walk.bvh", "walk.bvh"),
        ("../../etc/passwd", "passwd.bvh"),
        ("C:\\clips\\Walk.BVH", "Walk.bvh"),
        ("", "clip.bvh"),
        ("..", "clip.bvh"),
        ("Gang über.bvh", "Gang über.bvh"),
        ("a\x00b\n.bvh", "ab.bvh"),
    ],
)
def test_plain_names(name: str, plain: str) -> None:
    assert plain_name(name) == plain


def test_the_token_is_kept_and_private(tmp_path: Path) -> None:
    workspace = Workspace(tmp_path / "w")
    token = workspace.token()
    assert len(token) >= 32
    assert Workspace(tmp_path / "w").token() == token
    if os.name != "nt":
        assert (tmp_path / "w" / "token").stat().st_mode & 0o077 == 0


@pytest.mark.parametrize("identity", ["../token", "x" * 64, "", "A" * 64, "/etc/passwd"])
def test_what_is_no_id_is_no_path(tmp_path: Path, identity: str) -> None:
    with pytest.raises(FormatError):
        Workspace(tmp_path).path(identity)


@pytest.mark.parametrize("text", ["{", "[1]", '{"x": 1}', "\x00", "[" * 100_000])
def test_damaged_files_are_begun_anew(tmp_path: Path, text: str) -> None:
    workspace = Workspace(tmp_path)
    for name in ("clips.json", "project.json"):
        (tmp_path / name).write_text(text)
    assert workspace.names() == {}
    identity = workspace.keep("a.bvh", b"data")
    assert workspace.names() == {identity: "a.bvh"}
    workspace.forget(identity)
    assert not workspace.path(identity).exists()
