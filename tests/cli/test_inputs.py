from pathlib import Path

import pytest

from mien.cli.inputs import Input, expand, outputs
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
        ("bb.bvh", ["bb.bvh: no such file", "did you mean b.bvh"]),
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
    assert outputs(two, Path("out"), label="s0/sad") == [
        Path("out/b_s0-sad.bvh"),
        Path("out/er/c_s0-sad.bvh"),
    ]
    assert outputs(two[:1], Path("new.bvh"), label="sad") == [Path("new.bvh")]
    assert outputs(two[:1], None, label="strip", suffix=".png") == [Path("b_strip.png")]


def test_outputs_that_clash_are_refused_even_by_force(tree: Path) -> None:
    with pytest.raises(MienError, match=r"deep/a\.bvh and \S*a\.bvh would both be written to out/a_sad\.bvh"):
        outputs([clip("deep/a.bvh"), clip("a.bvh")], Path("out"), label="sad", force=True)
    with pytest.raises(MienError, match="one file, but there are 2 clips"):
        outputs([clip("b.bvh"), clip("odd1.bvh")], Path("new.bvh"), label="sad", force=True)
    with pytest.raises(MienError, match="is another input"):
        outputs([clip("b.bvh"), clip("b_sad.bvh")], None, label="sad", force=True)


def test_existing_files_need_force(tree: Path) -> None:
    with pytest.raises(MienError, match=r"b\.bvh exists already; use --force"):
        outputs([clip("b.bvh")], Path("b.bvh"), label="sad")
    assert outputs([clip("b.bvh")], Path("b.bvh"), label="sad", force=True) == [Path("b.bvh")]
