"""What a blend was made of, as a file beside it that a person can read."""

import hashlib
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

from .multitarget import Mixture
from .shares import BANDS

SUFFIX = ".blend.toml"  # what the file beside a blend is called, after the clip's own name


def record_of(clip: Path) -> Path:
    """Return the file that says what the blend ``clip`` was made of. It is no recipe: those need one clip."""
    return clip.with_name(clip.name + SUFFIX)


def ingredients(files: Sequence[Path], made: Mixture) -> list[dict[str, Any]]:
    """Return what was taken of each clip, as plain data: its weights, its first and last frame."""
    found = []
    for i, (file, (first, last)) in enumerate(zip(files, made.frames.tolist(), strict=True)):
        weights = dict(zip(("weight", *BANDS), made.shares.of(i), strict=True))
        found.append({"input": file.name, "first_frame": first, "last_frame": last, **weights})
    return found


def format_record(files: Sequence[Path], target: Path, made: Mixture, read: Mapping[str, Any]) -> str:
    """Return the text of the file beside a blend; ``read`` are the options that the clips were read with."""
    import tomli_w

    about = {"output": target.name, "mien": version("mien"), "align": made.method}
    about |= {key: value for key, value in read.items() if value}
    clips = ingredients(files, made)
    for file, clip in zip(files, clips, strict=True):
        clip["input_sha256"] = hashlib.sha256(file.read_bytes()).hexdigest()
    tables = [f"[[clips]]\n{tomli_w.dumps(clip)}" for clip in clips]
    return "\n".join([tomli_w.dumps(about), *tables])
