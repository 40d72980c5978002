"""Bad usage, bad files and interrupts: one sentence, the right exit code, never a traceback."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

from mien.batch import Job, edit_files
from mien.emotion.presets import preset

Run = Callable[..., Result]
Process = Callable[..., "subprocess.CompletedProcess[str]"]

BAD_USAGE = {
    "nothing to do": (["edit", "walk.bvh"], "say what to change"),
    "unknown emotion": (["edit", "walk.bvh", "-e", "sda"], "did you mean 'sad'?"),
    "two sources": (["edit", "walk.bvh", "-e", "sad", "-r", "x.toml"], "not both"),
    "missing recipe": (["edit", "walk.bvh", "-r", "x.toml"], "x.toml: there is no such file"),
    "two emotions": (["edit", "walk.bvh", "-e", "sad", "-e", "sad"], "give each emotion once"),
    "ease alone": (["edit", "walk.bvh", "-e", "sad", "--ease", "1"], "give --span too"),
    "ease below 0": (["edit", "walk.bvh", "-e", "sad", "--span", "0,1", "--ease", "-1"], "0 seconds or more"),
    "clip as recipe": (["edit", "walk.bvh", "-r", "brisk.bvh"], "brisk.bvh: is a clip; a recipe is"),
    "thesis's emotion": (["edit", "walk.bvh", "-e", "s0/sda"], "did you mean 's0/sad'?"),
    "s0 in short": (["edit", "walk.bvh", "-e", "xx"], "weak), and s0/NAME for the thesis"),
    "several to stdout": (["edit", "*.bvh", "-e", "sad", "-o", "-"], "takes one clip"),
    "picture to stdout": (["render", "walk.bvh", "-o", "-"], "takes one clip"),
    "pose to stdout": (["pose", "walk.bvh", "brisk.bvh", "-o", "-"], "written to a file"),
    "missing ghost": (["render", "walk.bvh", "--against", "wlak.bvh"], "wlak.bvh: there is no such file"),
    "missing pose": (["edit", "walk.bvh", "--posture-pose", "p.toml"], "p.toml: there is no such file"),
    "missing keys": (["edit", "walk.bvh", "--displacement-keys", "k.toml"], "k.toml: there is no such file"),
    "wrong keys": (["edit", "walk.bvh", "--displacement-keys", "1 nod"], "keys: at 1 s: there is no pose"),
    "file as folder": (["render", "walk.bvh", "-o", "walk.bvh/x.png"], "walk.bvh is a file, not a folder"),
    "unknown flag": (["edit", "walk.bvh", "--posture-hed", "3"], "--posture-head"),
    "no number": (["edit", "walk.bvh", "--posture-head", "low"], "--posture-head"),
    "out of range": (["edit", "walk.bvh", "--posture-head", "999"], "degrees, got 999"),
    "unknown choice": (["edit", "walk.bvh", "--posture-method", "bodyfixed"], "did you mean 'body_fixed'?"),
    "strength": (["edit", "walk.bvh", "-e", "sad", "--strength", "3"], "--strength must be from 0 to 2"),
    "part": (["edit", "walk.bvh", "-e", "sad", "--parts", "arm"], "did you mean 'arms'?"),
    "span": (["edit", "walk.bvh", "-e", "sad", "--span", "1"], "--span needs two times"),
    "span backwards": (["edit", "walk.bvh", "-e", "sad", "--span", "2,1"], "end after it starts"),
    "missing clip": (["edit", "wlak.bvh", "-e", "sad"], "did you mean walk.bvh?"),
    "no match": (["edit", "*.fbx", "-e", "sad"], "no file matches"),
    "missing map": (["edit", "walk.bvh", "-e", "sad", "--map", "m.toml"], "m.toml"),
    "other format": (["edit", "walk.bvh", "-e", "sad", "-o", "walk.fbx"], ".bvh"),
    "rate": (["edit", "walk.bvh", "-e", "sad", "--fps", "-3"], "fps must be above 0"),
    "diff of one": (["diff", "walk.bvh"], "after"),
    "picture type": (["render", "walk.bvh", "-o", "walk.pdf"], ".png"),
    "view": (["render", "walk.bvh", "--views", "frnt", "-o", "w.png"], "did you mean 'front'?"),
    "views of a film": (["render", "walk.bvh", "--views", "front,side", "-o", "w.gif"], "one view"),
    "unknown command": (["edti", "walk.bvh"], "edit"),
    "unknown preset": (["presets", "sda"], "did you mean 'sad'?"),
}


@pytest.mark.parametrize("case", BAD_USAGE)
def test_bad_usage_is_told_in_a_sentence(folder: Path, run: Run, case: str) -> None:
    arguments, words = BAD_USAGE[case]
    before = sorted(folder.rglob("*"))
    result = run(*arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert words.lower() in " ".join(result.stderr.replace("│", " ").split()).lower()
    assert "Traceback" not in result.stderr
    assert sorted(folder.rglob("*")) == before


RUBBISH = {
    "empty": b"",
    "binary": bytes(range(256)) * 40,
    "text": b"Dear all,\nhere is the clip.\n",
    "cut header": b"HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 3 Zrotation",
    "no motion": b"HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 3 Zrotation Xrotation Yrotation\n}\n",
    "no body": b"HIERARCHY\nROOT Box\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n"
    b"{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n0 0 0\n1 1 1\n",
}


@pytest.mark.parametrize("case", RUBBISH)
@pytest.mark.parametrize("command", ["edit", "info", "diff", "render"])
def test_rubbish_is_refused_without_a_traceback(folder: Path, run: Run, case: str, command: str) -> None:
    Path("bad.bvh").write_bytes(RUBBISH[case])
    more = {"edit": ["-e", "sad"], "info": [], "diff": ["walk.bvh"], "render": ["-o", "bad.png"]}[command]
    result = run(command, "bad.bvh", *more)
    assert "Traceback" not in result.stderr
    assert "error in mien itself" not in result.stderr
    if case == "no body" and command in ("info", "render"):
        assert result.exit_code == 0, "what needs no body works on anything that is a clip"
        assert command != "info" or "no body found" in result.stdout
        return
    assert result.exit_code == 2
    assert result.stderr.startswith("mien: ")
    assert not Path("bad.png").exists()
    assert not Path("bad_sad.bvh").exists()


@pytest.mark.parametrize("out", ["out", "out/sad.bvh", "out/deeper/sad.bvh"])
def test_a_folder_that_is_a_file(folder: Path, run: Run, out: str) -> None:
    Path("out").write_text("mine")
    result = run("edit", "walk.bvh", "-e", "sad", "-o", out)
    assert (result.exit_code, result.stderr) == (2, "mien: out is a file, not a folder\n")
    assert Path("out").read_text() == "mine"


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_folder_that_turns_out_to_be_a_file_is_told_for_each_clip(folder: Path, jobs: int) -> None:
    Path("out").write_text("mine")
    targets = {Path(name): Path("out") / name for name in ("walk.bvh", "brisk.bvh")}
    todo = [Job(source, target, preset("sad")) for source, target in targets.items()]
    done = list(edit_files(todo, workers=jobs))
    assert all(outcome.error.startswith("out: ") and not outcome.unexpected for outcome in done)
    assert Path("out").read_text() == "mine"


def test_errors_begin_with_the_path_as_it_was_given(folder: Path, run: Run) -> None:
    bad = Path("deeper/bad.bvh")
    bad.write_bytes(RUBBISH["cut header"])
    commands = (["edit", "deeper", "-e", "sad"], ["info", "deeper"], ["diff", bad, bad], ["render", bad])
    for command in commands:
        assert f"mien: {bad}" in run(*command).stderr, command


def test_json_tells_also_what_was_wrong_with_the_call(folder: Path, run: Run) -> None:
    for command in (
        ["edit", "none.bvh", "-e", "sad"],
        ["edit", "walk.bvh"],
        ["diff", "walk.bvh", "none.bvh"],
    ):
        result = run(*command, "--json")
        error = json.loads(result.stdout)["error"]
        assert (result.exit_code, result.stderr) == (2, f"mien: {error}\n")


def test_a_figure_without_a_body_is_drawn_and_said_to_be_sticks(folder: Path, run: Run) -> None:
    Path("box.bvh").write_bytes(RUBBISH["no body"])
    result = run("render", "box.bvh", "-o", "box.png")
    assert (result.exit_code, Path("box.png").exists()) == (0, True)
    assert re.match(
        r"mien: note: box\.bvh is drawn as sticks: not found in .+ \(a map file helps", result.stderr
    )


def test_a_clip_or_a_pose_given_as_recipe(folder: Path, run: Run) -> None:
    assert run("edit", "walk.bvh", "-e", "sad").exit_code == 0
    result = run("edit", "walk.bvh", "--recipe", "walk_sad.bvh")
    assert result.stderr == "mien: walk_sad.bvh: is a clip; its recipe is walk_sad.bvh.recipe.toml\n"
    assert run("pose", "walk.bvh", "brisk.bvh", "-o", "pose.toml").exit_code == 0
    assert "pose.toml: is a pose file" in run("edit", "walk.bvh", "--recipe", "pose.toml").stderr
    Path("keys.toml").write_text('[[keys]]\ntime = 1\npose = "none"\n', encoding="utf-8")
    assert "keys.toml: is a file of keys" in run("edit", "walk.bvh", "--recipe", "keys.toml").stderr


def test_one_bad_clip_among_good_ones(folder: Path, run: Run) -> None:
    Path("bad.bvh").write_bytes(RUBBISH["cut header"])
    result = run("edit", "*.bvh", "-e", "sad")
    assert result.exit_code == 1
    assert result.stdout.split() == ["brisk_sad.bvh", "walk_sad.bvh"]
    assert "bad.bvh" in result.stderr
    assert "2 of 3 clips written, 1 failed" in result.stderr
    assert run("info", "*.bvh").exit_code == 1


def test_stdout_holds_data_and_stderr_the_rest(folder: Path, process: Process) -> None:
    Path("bad.bvh").write_bytes(RUBBISH["binary"])
    done = process("info", "walk.bvh", "bad.bvh", "--json", cwd=folder)
    assert done.returncode == 1
    assert [Path(fact["file"]).name for fact in json.loads(done.stdout)] == ["walk.bvh", "bad.bvh"]
    assert done.stderr.startswith("mien: ")
    assert "Traceback" not in done.stderr


def test_an_error_in_mien_itself_is_a_sentence_and_a_hint(
    folder: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("the edit divides by nothing")

    from mien.edits import pipeline

    monkeypatch.delenv("MIEN_DEBUG", raising=False)
    monkeypatch.setattr(pipeline, "apply", broken)
    result = run("edit", "walk.bvh", "-e", "sad")
    assert result.exit_code == 1
    assert "ZeroDivisionError: the edit divides by nothing" in result.stderr
    assert "MIEN_DEBUG=1" in result.stderr
    assert "Traceback" not in result.stderr
    monkeypatch.setenv("MIEN_DEBUG", "1")
    assert isinstance(run("edit", "walk.bvh", "-e", "sad").exception, ZeroDivisionError)


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("jobs", [1, 2])
def test_interrupt_ends_with_130_and_leaves_whole_files(folder: Path, jobs: int) -> None:
    import shutil

    for number in range(400):
        shutil.copy("walk.bvh", f"many{number}.bvh")
    command = [sys.executable, "-m", "mien", "edit", "many*.bvh", "-e", "sad", "-o", "out", "-j", str(jobs)]
    child = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        until = time.monotonic() + 60
        while not list(Path("out").glob("*.bvh")) and time.monotonic() < until:
            time.sleep(0.02)
        child.send_signal(signal.SIGINT)
        _, said = child.communicate(timeout=60)
    finally:
        child.kill()
    assert child.returncode == 130
    assert said.strip() == "mien: interrupted"
    written = list(Path("out").glob("*.bvh"))
    assert 0 < len(written) < 400
    sizes = {path.stat().st_size for path in written}
    assert min(sizes) > 0.9 * max(sizes), "every file that is there is whole"
    assert not [p for p in Path("out").iterdir() if p.name.startswith(".")]


@pytest.mark.skipif(os.name == "nt", reason="pipes of POSIX")
def test_a_reader_that_stops_reading_is_no_failure(folder: Path) -> None:
    import shutil

    for number in range(60):
        shutil.copy("walk.bvh", f"many{number}.bvh")
    command = f"{sys.executable} -m mien info 'many*.bvh' --json | head -c 10; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0
    assert done.stderr == ""
