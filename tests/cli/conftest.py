"""Clips to work on, and two ways to run the command line: in this process and in one of its own."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

import mien
from mien import samples
from mien.cli.app import app


@pytest.fixture(scope="session")
def clips(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with ``walk.bvh``, ``brisk.bvh`` and ``deeper/tired_walk.bvh``; read only."""
    folder = tmp_path_factory.mktemp("clips")
    (folder / "deeper").mkdir()
    mien.save(samples.walk(seconds=1.5, fps=30.0).motion, folder / "walk.bvh")
    mien.save(samples.walk(seconds=1.5, cadence=2.2, heading=0.7, fps=30.0).motion, folder / "brisk.bvh")
    mien.save(samples.tired_walk(seconds=1.5, fps=30.0).motion, folder / "deeper" / "tired_walk.bvh")
    return folder


@pytest.fixture
def folder(clips: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An own copy of the clips, which is the current folder."""
    import shutil

    shutil.copytree(clips, tmp_path / "work")
    monkeypatch.chdir(tmp_path / "work")
    return tmp_path / "work"


@pytest.fixture
def run() -> Callable[..., Result]:
    """Run the command line in this process."""

    def go(*arguments: object) -> Result:
        return CliRunner(env={"COLUMNS": "200"}).invoke(app, [str(a) for a in arguments])

    return go


@pytest.fixture
def process() -> Callable[..., "subprocess.CompletedProcess[str]"]:
    """Run ``python -m mien`` in a process of its own."""

    def go(*arguments: object, cwd: Path | None = None) -> "subprocess.CompletedProcess[str]":
        command = [sys.executable, "-m", "mien", *map(str, arguments)]
        return subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=120, env=os.environ)

    return go
