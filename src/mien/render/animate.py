"""Films of a motion: GIF through Pillow, MP4 through PyAV (the ``video`` extra)."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import MienError
from ..formats import files
from ..kinematics.body import Body
from ..motion import Motion
from ..typing import Array, Progress, untold
from .figure import Figure
from .ground import grid, shadow
from .raster import draw, paste
from .sheet import FAINT, GHOST, OPACITY, PAPER, to_image
from .solids import Camera, Solids, view_axes
from .video import encode, frame_rate

if TYPE_CHECKING:
    from PIL.Image import Image

CHUNK = 128  # poses made solid at a time: bounds the memory of long clips


def animate(
    motion: Motion,
    path: str | Path,
    *,
    against: Motion | None = None,
    beside: bool = True,
    view: str = "three-quarter",
    fps: float | None = None,
    size: int | tuple[int, int] = 480,
    colour: str | None = None,
    body: Body | None = None,
    force: bool = False,
    progress: Progress = untold,
) -> Path:
    """Write a film of a motion to a ``.gif`` or ``.mp4`` file and return its path.

    The camera follows the hips smoothly over a metre grid that stays in place, so that a sliding
    foot is seen. ``against`` (such as the motion before an edit) is shown to the left, or as a ghost
    behind with ``beside=False``, turned to face the same way if it is another clip; a motion that ends
    first holds its last frame. ``view`` is one of those of ``strip``, from where the body faces on
    average. ``fps`` defaults to the clip's own rate or the largest whole part of it up to 30. ``size``
    is the height of the picture, or (width, height) of each figure's panel. ``colour`` and ``body``
    are as in ``strip``. ``progress`` is told before each picture; what it raises ends the film.

    The file appears whole or not at all. Raises ``MienError`` for another file ending, an unknown
    view, a rate or size out of range, or MP4 without PyAV; ``FormatError`` when the file exists and
    ``force`` is not set, or cannot be written.
    """
    path = Path(path)
    rate = frame_rate(path, motion.fps, fps)
    files.check_target(path, force=force)
    width, height = (size, size) if isinstance(size, int) else size
    if not (32 <= width <= 4096 and 32 <= height <= 4096):
        raise MienError(f"a film needs 32 to 4096 pixels each way, got {width} x {height}")
    size = width - width % 2, height - height % 2  # H.264 wants even sizes
    before = None
    if against is not None:
        before = Figure.of(against, body=body, colour=colour if beside else GHOST)
    figure = Figure.of(motion, body=body, colour=colour, like=before)
    panels = _panels(figure, before, beside, view, size)
    length = max(motion.duration, against.duration if against else 0.0)
    count = int(np.floor(length * rate + 1e-6)) + 1
    pictures = _pictures(panels, count, rate, progress)
    files.write(path, encode(path, pictures, rate))
    return path


@dataclass(frozen=True, eq=False)
class _Panel:
    """A figure, and behind it perhaps a ghost, seen by a camera that follows it."""

    label: str
    size: tuple[int, int]
    figures: list["_Actor"]
    scale: float  # pixels a leg length
    middle: Array  # where the origin is drawn (2,)


class _Actor:
    """A figure over time, seen along ``axes``; solids are made for a run of frames at once."""

    def __init__(self, figure: Figure, axes: Array, *, ghost: bool = False) -> None:
        self.figure, self.axes, self.ghost = figure, axes, ghost
        self.path = figure.steady_ground()
        self.solids: Solids | None = None
        self.first = 0

    def frame(self, time: float) -> int:
        return min(round(time / self.figure.motion.frame_time), len(self.figure.motion) - 1)

    def pose(self, frame: int) -> tuple[Solids, int]:
        """Return solids and which pose of them is ``frame``."""
        if self.solids is None or not 0 <= frame - self.first < CHUNK:
            self.first = frame
            stop = min(frame + CHUNK, len(self.figure.motion))
            self.solids = self.figure.solids(np.arange(frame, stop))
        return self.solids, frame - self.first


def _panels(
    figure: Figure, before: Figure | None, beside: bool, view: str, size: tuple[int, int]
) -> list[_Panel]:
    axes = view_axes(view, figure.up, figure.mean_facing())
    actor = _Actor(figure, axes)
    if before is None:
        return _to_one_scale([("", [actor])], size)
    labels = "original", "edited"
    if not figure.made_from(before):
        axes = view_axes(view, before.up, before.mean_facing())
        labels = before.motion.name or "one clip", figure.motion.name or "another clip"
    other = _Actor(before, axes, ghost=not beside)
    groups = [(labels[0], [other]), (labels[1], [actor])] if beside else [("", [other, actor])]
    return _to_one_scale(groups, size)


def _to_one_scale(groups: list[tuple[str, list[_Actor]]], size: tuple[int, int]) -> list[_Panel]:
    """Return panels in which every figure fits, all to the same scale."""
    extents = np.concatenate([_extents(actor) for _, actors in groups for actor in actors])
    low, high = extents[:, 0].min(axis=0), extents[:, 1].max(axis=0)
    low[1] = min(low[1], 0.0)
    scale = min(np.array(size) / (high - low + 0.4))
    middle = np.array(size) / 2 + scale * np.array([-1.0, 1.0]) * (low + high) / 2
    return [_Panel(label, size, actors, float(scale), middle) for label, actors in groups]


def _extents(actor: _Actor) -> Array:
    """Return low and high reach (N, 2, 2) from the followed point, right and up, in leg lengths."""
    figure, axes = actor.figure, actor.axes
    frames = np.unique(np.linspace(0, len(figure.motion) - 1, 60).round().astype(np.int64))
    solids = figure.solids(frames)
    reach = np.array([solids.bounds(k, axes[:2]) for k in range(len(frames))])
    return (reach - (actor.path[frames] @ axes[:2].T)[:, None]) / figure.size


def _pictures(panels: list[_Panel], count: int, rate: float, progress: Progress) -> Iterator[Array]:
    for k in range(count):
        progress("drawing", k / count)
        yield _picture(panels, k / rate)
    progress("writing", None)


def _picture(panels: list[_Panel], time: float) -> Array:
    """Return the picture ``(H, W, 3)`` uint8 of all panels at a time in seconds."""
    canvases = [_panel_picture(panel, time) for panel in panels]
    image = to_image(np.concatenate(canvases, axis=1))
    if panels[0].label:
        _label(image, panels)
    return np.asarray(image)


def _label(image: "Image", panels: list[_Panel]) -> None:
    from PIL import ImageDraw, ImageFont

    width, height = panels[0].size
    pen, font = ImageDraw.Draw(image), ImageFont.load_default(max(10, height // 28))
    for i, panel in enumerate(panels):
        pen.text(((i + 0.5) * width, height - 6), panel.label, FAINT, font, anchor="mb")


def _panel_picture(panel: _Panel, time: float) -> Array:
    width, height = panel.size
    canvas = np.empty((height, width, 3), np.float32)
    canvas[:] = PAPER
    dark = np.zeros((height, width), np.float32)
    layers = []
    for actor in panel.figures:
        figure, frame = actor.figure, actor.frame(time)
        x, y = (float(v) for v in panel.middle)
        camera = Camera(actor.axes, actor.path[frame], x, y, panel.scale / figure.size)
        solids, pose = actor.pose(frame)
        if not actor.ghost:
            step = 0.5 * figure.size if figure.metres is None else 0.5 / figure.metres
            grid(canvas, camera, figure.up, actor.path[frame], figure.size, step)
            shadow(dark, solids, pose, camera, figure.up, figure.floor, figure.size)
        layers.append((draw(solids, pose, camera, panel.size, figure.palette), actor.ghost))
    canvas *= 1.0 - dark[..., None]
    for layer, ghost in layers:
        paste(canvas, layer, opacity=OPACITY if ghost else 1.0)
    return canvas
