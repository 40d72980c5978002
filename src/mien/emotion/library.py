"""Find clips in a library: those nearest to a word, to a place on the disc, or to another clip.

* To a **word** that the model has as a label: the distance on the disc, where the label has a place, and how
  much its probability lacks to 1. To any other emotion word: as to its place.
* To a **place**: the distance on the disc, 0 to 2, and the share of the reading that has no place there.
* To an **example**: how much differs in manner, as a share of what both have: 0 is the same, near 1 nothing
  in common. So a clip in which little is unusual is not near to everything. What is done in the clips matters
  as well as how: a wave is seldom near to a walk.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import MienError, unknown
from ..typing import Array
from .circumplex import Point, words
from .model import EmotionModel
from .reading import Reading

SLIGHT = 0.25  # of what is usual: between clips that have hardly more, what differs counts by its size


@dataclass(frozen=True, eq=False)
class Match:
    """A clip that was found: its ``name``, how far it is from what was asked for, and its reading."""

    name: str
    distance: float
    reading: Reading

    def as_data(self) -> dict[str, Any]:
        """Return everything but the reasons as plain data, for JSON."""
        about = {key: value for key, value in self.reading.as_data().items() if key != "why"}
        return {"file": self.name, "distance": round(self.distance, 4), **about}


def by_place(library: Mapping[str, Reading], place: Point) -> tuple[Match, ...]:
    """Return the clips of a library (name -> reading) by their distance from a place, the nearest first."""
    return _sorted(library, {name: _off(reading, place) for name, reading in library.items()})


def by_word(library: Mapping[str, Reading], word: str, *, model: EmotionModel) -> tuple[Match, ...]:
    """Return the clips by their distance from an emotion word, or a label of the ``model`` that read them.

    Raises ``MienError`` for a word that is neither.
    """
    plain = " ".join(word.casefold().split())
    labels, known = {name.casefold(): name for name in model.change.planes.names}, words()
    label = labels.get(plain)
    place = model.places.get(label, known.get(plain)) if label else known.get(plain)
    if label is None and place is None:
        raise MienError(unknown("emotion word or label", word, {*known, *labels}))
    if label is None and place is not None:
        return by_place(library, place)
    away = {
        name: (_away(reading, place) if place else 0.0) + 1.0 - reading.labels.get(label or "", 0.0)
        for name, reading in library.items()
    }
    return _sorted(library, away)


def by_example(library: Mapping[str, Reading], example: Reading) -> tuple[Match, ...]:
    """Return the clips by how much they differ in manner from an example.

    Raises ``MienError`` where some were read against a neutral clip and others against the usual.
    """
    if any(reading.against != example.against for reading in library.values()):
        raise MienError("to compare clips with an example, read all against a neutral clip, or none")
    own = _size(example.manner)
    away = {
        name: _size(reading.manner - example.manner) / (_size(reading.manner) + own + SLIGHT)
        for name, reading in library.items()
    }
    return _sorted(library, away)


def _size(manner: Array) -> float:
    return float(np.sqrt(np.mean(manner**2)))


def _away(reading: Reading, place: Point) -> float:
    return float(np.hypot(*np.subtract(reading.place, place)))


def _off(reading: Reading, place: Point) -> float:
    """Return the distance on the disc, and what of the reading is nowhere on it."""
    return _away(reading, place) + 1.0 - reading.placed


def _sorted(library: Mapping[str, Reading], away: Mapping[str, float]) -> tuple[Match, ...]:
    order = sorted(library, key=lambda name: (away[name], name))
    return tuple(Match(name, away[name], library[name]) for name in order)
