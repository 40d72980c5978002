"""The few kinds of error mien raises. Every message says what, where, and what to do."""

from collections.abc import Iterable


class MienError(ValueError):
    """Base of every error that mien raises on purpose."""


class FormatError(MienError):
    """A file cannot be read or written; the message names the file and, where known, the line."""


class BodyError(MienError):
    """A skeleton lacks joints that an operation needs; the message says how to give a map."""


class RecipeError(MienError):
    """An edit, parameter, body part or recipe that does not exist or does not fit."""


def unknown(kind: str, name: object, known: Iterable[str]) -> str:
    """Return the sentence for an unknown name: what was asked, the nearest name, all names."""
    import difflib

    names = sorted(known)
    near = difflib.get_close_matches(str(name), names, n=1, cutoff=0.5)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    return f"there is no {kind} {name!r}{hint} (known: {', '.join(names) or 'none'})"


def sentence(error: BaseException) -> str:
    """Return what went wrong in one sentence, for somebody who does not read tracebacks."""
    if isinstance(error, MienError):
        return str(error)
    if isinstance(error, OSError):
        return f"{error.filename}: {error.strerror}" if error.filename else str(error)
    if isinstance(error, MemoryError):
        return "not enough memory for this clip"
    kind = type(error).__name__
    return f"an error in mien itself, {kind}: {error} (set MIEN_DEBUG=1 to see where, and please report it)"
