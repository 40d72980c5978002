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
    """Return the sentence for an unknown name: what was asked, a name that is close, all names."""
    names = sorted(set(known))
    near = _nearest(str(name), names)
    hint = f"; did you mean {near!r}?" if near else ""
    return f"there is no {kind} {name!r}{hint} (known: {', '.join(names) or 'none'})"


def _nearest(name: str, known: list[str]) -> str | None:
    """Return the known name that ``name`` is a slip of the fingers from; None where nothing is that close."""
    slips = {other: _slips(name.casefold(), other.casefold()) for other in known}
    near = min(known, key=slips.__getitem__, default="")
    return near if near and slips[near] <= (1 if len(name) < 6 else 2) else None


def _slips(one: str, other: str) -> int:
    """Return how many letters are left out, added, changed or swapped with the next (Damerau 1964)."""
    rows = [list(range(len(other) + 1))]
    for i, x in enumerate(one):
        row = [i + 1]
        for j, y in enumerate(other):
            row.append(min(row[j] + 1, rows[i][j + 1] + 1, rows[i][j] + (x != y)))
            if i and j and x == other[j - 1] and y == one[i - 1]:
                row[-1] = min(row[-1], rows[i - 1][j - 1] + 1)
        rows.append(row)
    return rows[-1][-1]


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
