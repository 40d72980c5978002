import hashlib
import json
import os
import re
import tomllib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import Result

import mien
from mien.emotion.files import read_recipe, write_recipe
from mien.recipe import Recipe, Step

Run = Callable[..., Result]


def files(folder: Path) -> set[str]:
    return {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}


def test_an_emotion_is_written_beside_the_clip(folder: Path, run: Run) -> None:
    source = (folder / "walk.bvh").read_bytes()
    result = run("edit", "walk.bvh", "--emotion", "sad")
    assert (result.exit_code, result.stdout, result.stderr) == (0, "walk_sad.bvh\n", "")
    assert (folder / "walk.bvh").read_bytes() == source
    before, after = mien.load("walk.bvh"), mien.load("walk_sad.bvh")
    assert after.skeleton.names == before.skeleton.names
    assert len(after) == pytest.approx(len(before) / 0.8, abs=1)  # at the tempo of sad
    assert after.frame_time == before.frame_time
    same = mien.edit(before, "sad")
    closeness = np.abs(np.einsum("tji,tji->tj", after.rotations, same.rotations))
    assert closeness.min() > 1 - 1e-9, "the command line and Python do the same"


def test_the_sidecar_says_what_was_done_and_replays_to_the_same_bytes(folder: Path, run: Run) -> None:
    flags = ["--strength", 0.7, "--parts", "arms,head", "--span", "0.2,1.1", "--posture-head", 12]
    assert run("edit", "walk.bvh", "-e", "sad", *flags).exit_code == 0
    made = Path("walk_sad_0.7_arms-head_0.2-1.1s.bvh")
    sidecar = made.with_name(f"{made.name}.recipe.toml")
    about = tomllib.loads(sidecar.read_text())["provenance"]
    assert about == {
        "input": "walk.bvh",
        "input_sha256": hashlib.sha256(Path("walk.bvh").read_bytes()).hexdigest(),
        "output": made.name,
        "mien": mien.__version__,
    }
    recipe = read_recipe(sidecar)
    posture = next(step for step in recipe.steps if step.edit == "posture")
    assert posture.parameters["head"] == 12
    assert (posture.strength, posture.parts, posture.span) == (0.7, ("arms", "head"), (0.2, 1.1))
    assert run("edit", "walk.bvh", "--recipe", sidecar, "-o", "again.bvh").exit_code == 0
    assert Path("again.bvh").read_bytes() == made.read_bytes()


def test_numbers_that_change_over_time(folder: Path, run: Run) -> None:
    result = run("edit", "walk.bvh", "-e", "sad", "--strength", "0:0,1.2:1", "--posture-head", "0:0,1:25")
    assert result.stdout == "walk_sad_0-1.bvh\n"
    steps = read_recipe("walk_sad_0-1.bvh.recipe.toml").steps
    posture = next(step for step in steps if step.edit == "posture")
    assert posture.strength == ((0.0, 0.0), (1.2, 1.0))
    assert posture.parameters["head"] == ((0.0, 0.0), (1.0, 25.0))
    assert run("edit", "walk.bvh", "-r", "walk_sad_0-1.bvh.recipe.toml", "-o", "again.bvh").exit_code == 0
    assert Path("again.bvh").read_bytes() == Path("walk_sad_0-1.bvh").read_bytes()
    shown = run("edit", "walk.bvh", "--posture-head", "0:0,1:25", "--strength", "0:1,1:0.5", "-n").stdout
    assert "posture head=0:0,1:25; strength 0:1,1:0.5" in shown


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--strength", "0:0,1"], "--strength must be a number, or times with their values"),
        (["--strength", "0:0,1:3"], "--strength must be from 0 to 2, got 3"),
        (["--posture-head", "down"], "--posture-head must be a number, or times with their values"),
        (["--posture-head", "1:0,1:5"], "--posture-head: the times of its keys must go up"),
        (["--resample-fps", "0:30,1:60"], "resample: fps cannot change over time"),
    ],
)
def test_curves_that_are_none(folder: Path, run: Run, flags: list[str], message: str) -> None:
    result = run("edit", "walk.bvh", "-e", "sad", *flags)
    assert (result.exit_code, result.stdout) == (2, "")
    assert message in result.stderr
    assert len(result.stderr.splitlines()) == 1


def test_flags_of_edits_make_a_clip_of_their_own(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "--posture-head", -20, "--no-foot-plant", "--no-sidecar").exit_code == 0
    before, after = mien.load("walk.bvh"), mien.load("walk_edited.bvh")
    assert turned(before, after) == {"Neck", "Head"}
    assert not Path("walk_edited.bvh.recipe.toml").exists()


def test_time_edits_and_switches(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "--trim-start", 0.5, "--resample-fps", 60, "--mirror").exit_code == 0
    after = mien.load("walk_edited.bvh")
    assert after.fps == pytest.approx(60)
    assert after.duration == pytest.approx(1.0, abs=1 / 30)
    steps = [s.edit for s in read_recipe("walk_edited.bvh.recipe.toml").steps]
    assert steps == ["trim", "resample", "mirror"]


def test_a_recipe_file_and_a_pose_file(folder: Path, run: Run) -> None:
    write_recipe(Recipe("mine", (Step("posture", {"trunk": 10.0}),)), folder / "mine.json")
    assert run("edit", "walk.bvh", "-r", "mine.json").stdout == "walk_mine.bvh\n"
    assert [s.edit for s in read_recipe("walk_mine.bvh.recipe.toml").steps] == ["posture"]
    assert run("pose", "walk.bvh", "deeper/tired_walk.bvh", "-o", "tired.toml").stdout == "tired.toml\n"
    assert run("edit", "walk.bvh", "--posture-pose", "tired.toml").exit_code == 0
    posture = read_recipe("walk_edited.bvh.recipe.toml").steps[0]
    assert "head" in posture.parameters["pose"], "the recipe holds the pose, not the name of a file"


def test_keys_in_a_line_or_a_file_that_names_pose_files(folder: Path, run: Run) -> None:
    assert run("pose", "walk.bvh", "deeper/tired_walk.bvh", "-o", "tired.toml").exit_code == 0
    Path("keys.toml").write_text(
        '[[keys]]\ntime = 0.5\npose = "tired.toml"\n[[keys]]\ntime = 1\npose = "none"\n', encoding="utf-8"
    )
    assert run("edit", "walk.bvh", "--displacement-keys", "keys.toml", "-o", "file.bvh").exit_code == 0
    keys = read_recipe("file.bvh.recipe.toml").steps[0].parameters["keys"]
    assert keys.startswith("0.5 hips "), "the recipe holds the keys, not the name of a file"
    assert keys.endswith(" | 1.0 none")
    assert run("edit", "walk.bvh", "--displacement-keys", keys, "-o", "line.bvh").exit_code == 0
    assert Path("line.bvh").read_bytes() == Path("file.bvh").read_bytes()


@pytest.mark.parametrize("jobs", [1, 2])
def test_folders_and_patterns_to_a_folder(folder: Path, run: Run, jobs: int) -> None:
    result = run("edit", ".", "-e", "tired", "-o", "out", "--jobs", jobs, "--no-sidecar")
    assert result.exit_code == 0
    assert files(folder / "out") == {"walk_tired.bvh", "brisk_tired.bvh", "deeper/tired_walk_tired.bvh"}
    assert run("edit", "*.bvh", "-e", "tired", "-o", "out2", "--no-sidecar").exit_code == 0
    for name in ("walk_tired.bvh", "brisk_tired.bvh"):
        assert (folder / "out" / name).read_bytes() == (folder / "out2" / name).read_bytes()


def test_dry_run_says_what_would_be_done_and_writes_nothing(folder: Path, run: Run) -> None:
    before = files(folder)
    result = run("edit", "*.bvh", "-e", "sad", "--posture-head", 7, "-o", "out", "--dry-run")
    assert result.exit_code == 0
    assert f"walk.bvh -> {Path('out/walk_sad.bvh')}" in result.stdout
    assert "posture head=7.0" in result.stdout
    data = json.loads(run("edit", "*.bvh", "-e", "sad", "-n", "--json").stdout)
    assert [f["input"] for f in data["files"]] == ["brisk.bvh", "walk.bvh"]
    assert data["steps"][-1]["edit"] == "foot_plant"
    assert files(folder) == before


def test_json_has_one_entry_a_clip(folder: Path, run: Run) -> None:
    (folder / "bad.bvh").write_text("HIERARCHY\nROOT Hips\n")
    result = run("edit", "*.bvh", "-e", "sad", "--json")
    assert result.exit_code == 1
    entries = {entry["input"]: entry for entry in json.loads(result.stdout)}
    assert "error" in entries["bad.bvh"]
    walk = entries["walk.bvh"]
    assert walk["output"] == "walk_sad.bvh"
    assert walk["frames"] == 57  # at the tempo of sad, 0.8
    assert walk["seconds"] == pytest.approx(1.5 / 0.8, abs=0.02)
    assert walk["steps"][-1] == "foot_plant"


def test_strength_zero_gives_the_clip_back(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "-e", "angry", "--strength", 0).exit_code == 0
    assert Path("walk_angry_0.bvh").read_bytes() == Path("walk.bvh").read_bytes()
    assert read_recipe("walk_angry_0.bvh.recipe.toml").steps == ()


def test_the_rate_in_the_header_can_be_overridden(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "--mirror", "--fps", 120).exit_code == 0
    assert mien.load("walk_edited.bvh").fps == pytest.approx(120)
    assert tomllib.loads(Path("walk_edited.bvh.recipe.toml").read_text())["provenance"]["fps"] == 120


def turned(before: mien.Motion, after: mien.Motion) -> set[str]:
    """Return the joints that the edit turns by more than a tenth of a degree."""
    cosine = np.abs(np.einsum("tji,tji->tj", before.rotations, after.rotations)).min(axis=0)
    return {before.skeleton.names[j] for j in np.flatnonzero(cosine < np.cos(np.radians(0.05)))}


def test_a_map_file_tells_edits_which_joint_is_which(folder: Path, run: Run) -> None:
    """With the chest a joint lower, the bend of the trunk is shared by two joints instead of three."""
    Path("map.toml").write_text('[roles]\nchest = "Spine1"\n')
    bend = ["edit", "walk.bvh", "--posture-trunk", 20, "--no-foot-plant"]
    assert run(*bend, "-o", "plain.bvh").exit_code == 0
    assert run(*bend, "-o", "mapped.bvh", "--map", "map.toml").exit_code == 0
    before, trunk = mien.load("walk.bvh"), {"Spine", "Spine1", "Chest"}
    assert turned(before, mien.load("plain.bvh")) & trunk == trunk
    assert turned(before, mien.load("mapped.bvh")) & trunk == {"Spine", "Spine1"}
    about = tomllib.loads(Path("mapped.bvh.recipe.toml").read_text())["provenance"]
    assert about["roles"] == {"chest": "Spine1"}


def test_an_existing_output_is_refused_and_force_replaces_it(folder: Path, run: Run) -> None:
    Path("walk_sad.bvh").write_text("mine")
    result = run("edit", "walk.bvh", "-e", "sad")
    assert result.exit_code == 2
    assert result.stderr.startswith("mien: walk_sad.bvh exists already: give another name, or allow")
    assert Path("walk_sad.bvh").read_text() == "mine"
    assert run("edit", "walk.bvh", "-e", "sad", "--force").exit_code == 0
    assert len(mien.load("walk_sad.bvh")) == 57


def test_the_input_is_refused_as_output_but_may_be_replaced_by_force(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "--mirror", "-o", "walk.bvh").exit_code == 2
    original = mien.load("walk.bvh")
    assert run("edit", "walk.bvh", "--mirror", "-o", "walk.bvh", "--force").exit_code == 0
    assert not np.allclose(mien.load("walk.bvh").rotations, original.rotations)


def test_an_existing_sidecar_is_refused_before_anything_is_written(folder: Path, run: Run) -> None:
    Path("walk_sad.bvh.recipe.toml").write_text("mine")
    assert run("edit", "walk.bvh", "-e", "sad").exit_code == 2
    assert not Path("walk_sad.bvh").exists()


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_may_not_be_written(folder: Path, run: Run) -> None:
    Path("closed").mkdir(mode=0o500)
    result = run("edit", "walk.bvh", "-e", "sad", "-o", "closed")
    assert result.exit_code == 2
    assert "closed" in result.stderr


def test_nothing_half_written_is_left_behind(folder: Path, run: Run) -> None:
    before = files(folder)
    assert run("edit", "*.bvh", "-e", "sad", "--no-sidecar").exit_code == 0
    assert files(folder) - before == {"walk_sad.bvh", "brisk_sad.bvh"}, "no temporary file stays"


def replayed(run: Run, made: str, *flags: object) -> bytes:
    """Return the clip that the recipe beside ``made`` makes of the walk again."""
    result = run("edit", "walk.bvh", "-r", f"{made}.recipe.toml", "-o", "again.bvh", "--force", *flags)
    assert result.exit_code == 0, result.stderr
    return Path("again.bvh").read_bytes()


def test_a_sidecar_replays_with_the_rate_that_was_given(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "-e", "sad", "--fps", 40, "-o", "made.bvh").exit_code == 0
    made = Path("made.bvh").read_bytes()
    assert replayed(run, "made.bvh") == made
    assert replayed(run, "made.bvh", "--fps", 30) != made, "flags go before what the sidecar says"
    assert mien.load("again.bvh").fps == pytest.approx(30)


def test_a_sidecar_replays_with_the_map_that_was_given(folder: Path, run: Run) -> None:
    Path("map.toml").write_text('[roles]\nchest = "Spine1"\n')
    Path("other.toml").write_text('[roles]\nchest = "Chest"\n')
    assert run("edit", "walk.bvh", "-e", "sad", "--map", "map.toml", "-o", "made.bvh").exit_code == 0
    made = Path("made.bvh").read_bytes()
    Path("map.toml").unlink()
    assert replayed(run, "made.bvh") == made
    assert replayed(run, "made.bvh", "--map", "other.toml") != made


def test_a_sidecar_replays_what_was_salvaged_and_says_so(folder: Path, run: Run) -> None:
    text = Path("walk.bvh").read_text()
    Path("walk.bvh").write_text(text[: int(0.8 * len(text))])
    assert run("edit", "walk.bvh", "-e", "sad").exit_code == 2
    result = run("edit", "walk.bvh", "-e", "sad", "--salvage")
    assert re.fullmatch(
        r"mien: note: walk\.bvh: salvaged \d+ frames of a damaged clip \(line \d+: .+\)\n", result.stderr
    )
    assert "--salvage" not in result.stderr
    assert replayed(run, "walk_sad.bvh") == Path("walk_sad.bvh").read_bytes()


@pytest.mark.parametrize(
    "wrong", ['fps = "fast"', "fps = true", 'salvage = "no"', "roles = 3", "roles = {a = 1}"]
)
def test_a_sidecar_with_wrong_reading_options_is_refused(folder: Path, run: Run, wrong: str) -> None:
    Path("made.toml").write_text(f'version = 1\nname = "x"\n[provenance]\n{wrong}\n')
    result = run("edit", "walk.bvh", "-r", "made.toml")
    assert result.exit_code == 2
    assert result.stderr.startswith("mien: made.toml: provenance.")


def test_a_rate_that_contradicts_the_motion_is_noted(folder: Path, run: Run) -> None:
    result = run("edit", "walk.bvh", "-e", "sad", "--fps", 300)
    assert (result.exit_code, result.stdout) == (0, "walk_sad.bvh\n")
    assert result.stderr.startswith("mien: note: walk.bvh: at 300 frames a second a foot takes")
    data = json.loads(run("edit", "walk.bvh", "-e", "sad", "--fps", 300, "--force", "--json").stdout)
    assert data[0]["notes"][0].startswith("at 300 frames a second")


def test_a_bit_less_gets_a_name_of_its_own(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "-e", "sad", "--no-sidecar").stdout == "walk_sad.bvh\n"
    less = ["edit", "walk.bvh", "-e", "SAD", "--no-sidecar", "--strength", 0.5]
    assert run(*less).stdout == "walk_sad_0.5.bvh\n"
    assert run(*less, "--parts", "arms", "--span", "0,1").stdout == "walk_sad_0.5_arms_0-1s.bvh\n"
    write_recipe(Recipe("worn out", (Step("posture", {"trunk": 10.0}),)), folder / "mine.toml")
    assert run("edit", "walk.bvh", "-r", "mine.toml").stdout == "walk_worn-out.bvh\n"


def test_dry_run_shows_the_steps_as_they_will_be_done(folder: Path, run: Run) -> None:
    """What is shown is what the history holds afterwards, and an output that exists is marked."""
    flags = [
        "edit",
        "walk.bvh",
        "-e",
        "sad",
        "--strength",
        0.5,
        "--parts",
        "arms",
        "--span",
        "0.2,1",
        "--ease",
        0.1,
    ]
    planned = json.loads(run(*flags, "-n", "--json").stdout)
    assert planned["files"][0]["exists"] is False
    text = run(*flags, "-n").stdout
    assert "strength 0.5; parts arms; 0.2 to 1 s, ease 0.1 s" in text
    assert run(*flags, "-o", "less.bvh").exit_code == 0
    done = read_recipe("less.bvh.recipe.toml").steps
    assert all(step.ease == 0.1 for step in done if step.span)
    known = [Step(**step) for step in planned["steps"]]
    assert [replace(s, parameters={}) for s in known] == [replace(s, parameters={}) for s in done]
    again = run(*flags, "-o", "less.bvh", "-n")
    assert again.exit_code == 0
    assert "walk.bvh -> less.bvh (exists: needs --force)" in again.stdout
    assert "(exists: will be replaced)" in run(*flags, "-o", "less.bvh", "-n", "--force").stdout
    assert "nothing is changed" in run("edit", "walk.bvh", "-e", "sad", "--strength", 0, "-n").stdout


def test_one_clip_to_stdout(folder: Path, process: Callable[..., Any]) -> None:
    before = files(folder)
    done = process("edit", "walk.bvh", "-e", "sad", "-o", "-", cwd=folder)
    assert (done.returncode, done.stderr) == (0, "")
    assert files(folder) == before
    assert process("edit", "walk.bvh", "-e", "sad", cwd=folder).returncode == 0
    assert done.stdout == Path("walk_sad.bvh").read_text()


def test_a_folder_is_edited_twice_without_its_results(folder: Path, run: Run) -> None:
    assert run("edit", ".", "-e", "sad").exit_code == 0
    result = run("edit", ".", "-e", "tired")
    assert result.stdout.split() == ["brisk_tired.bvh", "deeper/tired_walk_tired.bvh", "walk_tired.bvh"]
    assert "passed over 3 clips that mien made" in result.stderr
    assert run("edit", "walk_sad.bvh", "-e", "tired").stdout == "walk_sad_tired.bvh\n"
