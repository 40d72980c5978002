"""What figures stand on: soft shadows below the body, and a metre grid that makes sliding feet visible."""

import numpy as np

from ..typing import Array
from .solids import Camera, Solids

DARKNESS, FADE, REACH = 0.34, 0.16, 0.4  # of the shadow; heights in leg lengths
SHADE, LINE, PATCH = 0.045, 0.10, 2.2  # darkness of floor and grid lines; radius of the floor in leg lengths


def shadow(
    dark: Array, solids: Solids, pose: int, camera: Camera, up: Array, floor: float, size: float
) -> None:
    """Darken ``dark (H, W)``, 0 to 1, in place below every part near the floor, less the higher it is."""
    points = np.concatenate([solids.starts[pose], solids.ends[pose], solids.centres[pose]])
    reach = np.linalg.norm(solids.axes[pose], axis=1).min(axis=-1) if len(solids.axes[pose]) else np.zeros(0)
    radii = np.concatenate([solids.start_radii, solids.end_radii, reach])
    height = np.maximum(points @ up - floor - radii, 0.0) / size
    near = np.flatnonzero(height < REACH)
    spots = camera.project(points[near] + (floor - points[near] @ up)[:, None] * up)
    tilt = max(abs(float(camera.axes[2] @ up)), 0.12)
    for spot, radius, h in zip(spots, radii[near] * camera.scale, height[near], strict=True):
        spread = radius * (1.3 + 2.0 * h) + 1.0
        _spot(dark, spot, spread, spread * tilt, DARKNESS * np.exp(-h / FADE))


def _spot(dark: Array, centre: Array, width: float, height: float, strength: float) -> None:
    x0, x1 = (int(np.clip(centre[0] + s * 2.5 * width, 0, dark.shape[1])) for s in (-1, 1))
    y0, y1 = (int(np.clip(centre[1] + s * 2.5 * height + 1, 0, dark.shape[0])) for s in (-1, 1))
    x = np.exp(-(((np.arange(x0, x1) + 0.5 - centre[0]) / width) ** 2))
    y = np.exp(-(((np.arange(y0, y1) + 0.5 - centre[1]) / height) ** 2))
    part = dark[y0:y1, x0:x1]
    np.maximum(part, strength * y[:, None] * x[None], out=part)


def grid(canvas: Array, camera: Camera, up: Array, middle: Array, size: float, step: float) -> None:
    """Draw a round patch of floor around ``middle (3)`` with lines every ``step`` units, in place.

    The lines stay where they are in the world while the camera moves.
    """
    tilt = float(camera.axes[2] @ up)
    if tilt < 0.05:
        _edge(canvas, camera, middle, step)
        return
    height, width = canvas.shape[:2]
    centre, radius = camera.project(middle), PATCH * size * camera.scale
    top, end = (int(np.clip(centre[1] + s * radius * tilt, 0, height)) for s in (-1, 1))
    # A pixel's point on the floor: from the middle, along the camera's right and along the floor away.
    away = np.cross(up, camera.axes[0])
    right = ((np.arange(width) + 0.5 - centre[0]) / camera.scale)[None].astype(np.float32)
    back = ((centre[1] - np.arange(top, end) - 0.5) / (camera.scale * tilt))[:, None].astype(np.float32)
    lines = np.zeros((end - top, width), np.float32)
    first = _floor_axis(up)
    for axis in (first, np.cross(up, first)):
        across, along = float(camera.axes[0] @ axis), float(away @ axis)
        place = (float(middle @ axis) / step % 1.0 + across / step * right) + along / step * back
        place -= np.rint(place)
        pixels = step * camera.scale / np.hypot(across, along / tilt)  # from line to line
        np.maximum(lines, 1.3 - np.abs(place) * np.float32(pixels), out=lines)
    patch = 2.0 - (2.0 / (PATCH * size) ** 2) * (right**2 + back**2)
    patch = np.clip(patch, 0.0, 1.0, out=patch)
    canvas[top:end] *= (1.0 - patch * (SHADE + LINE * np.minimum(lines, 1.0)))[..., None]


def _edge(canvas: Array, camera: Camera, middle: Array, step: float) -> None:
    """Draw the floor as seen from the side: a band, with a mark every ``step`` units to the right."""
    centre = camera.project(middle)
    y = int(np.clip(round(centre[1]), 0, len(canvas)))
    canvas[y:] *= 1.0 - SHADE
    units = (np.arange(canvas.shape[1]) + 0.5 - centre[0]) / camera.scale + middle @ camera.axes[0]
    away = np.abs(units - np.rint(units / step) * step) * camera.scale
    canvas[y : y + 8] *= (1.0 - 2.0 * LINE * np.clip(1.3 - away, 0.0, 1.0))[:, None]


def _floor_axis(up: Array) -> Array:
    """Return the world axis that is most level."""
    axis = np.eye(3)[int(np.argmin(np.abs(up)))]
    level = axis - (axis @ up) * up
    return level / np.linalg.norm(level)
