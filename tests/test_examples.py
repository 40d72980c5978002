"""Every example runs as it stands, and its picture shows something."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

EXAMPLES = sorted((Path(__file__).resolve().parents[1] / "examples").glob("*.py"))


def run(example: Path, *arguments: object) -> str:
    words = [str(a) for a in arguments]
    done = subprocess.run([sys.executable, "-W", "error", example, *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_examples_are_numbered_from_one() -> None:
    assert [int(e.name[:2]) for e in EXAMPLES] == list(range(1, len(EXAMPLES) + 1))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda e: e.stem)
def test_example_makes_its_picture(example: Path, tmp_path: Path) -> None:
    run(example, *(("", tmp_path) if "[clip.bvh]" in example.read_text(encoding="utf-8") else (tmp_path,)))
    picture = np.asarray(Image.open(tmp_path / f"{example.stem}.png").convert("RGB"), float)
    background = picture[0, 0]
    drawn = (np.abs(picture - background) > 60).any(axis=-1).mean()
    assert 0.02 < drawn < 0.8, f"{drawn:.0%} of the picture is not background"


def test_an_example_takes_a_clip_of_ones_own(tmp_path: Path) -> None:
    import mien

    mien.save(mien.samples.walk(seconds=1, skeleton="capture31", up="z").motion, tmp_path / "mine.bvh")
    run(EXAMPLES[0], tmp_path / "mine.bvh", tmp_path)
    mine, edited = mien.load(tmp_path / "mine.bvh"), mien.load(tmp_path / "01_walk_sad.bvh")
    assert edited.skeleton.names == mine.skeleton.names
    assert len(edited) == pytest.approx(len(mine) / 0.84, abs=1)  # at four fifths of the tempo of sad
    assert np.abs(edited.rotations[: len(mine)] - mine.rotations).max() > 0.05
