"""Steps and recipes: what is to be done to a motion, as data.

A step names an edit and its parameters; a recipe is a named list of steps. Both are plain data that
the history of a motion, a preset file, the command line and the studio share. Whether the names and
values fit an edit is checked where the edits are known (``mien.edits.pipeline.check``).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

VERSION = 1


@dataclass(frozen=True)
class Step:
    """One edit with its parameters, how strongly, on which body parts and when.

    ``strength`` 0 changes nothing, 1 is as written, up to 2 exaggerates. ``parts`` empty means the
    whole body. ``span`` is ``(start, end)`` in seconds, ``None`` the whole clip; the effect grows
    and fades over ``ease`` seconds inside it.
    """

    edit: str
    parameters: Mapping[str, Any] = field(default_factory=dict)
    strength: float = 1.0
    parts: tuple[str, ...] = ()
    span: tuple[float, float] | None = None
    ease: float = 0.25


@dataclass(frozen=True)
class Recipe:
    """A named list of steps, with what it is for and where its numbers come from."""

    name: str
    steps: tuple[Step, ...]
    description: str = ""
    evidence: str = ""
    sources: Mapping[str, str] = field(default_factory=dict)
    version: int = VERSION
