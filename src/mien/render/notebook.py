"""What notebooks show inside the page itself: a motion as a strip of poses, readings and features as bars."""

from base64 import b64encode
from html import escape
from io import BytesIO

from ..analysis.laban import Features, Row
from ..analysis.laban_table import COMPONENTS
from ..emotion.reading import Reading
from ..motion import Motion
from .disc import Dot, disc_svg
from .shapes import Box, Shape, Words, svg
from .strip import strip

DISC, BARS, ROW = 380.0, 470.0, 19.0  # pixels: the disc, the width of the bars, the height of one
SHOWN, LEAST = 5, 0.01  # labels, and the least probability of one


def strip_html(motion: Motion, *, poses: int = 8, width: int = 900) -> str:
    """Return an ``<img>`` element that holds a strip of ``poses`` seen from the side, ``width`` pixels."""
    out = BytesIO()
    image = strip(motion, poses=poses, views=("side",), width=width)
    image.quantize(128).save(out, "PNG")
    text = f"{motion.name or 'motion'}: {len(motion)} frames, {motion.duration:.2f} s"
    data = b64encode(out.getvalue()).decode("ascii")
    return f'<img alt="{escape(text)}" width="{width}" src="data:image/png;base64,{data}">'


def reading_html(reading: Reading) -> str:
    """Return what a motion expresses: its place on the disc, and bars for labels and reasons."""
    rows: list[Shape] = []
    against = "its neutral clip" if reading.against == "neutral" else "how people usually move: a guess"
    place, words = reading.lines()[:2]
    for line in place.split(" (", 1):
        _line(rows, line.rstrip(")"))
    _line(rows, f"against {against}", ink="faint")
    _line(rows, words, ink="faint")
    _line(rows, "acted like", gap=True)
    for label, p in [item for item in reading.labels.items() if item[1] > LEAST][:SHOWN]:
        _bar(rows, label, p, f"{100 * p:.0f} %")
    if reading.why:
        _line(rows, f"what speaks for {next(iter(reading.labels))}", gap=True)
    most = max((reason.pull for reason in reading.why), default=1.0)
    for reason in reading.why:
        _bar(rows, reason.what, reason.pull / most, reason.how_much)
    disc = disc_svg([Dot.of("", reading)], size=DISC)
    bars = svg([*rows], BARS, _bottom(rows), label=place)
    return f'<div style="display:flex;flex-wrap:wrap;gap:16px;align-items:center">\n{disc}\n{bars}\n</div>'


def features_html(features: Features) -> str:
    """Return the selected Laban features of a clip, a bar each: its share of the largest of the same unit."""
    shown = [row for row in features.table() if row.feature.selected]
    largest: dict[str, float] = {}
    for row in shown:
        unit = row.feature.feature.unit
        largest[unit] = max(largest.get(unit, 0.0), abs(row.value))
    rows: list[Shape] = []
    _line(rows, f"Laban features: {len(features.times)} frames, {features.times[-1]:.2f} s")
    for component in COMPONENTS:
        _line(rows, component, gap=True)
        for row in shown:
            if row.feature.feature.component == component:
                _feature(rows, row, largest[row.feature.feature.unit])
    return svg(rows, BARS, _bottom(rows), label="Laban features")


def _feature(rows: list[Shape], row: Row, largest: float) -> None:
    unit = row.feature.feature.unit.replace("^2", "²").replace("^3", "³")
    share = abs(row.value) / largest if largest > 0.0 else 0.0
    _bar(rows, row.feature.name.replace("_", " "), share, f"{row.value:.3g} {unit}")


def _bottom(rows: list[Shape]) -> float:
    """Return where the next row begins."""
    return max((row.y for row in rows if isinstance(row, Words)), default=-0.5 * ROW) + 0.5 * ROW


def _line(rows: list[Shape], text: str, *, ink: str = "ink", gap: bool = False) -> None:
    rows.append(Words(2.0, _bottom(rows) + (1.0 if gap else 0.5) * ROW, text, 13.0, ink))


def _bar(rows: list[Shape], what: str, share: float, said: str) -> None:
    """Add a row: what it is, a bar from 0 to 1, and the value in words."""
    y = _bottom(rows) + 0.5 * ROW
    rows.append(Words(0.45 * BARS - 6, y, what, 12.0, "ink", "end"))
    rows.append(Box(0.45 * BARS, y - 5, max(0.26 * BARS * min(max(share, 0.0), 1.0), 1.0), 10))
    rows.append(Words(0.73 * BARS, y, said, 12.0, "faint"))
