"""Numbers over time: many small curves on one page, in groups, each to its own scale."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..errors import MienError
from ..typing import Array
from .sheet import FAINT, INK, MARGIN, PAPER

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageDraw import ImageDraw

SAMPLES = 2  # a pixel each way, for smooth lines
LINE = (52, 101, 164)
HEAD, GROUP, PANEL, PLOT, GAP = 30, 26, 104, 62, 18  # heights in pixels, and the space between panels
SCALE = 46  # width of the numbers on the left of a panel


@dataclass(frozen=True, eq=False)
class Curve:
    """What is shown in one panel: its ``label`` and ``unit``, and its ``values`` (T,)."""

    label: str
    unit: str
    values: Array


def curves(
    times: Array,
    groups: Mapping[str, Sequence[Curve]],
    *,
    title: str = "",
    width: int = 1600,
    columns: int = 4,
) -> "Image":
    """Return a picture of curves over ``times`` (T,) in seconds, ``columns`` beside each other.

    Each group begins a new row under its name. Each panel goes from the smallest to the largest value of its
    curve, which are written beside it; a value that does not change is a line in the middle. Raises
    ``MienError`` for a width below 64 pixels a column.
    """
    from PIL import Image, ImageDraw

    if columns < 1 or width < 64 * columns:
        raise MienError(
            f"{columns} columns need a width of at least {64 * max(columns, 1)} pixels, got {width}"
        )
    rows = {name: -(-len(shown) // columns) for name, shown in groups.items()}
    height = HEAD + sum(GROUP + PANEL * count for count in rows.values()) + MARGIN
    page = Image.new("RGB", (width * SAMPLES, height * SAMPLES), PAPER)
    pen, step = ImageDraw.Draw(page), (width - 2 * MARGIN) / columns
    _write(pen, MARGIN, HEAD / 2, title, 17, INK)
    top = float(HEAD)
    for name, shown in groups.items():
        _write(pen, MARGIN, top + GROUP / 2, name, 15, INK)
        for i, curve in enumerate(shown):
            row, column = divmod(i, columns)
            _panel(pen, times, curve, MARGIN + column * step, top + GROUP + row * PANEL, step - GAP)
        top += GROUP + PANEL * rows[name]
    return page.resize((width, height), Image.Resampling.LANCZOS)


def _panel(pen: "ImageDraw", times: Array, curve: Curve, x: float, y: float, width: float) -> None:
    """Draw one curve in a box with its label above, its range at the left and the time below."""
    low, high = float(curve.values.min()), float(curve.values.max())
    left, right, top, bottom = x + SCALE, x + width, y + 16, y + 16 + PLOT
    pen.rectangle([SAMPLES * v for v in (left, top, right, bottom)], (255, 255, 255))
    _write(pen, left, y + 8, f"{curve.label}, {curve.unit}", 11, INK)
    _write(pen, left - 4, top + 5, f"{high:.3g}", 10, FAINT, anchor="rm")
    if high > low:
        _write(pen, left - 4, bottom - 5, f"{low:.3g}", 10, FAINT, anchor="rm")
    _write(pen, left, bottom + 8, f"{times[0]:.1f} s", 10, FAINT)
    _write(pen, right, bottom + 8, f"{times[-1]:.1f} s", 10, FAINT, anchor="rm")
    span = max(float(times[-1] - times[0]), 1e-9)
    share = (curve.values - low) / (high - low) if high > low else np.full(len(times), 0.5)
    across = left + (right - left) * (times - times[0]) / span
    points = np.stack([across, bottom - 3 - (PLOT - 6) * share], axis=1)
    if len(points) == 1:
        points = np.array([[left, points[0, 1]], [right, points[0, 1]]])
    pen.line((SAMPLES * points).ravel().tolist(), LINE, 2 * SAMPLES - 1, joint="curve")


def _write(
    pen: "ImageDraw",
    x: float,
    y: float,
    text: str,
    size: int,
    ink: tuple[int, int, int],
    *,
    anchor: str = "lm",
) -> None:
    from PIL import ImageFont

    pen.text((SAMPLES * x, SAMPLES * y), text, ink, ImageFont.load_default(SAMPLES * size), anchor=anchor)
