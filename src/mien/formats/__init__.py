"""Files in and out: ``load`` and ``save``, one module a format.

A format is a line in ``FORMATS``: its suffix, and a module with ``parse(data, ...) -> Motion`` and
``render(motion) -> bytes``.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import Protocol, cast

from ..errors import FormatError, MienError, unknown
from ..motion import Motion, require_motion
from . import files


class Format(Protocol):
    """What a format's module must offer."""

    def parse(self, data: bytes, where: str, *, fps: float | None, salvage: bool) -> Motion:
        """Make a motion of a file's bytes; ``where`` is the file's name, for errors and the motion's name."""
        ...

    def render(self, motion: Motion) -> bytes:
        """Return the bytes of the file that holds ``motion``."""
        ...


@dataclass(frozen=True)
class Entry:
    """A format in the registry: the module that reads and writes it, and what it is called."""

    module: str
    title: str


FORMATS: Mapping[str, Entry] = {".bvh": Entry("bvh", "Biovision hierarchy")}


def load(
    path: str | PathLike[str],
    *,
    fps: float | None = None,
    salvage: bool = False,
    roles: Mapping[str, str] | None = None,
) -> Motion:
    """Read a motion from a file; the suffix says which format it is.

    ``fps`` (above 0) overrides the frame rate the file claims. ``salvage`` takes what is whole out of
    a damaged file instead of refusing it. ``roles`` (role -> joint name) tells edits of a body that
    they do not find by themselves. Raises ``FormatError`` with file, line and remedy.
    """
    if fps is not None and not 0 < fps < float("inf"):
        raise MienError(f"fps must be above 0, got {fps}")
    path = Path(path)
    motion = _module(path).parse(files.read(path), path.name, fps=fps, salvage=salvage)
    return motion.with_(skeleton=replace(motion.skeleton, roles=dict(roles))) if roles else motion


def save(motion: Motion, path: str | PathLike[str], *, force: bool = False) -> None:
    """Write a motion to a file; the suffix says which format it is.

    What no edit touched is written as it was read. The file appears whole or not at all; one that
    exists is replaced only with ``force``. Raises ``FormatError`` when that cannot be done.
    """
    require_motion(motion)
    path = Path(path)
    module = _module(path)
    files.check_target(path, force=force)
    files.write(path, module.render(motion))


def _module(path: Path) -> Format:
    entry = FORMATS.get(path.suffix.lower())
    if entry is None:
        raise FormatError(f"{path.name}: {unknown('format', path.suffix, FORMATS)}")
    return cast(Format, import_module(f"{__name__}.{entry.module}"))
