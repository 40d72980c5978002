"""Which files a command reads and writes: patterns and folders expanded by us, nothing overwritten."""

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from glob import glob
from pathlib import Path

from ..curve import Varying, values
from ..errors import FormatError, MienError
from ..formats import files
from .report import note

STDOUT = Path("-")


@dataclass(frozen=True)
class Input:
    """A clip to read, where it lies below the folder that was named, and whether a folder was."""

    path: Path
    below: Path = Path()
    of_folder: bool = False


def expand(patterns: Iterable[str]) -> list[Input]:
    """Return the clips meant by file names, folders (all clips below) and patterns (``*``, ``?``, ``**``).

    Each file once, in the order named; inside a folder or pattern sorted by name. Raises ``FormatError``
    when something names no clip.
    """
    found: dict[Path, Input] = {}
    for pattern in patterns:
        for clip in _matches(pattern):
            found.setdefault(clip.path.resolve(), clip)
    return list(found.values())


def _matches(pattern: str) -> list[Input]:
    path = Path(pattern)
    if path.is_dir():
        clips = [Input(p, p.parent.relative_to(path), True) for p in sorted(path.rglob("*")) if _is_clip(p)]
        if not clips:
            raise FormatError(f"{pattern}: no clip in this folder")
        return clips
    if path.exists() or not any(sign in pattern for sign in "*?["):
        return [Input(existing(path))]
    names = sorted(glob(pattern, recursive=True))
    clips = [Input(Path(name)) for name in names if Path(name).is_file()]
    if not clips:
        raise FormatError(f"{pattern}: no file matches this pattern")
    return clips


def existing(path: Path) -> Path:
    """Return ``path``; raise ``FormatError`` with the nearest name when there is no such file."""
    if not path.exists():
        raise FormatError(f"{path}: there is no such file{_nearest(path)}")
    return path


def passed_over(clips: Sequence[Input], made: Callable[[Path], bool]) -> list[Input]:
    """Return the clips to edit: of those found in folders, not the ones that were ``made`` by editing.

    Says on stderr how many were left out; raises ``FormatError`` when none is left.
    """
    left = [clip for clip in clips if not (clip.of_folder and made(clip.path))]
    gone = len(clips) - len(left)
    if gone:
        what = "clip that mien made" if gone == 1 else "clips that mien made"
        if not left:
            raise FormatError(f"nothing but {gone} {what} in this folder; name a clip to edit it")
        note(f"mien: passed over {gone} {what} (name one to edit it)")
    return left


def _is_clip(path: Path) -> bool:
    from ..formats import FORMATS

    return path.suffix.lower() in FORMATS and path.is_file()


def _nearest(path: Path) -> str:
    if not path.parent.is_dir():
        return f" (there is no folder {path.parent})"
    near = get_close_matches(path.name, [p.name for p in path.parent.iterdir()], n=1, cutoff=0.7)
    return f"; did you mean {path.with_name(near[0])}?" if near else ""


def label(name: str, strength: Varying, parts: Sequence[str], span: tuple[float, float] | None) -> str:
    """Return what to put behind a clip's name: ``sad``, ``sad_0-1`` or ``sad_0.5_arms-head_1-3.5s``."""
    words = [_safe(name) or "edited"]
    words += ["-".join(f"{value:g}" for value in values(strength))] if strength != 1.0 else []
    words += ["-".join(parts)] if parts else []
    words += [f"{span[0]:g}-{span[1]:g}s"] if span else []
    return "_".join(words)


def _safe(name: str) -> str:
    """Return a name as part of a file's name: letters, digits and a few signs, the rest as ``-``."""
    return re.sub(r"[^\w.+-]+", "-", name).strip("-.")


def outputs(
    clips: Sequence[Input], out: Path | None, *, label: str, suffix: str = "", doing: str = "edit"
) -> list[Path]:
    """Return the file to write for each clip: ``<stem>_<label>`` beside it or in the folder ``out``.

    ``out`` is a file (for one clip) or a folder. Raises ``MienError`` when two clips would be written
    to one file, or when one clip's output is another's input.
    """
    names = [f"{clip.path.stem}_{label}{suffix or clip.path.suffix}" for clip in clips]
    if out is None:
        targets = [clip.path.with_name(name) for clip, name in zip(clips, names, strict=True)]
    elif out == STDOUT:
        raise MienError("stdout (-o -) takes one clip, from mien edit; name a file or a folder")
    elif _is_folder(out):
        targets = [out / clip.below / name for clip, name in zip(clips, names, strict=True)]
    elif len(clips) > 1:
        raise MienError(f"{out} is one file, but there are {len(clips)} clips to write; name a folder")
    else:
        targets = [out]
    for target in targets:
        files.check_folder(target.parent)
    _refuse_clashes([clip.path for clip in clips], targets, doing)
    return targets


def refuse_existing(targets: Iterable[Path]) -> None:
    """Raise ``FormatError`` when one of the files is there already."""
    there = [target for target in targets if target.exists()]
    if there:
        raise files.exists_already(there[0], more=len(there) - 1)


def _is_folder(out: Path) -> bool:
    return out.is_dir() or not out.suffix


def _refuse_clashes(sources: Sequence[Path], targets: Sequence[Path], doing: str) -> None:
    owner: dict[Path, Path] = {}
    read = {source.resolve(): source for source in sources}
    for source, target in zip(sources, targets, strict=True):
        key = target.resolve()
        if key in owner:
            raise MienError(
                f"{owner[key]} and {source} would both be written to {target}; {doing} them apart"
            )
        if key in read and read[key] != source:
            raise MienError(f"{target}, the output of {source}, is another input; choose another -o")
        owner[key] = source
