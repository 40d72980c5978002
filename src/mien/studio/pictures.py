"""Small pictures of presets for the panel: one moment of the sample walk, edited; made once, then kept.

The ground is left clear, so that a picture sits as well in dark colours as in light ones.
"""

from hashlib import sha256
from importlib.metadata import version
from io import BytesIO
from pathlib import Path

import numpy as np

from ..emotion.presets import PRESETS, preset
from ..emotion.resolve import apply
from ..errors import MienError, unknown
from ..formats import files
from ..motion import Motion
from ..render.figure import Figure
from ..render.ground import shadow
from ..render.raster import draw, paste
from ..render.sheet import Shot
from ..render.solids import view_axes
from ..render.strip import pose_frames
from ..samples import walk
from ..typing import Array

SECONDS = 2.4
WIDTH, HEIGHT, FLOOR = 200, 250, 228  # pixels: of the picture, and from its top to the floor
TALLEST, WIDEST = 206, 190  # pixels: of the figure
STYLE = "clear ground"  # how they are drawn; another word here, and kept ones are made anew


def preset_picture(name: str, folder: Path) -> bytes:
    """Return the picture of a preset as PNG, kept in a folder; raises ``MienError`` for an unknown one."""
    if name not in PRESETS:
        raise MienError(unknown("preset", name, PRESETS))
    made_of = sha256(f"{STYLE} {version('mien')} {preset(name)!r}".encode()).hexdigest()
    path = folder / "pictures" / f"{made_of}.png"
    try:
        return path.read_bytes()
    except OSError:
        made = _picture(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    files.write(path, made)
    return made


def _picture(name: str) -> bytes:
    from PIL import Image

    canvas = _drawn(apply(walk(seconds=SECONDS).motion, preset(name)))
    data = BytesIO()
    Image.fromarray(np.rint(canvas).astype(np.uint8), "RGBA").save(data, "PNG")
    return data.getvalue()


def _drawn(motion: Motion) -> Array:
    """Return red, green, blue and cover ``(H, W, 4)``, 0 to 255, of the figure halfway, and of its shadow."""
    figure = Figure.of(motion)
    frames = pose_frames(len(motion), 1)
    axes = view_axes("three-quarter", figure.up, figure.facing[frames[0]])
    shot = Shot(figure, figure.solids(frames), 0, figure.ground[frames[0]], axes)
    left, right, _, high = shot.extent()
    scale = min(TALLEST / high, WIDEST / (right - left))
    camera = shot.camera(WIDTH / 2 - scale * (left + right) / 2, FLOOR, scale)
    cover = np.zeros((HEIGHT, WIDTH), np.float32)
    shadow(cover, shot.solids, 0, camera, figure.up, figure.floor, figure.size)
    colour, solid = np.zeros((HEIGHT, WIDTH, 3), np.float32), np.zeros((HEIGHT, WIDTH), np.float32)
    if layer := draw(shot.solids, 0, camera, (WIDTH, HEIGHT), figure.palette):
        paste(colour, layer)
        rows, columns = layer.cover.shape
        solid[layer.y : layer.y + rows, layer.x : layer.x + columns] = layer.cover
    cover = solid + (1.0 - solid) * cover
    # Colours were weighted with the cover, a picture file wants them plain.
    colour /= np.maximum(cover, 1e-6)[..., None]
    return np.clip(np.concatenate([colour, 255.0 * cover[..., None]], axis=-1), 0.0, 255.0)
