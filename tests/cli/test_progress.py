"""The bar: on a terminal only, on stderr only."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pty = pytest.importorskip("pty", reason="terminals of POSIX")


def edit_on_a_terminal(folder: Path, *clips: str) -> tuple[str, str]:
    """Return what was written to stdout (a pipe) and to stderr (a terminal)."""
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "mien", "edit", *clips, "-e", "sad", "--no-sidecar", "--force"]
    environment = {**os.environ, "TERM": "xterm-256color", "COLUMNS": "100"}
    child = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=theirs, env=environment)
    os.close(theirs)
    seen = b""
    while True:
        try:
            piece = os.read(ours, 4096)
        except OSError:  # how Linux says that the other end was closed
            break
        if not piece:
            break
        seen += piece
    os.close(ours)
    out, _ = child.communicate(timeout=60)
    assert child.returncode == 0
    return out.decode(), seen.decode()


def test_several_files_show_a_bar_on_stderr(folder: Path) -> None:
    out, terminal = edit_on_a_terminal(folder, "walk.bvh", "brisk.bvh")
    assert out == "walk_sad.bvh\nbrisk_sad.bvh\n"
    assert "editing" in terminal
    assert "%" in terminal


def test_one_file_shows_none(folder: Path) -> None:
    assert edit_on_a_terminal(folder, "walk.bvh") == ("walk_sad.bvh\n", "")
