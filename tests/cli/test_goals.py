"""``mien edit`` to a word, a point, by so much, or like an example."""

from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

import mien
from mien.recipe import Step

Run = Callable[..., Result]


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
    ],
)
def test_slips_are_told_before_any_work(folder: Path, run: Run, flags: list[str], message: str) -> None:
    result = run("edit", "walk.bvh", *flags)
    assert result.exit_code == 2
    assert message in result.stderr
    assert "Traceback" not in result.output
