"""The file beside a blend says what is in it, in TOML that reads back."""

import hashlib
import tomllib
from pathlib import Path

import mien
from mien import samples
from mien.styles.multitarget import mix
from mien.styles.record import format_record, ingredients, record_of


def test_the_record_reads_back(tmp_path: Path) -> None:
    motions = [samples.walk(seconds=2.0).motion, samples.tired_walk(seconds=3.0).motion]
    files = [tmp_path / name for name in ("a.bvh", "b.bvh")]
    for motion, file in zip(motions, files, strict=True):
        mien.save(motion, file)
    made = mix(motions, [0.25, 0.75], bands={"low": [0, 1]})
    text = format_record(files, tmp_path / "c.bvh", made, {"fps": 60.0, "salvage": False, "roles": {}})
    found = tomllib.loads(text)
    assert found["output"] == "c.bvh"
    assert (found["align"], found["mien"], found["fps"]) == ("steps", mien.__version__, 60.0)
    assert "salvage" not in found
    one, other = found["clips"]
    assert one["input_sha256"] == hashlib.sha256(files[0].read_bytes()).hexdigest()
    assert [other[key] for key in ("input", "weight", "low", "mid", "high")] == [
        "b.bvh",
        0.75,
        1.0,
        0.75,
        0.75,
    ]
    assert [one["first_frame"], one["last_frame"]] == made.frames[0].tolist()
    assert ingredients(files, made)[1]["last_frame"] == made.frames[1][1]


def test_it_is_named_after_the_clip_and_not_as_a_recipe() -> None:
    assert record_of(Path("a/b.bvh")) == Path("a/b.bvh.blend.toml")
