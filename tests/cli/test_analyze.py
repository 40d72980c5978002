"""``mien analyze``: what it prints, writes and refuses."""

import csv
import io
import json
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import Result

import mien
from mien import samples
from mien.analysis.effort import EFFORT, effort
from mien.analysis.laban_table import DERIVED, FEATURES, SELECTED

Run = Callable[..., Result]
ALL = [d.name for d in DERIVED]
READ = ["valence", "arousal", "quadrant", "label", "probability", "placed", "against", "neutral", "because"]


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_a_table_for_a_person(folder: Path, run: Run) -> None:
    result = run("analyze", "walk.bvh", "--laban")
    assert result.exit_code == 0
    found = mien.features(mien.load("walk.bvh"))
    for component in ("BODY", "EFFORT", "SHAPE", "SPACE"):
        assert f"\n{component}\n" in result.stdout
    for d in SELECTED:
        line = next(s for s in result.stdout.splitlines() if s.startswith(f"  {d.name.replace('_', ' ')} "))
        assert float(line.split()[-1]) == pytest.approx(found[d.name], rel=0.006, abs=1e-9)
    assert "kinetic energy" in result.stdout


def test_clips_beside_each_other(folder: Path, run: Run) -> None:
    result = run("analyze", "walk.bvh", "deeper", "--laban")
    head = next(line for line in result.stdout.splitlines() if line.startswith("feature"))
    assert head.split() == ["feature", "unit", "walk.bvh", "tired_walk.bvh"]
    speed = next(line for line in result.stdout.splitlines() if "pelvis speed mean" in line)
    walk, tired = (float(number) for number in speed.split()[-2:])
    assert tired < walk


def test_every_feature_as_csv(folder: Path, run: Run) -> None:
    result = run("analyze", ".", "--features", "--jobs", "2")
    table = rows(result.stdout)
    assert [row["file"] for row in table] == ["brisk.bvh", "deeper/tired_walk.bvh", "walk.bvh"]
    assert list(table[0]) == ["file", "duration", *READ, *ALL]
    found = mien.features(mien.load("walk.bvh")).clip
    np.testing.assert_array_equal([float(table[2][name]) for name in ALL], found)
    alone = run("analyze", ".", "--features", "--jobs", "1")
    assert alone.stdout == result.stdout


def test_windows_and_frames(folder: Path, run: Run) -> None:
    found = mien.features(mien.load("walk.bvh"))
    windows = rows(run("analyze", "walk.bvh", "--features", "--per", "window").stdout)
    assert [float(row["time"]) for row in windows] == found.window_times().tolist()
    assert float(windows[1]["hands_distance_mean"]) == found.windows()[1, ALL.index("hands_distance_mean")]
    frames = rows(run("analyze", "walk.bvh", "--features", "--per", "frame").stdout)
    assert list(frames[0]) == ["file", "time", *(f.name for f in FEATURES)]
    assert len(frames) == len(found.frames)


def test_a_file(folder: Path, run: Run) -> None:
    result = run("analyze", "walk.bvh", "brisk.bvh", "--features", "-o", "new/table.csv")
    assert (result.exit_code, result.stdout) == (0, "new/table.csv\n")
    assert Path("new/table.csv").read_text() == run("analyze", "walk.bvh", "brisk.bvh", "--features").stdout
    again = run("analyze", "walk.bvh", "-o", "new/table.csv")
    assert again.exit_code == 2
    assert "--force" in again.stderr
    assert run("analyze", "walk.bvh", "-o", "new/table.csv", "--force").exit_code == 0
    assert len(rows(Path("new/table.csv").read_text())) == 1


def test_parquet(folder: Path, run: Run) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    assert (
        run("analyze", "walk.bvh", "brisk.bvh", "--features", "-o", "table.parquet").stdout
        == "table.parquet\n"
    )
    table = parquet.read_table("table.parquet").to_pydict()
    assert table["file"] == ["walk.bvh", "brisk.bvh"]
    assert table["hands_distance_mean"][0] == mien.features(mien.load("walk.bvh"))["hands_distance_mean"]


def test_parquet_without_pyarrow(folder: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    result = run("analyze", "walk.bvh", "-o", "table.parquet")
    assert result.exit_code == 2
    assert result.stderr == (
        "mien: table.parquet: Parquet needs pyarrow: pip install pyarrow (or write a .csv)\n"
    )
    assert not Path("table.parquet").exists()


def test_a_picture(folder: Path, run: Run) -> None:
    from PIL import Image

    result = run("analyze", "walk.bvh", "--plot", "walk.png")
    assert (result.exit_code, result.stdout) == (0, "walk.png\n")
    with Image.open("walk.png") as picture:
        assert picture.width == 1600
        assert len(np.unique(np.asarray(picture).reshape(-1, 3), axis=0)) > 20
    both = run("analyze", "walk.bvh", "--plot", "walk.png", "--features", "--force")
    assert both.stdout.startswith("file,duration,")
    assert both.stdout.endswith("walk.png\n")


def test_json(folder: Path, run: Run) -> None:
    (found,) = json.loads(run("analyze", "walk.bvh", "--json").stdout)
    assert found["file"] == "walk.bvh"
    assert found["reading"] == mien.read(mien.load("walk.bvh")).as_data()
    assert list(found["features"]) == [d.name for d in SELECTED]
    assert list(found["effort"]) == list(EFFORT)
    assert found["effort"]["weight"] == effort(mien.load("walk.bvh")).clip[0]
    (every,) = json.loads(run("analyze", "walk.bvh", "--json", "--features").stdout)
    assert list(every["features"]) == ALL
    (frames,) = json.loads(run("analyze", "walk.bvh", "--json", "--features", "--per", "frame").stdout)
    assert len(frames["times"]) == len(frames["features"]["pelvis_speed"]) == 46


def test_a_clip_that_fails_does_not_stop_the_others(folder: Path, run: Run) -> None:
    Path("bad.bvh").write_text("HIERARCHY\nnothing")
    result = run("analyze", "bad.bvh", "walk.bvh", "--features")
    assert result.exit_code == 1
    assert [row["file"] for row in rows(result.stdout)] == ["walk.bvh"]
    assert "mien: bad.bvh" in result.stderr
    assert "1 of 2 clips analysed, 1 failed" in result.stderr
    alone = run("analyze", "bad.bvh")
    assert (alone.exit_code, alone.stdout) == (2, "")
    assert json.loads(run("analyze", "bad.bvh", "--json").stdout) == []


def test_a_skeleton_that_is_no_body(folder: Path, run: Run) -> None:
    Path("rod.bvh").write_text(
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
        "End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n"
    )
    result = run("analyze", "rod.bvh")
    assert result.exit_code == 2
    assert "--map" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["walk.bvh", "--per", "windows"], "did you mean 'window'?"),
        (["walk.bvh", "--per", "frame"], "--per frame goes with --features"),
        (["walk.bvh", "-o", "table.xlsx"], "a table is .csv or .parquet"),
        (["walk.bvh", "--plot", "walk.svg"], "a picture is .png"),
        (["walk.bvh", "brisk.bvh", "--plot", "both.png"], "--plot shows one clip, but there are 2"),
        (["none.bvh"], "there is no such file"),
        (["walk.bvh", "--disc", "disc.svg"], "a disc is .html or .png"),
        (["walk.bvh", "--neutral", "none.bvh"], "none.bvh: there is no such file"),
        (["walk.bvh", "--model", "none.json"], "none.json: cannot be read as a model"),
        (["walk.bvh", "--model", "walk.bvh"], "is no model of emotion"),
    ],
)
def test_what_it_refuses(folder: Path, run: Run, arguments: list[str], said: str) -> None:
    result = run("analyze", *arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert said in result.stderr


def test_one_frame(folder: Path, run: Run) -> None:
    mien.save(samples.still(seconds=0.0).motion, "one.bvh")
    assert run("analyze", "one.bvh", "--plot", "one.png", "--features").exit_code == 0


def test_what_a_clip_expresses(folder: Path, run: Run) -> None:
    mien.save(mien.edit(mien.load("walk.bvh"), "sad"), "low.bvh")
    found = mien.read(mien.load("low.bvh"), neutral=mien.load("walk.bvh"))
    lines = run("analyze", "low.bvh", "--neutral", "walk.bvh").stdout.splitlines()
    assert lines[0] == "low.bvh, against walk.bvh"
    place = found.place
    assert lines[1] == f"  valence {place.valence:+.2f}, arousal {place.arousal:+.2f}: mild and unpleasant"
    assert lines[2] == f"  nearest words: {', '.join(found.words)}"
    assert lines[3].startswith(f"  acted like: sad {100 * found.labels['sad']:.0f} %")
    assert lines[4] == f"  because: {'; '.join(map(str, found.why))}"
    assert "BODY" not in "".join(lines)


def test_an_edited_clip_is_read_against_its_source(folder: Path, run: Run) -> None:
    run("edit", "walk.bvh", "-e", "sad", "-o", "new/low.bvh")
    by_itself, told = (
        json.loads(run("analyze", "new/low.bvh", *more, "--json").stdout)[0]["reading"]
        for more in ([], ["--neutral", "walk.bvh"])
    )
    assert by_itself == told
    assert by_itself["against"] == "neutral"
    assert "a guess, --neutral makes it sure" in run("analyze", "walk.bvh").stdout


def test_a_model_of_ones_own(folder: Path, run: Run) -> None:
    from mien.emotion.model import format_model, shipped_model

    text = format_model(shipped_model())
    Path("own.json").write_text(text.replace('"tired"', '"weary"'), encoding="utf-8")
    (own,) = json.loads(run("analyze", "walk.bvh", "--model", "own.json", "--json").stdout)
    (usual,) = json.loads(run("analyze", "walk.bvh", "--json").stdout)
    assert own["reading"]["labels"]["weary"] == usual["reading"]["labels"]["tired"]


def test_what_clips_express_in_a_table(folder: Path, run: Run) -> None:
    table = rows(run("analyze", ".", "--features", "--neutral", "walk.bvh").stdout)
    for row in table:
        found = mien.read(mien.load(row["file"]), neutral=mien.load("walk.bvh"))
        label, probability = next(iter(found.labels.items()))
        assert (float(row["valence"]), float(row["arousal"])) == found.place
        assert (row["quadrant"], row["label"], row["against"]) == (found.quadrant, label, "neutral")
        assert float(row["probability"]) == probability
    assert (table[-1]["file"], table[-1]["quadrant"]) == ("walk.bvh", "neutral")
    windows = rows(run("analyze", "walk.bvh", "--features", "--per", "window").stdout)
    assert not set(READ) & set(windows[0])


def test_a_map_of_a_folder(folder: Path, run: Run) -> None:
    from PIL import Image

    Path("<b>&.bvh").write_bytes(Path("walk.bvh").read_bytes())
    result = run("analyze", ".", "--disc", "new/map.html")
    assert (result.exit_code, result.stdout) == (0, "new/map.html\n")
    page = Path("new/map.html").read_text(encoding="utf-8")
    for name in ("walk.bvh", "brisk.bvh", "deeper/tired_walk.bvh", "&lt;b&gt;&amp;.bvh"):
        assert f"<title>{name}\n" in page
        assert f"<td>{name}</td>" in page
    assert "<b>" not in page
    assert str(folder) not in page
    again = run("analyze", ".", "--disc", "new/map.html")
    assert (again.exit_code, again.stdout) == (2, "")
    assert (
        run("analyze", "walk.bvh", "--disc", "map.png", "--plot", "walk.png").stdout == "walk.png\nmap.png\n"
    )
    with Image.open("map.png") as picture:
        assert picture.size == (1200, 1200)


def test_the_bar_over_a_folder(folder: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every clip goes through the bar, by the number of clips."""
    from mien.cli import analyze

    seen: list[tuple[int, str]] = []

    def watched(items: object, *, total: int, doing: str) -> object:
        seen.append((total, doing))
        return items

    monkeypatch.setattr(analyze, "progress", watched)
    run("analyze", ".", "--disc", "map.html")
    assert seen == [(3, "analysing")]


def test_a_table_of_readings(folder: Path, run: Run) -> None:
    """Without --features a table holds what a person would read, and why."""
    run("edit", "walk.bvh", "-e", "sad", "-o", "new/low.bvh")
    run("analyze", "walk.bvh", "new/low.bvh", "-o", "read.csv")
    walk, low = rows(Path("read.csv").read_text())
    assert list(walk) == ["file", "duration", *READ]
    assert (walk["against"], walk["neutral"]) == ("usual", "")
    assert (low["against"], low["neutral"]) == ("neutral", "walk.bvh")
    assert low["because"] in run("analyze", "new/low.bvh").stdout
    run("analyze", "walk.bvh", "--per", "window", "-o", "windows.csv")
    assert len(rows(Path("windows.csv").read_text())) > 1


def test_laban_tells_the_reading_too(folder: Path, run: Run) -> None:
    assert run("analyze", "walk.bvh", "--laban").stdout.startswith(run("analyze", "walk.bvh").stdout)


def test_every_clip_against_its_own_neutral_one(folder: Path, run: Run) -> None:
    """Found by names: the neutral take of the same content and performer."""
    Path("takes").mkdir()
    for content, make in {"walk": samples.walk, "wave": samples.wave}.items():
        rest = make(seconds=2.0, fps=30.0).motion
        mien.save(rest, f"takes/{content}_calm.bvh")
        mien.save(mien.edit(rest, "sad"), f"takes/{content}_low.bvh")
    mien.save(samples.knock(seconds=2.0, fps=30.0).motion, "takes/knock_low.bvh")
    pattern = ["--labels", "(?P<content>.+)_(?P<label>.+)"]
    result = run("analyze", "takes", "--neutral", "calm", *pattern, "--json", "--jobs", "2")
    found = {entry["file"]: entry.get("neutral", "") for entry in json.loads(result.stdout)}
    for content in ("walk", "wave"):
        assert found[f"takes/{content}_low.bvh"] == found[f"takes/{content}_calm.bvh"]
        assert found[f"takes/{content}_low.bvh"] == f"takes/{content}_calm.bvh"
    assert found["takes/knock_low.bvh"] == ""
    assert "1 of 5 clips have no neutral take" in result.stderr
    near = json.loads(run("find", "takes", "--like", "sad", "--neutral", "calm", *pattern, "--json").stdout)
    guessed = {entry["file"] for entry in near if entry["against"] == "usual"}
    assert guessed == {"takes/knock_low.bvh"}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--labels", "(?P<label>.+)"], "give --neutral LABEL too"),
        (
            ["--labels", "(?P<label>.+)", "--neutral", "wolk"],
            "--neutral: there is no label 'wolk'; did you mean",
        ),
        (["--neutral", "normal"], "a label needs --labels"),
        (["--neutral", "rod.bvh"], "mien: rod.bvh: not found in this skeleton"),
        (["--jobs", "-2"], "--jobs"),
    ],
)
def test_neutral_clips_it_refuses(folder: Path, run: Run, arguments: list[str], said: str) -> None:
    Path("rod.bvh").write_text(
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
        "End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n"
    )
    result = run("analyze", "walk.bvh", *arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert said in result.stderr


def test_a_clip_of_no_length_is_told(folder: Path, run: Run) -> None:
    mien.save(samples.still(seconds=0.0).motion, "one.bvh")
    assert "too short to say how somebody moves" in run("analyze", "one.bvh").stdout
    assert "too short" not in run("analyze", "walk.bvh").stdout
