"""The disc of emotions with clips on it: pleasant to the right, intense upwards, the emotion words in grey.

A filled dot is a clip that was read against a neutral one, a ring one whose reading is a guess.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import PurePath
from typing import TYPE_CHECKING, Self

import numpy as np

from ..emotion.circumplex import QUADRANTS, words
from ..typing import Array
from .shapes import Labels, Round, Shape, Stroke, Words, picture, svg

if TYPE_CHECKING:
    from PIL.Image import Image

    from ..emotion.reading import Reading

SIZE = 720.0  # pixels across, as laid out
MARGIN = 76.0  # around the disc, for what the axes mean
NAMED = 16  # up to so many clips have their names beside them
DOT, LEAST_DOT = 5.0, 2.0  # radius of a dot: of a few clips, and of very many
CLEAR = 0.02  # labels with a smaller probability are not named
SPREAD = 0.55  # of a step: how far the first seed lies from the middle
FURTHEST = 0.1  # of the disc's radius: how far a dot goes to lie beside another
GOLDEN = np.pi * (3.0 - np.sqrt(5.0))
CORNERS = {
    "Q1": (0.0, 0.0, "start"),
    "Q2": (1.0, 0.0, "end"),
    "Q3": (1.0, 1.0, "end"),
    "Q4": (0.0, 1.0, "start"),
}
LEGEND = (
    "Pleasant to the right, intense upwards; rest the pointer on a dot for its name. A filled dot was read "
    "against a neutral clip, a ring is a guess. A grey one is like something that has no place on the disc, "
    "so its place says little. Clips at the same place are drawn beside each other."
)
STYLE = (
    ":root{color-scheme:light dark}"
    "body{font:15px/1.4 sans-serif;max-width:60em;margin:1em auto;padding:0 1em}"
    "h1{font-size:1.3em}table{border-collapse:collapse;margin-top:1em}"
    "th,td{text-align:left;padding:.15em .8em .15em 0;border-bottom:1px solid #8886}"
    "td:nth-child(2),td:nth-child(3){font-variant-numeric:tabular-nums}td:last-child{white-space:nowrap}"
    "circle:hover{stroke:currentColor;stroke-width:3}svg{display:block}"
)


@dataclass(frozen=True)
class Dot:
    """A clip on the disc: its ``name``, place, what else is said of it, and whether that is a guess.

    ``faint`` is a place that says little, because most of what the clip is like has none on the disc.
    """

    name: str
    valence: float
    arousal: float
    said: str = ""
    guess: bool = False
    faint: bool = False

    @classmethod
    def of(cls, name: str, reading: "Reading") -> Self:
        """Return the dot of a clip that was read."""
        first = [(label, p) for label, p in reading.labels.items() if p > CLEAR][:3]
        likely = ", ".join(f"{label} {100 * p:.0f} %" for label, p in first)
        return cls(name, *reading.place, likely, reading.against != "neutral", reading.hardly_placed)


def disc(dots: Sequence[Dot], *, width: int = 1200) -> "Image":
    """Return a picture of clips on the disc, ``width`` pixels wide and high."""
    return picture(disc_shapes(dots), SIZE, SIZE, across=width)


def disc_svg(dots: Sequence[Dot], *, size: float = SIZE) -> str:
    """Return clips on the disc as an ``<svg>`` element, ``size`` pixels wide and high."""
    names = ", ".join(dot.name for dot in dots[:NAMED])
    label = f"{len(dots)} clips between pleasant and unpleasant, intense and mild"
    return svg(
        disc_shapes(dots, size=size), size, size, label=f"{label}: {names}" if names.strip() else label
    )


def disc_page(dots: Sequence[Dot], *, title: str = "Clips by what they express") -> str:
    """Return a whole page (HTML) with the disc and a table of the clips; it needs nothing else."""
    rows = "\n".join(
        f"<tr><td>{escape(dot.name)}</td><td>{dot.valence:+.2f}</td><td>{dot.arousal:+.2f}</td>"
        f"<td>{escape(dot.said)}</td><td>{'a guess' if dot.guess else 'against a neutral clip'}"
        f"{', place unsure' if dot.faint else ''}</td></tr>"
        for dot in dots
    )
    head = "<tr><th>clip</th><th>valence</th><th>arousal</th><th>acted like</th><th>read</th></tr>"
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>{escape(title)}</title>\n'
        f"<style>{STYLE}</style>\n</head>\n<body>\n<h1>{escape(title)}</h1>\n<p>{LEGEND}</p>\n"
        f"{disc_svg(dots)}\n<table>\n{head}\n{rows}\n</table>\n</body>\n</html>\n"
    )


def disc_shapes(dots: Sequence[Dot], *, size: float = SIZE) -> list[Shape]:
    """Return the disc with its words, and the clips on it, as shapes on ``size`` pixels square."""
    unit = size / SIZE
    letters = max(12.0 * unit, 9.0)
    middle, reach = 0.5 * size, 0.5 * size - MARGIN * max(unit, 0.85)
    labels = Labels(size, size)
    across, up = middle + reach * np.array([[d.valence, -d.arousal] for d in dots]).reshape(-1, 2).T
    radius = max(unit, 0.8) * float(np.clip(DOT * np.sqrt(60.0 / max(len(dots), 1)), LEAST_DOT, DOT))
    places = _apart(np.stack([across, up], axis=1), 2.2 * radius, FURTHEST * reach)
    for x, y in places:
        labels.keep(float(x), float(y), radius)
    shapes = _frame(middle, reach, letters)
    labels.taken += [shape.box for shape in shapes if isinstance(shape, Words)]
    named = [
        labels.beside(float(x), float(y), _short(dot.name), away=radius + 4, size=letters, ink="ink")
        for dot, (x, y) in zip(dots, places, strict=True)
        if len(dots) <= NAMED and dot.name
    ]
    shapes += _words(labels, middle, reach, letters)
    for dot, (x, y) in zip(dots, places, strict=True):
        said = f"{dot.name}\n{dot.said}".strip()
        ink = "faint" if dot.faint else "other" if dot.guess else "mark"
        shapes.append(Round(float(x), float(y), radius, ink, not dot.guess, said))
    return shapes + [name for name in named if name]


def _short(name: str) -> str:
    """Return the name of a clip without its folders and its kind."""
    return PurePath(name).stem


def _frame(middle: float, reach: float, letters: float) -> list[Shape]:
    """Return the rim, the axes with what they mean, and the names of the quadrants in the corners."""
    low, high = middle - reach, middle + reach
    shapes: list[Shape] = [
        Round(middle, middle, reach, "rule", False),
        Stroke(low, middle, high, middle),
        Stroke(middle, low, middle, high),
        Words(middle, low - letters, "intense", letters, anchor="middle"),
        Words(middle, high + letters, "mild", letters, anchor="middle"),
        Words(high + 6, middle, "pleasant", letters),
        Words(low - 6, middle, "unpleasant", letters, anchor="end"),
    ]
    for name, (right, down, anchor) in CORNERS.items():
        x, y = letters + right * (2 * middle - 2 * letters), letters + down * (2 * middle - 2 * letters)
        shapes.append(Words(x, y, QUADRANTS[name], letters, "faint", anchor))
    return shapes


def _words(labels: Labels, middle: float, reach: float, letters: float) -> list[Shape]:
    """Return the emotion words at their places; where names of clips leave no room, the place only."""
    shapes: list[Shape] = []
    spots = {word: (middle + reach * p.valence, middle - reach * p.arousal) for word, p in words().items()}
    for x, y in spots.values():
        labels.keep(x, y, 2.0)
    for word, (x, y) in spots.items():
        name = labels.beside(x, y, word, away=5, size=letters, ink="faint")
        shapes += [Round(x, y, 1.6, "faint"), *([name] if name else [])]
    return shapes


def _apart(places: Array, step: float, furthest: float) -> Array:
    """Return the places (N, 2) with those that would cover others set out around them, as seeds in a flower.

    ``step`` is the least distance; what would have to go further than ``furthest`` stays where it is.
    """
    out, seen = places.copy(), dict[tuple[int, ...], int]()
    seeds = int((furthest / (SPREAD * step)) ** 2)
    for i, place in enumerate(places):
        cell = tuple(np.rint(place / step).astype(int).tolist())
        k = seen.get(cell, 0)
        while k <= seeds and i and _nearest(out[:i], _seed(place, k, step)) < 0.9 * step:
            k += 1
        out[i] = _seed(place, k, step) if k <= seeds else place
        seen[cell] = k
    return out


def _nearest(places: Array, spot: Array) -> float:
    return float(np.sqrt(np.square(places - spot).sum(axis=1).min()))


def _seed(place: Array, k: int, step: float) -> Array:
    """Return the place of the seed ``k`` around a place (Vogel 1979)."""
    found: Array = place + SPREAD * step * np.sqrt(k) * np.array([np.cos(k * GOLDEN), np.sin(k * GOLDEN)])
    return found
