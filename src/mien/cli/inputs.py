"""Which files a command reads and writes: patterns and folders expanded by us, nothing overwritten."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from glob import glob
from pathlib import Path

from ..errors import FormatError, MienError


@dataclass(frozen=True)
class Input:
    """A clip to read, and where it lies below the folder that was named (``.`` for a single file)."""

    path: Path
    below: Path = Path()


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
        clips = [Input(p, p.parent.relative_to(path)) for p in sorted(path.rglob("*")) if _is_clip(p)]
        if not clips:
            raise FormatError(f"{pattern}: no clip in this folder")
        return clips
    if path.exists() or not any(sign in pattern for sign in "*?["):
        if not path.exists():
            raise FormatError(f"{pattern}: no such file{_nearest(path)}")
        return [Input(path)]
    names = sorted(glob(pattern, recursive=True))
    clips = [Input(Path(name)) for name in names if Path(name).is_file()]
    if not clips:
        raise FormatError(f"{pattern}: no file matches this pattern")
    return clips


def _is_clip(path: Path) -> bool:
    from ..formats import FORMATS

    return path.suffix.lower() in FORMATS and path.is_file()


def _nearest(path: Path) -> str:
    if not path.parent.is_dir():
        return f" (there is no folder {path.parent})"
    near = get_close_matches(path.name, [p.name for p in path.parent.iterdir()], n=1)
    return f"; did you mean {path.with_name(near[0])}?" if near else ""


def outputs(
    clips: Sequence[Input], out: Path | None, *, label: str, suffix: str = "", force: bool = False
) -> list[Path]:
    """Return the file to write for each clip: ``<stem>_<label>`` beside it or in the folder ``out``.

    ``out`` is a file (for one clip) or a folder. Raises ``MienError`` when two clips would be written
    to one file, when a file exists and ``force`` is not given, or when one clip's output is another's
    input.
    """
    names = [f"{clip.path.stem}_{label.replace('/', '-')}{suffix or clip.path.suffix}" for clip in clips]
    if out is None:
        targets = [clip.path.with_name(name) for clip, name in zip(clips, names, strict=True)]
    elif _is_folder(out):
        targets = [out / clip.below / name for clip, name in zip(clips, names, strict=True)]
    elif len(clips) > 1:
        raise MienError(f"{out} is one file, but there are {len(clips)} clips to write; name a folder")
    else:
        targets = [out]
    _refuse_clashes([clip.path for clip in clips], targets)
    if not force:
        refuse_existing(targets)
    return targets


def refuse_existing(targets: Iterable[Path]) -> None:
    """Raise ``MienError`` when one of the files is there already."""
    there = [target for target in targets if target.exists()]
    if there:
        more = f" (and {len(there) - 1} more)" if len(there) > 1 else ""
        raise MienError(
            f"{there[0]}{more} exists already; use --force to overwrite it, or -o to name another"
        )


def _is_folder(out: Path) -> bool:
    return out.is_dir() or not out.suffix


def _refuse_clashes(sources: Sequence[Path], targets: Sequence[Path]) -> None:
    owner: dict[Path, Path] = {}
    read = {source.resolve(): source for source in sources}
    for source, target in zip(sources, targets, strict=True):
        key = target.resolve()
        if key in owner:
            raise MienError(f"{owner[key]} and {source} would both be written to {target}; edit them apart")
        if key in read and read[key] != source:
            raise MienError(f"{target}, the output of {source}, is another input; choose another -o")
        owner[key] = source
