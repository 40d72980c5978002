"""Flat shapes, laid out once and drawn twice: as SVG inside a page, and by Pillow as a picture.

SVG takes the text colour of the page around it, so it can be read on light and on dark pages. Lengths are in
pixels, x to the right and y down.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, NamedTuple

from ..errors import MienError
from .sheet import PAPER

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

Edges = tuple[float, float, float, float]  # left, top, right, bottom
SAMPLES = 2  # a pixel each way, for smooth lines
WIDEST = 0.56  # of the letters' size: how wide a letter is, about


class Ink(NamedTuple):
    """A colour on pages, how solid it is there, and the colour in pictures."""

    page: str
    opacity: float
    picture: tuple[int, int, int]


INKS = {
    "ink": Ink("currentColor", 1.0, (38, 42, 48)),
    "faint": Ink("currentColor", 0.62, (122, 128, 136)),
    "rule": Ink("currentColor", 0.25, (200, 204, 210)),
    "mark": Ink("#3d84cc", 1.0, (52, 101, 164)),
    "other": Ink("#d9802e", 1.0, (214, 118, 38)),
}


@dataclass(frozen=True)
class Round:
    """A circle, filled or as a line; ``said`` is shown where the pointer rests on it."""

    x: float
    y: float
    radius: float
    ink: str = "ink"
    filled: bool = True
    said: str = ""


@dataclass(frozen=True)
class Stroke:
    """A straight line."""

    x: float
    y: float
    to_x: float
    to_y: float
    ink: str = "rule"


@dataclass(frozen=True)
class Box:
    """A filled rectangle; ``x`` and ``y`` are its upper left corner."""

    x: float
    y: float
    width: float
    height: float
    ink: str = "mark"


@dataclass(frozen=True)
class Words:
    """A line of text about the height ``y``; ``anchor`` says which end of it ``x`` is."""

    x: float
    y: float
    text: str
    size: float = 12.0
    ink: str = "ink"
    anchor: str = "start"

    @property
    def box(self) -> Edges:
        """About where it is written: left, top, right, bottom."""
        wide = WIDEST * self.size * len(self.text)
        left = self.x - {"start": 0.0, "middle": 0.5, "end": 1.0}[self.anchor] * wide
        return left, self.y - 0.6 * self.size, left + wide, self.y + 0.6 * self.size


Shape = Round | Stroke | Box | Words


def svg(shapes: Iterable[Shape], width: float, height: float, *, label: str) -> str:
    """Return an ``<svg>`` element; ``label`` is what it shows, for those who cannot see it."""
    inside = "\n".join(_element(shape) for shape in shapes)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" aria-label="{escape(label)}" '
        f'viewBox="0 0 {width:g} {height:g}" width="{width:g}" height="{height:g}" '
        f'style="max-width:100%;height:auto;font-family:sans-serif">\n{inside}\n</svg>'
    )


def _element(shape: Shape) -> str:
    ink = INKS[shape.ink]
    fill = f'fill="{ink.page}" fill-opacity="{ink.opacity:g}"'
    line = f'fill="none" stroke="{ink.page}" stroke-opacity="{ink.opacity:g}"'
    match shape:
        case Round():
            paint = fill if shape.filled else f'{line} stroke-width="1.5" pointer-events="all"'
            start = f'<circle cx="{shape.x:.1f}" cy="{shape.y:.1f}" r="{shape.radius:.1f}" {paint}'
            return f"{start}><title>{escape(shape.said)}</title></circle>" if shape.said else f"{start}/>"
        case Stroke():
            ends = f'x1="{shape.x:.1f}" y1="{shape.y:.1f}" x2="{shape.to_x:.1f}" y2="{shape.to_y:.1f}"'
            return f"<line {ends} {line}/>"
        case Box():
            at = f'x="{shape.x:.1f}" y="{shape.y:.1f}"'
            return f'<rect {at} width="{shape.width:.1f}" height="{shape.height:.1f}" {fill}/>'
        case Words():
            at = f'x="{shape.x:.1f}" y="{shape.y:.1f}" font-size="{shape.size:g}"'
            kind = f'text-anchor="{shape.anchor}" dominant-baseline="central" pointer-events="none"'
            return f"<text {at} {kind} {fill}>{escape(shape.text)}</text>"


def picture(shapes: Iterable[Shape], width: float, height: float, *, across: int) -> "Image":
    """Return the shapes as a picture ``across`` pixels wide. Raises ``MienError`` for fewer than 64."""
    from PIL import Image, ImageDraw

    if across < 64:
        raise MienError(f"a picture needs a width of at least 64 pixels, got {across}")
    scale, size = across / width, (across, round(across * height / width))
    page = Image.new("RGB", (size[0] * SAMPLES, size[1] * SAMPLES), PAPER)
    pen = ImageDraw.Draw(page)
    for shape in shapes:
        _draw(pen, shape, scale * SAMPLES)
    return page.resize(size, Image.Resampling.LANCZOS)


def _draw(pen: "ImageDraw", shape: Shape, scale: float) -> None:
    from PIL import ImageFont

    ink = INKS[shape.ink].picture
    x, y = shape.x * scale, shape.y * scale
    thick = max(round(1.5 * scale), 1)
    match shape:
        case Round():
            r = shape.radius * scale
            edge = [x - r, y - r, x + r, y + r]
            pen.ellipse(edge, ink if shape.filled else None, ink, thick)
        case Stroke():
            pen.line([x, y, shape.to_x * scale, shape.to_y * scale], ink, max(round(scale), 1))
        case Box():
            pen.rectangle([x, y, x + shape.width * scale, y + shape.height * scale], ink)
        case Words():
            anchor = {"start": "lm", "middle": "mm", "end": "rm"}[shape.anchor]
            pen.text((x, y), shape.text, ink, ImageFont.load_default(shape.size * scale), anchor=anchor)


class Labels:
    """Puts names beside points so that they hide no other name and, where there is room, no point.

    ``taken`` are the boxes (left, top, right, bottom) of names on a page of ``width`` and ``height``.
    """

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = width, height
        self.taken: list[Edges] = []
        self.points: list[Edges] = []

    def keep(self, x: float, y: float, radius: float) -> None:
        """Leave the place around a point free, if possible."""
        self.points.append((x - radius, y - radius, x + radius, y + radius))

    def beside(self, x: float, y: float, text: str, *, away: float, size: float, ink: str) -> Words | None:
        """Return the name right, left, above or below a point; None where other names take all these."""
        places: Sequence[tuple[float, float, str]] = (
            (x + away, y, "start"),
            (x - away, y, "end"),
            (x, y - away - 0.4 * size, "middle"),
            (x, y + away + 0.4 * size, "middle"),
            (x + away, y - 0.9 * size, "start"),
            (x + away, y + 0.9 * size, "start"),
            (x - away, y - 0.9 * size, "end"),
            (x - away, y + 0.9 * size, "end"),
        )
        possible = [Words(px, py, text, size, ink, anchor) for px, py, anchor in places]
        for others in ([*self.taken, *self.points], self.taken):
            for words in possible:
                if self._inside(words.box) and not any(_meet(words.box, other) for other in others):
                    self.taken.append(words.box)
                    return words
        return None

    def _inside(self, box: Edges) -> bool:
        return box[0] >= 0.0 <= box[1] and box[2] <= self.width and box[3] <= self.height


def _meet(a: Edges, b: Edges) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
