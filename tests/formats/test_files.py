"""Files appear whole or not at all, and nothing is lost without asking."""

import os
import stat
from pathlib import Path

import numpy as np
import pytest

from mien.errors import FormatError
from mien.formats import files, load, save
from mien.motion import Motion, Skeleton

POINT = Motion(
    Skeleton(("a",), np.array([-1]), np.zeros((1, 3))), np.array([[[0, 0, 0, 1.0]]]), np.ones((1, 1, 3)), 0.1
)


def test_round_trip(tmp_path: Path) -> None:
    save(POINT, tmp_path / "a.bvh")
    again = load(str(tmp_path / "a.bvh"))
    assert again.name == "a"
    np.testing.assert_array_equal(again.translations, POINT.translations)


def test_an_unknown_suffix_lists_what_exists(tmp_path: Path) -> None:
    for action in (lambda p: load(p), lambda p: save(POINT, p)):
        with pytest.raises(FormatError, match=r"no format '.bvj'; did you mean '.bvh'\? \(known: .*\.bvh"):
            action(tmp_path / "walk.bvj")
    save(POINT, tmp_path / "LOUD.BVH")
    assert len(load(tmp_path / "LOUD.BVH")) == 1


def test_what_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="there is no such file"):
        load(tmp_path / "missing.bvh")
    (tmp_path / "folder.bvh").mkdir()
    with pytest.raises(FormatError, match="is a folder"):
        load(tmp_path / "folder.bvh")
    with pytest.raises(FormatError, match="cannot be read"):
        load("nul\0.bvh")


def test_an_existing_file_is_kept_unless_forced(tmp_path: Path) -> None:
    target = tmp_path / "a.bvh"
    target.write_text("precious")
    with pytest.raises(FormatError, match=r"exists already: .*--force.*force=True"):
        save(POINT, target)
    assert target.read_text() == "precious"
    save(POINT, target, force=True)
    assert len(load(target)) == 1


def test_what_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "folder.bvh").mkdir()
    with pytest.raises(FormatError, match="is a folder"):
        save(POINT, tmp_path / "folder.bvh", force=True)
    with pytest.raises(FormatError, match=r"there is no folder .*nowhere; make it first"):
        save(POINT, tmp_path / "nowhere" / "a.bvh")


def test_a_failure_leaves_the_old_file_and_no_scraps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "a.bvh"
    target.write_text("precious")

    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(FormatError, match=r"a.bvh: cannot be written .No space left"):
        save(POINT, target, force=True)
    assert target.read_text() == "precious"
    assert os.listdir(tmp_path) == ["a.bvh"]


def test_permissions_are_kept_or_the_usual_ones(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("")
    files.write(tmp_path / "new", b"x")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "plain").stat().st_mode
    (tmp_path / "new").chmod(0o640)
    files.write(tmp_path / "new", b"y")
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o640


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "real").write_bytes(b"old")
    (tmp_path / "link").symlink_to(tmp_path / "real")
    files.write(tmp_path / "link", b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_bytes() == b"new"


def test_an_interrupt_while_the_file_is_made_leaves_nothing(tmp_path: Path, monkeypatch) -> None:
    made = Path.open

    def interrupted(path: Path, mode: str = "r") -> None:
        made(path, mode).close()
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "open", interrupted)
    with pytest.raises(KeyboardInterrupt):
        files.write(tmp_path / "new", b"x")
    assert not list(tmp_path.iterdir())
    monkeypatch.undo()
    files.write(tmp_path / ("n" * 250), b"x")
    assert [path.stat().st_size for path in tmp_path.iterdir()] == [1]
