"""``mien blend``: what it writes, says and refuses."""

import json
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import Result

import mien
from mien import samples

Run = Callable[..., Result]
TIRED = "deeper/tired_walk.bvh"


def test_it_writes_the_blend_and_what_was_blended(folder: Path, run: Run) -> None:
    result = run("blend", "walk.bvh", TIRED, "--weights", "0.25,0.75")
    assert (result.exit_code, result.stdout) == (0, "walk_blend.bvh\n")
    made = mien.load("walk_blend.bvh")
    want = mien.blend([mien.load("walk.bvh"), mien.load(TIRED)], [0.25, 0.75])
    np.testing.assert_allclose(made.rotations, want.rotations, atol=1e-5)
    record = tomllib.loads(Path("walk_blend.bvh.blend.toml").read_text())
    assert [clip["weight"] for clip in record["clips"]] == [0.25, 0.75]


def test_what_is_left_out_is_said_on_stderr(folder: Path, run: Run) -> None:
    mien.save(samples.walk(seconds=4.0, fps=30.0).motion, "long.bvh")
    result = run("blend", "walk.bvh", "long.bvh", "-o", "half.bvh")
    assert result.stdout == "half.bvh\n"
    assert "mien: note: long.bvh: frames 0 to 45 of 121 are in the blend" in result.stderr


def test_weights_are_equal_without_being_named_and_may_be_negative(folder: Path, run: Run) -> None:
    mien.save(samples.turn(seconds=1.5, fps=30.0).motion, "turn.bvh")
    run("blend", "walk.bvh", TIRED, "turn.bvh", "-o", "third.bvh")
    record = tomllib.loads(Path("third.bvh.blend.toml").read_text())
    assert [clip["weight"] for clip in record["clips"]] == pytest.approx([1 / 3] * 3)
    assert run("blend", "walk.bvh", TIRED, "--weights", "-0.3,1.3", "-o", "more.bvh").exit_code == 0


def test_bands(folder: Path, run: Run) -> None:
    bands = ["--low", "0,1", "--mid", "1,0", "--high", "1,0"]
    data = json.loads(run("blend", "walk.bvh", TIRED, *bands, "-o", "slumped.bvh", "--json").stdout)
    assert data["output"] == "slumped.bvh"
    assert [data["clips"][0][key] for key in ("weight", "low", "mid", "high")] == [1, 0, 1, 1]
    made = mien.load("slumped.bvh")
    assert (data["frames"], data["seconds"]) == (len(made), pytest.approx(made.duration, abs=1e-3))


def test_alignment_is_chosen(folder: Path, run: Run) -> None:
    for align in ("none", "dtw"):
        data = json.loads(run("blend", "walk.bvh", TIRED, "--align", align, "-f", "--json").stdout)
        assert data["align"] == align


def test_nothing_is_overwritten_or_written_without_being_told_to(folder: Path, run: Run) -> None:
    assert run("blend", "walk.bvh", TIRED, "--no-sidecar").exit_code == 0
    assert not Path("walk_blend.bvh.blend.toml").exists()
    again = run("blend", "walk.bvh", TIRED)
    assert again.exit_code == 2
    assert "walk_blend.bvh exists already" in again.stderr
    assert run("blend", "walk.bvh", TIRED, "--force").exit_code == 0


def test_dry_run_reads_and_writes_nothing(folder: Path, run: Run) -> None:
    Path("broken.bvh").write_text("nonsense")
    before = sorted(folder.rglob("*"))
    shown = run("blend", "walk.bvh", "broken.bvh", "--low", "0,1", "--dry-run")
    assert shown.exit_code == 0
    assert "-> walk_blend.bvh" in shown.stdout
    plan = json.loads(run("blend", "walk.bvh", "broken.bvh", "--low", "0,1", "-n", "--json").stdout)
    assert plan["clips"][1] == {"input": "broken.bvh", "weight": 0.5, "low": 1.0, "mid": 0.5, "high": 0.5}
    assert plan["exists"] is False
    assert sorted(folder.rglob("*")) == before


def test_into_a_folder(folder: Path, run: Run) -> None:
    assert run("blend", "walk.bvh", TIRED, "-o", "made").stdout == f"{Path('made') / 'walk_blend.bvh'}\n"
    assert (folder / "made" / "walk_blend.bvh").exists()


def test_a_blend_can_be_edited(folder: Path, run: Run) -> None:
    run("blend", "walk.bvh", TIRED, "-o", "half.bvh")
    assert run("edit", "half.bvh", "-e", "proud").exit_code == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["walk.bvh"], "two clips or more, got walk.bvh"),
        (["walk.bvh", "walk.bvh"], "two clips or more"),
        (["walk.bvh", TIRED, "--weights", "1,1"], "weights must sum to 1, but 1,1 sum to 2"),
        (["walk.bvh", TIRED, "--weights", "1"], "1 for 2 clips"),
        (["walk.bvh", TIRED, "--mid", "half,half"], "--mid needs one number for each clip"),
        (["walk.bvh", TIRED, "--low", "3,-2"], "weights of low must be from -1 to 2, got 3"),
        (["walk.bvh", TIRED, "--align", "dwt"], "did you mean 'dtw'"),
        (["walk.bvh", "tried.bvh"], "tried.bvh: there is no such file"),
        (["walk.bvh", TIRED, "-o", "-"], "written to a file"),
        (["walk.bvh", TIRED, "-o", "half.fbx"], ".bvh"),
        (["walk.bvh", TIRED, "-o", TIRED], "exists already"),
    ],
)
def test_what_does_not_fit_is_one_sentence(folder: Path, run: Run, arguments: list[str], words: str) -> None:
    before = sorted(folder.rglob("*"))
    result = run("blend", *arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert words in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1
    assert sorted(folder.rglob("*")) == before


def test_other_skeletons_are_refused_by_name(folder: Path, run: Run) -> None:
    Path("other.bvh").write_text(Path("walk.bvh").read_text().replace("JOINT Head\n", "JOINT Skull\n"))
    result = run("blend", "walk.bvh", "other.bvh")
    assert result.exit_code == 2
    assert "Head, Skull" in result.stderr
