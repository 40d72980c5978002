"""Steps and recipes: what is to be done to a motion, as data.

A step names an edit and its parameters; a recipe is a named list of steps. Both are plain data that
the history of a motion, a preset file, the command line and the studio share. Whether the names and
values fit an edit is checked where the edits are known (``mien.edits.pipeline.check``).
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from numbers import Real
from typing import Any

from .curve import Varying, read_varying
from .errors import RecipeError

VERSION = 1


@dataclass(frozen=True)
class Step:
    """One edit with its parameters, how strongly, on which body parts and when.

    ``strength`` 0 changes nothing, 1 is as written, up to 2 exaggerates. ``parts`` empty means the
    whole body. ``span`` is ``(start, end)`` in seconds, ``None`` the whole clip; the effect grows
    and fades over ``ease`` seconds inside it. ``strength`` and any parameter that is a number may also be
    a curve through ``(seconds, value)``, such as ``((0, 0), (1.5, 1))``. ``parts``, ``span`` and
    ``strength`` may be given as the command line takes them: ``"head,arms"``, ``"0.5,2"``, ``"0:0,1.5:1"``.
    """

    edit: str
    parameters: Mapping[str, Any] = field(default_factory=dict)
    strength: Varying = 1.0
    parts: tuple[str, ...] = ()
    span: tuple[float, float] | None = None
    ease: float = 0.25

    def __post_init__(self) -> None:
        if not isinstance(self.edit, str):
            raise RecipeError(f"a step needs the name of an edit, such as 'posture', got {self.edit!r:.60}")
        if not isinstance(self.parameters, Mapping):
            given = f"{self.parameters!r:.60}"
            raise RecipeError(
                f"{self.edit}: parameters must be a mapping such as {{'head': 20.0}}, got {given}"
            )
        require_number(f"{self.edit}: ease", self.ease)
        object.__setattr__(self, "strength", read_varying(f"{self.edit}: strength", self.strength))
        object.__setattr__(self, "parts", read_parts(self.parts))
        object.__setattr__(self, "span", read_span(self.span))

    def __repr__(self) -> str:
        """Return the call that makes the step, without what stands at its default."""
        given = [repr(self.edit)]
        given += [repr(dict(self.parameters))] if self.parameters else []
        for f in fields(self)[2:]:
            value = getattr(self, f.name)
            given += [f"{f.name}={value!r}"] if value != f.default else []
        return f"Step({', '.join(given)})"


@dataclass(frozen=True)
class Recipe:
    """A named list of steps, with what it is for and where its numbers come from.

    ``safe`` asks that what is done with it is checked, and mended where it breaks the body.
    """

    name: str
    steps: tuple[Step, ...]
    description: str = ""
    evidence: str = ""
    sources: Mapping[str, str] = field(default_factory=dict)
    version: int = VERSION
    safe: bool = False


def read_parts(parts: str | Iterable[str] | None) -> tuple[str, ...]:
    """Return body parts given as a list, or as one text with commas between them.

    Raises ``RecipeError`` for anything else. Whether there are such parts is checked where bodies are known.
    """
    if parts is None:
        return ()
    if isinstance(parts, str):
        return tuple(part.strip() for part in parts.split(",") if part.strip())
    found = tuple(parts) if isinstance(parts, Iterable) else (parts,)
    if not all(isinstance(part, str) for part in found):
        raise RecipeError(f"parts must be names such as 'head,arms' or ('head', 'arms'), got {parts!r:.60}")
    return found


def read_span(span: str | Sequence[float] | None) -> tuple[float, float] | None:
    """Return a span given as two times in seconds, or as one text such as ``"0.5,2"``; None is None.

    Raises ``RecipeError`` for anything else.
    """
    if span is None:
        return None
    try:
        items = [float(item) for item in span.split(",")] if isinstance(span, str) else list(span)
        if all(map(_is_number, items)):
            start, end = items
            return start, end
    except (TypeError, ValueError):
        pass
    raise RecipeError(f"span must be two times in seconds, such as (0.5, 2.0), got {span!r:.60}") from None


def require_number(what: str, value: object) -> None:
    """Raise ``RecipeError`` for what is no number; ``what`` names it in the sentence."""
    if not _is_number(value):
        raise RecipeError(f"{what} must be a number, got {value!r:.60}")


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)
