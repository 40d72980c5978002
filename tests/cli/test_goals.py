"""``mien edit`` to a word, a point, by so much, or like an example."""

from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

import mien
from mien.recipe import Step

Run = Callable[..., Result]
CRATE = (
    "HIERARCHY\nROOT crate\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
    "End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n"
)


@pytest.mark.parametrize(
    "flags",
    [["--to", "bored"], ["--valence", "0.6"], ["--by", "+.3,-.1"], ["--by", "0.2,0", "--start", "sad"]],
)
def test_to_a_place(folder: Path, run: Run, flags: list[str]) -> None:
    result = run("edit", "walk.bvh", *flags, "-o", "there.bvh")
    assert result.exit_code == 0, result.output
    assert "asked for valence" in result.stderr
    made, walk = mien.load("there.bvh"), mien.load("walk.bvh")
    assert made.skeleton.names == walk.skeleton.names
    assert abs(mien.compare(walk, made).rotation_mean).max() > 1.0


def test_what_was_done_is_a_recipe_that_replays(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "--to", "annoyed", "-o", "one.bvh").exit_code == 0
    assert run("edit", "walk.bvh", "-r", "one.bvh.recipe.toml", "-o", "two.bvh").exit_code == 0
    assert Path("one.bvh").read_bytes() == Path("two.bvh").read_bytes()


def test_like_an_example(folder: Path, run: Run) -> None:
    wave = mien.samples.wave().motion
    mien.save(wave, "wave.bvh")
    mien.save(mien.apply(wave, [Step("posture", {"trunk": 15.0})]), "bent_wave.bvh")
    given = ["--from-example", "bent_wave.bvh", "--example-neutral", "wave.bvh"]
    result = run("edit", "walk.bvh", *given, "-o", "bent.bvh")
    assert result.exit_code == 0, result.output
    changes = {c.name: c for c in mien.compare(mien.load("walk.bvh"), mien.load("bent.bvh")).changes}
    assert changes["trunk_flexion"].after - changes["trunk_flexion"].before > 8.0


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--to", "hapy"], "did you mean 'happy'"),
        (["--to", "happy", "--by", "1,0"], "give one"),
        (["--by", "1"], "valence and arousal"),
        (["--to", "happy", "-e", "sad"], "one of them"),
        (["--example-neutral", "walk.bvh"], "--from-example too"),
        (["--method", "rules"], "--to, --by"),
        (["--to", "happy", "--method", "magic"], "no method 'magic'"),
        (["--from-example", "none.bvh"], "no such file"),
        (["--from-example", "crate.bvh"], "mien: crate.bvh: not found in this skeleton"),
        (["--from-example", "walk.bvh", "--example-neutral", "crate.bvh"], "mien: crate.bvh: not found"),
        (["--from-example", "walk.bvh", "--model", "ours.json"], "--to, --by"),
        (["--to", "proud"], "--emotion proud"),
        (["--to", "2,0"], "from -1 to 1"),
        (["--to", "0.5,x"], "valence and arousal"),
        (["--valence", "nan"], "from -1 to 1"),
        (["--to", "sad", "--model", "none.json"], "none.json: cannot be read as a model"),
    ],
)
def test_slips_are_told_before_any_work(folder: Path, run: Run, flags: list[str], message: str) -> None:
    Path("crate.bvh").write_text(CRATE)
    result = run("edit", "walk.bvh", *flags)
    assert result.exit_code == 2
    assert message in result.stderr
    assert "Traceback" not in result.output


@pytest.mark.parametrize(
    ("flags", "name"),
    [
        (["--to", "sad"], "walk_sad.bvh"),
        (["--to", "sad", "--method", "rules"], "walk_sad_rules.bvh"),
        (["--to", "sad", "--start", "happy"], "walk_sad_from-happy.bvh"),
        (["--to", "sad", "--start", "neutral"], "walk_sad.bvh"),
        (["--to", "0.3,-0.25"], "walk_at+0.3-0.25.bvh"),
        (["--valence", "-0.4"], "walk_at-0.4+0.bvh"),
        (["--by=-.3,0.1"], "walk_by-0.3+0.1.bvh"),
        (
            ["--by", ".2,0", "--start", "0.1,-.1", "--method", "joint"],
            "walk_by+0.2+0_from-+0.1-0.1_joint.bvh",
        ),
    ],
)
def test_names_tell_ways_apart(folder: Path, run: Run, flags: list[str], name: str) -> None:
    result = run("edit", "walk.bvh", *flags, "--dry-run")
    assert result.stdout.splitlines()[0] == f"walk.bvh -> {name}"


def test_a_point_beyond_the_disc_is_drawn_in_and_told(folder: Path, run: Run) -> None:
    result = run("edit", "walk.bvh", "--to", "1,1", "--dry-run")
    assert "beyond the disc: drawn in to +0.71, +0.71" in result.stderr
    assert "drawn in" not in run("edit", "walk.bvh", "--to", "0.6,0.8", "--dry-run").stderr


def test_what_is_asked_for_at_half_the_strength_is_half(folder: Path, run: Run) -> None:
    whole, half, some = (
        run("edit", "walk.bvh", "--to", "1,0", *more, "-o", name).stderr
        for name, more in (("a.bvh", []), ("b.bvh", ["--strength", "0.5"]), ("c.bvh", ["--span", "0,1"]))
    )
    assert "asked for valence +1.00" in whole
    assert "asked for valence +0.50" in half
    assert "only some of it was to change" in some
    assert "only some" not in half


def test_a_model_of_ones_own_moves_clips(folder: Path, run: Run) -> None:
    """One that has seen features change twice as much asks for more."""
    from dataclasses import replace

    from mien.emotion.model import format_model, shipped_model

    shipped = shipped_model()
    changes = {label: 2.0 * change for label, change in shipped.clusters.changes.items()}
    twice = replace(shipped, clusters=replace(shipped.clusters, changes=changes))
    Path("ours.json").write_text(format_model(twice), encoding="utf-8")
    assert run("edit", "walk.bvh", "--to", "sad", "--method", "rules").exit_code == 0
    ours = run(
        "edit", "walk.bvh", "--to", "sad", "--method", "rules", "--model", "ours.json", "-o", "ours.bvh"
    )
    assert ours.exit_code == 0, ours.output
    rates = [mien.load(name).duration for name in ("walk.bvh", "walk_sad_rules.bvh", "ours.bvh")]
    assert rates[0] < rates[1] < rates[2]


def test_an_example_with_the_map_of_the_clip(folder: Path, run: Run) -> None:
    """The map of odd joint names counts for an example that has them, and not for one that has not."""
    text = Path("walk.bvh").read_text()
    names = mien.load("walk.bvh").skeleton.names
    for name in sorted(names, key=len, reverse=True):
        text = text.replace(f" {name}\n", f" j{names.index(name)}\n")
    Path("odd.bvh").write_text(text)
    roles = mien.kinematics.body.Body.of(mien.load("walk.bvh")).roles
    lines = "\n".join(f'{role} = "j{joint}"' for role, joint in roles.items())
    Path("odd.toml").write_text(f"[roles]\n{lines}\n")
    for example in ("odd.bvh", "brisk.bvh"):
        result = run(
            "edit", "odd.bvh", "--from-example", example, "--map", "odd.toml", "-o", "x.bvh", "--force"
        )
        assert result.exit_code == 0, result.output
