"""``mien grid``: nine clips and how to blend them, or one; each is made again by its recipe."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import Result

import mien

Run = Callable[..., Result]
NAMES = [
    "walk_A_short-even",
    "walk_B_even",
    "walk_C_long-even",
    "walk_D_short",
    "walk_E_original",
    "walk_F_long",
    "walk_G_short-rushed",
    "walk_H_rushed",
    "walk_I_long-rushed",
]


def test_the_nine_and_the_blend_space(folder: Path, run: Run) -> None:
    result = run("grid", "walk.bvh", "-o", "square")
    assert (result.exit_code, result.stderr) == (0, "")
    engine = ["walk.blendspace.json", "walk.blendspace.tres"]
    clips = [f"{name}.bvh" for name in NAMES]
    assert [Path(line).name for line in result.stdout.splitlines()] == clips + engine
    found = sorted(p.name for p in Path("square").iterdir())
    assert found == sorted(clips + engine + [f"{clip}.recipe.toml" for clip in clips])
    assert Path("square/walk_E_original.bvh").read_bytes() == Path("walk.bvh").read_bytes()
    square, walk = mien.grid(mien.load("walk.bvh")), mien.load("square/walk_C_long-even.bvh")
    np.testing.assert_allclose(np.abs((walk.rotations * square.at(2, 2).rotations).sum(-1)), 1.0, atol=1e-9)


@pytest.mark.parametrize("name", ["walk_A_short-even", "walk_E_original", "walk_I_long-rushed"])
def test_each_of_the_nine_is_made_again_by_its_recipe(folder: Path, run: Run, name: str) -> None:
    run("grid", "walk.bvh")
    clip = Path("walk_grid") / f"{name}.bvh"
    result = run("edit", "walk.bvh", "--recipe", f"{clip}.recipe.toml", "-o", "again.bvh")
    assert result.exit_code == 0, result.stderr
    assert Path("again.bvh").read_bytes() == clip.read_bytes()


def test_the_blend_space_says_where_each_clip_stands(folder: Path, run: Run) -> None:
    run("grid", "walk.bvh", "--short", 0.5, "--posture-head", 12)
    space = json.loads(Path("walk_grid/walk.blendspace.json").read_text(encoding="utf-8"))
    assert (space["format"], space["version"]) == ("mien blend space", 1)
    assert [axis["name"] for axis in space["axes"]] == ["path", "timing"]
    assert {(axis["min"], axis["neutral"], axis["max"]) for axis in space["axes"]} == {(0, 1, 2)}
    at = {sample["letter"]: sample["at"] for sample in space["samples"]}
    assert (at["A"], at["C"], at["E"], at["G"], at["I"]) == ([0, 2], [2, 2], [1, 1], [0, 0], [2, 0])
    assert all((Path("walk_grid") / sample["file"]).is_file() for sample in space["samples"])
    assert space["made_with"]["short"] == 0.5
    assert space["clips"]["frames"] == 46
    assert space["source"]["posture"][0]["head"] == 12.0


def test_the_file_for_godot_is_whole(folder: Path, run: Run) -> None:
    """Every point has a node that exists and names an animation; nine points on the square."""
    run("grid", "walk.bvh")
    text = Path("walk_grid/walk.blendspace.tres").read_text(encoding="utf-8")
    assert text.startswith('[gd_resource type="AnimationNodeBlendSpace2D" load_steps=10 format=3]\n')
    nodes = dict(
        re.findall(
            r'\[sub_resource type="AnimationNodeAnimation" id="(\w)"\]\nanimation = &"([\w-]+)"\n', text
        )
    )
    assert list(nodes.values()) == NAMES
    points = re.findall(
        r'blend_point_(\d)/node = SubResource\("(\w)"\)\n'
        r"blend_point_\1/pos = Vector2\((\d), (\d)\)\n",
        text,
    )
    assert [point[0] for point in points] == list("012345678")
    assert {point[1] for point in points} == set(nodes)
    assert {point[2:] for point in points} == {(x, y) for x in "012" for y in "012"}
    assert points[0][2:] == ("0", "2")


def test_one_clip_at_a_point(folder: Path, run: Run) -> None:
    result = run("grid", "walk.bvh", "--at", "1.4,0.3", "--mode", "bilinear")
    assert (result.exit_code, result.stdout) == (0, "walk_grid_1.4_0.3.bvh\n")
    assert sorted(p.name for p in Path().iterdir() if "grid" in p.name) == [
        "walk_grid_1.4_0.3.bvh",
        "walk_grid_1.4_0.3.bvh.recipe.toml",
    ]
    again = run("edit", "walk.bvh", "-r", "walk_grid_1.4_0.3.bvh.recipe.toml", "-o", "again.bvh")
    assert again.exit_code == 0
    assert Path("again.bvh").read_bytes() == Path("walk_grid_1.4_0.3.bvh").read_bytes()
    other = run("grid", "walk.bvh", "--at", "1.4,0.3", "-o", "other.bvh")
    assert other.stdout == "other.bvh\n"
    assert Path("other.bvh").read_bytes() != Path("again.bvh").read_bytes()


def test_a_posture_comes_last_with_the_feet_put_back(folder: Path, run: Run) -> None:
    flags = ("--posture-head", 20, "--posture-legs", 4)
    assert run("grid", "walk.bvh", "--at", "0.5,1", *flags, "-o", "low.bvh").exit_code == 0
    steps = mien.read_recipe("low.bvh.recipe.toml").steps
    assert [step.edit for step in steps] == ["grid", "posture", "foot_plant"]
    assert steps[1].parameters["head"] == 20.0


def test_json_and_dry_run(folder: Path, run: Run) -> None:
    planned = json.loads(run("grid", "walk.bvh", "-n", "--json").stdout)
    assert not Path("walk_grid").exists()
    assert [entry["letter"] for entry in planned["files"]] == list("ABCDEFGHI")
    assert not any(entry["exists"] for entry in planned["files"])
    done = json.loads(run("grid", "walk.bvh", "--json").stdout)
    assert [e["output"] for e in done["files"]] == [e["output"] for e in planned["files"]]
    assert done["engine_files"] == planned["engine_files"]
    shown = run("grid", "walk.bvh", "-n").stdout.splitlines()
    place = Path("walk_grid") / "walk_A_short-even.bvh"
    assert shown[0] == f"walk.bvh -> {place}: path 0, timing 2 (exists: needs --force)"
    assert "will be replaced" in run("grid", "walk.bvh", "-n", "--force").stdout


def test_nothing_is_lost(folder: Path, run: Run) -> None:
    assert run("grid", "walk.bvh").exit_code == 0
    kept = Path("walk_grid/walk.blendspace.tres")
    for path in Path("walk_grid").iterdir():
        if path != kept:
            path.unlink()
    again = run("grid", "walk.bvh")
    assert again.exit_code == 2
    assert "walk.blendspace.tres exists already" in again.stderr
    assert [p.name for p in Path("walk_grid").iterdir()] == [kept.name]
    assert run("grid", "walk.bvh", "--force").exit_code == 0


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--at", "3,1"), "--at needs two numbers from 0 to 2, e.g. 1.4,0.3, got '3,1'"),
        (("--at", "nan,1"), "--at needs two numbers from 0 to 2"),
        (("--at", "1"), "--at needs two numbers from 0 to 2"),
        (("--mode", "bilinar"), "did you mean 'bilinear'?"),
        (("--short", "1.5"), "grid: short must be from 0 to 1, got 1.5"),
        (("--acceleration", "-1"), "grid: acceleration must be from 0 to 1, got -1"),
        (("-o", "square.bvh"), "square.bvh: the nine clips need a folder, such as -o walk_grid"),
        (("-o", "-"), "-: the nine clips need a folder"),
        (("-o", "walk.bvh/deeper"), "walk.bvh is a file, not a folder"),
        (("--posture-head", "200"), "posture: head must be from"),
        (("--fps", "0"), "fps must be above 0"),
    ],
)
def test_what_does_not_fit_is_one_sentence(
    folder: Path, run: Run, arguments: tuple[str, ...], said: str
) -> None:
    before = sorted(Path().rglob("*"))
    result = run("grid", "walk.bvh", *arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert len(result.stderr.splitlines()) == 1
    assert sorted(Path().rglob("*")) == before


def test_a_clip_without_a_body_is_named(folder: Path, run: Run) -> None:
    text = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
    text += "End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 5\nFrame Time: 0.1\n" + "0 0 0\n" * 5
    Path("stick.bvh").write_text(text)
    result = run("grid", "stick.bvh")
    assert result.exit_code == 2
    assert result.stderr.startswith("mien: stick.bvh: ")
    assert run("grid", "wlak.bvh").stderr.startswith(
        "mien: wlak.bvh: there is no such file; did you mean walk.bvh"
    )
    result = run("grid", ".")
    assert (result.exit_code, result.stderr) == (2, "mien: . is a folder; mien grid takes one clip\n")


def test_damage_and_doubt_are_noted(folder: Path, run: Run) -> None:
    text = Path("walk.bvh").read_text()
    Path("walk.bvh").write_text(text[: int(0.8 * len(text))])
    assert run("grid", "walk.bvh", "--at", "1,0").exit_code == 2
    result = run("grid", "walk.bvh", "--at", "1,0", "--salvage")
    assert result.exit_code == 0
    assert result.stderr.startswith("mien: note: walk.bvh: salvaged")
    again = run("edit", "walk.bvh", "-r", "walk_grid_1_0.bvh.recipe.toml", "-o", "again.bvh")
    assert again.exit_code == 0
    assert Path("again.bvh").read_bytes() == Path("walk_grid_1_0.bvh").read_bytes()
