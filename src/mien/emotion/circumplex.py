"""Emotion words as points on a disc: valence to the right, arousal upwards (Russell 1980).

Two tables of the same study stand in ``circumplex.toml``, with their sources. They disagree: ``ratings`` is
the default, because in ``circle`` anger is hardly unpleasant and pleased is calm. A point is ``(valence,
arousal)`` within the unit disc.
"""

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from ..errors import RecipeError, unknown

TABLES = ("ratings", "circle")
# Numbered as Aristidou et al. 2017, table 4: clockwise from the upper left.
QUADRANTS: Mapping[str, str] = MappingProxyType(
    {
        "Q1": "intense and unpleasant",
        "Q2": "intense and pleasant",
        "Q3": "mild and pleasant",
        "Q4": "mild and unpleasant",
    }
)
NEAR = 0.1  # within this of the centre a point is in no quadrant


class Point(NamedTuple):
    """A place on the disc: ``valence`` and ``arousal``, each -1 to 1."""

    valence: float
    arousal: float


@cache
def words(*, table: str = "ratings") -> Mapping[str, Point]:
    """Return emotion word -> its point, of the table ``"ratings"`` or ``"circle"``.

    Raises ``RecipeError`` for another name.

    >>> words()["happy"]
    Point(valence=0.826, arousal=0.526)
    """
    entry = _tables().get(table)
    if entry is None:
        raise RecipeError(unknown("table of emotion words", table, TABLES))
    if "words" in entry:
        return MappingProxyType({word: Point(*place) for word, place in entry["words"].items()})
    angles = {word: np.radians(angle) for word, angle in entry["angles"].items()}
    found = {word: Point(float(np.cos(a)), float(np.sin(a))) for word, a in angles.items()}
    return MappingProxyType({"neutral": Point(0.0, 0.0), **found})


def source(*, table: str = "ratings") -> str:
    """Return where the numbers of a table come from."""
    words(table=table)
    return str(_tables()[table]["source"])


def point(word: str, *, table: str = "ratings") -> Point:
    """Return the point of an emotion word, in upper or lower case.

    Raises ``RecipeError`` with the nearest word that is known.
    """
    known = words(table=table)
    plain = " ".join(word.casefold().split())
    if plain not in known:
        raise RecipeError(unknown("emotion word", word, known))
    return known[plain]


def nearest(valence: float, arousal: float, *, table: str = "ratings") -> tuple[tuple[str, float], ...]:
    """Return all words by their distance from a point, the nearest first, as ``(word, distance)``."""
    away = {
        word: float(np.hypot(p.valence - valence, p.arousal - arousal))
        for word, p in words(table=table).items()
    }
    return tuple(sorted(away.items(), key=lambda item: (item[1], item[0])))


def quadrant(valence: float, arousal: float) -> str | None:
    """Return the quadrant, ``"Q1"`` to ``"Q4"`` as ``QUADRANTS`` describes them; None at the centre.

    >>> quadrant(0.8, 0.5), quadrant(-0.6, -0.3), quadrant(0.0, 0.05)
    ('Q2', 'Q4', None)
    """
    if np.hypot(valence, arousal) < NEAR:
        return None
    if arousal >= 0.0:
        return "Q2" if valence >= 0.0 else "Q1"
    return "Q3" if valence >= 0.0 else "Q4"


def described(valence: float, arousal: float) -> str:
    """Return where a point is in words; what is hardly there in one direction is left out.

    >>> described(0.8, 0.5), described(0.04, -0.6), described(0.0, 0.05)
    ('intense and pleasant', 'mild', 'neutral')
    """
    name = quadrant(valence, arousal)
    if name is None:
        return "neutral"
    sizes = zip((arousal, valence), QUADRANTS[name].split(" and "), strict=True)
    return " and ".join(word for size, word in sizes if abs(size) >= NEAR) or QUADRANTS[name]


ORIGIN = Point(0.0, 0.0)  # where nothing is expressed


def clamp(valence: float, arousal: float) -> Point:
    """Return the point, drawn straight towards the centre until it is on the disc.

    >>> clamp(3.0, 4.0)
    Point(valence=0.6, arousal=0.8)
    """
    reach = max(float(np.hypot(valence, arousal)), 1.0)
    return Point(valence / reach, arousal / reach)


@cache
def _tables() -> dict[str, dict[str, dict[str, list[float]]]]:
    return tomllib.loads(files(__package__).joinpath("circumplex.toml").read_text(encoding="utf-8"))
