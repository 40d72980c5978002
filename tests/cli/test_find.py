"""``mien find``: which clips it names, and what it refuses."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import Result

import mien
from mien.recipe import Step

Run = Callable[..., Result]


@pytest.fixture
def library(folder: Path) -> Path:
    """The clips, and two that hang their heads."""
    for name in ("walk", "brisk"):
        bent = mien.apply(mien.load(f"{name}.bvh"), [Step("posture", {"head": 25.0, "trunk": 20.0})])
        mien.save(bent, f"{name}_bent.bvh")
    return folder


def test_by_a_word(library: Path, run: Run) -> None:
    result = run("find", ".", "--like", "sad", "--neutral", "walk.bvh", "--top", "3", "--json")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert len(found) == 3
    assert "walk_bent.bvh" in [entry["file"] for entry in found[:2]]
    assert [entry["distance"] for entry in found] == sorted(entry["distance"] for entry in found)
    first = found[0]
    away = np.hypot(first["valence"] + 0.648, first["arousal"] + 0.267) + 1.0 - first["labels"]["sad"]
    assert first["distance"] == pytest.approx(away, abs=0.002)
    assert first["against"] == "neutral"


def test_a_table_for_a_person(library: Path, run: Run) -> None:
    lines = run("find", ".", "--like", "bored", "--top", "2").stdout.splitlines()
    assert lines[0].split() == ["distance", "valence", "arousal", "acted", "like", "clip"]
    assert len(lines) == 3
    assert lines[1].endswith(".bvh")
    assert "a guess" in lines[1]


def test_by_a_place(library: Path, run: Run) -> None:
    found = json.loads(run("find", ".", "--valence", -0.5, "--arousal", -0.5, "--json").stdout)
    assert len(found) == 5
    for entry in found:
        away = np.hypot(entry["valence"] + 0.5, entry["arousal"] + 0.5) + 1.0 - entry["placed"]
        assert entry["distance"] == pytest.approx(away, abs=0.002)


def test_by_a_clip(library: Path, run: Run) -> None:
    """Two bent clips are like each other; the clip itself is not named."""
    arguments = ["--like", "walk_bent.bvh", "--neutral", "walk.bvh", "--json", "--jobs", "1"]
    found = json.loads(run("find", ".", *arguments).stdout)
    names = [entry["file"] for entry in found]
    assert "walk_bent.bvh" not in names
    assert len(names) == 4
    bent, plain = names.index("brisk_bent.bvh"), names.index("brisk.bvh")
    assert bent < plain
    shared = run("find", ".", *arguments[:-1], "2")
    assert json.loads(shared.stdout) == found


def test_an_edited_clip_beside_its_source(library: Path, run: Run) -> None:
    """By a word it is read against its source; by a clip all are read alike."""
    run("edit", "walk.bvh", "-e", "sad", "-o", "new/walk_sad.bvh")
    by_word = json.loads(run("find", ".", "--like", "sad", "--json").stdout)
    against = {entry["file"]: entry["against"] for entry in by_word}
    assert against["new/walk_sad.bvh"] == "neutral"
    assert against["walk.bvh"] == "usual"
    by_clip = json.loads(run("find", ".", "--like", "walk.bvh", "--json").stdout)
    assert {entry["against"] for entry in by_clip} == {"usual"}


def test_a_neutral_clip_is_read_once(library: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from mien import batch

    read: list[str] = []
    load = batch.load

    def counted(path: Path, **options: object) -> mien.Motion:
        read.append(str(path))
        return load(path, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(batch, "load", counted)
    arguments = ["--like", "sad", "--jobs", "1", "--json"]
    run("find", "brisk.bvh", "deeper", "brisk_bent.bvh", "--neutral", "walk.bvh", *arguments)
    assert read.count("walk.bvh") <= 1 + 1  # once before any work, to refuse what cannot be used
    run("edit", "walk.bvh", "-e", "sad", "-o", "walk.bvh", "--force")
    before = len(read)
    run("find", "brisk.bvh", "--neutral", "walk.bvh", *arguments)
    assert "walk.bvh" in read[before:], "a file that has changed is read again"


def test_a_clip_that_fails_does_not_stop_the_others(library: Path, run: Run) -> None:
    Path("bad.bvh").write_text("rubbish")
    result = run("find", ".", "--like", "sad", "--json")
    assert result.exit_code == 1
    assert len(json.loads(result.stdout)) == 5
    assert "mien: bad.bvh" in result.stderr
    example = run("find", ".", "--like", "bad.bvh")
    assert (example.exit_code, example.stdout) == (2, "")
    assert example.stderr.startswith("mien: bad.bvh")
    only = run("find", "bad.bvh", "--like", "sad", "--json")
    assert (only.exit_code, json.loads(only.stdout)) == (2, [])


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "say what to find"),
        (["--like", "sad", "--valence", "0"], "not both"),
        (["--valence", "0.5"], "needs both numbers"),
        (["--like", "sadd"], "did you mean 'sad'?"),
        (["--like", "wolk.bvh"], "did you mean walk.bvh?"),
        (["--like", "sad", "--neutral", "none.bvh"], "none.bvh: there is no such file"),
        (["--like", "sad", "--model", "none.json"], "none.json: cannot be read as a model"),
        (["--like", "sad", "--top", "0"], "--top"),
        (["--valence", "2", "--arousal", "0"], "--valence"),
    ],
)
def test_what_it_refuses(folder: Path, run: Run, arguments: list[str], said: str) -> None:
    result = run("find", ".", *arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert said in result.stderr


def test_nothing_but_the_clip_itself(folder: Path, run: Run) -> None:
    result = run("find", "walk.bvh", "--like", "walk.bvh")
    assert result.exit_code == 2
    assert "nothing but walk.bvh" in result.stderr


def test_names_of_files_are_never_broken(library: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """However narrow the terminal is: they are to be copied."""
    monkeypatch.setenv("COLUMNS", "40")
    long = "a" * 120 + ".bvh"
    Path("walk.bvh").rename(long)
    lines = run("find", long, "brisk.bvh", "--like", "sad").stdout.splitlines()
    assert sorted(line.split()[-1] for line in lines[1:]) == sorted([long, "brisk.bvh"])
