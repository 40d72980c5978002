"""A small software renderer: round cones and ellipsoids with true depth, shaded, on an RGB canvas.

Every solid is met exactly at each pixel: a parallel ray and a quadric give a quadratic in the depth
(after Quilez, "Intersectors", for the round cone). A depth buffer keeps the nearest surface, light is
worked out once a pixel at the end, and two samples a pixel each way smooth the edges.
"""

from dataclasses import dataclass

import numpy as np

from ..typing import Array, Integers
from .solids import Camera, Solids

SAMPLES = 2
LIGHT = np.array([-0.42, -0.62, 0.66])  # right, down, towards the viewer: over the viewer's left shoulder
AMBIENT, OUTLINE = 0.42, 0.45


@dataclass(frozen=True, eq=False)
class Layer:
    """A drawn figure: premultiplied ``colour (h, w, 3)``, ``cover (h, w)`` in [0, 1], at pixel ``x, y``."""

    colour: Array
    cover: Array
    x: int
    y: int


class _Buffer:
    """Depth, surface normal and colour index of the nearest surface in a window of the picture."""

    def __init__(self, left: int, top: int, width: int, height: int) -> None:
        self.left, self.top = left, top
        self.depth = np.full((height, width), -np.inf, np.float32)
        self.normal = np.zeros((2, height, width), np.float32)
        self.index = np.full((height, width), -1, np.int16)

    def window(self, box: Integers) -> tuple[tuple[slice, slice], Array, Array]:
        """Return the slices of a pixel box, with its rows (h, 1) and columns (1, w)."""
        x0, y0, x1, y1 = (int(v) for v in box)
        part = (slice(y0 - self.top, y1 - self.top), slice(x0 - self.left, x1 - self.left))
        rows = np.arange(y0, y1, dtype=np.float32)[:, None]
        return part, rows + np.float32(0.5), np.arange(x0, x1, dtype=np.float32)[None] + np.float32(0.5)

    def merge(self, part: tuple[slice, slice], z: Array, nx: Array, ny: Array, colour: int) -> None:
        """Keep the surface where it is nearer than what is there; NaN means no surface."""
        nearer = z > self.depth[part]
        np.copyto(self.depth[part], z, where=nearer)
        np.copyto(self.normal[0][part], nx, where=nearer)
        np.copyto(self.normal[1][part], ny, where=nearer)
        np.copyto(self.index[part], colour, where=nearer)


def draw(solids: Solids, pose: int, camera: Camera, size: tuple[int, int], palette: Array) -> Layer | None:
    """Return the picture of one pose on a canvas of ``size`` (width, height), or None if it is outside.

    ``palette (K, 3)`` holds the colours, 0 to 255.
    """
    fine = Camera(camera.axes, camera.centre, camera.x * SAMPLES, camera.y * SAMPLES, camera.scale * SAMPLES)
    a, b = fine.project(solids.starts[pose]), fine.project(solids.ends[pose])
    ra, rb = solids.start_radii * fine.scale, solids.end_radii * fine.scale
    centres, axes = fine.project(solids.centres[pose]), fine.turn(solids.axes[pose])
    boxes = _boxes(a, b, ra, rb, centres, axes, size)
    seen = np.flatnonzero((boxes[:, :2] < boxes[:, 2:]).all(axis=1))
    if not len(seen):
        return None
    left, top = boxes[seen, :2].min(axis=0) // SAMPLES * SAMPLES
    right, bottom = -(-boxes[seen, 2:].max(axis=0) // SAMPLES) * SAMPLES
    buffer = _Buffer(int(left), int(top), int(right - left), int(bottom - top))
    shapes = np.linalg.inv(axes @ np.swapaxes(axes, -1, -2))
    with np.errstate(invalid="ignore", divide="ignore"):
        for i in seen:
            part, rows, columns = buffer.window(boxes[i])
            if i < len(a):
                surface = _cone(columns, rows, a[i], b[i], ra[i], rb[i])
            else:
                surface = _ellipsoid(columns, rows, centres[i - len(a)], shapes[i - len(a)])
            buffer.merge(part, *surface, int(solids.colours[i]))
    return _resolve(buffer, palette)


def _boxes(
    a: Array, b: Array, ra: Array, rb: Array, centres: Array, axes: Array, size: tuple[int, int]
) -> Integers:
    """Return the pixel box (left, top, right, bottom) of every solid, cut to the canvas."""
    ra, rb = ra[:, None], rb[:, None]
    low = np.minimum(a[:, :2] - ra, b[:, :2] - rb)
    high = np.maximum(a[:, :2] + ra, b[:, :2] + rb)
    reach = np.linalg.norm(axes, axis=-1)[:, :2]
    low = np.concatenate([low, centres[:, :2] - reach])
    high = np.concatenate([high, centres[:, :2] + reach])
    limit = np.array(size) * SAMPLES
    return np.concatenate(
        [np.clip(np.floor(low), 0, limit), np.clip(np.ceil(high), 0, limit)], axis=1
    ).astype(np.int64)


def _ellipsoid(x: Array, y: Array, centre: Array, shape: Array) -> tuple[Array, Array, Array]:
    """Depth and normal where the ray meets ``q . shape q = 1``, with q from the centre; NaN elsewhere."""
    m = shape.astype(np.float32)
    x, y = x - np.float32(centre[0]), y - np.float32(centre[1])
    slope = m[0, 2] * x + m[1, 2] * y
    rest = m[0, 0] * x * x + (2 * m[0, 1]) * x * y + (m[1, 1] * y * y - 1)
    z = (np.sqrt(slope * slope - m[2, 2] * rest) - slope) / m[2, 2]
    nx = m[0, 0] * x + m[0, 1] * y + m[0, 2] * z
    ny = m[0, 1] * x + m[1, 1] * y + m[1, 2] * z
    nz = slope + m[2, 2] * z
    length = np.sqrt(nx * nx + ny * ny + nz * nz)
    return z + np.float32(centre[2]), nx / length, ny / length


def _cone(x: Array, y: Array, a: Array, b: Array, ra: float, rb: float) -> tuple[Array, Array, Array]:
    """Depth and normal where the ray meets the hull of two spheres; NaN elsewhere.

    The hull is swept by spheres at ``a + t d`` of radius ``ra + t s``. A point ``q`` from ``a`` lies on
    the sweep when ``t = (d.q + s ra) / m``, ``m = d.d - s^2`` and ``m (q.q - ra^2) = (d.q + s ra)^2``.
    """
    d, s, ra = (b - a).astype(np.float32), float(rb - ra), float(ra)
    x, y = x - np.float32(a[0]), y - np.float32(a[1])
    flat = x * x + y * y - ra * ra
    far = flat - 2 * (d[0] * x + d[1] * y) + (d[0] ** 2 + d[1] ** 2 + ra * ra - (ra + s) ** 2)
    z = np.sqrt(-flat)
    t = np.zeros_like(z)
    z, t = _nearer(z, t, d[2] + np.sqrt(-far), np.float32(1.0))
    m = float(d @ d - s * s)
    if m > 1e-6 * float(ra * ra):
        for body, at in _sweep(x, y, d, s, ra, m, flat):
            z, t = _nearer(z, t, np.where((at >= 0) & (at <= 1), body, np.float32(np.nan)), at)
    radius = ra + s * t
    return z + np.float32(a[2]), (x - t * d[0]) / radius, (y - t * d[1]) / radius


def _sweep(
    x: Array, y: Array, d: Array, s: float, ra: float, m: float, flat: Array
) -> list[tuple[Array, Array]]:
    """Return depth and ``t`` of the cone between the spheres: one root, or both where it points at us."""
    g = d[0] * x + d[1] * y + s * ra
    k = m - float(d[2]) ** 2
    if abs(k) < 1e-5 * m:
        k = 1e-5 * m
    root = np.sqrt((g * d[2]) ** 2 - k * (m * flat - g * g))
    roots = [(g * d[2] + sign * root) / k for sign in ((1,) if k > 0 else (1, -1))]
    return [(z, (g + d[2] * z) / m) for z in roots]


def _nearer(z: Array, t: Array, other_z: Array, other_t: Array | np.float32) -> tuple[Array, Array]:
    take = (other_z > z) | np.isnan(z)
    return np.where(take, other_z, z), np.where(take, other_t, t)


def _resolve(buffer: _Buffer, palette: Array) -> Layer:
    """Light the nearest surfaces and average the samples of each pixel."""
    hit = np.flatnonzero(buffer.index >= 0)
    nx, ny = buffer.normal.reshape(2, -1)[:, hit]
    nz = np.sqrt(np.maximum(1.0 - nx * nx - ny * ny, 0.0))
    x, y, z = (LIGHT / np.linalg.norm(LIGHT)).astype(np.float32)
    # Half-Lambert light reaches round the body, so that no part drowns in black; edges turn darker.
    lit = 0.5 + 0.5 * (nx * x + ny * y + nz * z)
    lit = (AMBIENT + (1.0 - AMBIENT) * lit * np.sqrt(lit)) * (0.82 + 0.26 * nz)
    lit *= 1.0 - OUTLINE * _steps(buffer).ravel()[hit]
    seen = palette.astype(np.float32)[buffer.index.ravel()[hit]] * lit[:, None]
    samples = np.zeros((*buffer.index.shape, 4), np.float32)  # red, green, blue and cover
    flat = samples.reshape(-1, 4)
    flat[hit, :3] = np.minimum(seen, 255.0)
    flat[hit, 3] = 1.0
    pixels = 0.25 * (samples[::2, ::2] + samples[1::2, ::2] + samples[::2, 1::2] + samples[1::2, 1::2])
    return Layer(pixels[..., :3], pixels[..., 3], buffer.left // SAMPLES, buffer.top // SAMPLES)


def _steps(buffer: _Buffer) -> Array:
    """Return 1 where a nearer surface begins beside a pixel and 0 where the depth is smooth."""
    far = np.float32(-1e9)
    depth = np.maximum(buffer.depth, far)
    size = np.float32(0.02 * np.hypot(*depth.shape))  # a depth step that counts, in samples
    step = np.zeros(depth.shape, np.float32)
    across, down = depth[:, 1:] - depth[:, :-1], depth[1:] - depth[:-1]
    # Only between two surfaces: the outline against the paper is clear without a line.
    across[np.abs(across) > 1e8] = 0.0
    down[np.abs(down) > 1e8] = 0.0
    step[:, :-1] = across
    np.maximum(step[:, 1:], -across, out=step[:, 1:])
    np.maximum(step[:-1], down, out=step[:-1])
    np.maximum(step[1:], -down, out=step[1:])
    return np.clip(step / size - 0.5, 0.0, 1.0)


def paste(canvas: Array, layer: Layer | None, *, opacity: float = 1.0) -> None:
    """Lay a drawn figure over ``canvas (H, W, 3)`` in place, as solid as ``opacity`` says."""
    if layer is None:
        return
    height, width = layer.cover.shape
    part = canvas[layer.y : layer.y + height, layer.x : layer.x + width]
    part *= 1.0 - opacity * layer.cover[..., None]
    part += opacity * layer.colour
