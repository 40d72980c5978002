"""``mien learn``: labels from names and tables, places, the card, and what it refuses."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import Result

import mien
from mien import samples
from mien.emotion.model import load_model
from mien.recipe import Step

Run = Callable[..., Result]
STYLES = {
    "calm": [],
    "sad": [Step("posture", {"head": 20.0, "trunk": 12.0})],
    "big": [Step("posture", {"arms": 15.0, "elbows": 20.0})],
}
CONTENTS = {"walk": samples.walk, "wave": samples.wave, "knock": samples.knock}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("takes")
    for content, make in CONTENTS.items():
        for label, steps in STYLES.items():
            motion = mien.apply(make(seconds=2.0, fps=30.0).motion, steps)
            mien.save(motion, folder / f"{content}_{label}.bvh")
    return folder


@pytest.fixture
def takes(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    import shutil

    shutil.copytree(made, tmp_path / "work" / "takes")
    monkeypatch.chdir(tmp_path / "work")
    return Path("takes")


def learn(run: Run, *more: object) -> Result:
    return run("learn", "emotion", "takes", "--neutral", "calm", "--place", "big=excited", *more)


def test_learn_and_read(takes: Path, run: Run) -> None:
    result = learn(run, "-o", "models/own.json", "--source", "our takes", "--licence", "ours")
    assert (result.exit_code, result.stderr) == (0, "")
    lines = result.stdout.splitlines()
    assert lines[-1] == "models/own.json"
    assert lines[:2] == ["9 takes of knock, walk, wave", "labels: big, neutral, sad"]
    assert any(line.startswith("takes whose label is the likeliest") for line in lines)
    assert "guessing a label would be right in 0.33" in lines
    model = load_model("models/own.json")
    assert (model.card["source"], model.card["licence"]) == ("our takes", "ours")
    assert model.card["labels"] == ["big", "neutral", "sad"]
    assert model.card["contents"] == ["knock", "walk", "wave"]
    assert model.places["big"] == pytest.approx((0.618, 0.757))
    read = run(
        "analyze", "takes/walk_sad.bvh", "--neutral", "takes/walk_calm.bvh", "--model", "models/own.json"
    )
    assert "acted like: sad" in read.stdout


def test_the_card_as_json(takes: Path, run: Run) -> None:
    data = json.loads(learn(run, "--json").stdout)
    assert data["model"] == "model.json"
    assert data["takes"] == 9
    assert data["scores on contents left out"]["chance"] == pytest.approx(0.333)
    again = learn(run)
    assert again.exit_code == 2
    assert "--force" in again.stderr


def test_labels_from_a_table(takes: Path, run: Run) -> None:
    """The longest way that fits a clip is its own; clips and lines without a label are left out."""
    (takes / "other").mkdir()
    (takes / "walk_sad.bvh").rename(takes / "other" / "walk_calm.bvh")
    rows = [
        "file,label,content",
        "other/walk_calm.bvh,sad,walk",
        "walk_calm.bvh,calm,walk",
        "wave_big.bvh,,wave",
    ]
    for content in ("wave", "knock"):
        rows += [f"{content}_{label}.bvh,{label},{content}" for label in ("calm", "sad")]
    rows += ["walk_big.bvh,big,walk", "knock_big.bvh,big,knock", ",sad,walk"]
    Path("labels.csv").write_text("\n".join(rows) + "\n")
    data = json.loads(learn(run, "--labels", "labels.csv", "--json").stdout)
    assert data["takes"] == 8
    assert data["labels"] == ["big", "neutral", "sad"]


def test_labels_are_renamed_before_the_neutral_one_is_told(takes: Path, run: Run) -> None:
    arguments = ["--rename", "calm=still", "--rename", "sad=tired", "--neutral", "still", "--json"]
    data = json.loads(run("learn", "emotion", "takes", "--place", "big=0.6,0.7", *arguments).stdout)
    assert data["labels"] == ["big", "neutral", "tired"]


def test_a_clip_that_cannot_be_used_is_told(takes: Path, run: Run) -> None:
    (takes / "jump_sad.bvh").write_text("rubbish")
    (takes / "rod_sad.bvh").write_text(
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
        "End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n"
    )
    result = learn(run)
    assert result.exit_code == 1
    assert "mien: takes/jump_sad.bvh" in result.stderr
    assert "mien: takes/rod_sad.bvh" in result.stderr
    assert "9 of 11 clips learned from, 2 failed" in result.stderr
    assert load_model("model.json").card["takes"] == 9


def test_the_same_clips_teach_the_same_bytes(takes: Path, process: Callable[..., Any]) -> None:
    """Whatever order Python's sets are in, which another process changes."""
    for name in ("one", "two"):
        arguments = ["--neutral", "calm", "--rename", "big=excited", "-o", f"{name}.json"]
        assert process("learn", "emotion", "takes", *arguments).returncode == 0
    assert Path("one.json").read_bytes() == Path("two.json").read_bytes()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--labels", "(?P<label"], "is no pattern"),
        (["--labels", "[a-z]+"], "must say where the label is"),
        (["--labels", "(?P<label>[0-9]+)"], "says nothing about any of the 9 clips"),
        (["--labels", "none.csv"], "there is no such file"),
        (["--labels", "bytes.csv"], "is no table of text"),
        (["--labels", "columns.csv"], "needs a first line with the columns"),
        (["--rename", "sad"], "write OLD=NEW"),
        (["--rename", "sat=tired"], "did you mean 'sad'?"),
        (["--place", "bigg=excited"], "did you mean 'big'?"),
        (["--place", "big=exited"], "did you mean 'excited'?"),
        (["--place", "big=nan,0"], "a place is two numbers"),
        (["--place", "big=1,2,3"], "a place is two numbers"),
        (["--neutral", "rest"], "no clip is labelled 'rest'"),
    ],
)
def test_what_it_refuses(takes: Path, run: Run, arguments: list[str], said: str) -> None:
    Path("bytes.csv").write_bytes(b"file,label\n\xff\xfe,sad\n")
    Path("columns.csv").write_text("name,emotion\nwalk_sad.bvh,sad\n")
    result = learn(run, *arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert said in result.stderr
    assert not Path("model.json").exists()


def test_what_it_cannot_learn(takes: Path, run: Run) -> None:
    assert "there is no thing to learn 'style'" in run("learn", "style", "takes").stderr
    unplaced = run("learn", "emotion", "takes", "--neutral", "calm")
    assert unplaced.exit_code == 2
    assert "--place LABEL=VALENCE,AROUSAL" in unplaced.stderr
    one = run("learn", "emotion", "takes/walk*", "--neutral", "calm", "--place", "big=excited")
    assert one.exit_code == 2
    assert "two or more contents" in one.stderr


def test_too_little_is_told_before_a_clip_is_read(takes: Path, run: Run) -> None:
    """And what was found in the names, as the pattern may be the slip."""
    for file in takes.iterdir():
        file.write_text("rubbish")
    pattern = "(?P<content>.+)_(?P<label>.+)"
    missing = run("learn", "emotion", "takes", "--labels", pattern)
    assert missing.exit_code == 2
    assert missing.stderr == "mien: --neutral: no clip is labelled 'neutral' (labels found: big, calm, sad)\n"
    swapped = run(
        "learn", "emotion", "takes", "--labels", "(?P<label>.+)_(?P<content>.+)", "--neutral", "walk"
    )
    assert "no place yet: knock, wave" in swapped.stderr
    for name in ("wave_calm.bvh", "knock_calm.bvh"):
        (takes / name).unlink()
    one = learn(run)
    assert "mien: note: left out, as there is no neutral take: knock, wave" in one.stderr
    assert (
        "two or more contents with a neutral take and takes of labels with a place; there is walk"
        in one.stderr
    )
    (takes / "walk_sad.bvh").unlink()
    none = learn(run)
    assert "contents with one: walk; without one: knock, wave; labels: big, neutral, sad" in none.stderr
