"""Rows of panels with figures in them, all to one scale: the page behind ``strip`` and ``compare``."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..errors import MienError
from ..typing import Array
from .figure import Figure
from .ground import shadow
from .raster import draw, paste
from .solids import Camera, Solids

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw
    from PIL.ImageFont import FreeTypeFont, ImageFont

PAPER, INK, FAINT, FLOOR = (247, 248, 250), (38, 42, 48), (122, 128, 136), 0.93
GHOST, OPACITY = "#8f8abf", 0.5
MARGIN, TALLEST = 12, 0.27  # pixels; tallest figure as a share of the picture's width


@dataclass(frozen=True, eq=False)
class Shot:
    """One figure in one pose, seen along ``axes``; ``origin (3)`` is set on the panel's floor point."""

    figure: Figure
    solids: Solids
    pose: int
    origin: Array
    axes: Array
    ghost: bool = False

    def extent(self) -> Array:
        """Return left, right, bottom and top ``(4,)`` seen from the origin, in leg lengths."""
        low, high = self.solids.bounds(self.pose, self.axes[:2])
        from_origin = self.axes[:2] @ self.origin
        low, high = (low - from_origin) / self.figure.size, (high - from_origin) / self.figure.size
        return np.array([low[0], high[0], low[1], high[1]])

    def camera(self, x: float, y: float, scale: float) -> Camera:
        """Return the camera that draws this shot; ``scale`` in pixels a leg length."""
        return Camera(self.axes, self.origin, x, y, scale / self.figure.size)


@dataclass(frozen=True, eq=False)
class Panel:
    """Shots on the same floor, the figure's own last, with a label below."""

    shots: list[Shot]
    label: str

    @property
    def level(self) -> bool:
        """Whether the floor is seen edge-on."""
        return abs(float(self.shots[-1].axes[2] @ self.shots[-1].figure.up)) < 0.05


@dataclass(frozen=True, eq=False)
class Row:
    """Panels side by side, with a label above."""

    label: str
    panels: list[Panel]


@dataclass(frozen=True, eq=False)
class Layout:
    """Where everything goes, in pixels; ``scale`` in pixels a leg length."""

    width: int
    height: int
    scale: float
    middle: float  # of a figure's reach to left and right of its origin
    text: int  # height of the letters
    head: int  # height of the title
    tops: list[int]  # of each row
    floors: list[int]  # of each row
    ends: list[int]  # of each row's floor; the labels come below

    @classmethod
    def of(cls, rows: list[Row], width: int, titled: bool) -> "Layout":
        """Find the largest scale at which every figure fits its panel, and stack the rows."""
        extents = [np.array([s.extent() for p in row.panels for s in p.shots]) for row in rows]
        left = min(float(e[:, 0].min()) for e in extents)
        right = max(float(e[:, 1].max()) for e in extents)
        low = [min(0.0, float(e[:, 2].min())) for e in extents]
        high = [max(0.1, float(e[:, 3].max())) for e in extents]
        panel = (width - 2 * MARGIN) / max(len(row.panels) for row in rows)
        tallest = max(h - b for h, b in zip(high, low, strict=True))
        scale = min(panel / (right - left + 0.12), TALLEST * width / tallest)
        text = int(np.clip(width / 110, 9, 15))
        head = 2 * text + 4 if titled else 4
        tops, floors, ends, y = [], [], [], head
        for b, h in zip(low, high, strict=True):
            tops.append(y)
            floors.append(y + round(h * scale) + text + 12)
            ends.append(floors[-1] + round(-b * scale) + 8)
            y = ends[-1] + text + 8
        return cls(width, y, scale, 0.5 * (left + right), text, head, tops, floors, ends)

    def origins(self, panels: int) -> list[float]:
        """Return how far right the origin of each of a row's panels is."""
        step = (self.width - 2 * MARGIN) / panels
        return [MARGIN + (k + 0.5) * step - self.middle * self.scale for k in range(panels)]


def sheet(rows: list[Row], *, width: int, title: str = "", notes: Mapping[str, str] | None = None) -> "Image":
    """Return the rows drawn below each other, every figure to the same scale in leg lengths.

    ``notes`` (text -> colour) go to the right of the title. Raises ``MienError`` for a width below 64.
    """
    if width < 64:
        raise MienError(f"a picture needs a width of at least 64 pixels, got {width}")
    layout = Layout.of(rows, width, bool(title or notes))
    canvas = np.empty((layout.height, width, 3), np.float32)
    canvas[:] = PAPER
    for i, row in enumerate(rows):
        _draw_row(canvas, row, i, layout)
    image = to_image(canvas)
    _write(image, rows, layout, title, notes or {})
    return image


def _draw_row(canvas: Array, row: Row, index: int, layout: Layout) -> None:
    xs, y, end = layout.origins(len(row.panels)), layout.floors[index], layout.ends[index]
    if row.panels[0].level:
        canvas[y:end] *= FLOOR
        canvas[y : y + 1] *= 0.72
    dark = np.zeros(canvas.shape[:2], np.float32)
    shots = [
        (shot, shot.camera(x, y, layout.scale))
        for panel, x in zip(row.panels, xs, strict=True)
        for shot in panel.shots
    ]
    for shot, camera in shots:
        if not shot.ghost:
            figure = shot.figure
            shadow(dark, shot.solids, shot.pose, camera, figure.up, figure.floor, figure.size)
    canvas *= 1.0 - dark[..., None]
    for shot, camera in shots:
        size = canvas.shape[1], canvas.shape[0]
        layer = draw(shot.solids, shot.pose, camera, size, shot.figure.palette)
        paste(canvas, layer, opacity=OPACITY if shot.ghost else 1.0)


def _write(image: "Image", rows: list[Row], layout: Layout, title: str, notes: Mapping[str, str]) -> None:
    from PIL import ImageDraw, ImageFont

    pen, text = ImageDraw.Draw(image), layout.text
    font, small = ImageFont.load_default(text + 3), ImageFont.load_default(text)
    pen.text((MARGIN, layout.head / 2), title, INK, font, anchor="lm")
    right = layout.width - MARGIN
    for note, colour in reversed(list(notes.items())):
        pen.text((right, layout.head / 2), note, colour, font, anchor="rm")
        right -= int(pen.textlength(note, font)) + 2 * MARGIN
    for i, row in enumerate(rows):
        xs = layout.origins(len(row.panels))
        pen.text((MARGIN, layout.tops[i] + 2), row.label, FAINT, small, anchor="lt")
        for panel, x in zip(row.panels, xs, strict=True):
            middle = x + layout.middle * layout.scale
            pen.text((middle, layout.ends[i] + 3), panel.label, FAINT, small, anchor="mt")
    _scale_bar(pen, rows, layout, small)


def _scale_bar(pen: "ImageDraw", rows: list[Row], layout: Layout, font: "FreeTypeFont | ImageFont") -> None:
    """Draw a bar of half a metre at the right above the first row, where the unit is known."""
    figure = rows[0].panels[0].shots[-1].figure
    if figure.metres is None:
        return
    length = 0.5 / (figure.metres * figure.size) * layout.scale
    y = layout.head + layout.text // 2 + 2
    right = layout.width - MARGIN
    pen.line([(right - length, y), (right, y)], FAINT, 2)
    pen.text((right - length - 4, y), "0.5 m", FAINT, font, anchor="rm")


def to_image(canvas: Array) -> "Image":
    """Return a canvas ``(H, W, 3)``, 0 to 255, as a Pillow picture."""
    from PIL import Image

    return Image.fromarray(np.clip(canvas + 0.5, 0, 255).astype(np.uint8))
