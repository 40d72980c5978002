import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import CliRunner, Result

import mien
from mien.cli.app import app
from mien.emotion.files import parse_recipe, read_recipe
from mien.emotion.presets import PRESETS, preset

Run = Callable[..., Result]


def test_info_of_a_walk(folder: Path, run: Run) -> None:
    [fact] = json.loads(run("info", "walk.bvh", "--json").stdout)
    assert (fact["joints"], fact["frames"]) == (22, 46)
    assert fact["fps"] == pytest.approx(30)
    assert fact["seconds"] == pytest.approx(1.5)
    body = fact["body"]
    assert (body["unit"], body["up"]) == ("cm", "+y")
    assert body["roles"]["left_knee"] == "LeftLeg"
    assert body["spine"] == ["Spine", "Spine1", "Chest"]
    assert 1.5 < body["height_m"] < 2.0
    text = run("info", "walk.bvh").stdout
    assert "22 joints, 46 frames at 30 fps: 1.50 s" in text
    assert "left: " in text


def test_info_of_several(folder: Path, run: Run) -> None:
    assert len(json.loads(run("info", ".", "--json").stdout)) == 3


def test_diff_of_a_clip_with_itself(folder: Path, run: Run) -> None:
    result = run("diff", "walk.bvh", "walk.bvh")
    assert (result.exit_code, result.stdout) == (0, "nothing moves differently\n")
    assert json.loads(run("diff", "walk.bvh", "walk.bvh", "--json").stdout)["same"] is True


def test_diff_names_the_joints_that_changed(folder: Path, run: Run) -> None:
    run("edit", "walk.bvh", "--posture-head", 20, "--no-foot-plant", "-o", "low.bvh")
    shown = run("diff", "walk.bvh", "low.bvh").stdout
    assert re.search(r"^head down, against the floor, degrees +\S+ +\S+ +\+20\.0$", shown, re.MULTILINE)
    assert re.search(r"^Head \*", shown, re.MULTILINE)
    assert "LeftLeg" not in shown
    assert "LeftLeg" in run("diff", "walk.bvh", "low.bvh", "--all").stdout
    data = json.loads(run("diff", "walk.bvh", "low.bvh", "--json").stdout)
    turned = {joint["joint"]: joint["rotation_mean_degrees"] for joint in data["joints"]}
    assert turned["Neck"] + turned["Head"] == pytest.approx(20, abs=0.01)


def test_diff_of_different_skeletons_is_refused(folder: Path, run: Run) -> None:
    text = Path("walk.bvh").read_text().replace("JOINT Head\n", "JOINT Skull\n")
    Path("other.bvh").write_text(text)
    result = run("diff", "walk.bvh", "other.bvh")
    assert result.exit_code == 2
    assert "Head, Skull" in result.stderr


def test_render_a_picture_and_a_film(folder: Path, run: Run) -> None:
    result = run("render", "walk.bvh", "brisk.bvh", "--poses", 3, "--width", 400, "-o", "pictures")
    assert result.exit_code == 0
    assert result.stdout.split() == [str(Path("pictures") / n) for n in ("walk_strip.png", "brisk_strip.png")]
    with Image.open("pictures/walk_strip.png") as picture:
        assert picture.width == 400
    film = ["--against", "brisk.bvh", "--views", "side", "-o", "w.gif"]
    assert run("render", "walk.bvh", *film).exit_code == 0
    with Image.open("w.gif") as picture:
        assert picture.n_frames > 10
    again = run("render", "walk.bvh", "-o", "w.gif")
    assert again.exit_code == 2
    assert "exists already" in again.stderr


def test_presets_are_listed_and_printed_as_files(folder: Path, run: Run) -> None:
    listed = json.loads(run("presets", "--json").stdout)
    assert [entry["name"] for entry in listed] == list(PRESETS)
    assert all(name in run("presets").stdout for name in PRESETS)
    assert parse_recipe(run("presets", "sad").stdout) == preset("sad")
    assert parse_recipe(run("presets", "s0/sad", "--json").stdout, kind="json") == preset("s0/sad")
    Path("mine.toml").write_text(run("presets", "strong").stdout)
    assert read_recipe("mine.toml") == preset("strong")


def test_demo_edits_a_walk_and_shows_it(folder: Path, run: Run) -> None:
    result = run("demo")
    assert result.exit_code == 0
    assert re.search(r"^head down, against the floor, degrees", result.stdout, re.MULTILINE)
    out = Path("mien-demo")
    assert {p.name for p in out.iterdir()} == {
        "walk.bvh",
        "walk_sad.bvh",
        "walk_sad.bvh.recipe.toml",
        "walk_sad.png",
    }
    before, after = mien.load(out / "walk.bvh"), mien.load(out / "walk_sad.bvh")
    assert before.skeleton.names == after.skeleton.names
    assert run("demo").exit_code == 2, "nothing is overwritten unasked"
    measures = json.loads(run("demo", "--force", "--emotion", "strong", "--json").stdout)["measures"]
    assert {m["name"] for m in measures} >= {"head_pitch", "foot_slide", "step_length"}


def test_doctor_finds_nothing_wrong(run: Run) -> None:
    findings = json.loads(run("doctor", "--json").stdout)
    assert [f["what"] for f in findings if not f["good"]] == []
    result = run("doctor")
    assert result.exit_code == 0
    assert "numpy" in result.stdout


def test_doctor_reports_what_is_broken(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from mien.edits.registry import EDITS

    monkeypatch.delitem(EDITS, "posture")
    result = run("doctor")
    assert result.exit_code == 1
    assert "posture" in result.stdout


def test_version_and_help(run: Run) -> None:
    assert run("--version").stdout == f"mien {mien.__version__}\n"
    shown = run("-h").stdout
    for command in (
        "demo",
        "info",
        "edit",
        "grid",
        "blend",
        "presets",
        "diff",
        "check",
        "render",
        "pose",
        "doctor",
    ):
        assert re.search(rf"^  {command} ", shown, re.MULTILINE)
        assert run(command, "--help").exit_code == 0


@pytest.mark.parametrize("command", ["edit", "grid", "blend", "render", "pose"])
def test_help_on_a_narrow_terminal_cuts_nothing(
    run: Run, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    shown = CliRunner().invoke(app, [command, "--help"]).stdout
    assert max(map(len, shown.splitlines())) <= 80
    assert "…" not in shown
    assert " ..." not in shown
    assert "`" not in shown


@pytest.mark.parametrize("width", [60, 100])
def test_tables_in_a_pipe_keep_to_the_width(monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    lines = CliRunner().invoke(app, ["presets"]).stdout.splitlines()
    assert width - 12 < max(map(len, lines)) <= width
    assert all(line == line.rstrip() for line in lines)
    assert sum("s0/NAME: as in K. Förger's thesis (2011)" in line for line in lines) == 1


def test_render_goes_on_after_a_bad_clip(folder: Path, run: Run) -> None:
    (folder / "bad.bvh").write_text("rubbish", encoding="utf-8")
    done = run("render", "walk.bvh", "bad.bvh", "-o", "pictures/", "--poses", "1")
    assert done.exit_code == 1
    assert len(list((folder / "pictures").glob("*.png"))) == 1
    assert "bad.bvh" in done.stderr


def test_a_recipe_that_leaves_the_feet_is_noted(folder: Path, run: Run) -> None:
    text = 'version = 1\nname = "own"\n[[steps]]\nedit = "posture"\nhead = 10.0\n'
    (folder / "own.toml").write_text(text, encoding="utf-8")
    done = run("edit", "walk.bvh", "--recipe", "own.toml", "-n")
    assert "--foot-plant adds that step" in done.stderr
    assert "--foot-plant adds" not in run("edit", "walk.bvh", "-r", "own.toml", "-n", "--foot-plant").stderr
