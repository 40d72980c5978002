"""``mien check``."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import Result

import mien
from mien.analysis.checks.report import CHECKS
from mien.recipe import Step

Run = Callable[..., Result]


@pytest.fixture
def broken(folder: Path) -> Path:
    """A walk that drifts aside by 20 cm a second; nothing beside it tells of its source."""
    walk = mien.load("walk.bvh")
    moved = np.array(walk.translations)
    moved[:, 0, 0] += 20.0 * walk.times
    mien.save(walk.with_(translations=moved, source=None), "drift.bvh")
    return Path("drift.bvh")


def test_a_clip_by_itself(folder: Path, run: Run) -> None:
    result = run("check", "walk.bvh")
    assert result.exit_code == 0
    assert "walk.bvh, by itself: all checks passed" in result.stdout
    assert all(f"\n{name} " in result.stdout for name, c in CHECKS.items() if not c.needs_source)
    assert "content" not in result.stdout


def test_against_a_source(broken: Path, run: Run) -> None:
    result = run("check", broken, "--against", "walk.bvh")
    assert result.exit_code == 0, "without --strict a failed check is an answer, no error"
    assert "against its source: 1 of 12 checks failed" in result.stdout
    assert "foot_slide  " in result.stdout
    assert "!!" in result.stdout
    assert "foot_slide: " in result.stdout.split("FAILED")[1]
    assert run("check", broken, "--against", "walk.bvh", "--strict").exit_code == 4
    assert run("check", "walk.bvh", "--strict").exit_code == 0


def test_the_source_is_found_by_the_recipe_beside_the_clip(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "-e", "sad").exit_code == 0
    assert "walk_sad.bvh, against its source" in run("check", "walk_sad.bvh").stdout
    Path("walk.bvh").write_bytes(Path("brisk.bvh").read_bytes())
    result = run("check", "walk_sad.bvh")
    assert "walk_sad.bvh, by itself" in result.stdout
    assert "judged by itself, by wide limits: the clip it was made from was not found" in result.stderr


def test_the_source_goes_through_the_same_changes_of_time(folder: Path, run: Run) -> None:
    walk = mien.load("walk.bvh")
    made = mien.apply(
        walk, [Step("trim", {"start": 0.4}), Step("posture", {"head": 10.0}), Step("foot_plant")]
    )
    flags = ["--trim-start", 0.4, "--posture-head", 10]
    assert run("edit", "walk.bvh", *flags).exit_code == 0
    data = json.loads(run("check", "walk_edited.bvh", "--json").stdout)[0]
    assert data["against"] is True
    wanted = mien.check(made)
    for found, check in zip(data["checks"], wanted.findings, strict=True):
        assert found["value"] == pytest.approx(check.value, rel=1e-3, abs=1e-3)


def test_json_holds_every_check(broken: Path, run: Run) -> None:
    data = json.loads(run("check", broken, "walk.bvh", "--json", "--against", "walk.bvh").stdout)
    assert [d["file"] for d in data] == ["drift.bvh", "walk.bvh"]
    assert [d["passed"] for d in data] == [False, True]
    slide = data[0]["checks"][0]
    assert slide["check"] == "foot_slide"
    assert slide["value"] > slide["allowed"]
    assert slide["marks"][0]["end"] > slide["marks"][0]["start"]
    assert "skating frames" in slide["facts"]


def test_a_mistyped_check_is_answered_with_the_nearest(folder: Path, run: Run) -> None:
    result = run("check", "walk.bvh", "--only", "colision")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "there is no check 'colision'; did you mean 'collision'?" in result.stderr


def test_a_bad_clip_does_not_stop_the_others(folder: Path, run: Run) -> None:
    Path("bad.bvh").write_text("HIERARCHY\n")
    result = run("check", "bad.bvh", "walk.bvh", "--only", "bones")
    assert result.exit_code == 1
    assert "bad.bvh" in result.stderr
    assert "walk.bvh, by itself: all checks passed" in result.stdout
    assert run("check", "bad.bvh").exit_code == 2
