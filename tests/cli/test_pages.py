"""What the documents show is done as they show it: commands line by line, Python, maps and recipes."""

import contextlib
import io
import os
import re
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

import mien
from mien import samples
from mien.emotion.files import parse_recipe
from mien.kinematics.roles import read_map

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
FOR_THE_SHELL = ("python3", "source")  # installing is tested by scripts/check.py

Run = Callable[..., Result]


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(
        rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )


def recipes(page: Path) -> list[tuple[str, str]]:
    """Every recipe on a page, and the file that the words before it say it is in."""
    found, text = [], page.read_text(encoding="utf-8")
    for block in re.finditer(r"^```toml\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        names = re.findall(r"[\w-]+\.toml", text[: block.start()])
        if "[[steps]]" in block[1]:
            found.append((f"mien-demo/{names[-1]}" if page.stem == "quickstart" else names[-1], block[1]))
    return found


def done(line: str, run: Run) -> None:
    """Do one line of a command block in the current folder."""
    words = shlex.split(line.removeprefix("$ "), comments=True)
    if words[0] == "cd":
        os.chdir(words[1])
    elif words[0] not in FOR_THE_SHELL:
        assert words[0] == "mien", line
        end = words.index(">") if ">" in words else len(words)
        result = run(*words[1:end])
        assert result.exit_code == 0, f"{line}\n{result.output}"
        for file in words[end + 1 :]:
            Path(file).write_text(result.stdout, encoding="utf-8")


PAGES_DONE = [
    "README.md",
    *(f"docs/{name}.md" for name in ("quickstart", "presets", "checks", "laban", "emotion", "grid", "blend")),
]


@pytest.mark.parametrize("name", PAGES_DONE)
def test_commands_work_line_by_line_and_python_twice(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Run
) -> None:
    monkeypatch.chdir(tmp_path)
    page = ROOT / name
    if name == "README.md":
        assert run("demo").exit_code == 0  # the last words of the line that installs mien
    if name in ("docs/presets.md", "docs/grid.md"):
        mien.save(samples.walk(seconds=1.0, fps=30.0).motion, "walk.bvh")
    if name in ("docs/laban.md", "docs/emotion.md"):
        mien.save(samples.walk(seconds=2.0, fps=30.0).motion, "walk.bvh")
        mien.save(samples.tired_walk(seconds=2.0, fps=30.0).motion, "tired.bvh")
    for file, text in recipes(page):
        Path(file).parent.mkdir(exist_ok=True)
        Path(file).write_text(text)
    if name == "docs/blend.md":
        for clip, emotion in (("neutral", {}), ("sad", {"cadence": 1.4}), ("proud", {"step_length": 0.8})):
            mien.save(samples.walk(seconds=3.0, fps=30.0, **emotion).motion, f"{clip}.bvh")
    lines = [line for block in blocks(page, "console") for line in block.splitlines()]
    assert lines, "no commands were found on the page"
    for line in lines:
        done(line, run)
    for _ in range(2):
        names: dict[str, object] = {}
        for block in blocks(page, "python"):
            with contextlib.redirect_stdout(io.StringIO()):
                exec(block, names)


def test_maps_and_recipes_are_such(tmp_path: Path) -> None:
    seen = {"map": 0, "recipe": 0}
    for page in PAGES:
        for block in blocks(page, "toml"):
            if "[[steps]]" in block:
                seen["recipe"] += 1
                assert parse_recipe(block).steps
            else:
                seen["map"] += 1
                (tmp_path / "body.toml").write_text(block, encoding="utf-8")
                assert read_map(tmp_path / "body.toml")
    assert min(seen.values()) > 0
