from pathlib import Path

import pytest

from mien.cli.inputs import Input, expand, label, outputs, passed_over, refuse_existing
from mien.errors import FormatError, MienError


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    for name in ("b.bvh", "a.BVH", "x.txt", "deep/er/c.bvh", "deep/a.bvh", "odd[1].bvh", "odd1.bvh"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("")
    (tmp_path / "empty").mkdir()
    return tmp_path


def names(*patterns: str) -> list[str]:
    return [clip.path.as_posix() for clip in expand(patterns)]


def test_files_patterns_and_folders(tree: Path) -> None:
    assert names("b.bvh") == ["b.bvh"]
    assert names("?.bvh") == ["b.bvh"]
    assert names("deep/**/*.bvh") == ["deep/a.bvh", "deep/er/c.bvh"]
    assert names("deep") == ["deep/a.bvh", "deep/er/c.bvh"], "a folder means every clip below it"
    assert names(".") == ["a.BVH", "b.bvh", "deep/a.bvh", "deep/er/c.bvh", "odd1.bvh", "odd[1].bvh"]
    assert names("b.bvh", "*.bvh", "./b.bvh") == ["b.bvh", "odd1.bvh", "odd[1].bvh"], "each file once"


def test_a_file_with_brackets_in_its_name_is_meant_literally(tree: Path) -> None:
    assert names("odd[1].bvh") == ["odd[1].bvh"]
    (tree / "odd[1].bvh").unlink()
    assert names("odd[1].bvh") == ["odd1.bvh"], "without such a file it is a pattern"


@pytest.mark.parametrize(
    ("pattern", "words"),
    [
        ("bb.bvh", ["bb.bvh: there is no such file", "did you mean b.bvh"]),
        ("nowhere/a.bvh", ["no such file", "no folder nowhere"]),
        ("*.fbx", ["no file matches"]),
        ("empty", ["no clip in this folder"]),
    ],
)
def test_what_names_no_clip_is_an_error(tree: Path, pattern: str, words: list[str]) -> None:
    with pytest.raises(FormatError) as error:
        expand(["b.bvh", pattern])
    assert all(word in str(error.value) for word in words)


def clip(path: str, below: str = "") -> Input:
    return Input(Path(path), Path(below))


def test_outputs_beside_in_a_folder_and_as_a_file(tree: Path) -> None:
    two = [clip("b.bvh"), clip("deep/er/c.bvh", "er")]
    assert outputs(two, None, label="sad") == [Path("b_sad.bvh"), Path("deep/er/c_sad.bvh")]
    assert outputs(two, Path("out"), label="sad") == [
        Path("out/b_sad.bvh"),
        Path("out/er/c_sad.bvh"),
    ]
    assert outputs(two[:1], Path("new.bvh"), label="sad") == [Path("new.bvh")]
    assert outputs(two[:1], None, label="strip", suffix=".png") == [Path("b_strip.png")]


def test_outputs_that_clash_are_refused_even_by_force(tree: Path) -> None:
    with pytest.raises(MienError, match=r"deep/a\.bvh and \S*a\.bvh would both be written to out/a_sad\.bvh"):
        outputs([clip("deep/a.bvh"), clip("a.bvh")], Path("out"), label="sad")
    with pytest.raises(MienError, match="one file, but there are 2 clips"):
        outputs([clip("b.bvh"), clip("odd1.bvh")], Path("new.bvh"), label="sad")
    with pytest.raises(MienError, match="is another input"):
        outputs([clip("b.bvh"), clip("b_sad.bvh")], None, label="sad")


def test_clips_that_clash_are_to_be_done_apart(tree: Path) -> None:
    with pytest.raises(MienError, match="render them apart"):
        outputs([clip("deep/a.bvh"), clip("a.bvh")], Path("out"), label="strip", doing="render")


def test_existing_files_are_named(tree: Path) -> None:
    refuse_existing([Path("new.bvh")])
    with pytest.raises(MienError, match=r"^b\.bvh \(and 1 more\) exists already: .*--force.*force=True"):
        refuse_existing([Path("new.bvh"), Path("b.bvh"), Path("odd1.bvh")])


def test_a_name_says_what_was_asked_for_and_is_safe() -> None:
    assert label("sad", 1.0, (), None) == "sad"
    assert label("s0/sad", 0.5, ("arms", "head"), (1.0, 3.5)) == "s0-sad_0.5_arms-head_1-3.5s"
    assert label("worn out", 1.0, ("left_arm",), None) == "worn-out_left_arm"
    assert label('../a\\b:c*"?<>|', 1.0, (), None) == "a-b-c"
    assert label("müde", 1.0, (), None) == "müde"
    assert label("..", 1.0, (), None) == "edited"


def test_clips_that_mien_made_are_passed_over_in_a_folder_only(
    tree: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def made(path: Path) -> bool:
        return path.name == "a.bvh"

    assert [c.path.as_posix() for c in passed_over(expand(["deep"]), made)] == ["deep/er/c.bvh"]
    assert "passed over 1 clip that mien made" in capsys.readouterr().err
    assert len(passed_over(expand(["deep/a.bvh", "deep/*.bvh"]), made)) == 1
    assert capsys.readouterr().err == ""
    with pytest.raises(FormatError, match="nothing but 2 clips that mien made"):
        passed_over(expand(["deep"]), lambda path: True)
