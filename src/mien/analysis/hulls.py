"""Volumes of convex hulls: of a few points in every frame, all at once, and of many points in one go.

Qhull, called frame by frame, takes most of its time to start: 0.1 ms for twelve points, 0.4 s for six groups
of points in 600 frames. Here every frame is done at the same time, in 0.03 s. A triangle of points is a face
of the hull where all other points lie on one side of it; on which side a point lies is the sign of a
tetrahedron's volume, and each tetrahedron serves four triangles and every group of points that holds it.
"""

from collections.abc import Sequence
from functools import lru_cache
from itertools import combinations

import numpy as np

from ..typing import Array, Integers

NUDGE = 1e-9  # of the points' extent: moves every point a little, so that no four lie in one plane
FLAT = 1e-7  # of the extent's cube: a smaller hull is flat
_BLOCK = 120_000  # tetrahedra worked on at a time, which fit the processor's cache


def hull_volumes(points: Array, groups: Sequence[Sequence[int]]) -> Array:
    """Return the volume (T, G) of the convex hull of each group of ``points`` (T, N, 3), frame by frame.

    ``V = 1/6 sum over faces of a . (b x c)``, faces oriented outwards: exact but for a nudge of every point
    by 1e-9 of the extent, which takes ties away. A flat or empty hull, and fewer than four points, give 0.
    The work grows with ``N^4``: meant for 20 points or fewer.

    >>> corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]], float)
    >>> round(float(hull_volumes(corners, [range(4)])[0, 0]), 6)
    0.166667
    """
    count = points.shape[1]
    chosen = tuple(tuple(sorted(set(map(int, group)))) for group in groups)
    out = np.zeros((len(points), len(chosen)))
    if count < 4 or not chosen:
        return out
    rows, plan = _rows(points), _plan(count, chosen)
    extent = np.abs(rows).max(axis=(0, 1))
    frames = min(len(points), max(1, _BLOCK // len(plan.base)))
    room = _Room(plan, frames)
    for start in range(0, len(points), frames):
        if len(points) - start < frames:  # the last block is shorter
            room = _Room(plan, len(points) - start)
        part = slice(start, start + frames)
        out[part] = _volumes(np.ascontiguousarray(rows[..., part]), plan, room)
    out[out < FLAT * extent[:, None] ** 3] = 0.0
    return out


def _rows(points: Array) -> Array:
    """Return the points, centred and nudged, in rows over frames (N, 3, T)."""
    rows = np.ascontiguousarray(np.moveaxis(points - points.mean(axis=1, keepdims=True), 0, -1))
    extent = np.abs(rows).max(axis=(0, 1))
    rows += NUDGE * extent * np.random.default_rng(0).uniform(-1.0, 1.0, (points.shape[1], 3, 1))
    return rows


class _Room:
    """Memory for one block of frames, taken once: to ask for it again and again costs more than the work."""

    def __init__(self, plan: "_Plan", frames: int) -> None:
        triangles, quads = len(plan.triangles), len(plan.base)
        self.corners = np.empty((3, triangles, 3, frames))
        self.normal = np.empty((3, triangles, frames))
        self.height, self.spare = np.empty((triangles, frames)), np.empty((triangles, frames))
        self.beyond, self.one, self.other = (np.empty((quads, frames)) for _ in range(3))
        self.side = np.empty((quads, frames), np.float32)


def _volumes(rows: Array, plan: "_Plan", room: _Room) -> Array:
    """Return the volumes (t, G) for points in rows over frames (N, 3, t), no four of them in a plane."""
    face = _faces(rows, plan, room)
    return np.add.reduceat(face * room.height[plan.triangle_of], plan.starts, axis=0).T / 6.0


def _faces(rows: Array, plan: "_Plan", room: _Room) -> Array:
    """Return 1 or -1 (R, t) where a triangle of a group is a face of its hull, seen from outside, else 0."""
    _planes(rows, plan, room)
    side = plan.sides @ _sides(rows, plan, room)
    return np.where(np.abs(side) == plan.others[:, None], -np.sign(side), 0.0)


def _planes(rows: Array, plan: "_Plan", room: _Room) -> None:
    """Work out the normal ``(b - a) x (c - a)`` of each triangle, and its height ``normal . a``."""
    for i, corner in enumerate(room.corners):
        np.take(rows, plan.triangles[:, i], axis=0, out=corner, mode="clip")
    a, u, v = room.corners
    u -= a
    v -= a
    room.height[:] = 0.0
    for i, normal in enumerate(room.normal):
        j, k = (i + 1) % 3, (i + 2) % 3
        np.multiply(u[:, j], v[:, k], out=normal)
        normal -= np.multiply(u[:, k], v[:, j], out=room.spare)
        room.height += np.multiply(normal, a[:, i], out=room.spare)


def _sides(rows: Array, plan: "_Plan", room: _Room) -> Array:
    """Return 1 or -1 (Q, t): on which side of the plane of each base its apex lies."""
    room.beyond[:] = 0.0
    for i, normal in enumerate(room.normal):
        np.take(normal, plan.base, axis=0, out=room.one, mode="clip")
        np.take(rows[:, i], plan.apex, axis=0, out=room.other, mode="clip")
        room.beyond += np.multiply(room.one, room.other, out=room.one)
    room.beyond -= np.take(room.height, plan.base, axis=0, out=room.one, mode="clip")
    return np.sign(room.beyond, out=room.side, casting="unsafe")


class _Plan:
    """Which tetrahedra tell about which triangles, for each group of points.

    ``triangles`` (M, 3). Tetrahedra have a ``base`` (Q) among them and an ``apex`` (Q). For every triangle of
    every group, one after the other from ``starts`` (G) on: ``triangle_of`` (R), the number of ``others``
    (R), and a row of ``sides`` (R, Q), which adds up on which side they lie.
    """

    def __init__(self, count: int, groups: tuple[tuple[int, ...], ...]) -> None:
        from scipy.sparse import csr_array

        listed = list(combinations(range(count), 3))
        place: dict[tuple[int, ...], int] = {triangle: i for i, triangle in enumerate(listed)}
        quads = list(combinations(range(count), 4))
        of_quad: dict[tuple[int, ...], int] = {quad: i for i, quad in enumerate(quads)}
        self.triangles: Integers = np.array(listed)
        self.base: Integers = np.array([place[q[:3]] for q in quads])
        self.apex: Integers = np.array([q[3] for q in quads])
        starts: list[int] = []
        triangle_of: list[int] = []
        others: list[int] = []
        row: list[int] = []
        column: list[int] = []
        sign: list[float] = []
        for group in groups:
            starts.append(len(triangle_of))
            for triangle in combinations(group, 3) if len(group) > 3 else [listed[0]]:
                for apex in set(group) - set(triangle) if len(group) > 3 else ():
                    quad = tuple(sorted((*triangle, apex)))
                    row.append(len(triangle_of))
                    column.append(of_quad[quad])
                    sign.append(1.0 if (3 - quad.index(apex)) % 2 == 0 else -1.0)
                triangle_of.append(place[triangle])
                others.append(len(group) - 3 if len(group) > 3 else -1)  # -1: never a face
        shape = (len(triangle_of), len(quads))
        self.starts, self.triangle_of = np.array(starts), np.array(triangle_of)
        self.others = np.array(others)
        self.sides = csr_array((np.array(sign, np.float32), (row, column)), shape=shape)


@lru_cache(maxsize=16)
def _plan(count: int, groups: tuple[tuple[int, ...], ...]) -> _Plan:
    return _Plan(count, groups)


def hull_faces(points: Array, groups: Sequence[Sequence[int]]) -> list[Integers]:
    """Return for each group the faces (T, F, 3) of its hull in every frame, as indices of ``points``.

    Corners are in order seen from outside; where a frame has fewer faces than another, the last ones are
    ``0 0 0``. ``faces_volumes`` of them is ``hull_volumes``, and stays near to it while points move a little.

    >>> corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]], float)
    >>> hull_faces(corners, [range(4)])[0].shape
    (1, 4, 3)
    """
    frames, count = points.shape[:2]
    chosen = tuple(tuple(sorted(set(map(int, group)))) for group in groups)
    if count < 4 or not chosen:
        return [np.zeros((frames, 0, 3), np.int64)] * len(chosen)
    rows, plan = _rows(points), _plan(count, chosen)
    step = max(1, _BLOCK // len(plan.base))
    parts = [rows[..., start : start + step] for start in range(0, frames, step)]
    signs = np.concatenate(
        [_faces(np.ascontiguousarray(p), plan, _Room(plan, p.shape[-1])) for p in parts], axis=1
    )
    stops = np.append(plan.starts[1:], len(plan.triangle_of))
    return [
        _listed(plan.triangles[plan.triangle_of[a:b]], signs[a:b])
        for a, b in zip(plan.starts, stops, strict=True)
    ]


def _listed(triangles: Integers, signs: Array) -> Integers:
    """Return the triangles (T, F, 3) whose ``signs`` (R, T) are not 0, turned over where it is negative."""
    frame, row = np.nonzero(signs.T)
    count = np.bincount(frame, minlength=signs.shape[1])
    place = np.arange(len(frame)) - (np.cumsum(count) - count)[frame]
    out = np.zeros((len(count), int(count.max(initial=0)), 3), np.int64)
    turned = np.where(signs[row, frame][:, None] < 0.0, triangles[row][:, ::-1], triangles[row])
    out[frame, place] = turned
    return out


def faces_volumes(points: Array, faces: Sequence[Integers]) -> Array:
    """Return the volumes (T, G) inside each of ``faces`` (T, F, 3) of ``points`` (T, N, 3).

    ``1/6 sum a . (b x c)`` over the faces.

    >>> corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]], float)
    >>> round(float(faces_volumes(corners, hull_faces(corners, [range(4)]))[0, 0]), 6)
    0.166667
    """
    every = np.concatenate(faces, axis=1)
    rows = np.ascontiguousarray(np.moveaxis(points - points[:, :1], -1, 0))  # (3, T, N)
    frames = np.arange(len(every))[:, None]
    (a, b, c), (d, e, f), (g, h, i) = np.moveaxis(rows[:, frames[..., None], every], -1, 0)
    parts = a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
    stops = np.cumsum([part.shape[1] for part in faces])
    total = np.concatenate([np.zeros((len(every), 1)), np.cumsum(parts, axis=1)], axis=1)
    return np.asarray(np.diff(total[:, [0, *stops]], axis=1) / 6.0)


def hull_size(points: Array) -> float:
    """Return the volume of the convex hull of ``points`` (N, 3), or the area of that of (N, 2).

    0 where they lie in a plane (or on a line), or are too few: Qhull finds no hull there.

    >>> hull_size(np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [0.5, 0.5]]))
    2.0
    """
    from scipy.spatial import ConvexHull, QhullError

    flat = points.reshape(-1, points.shape[-1])
    extent = float(np.ptp(flat, axis=0).max()) if len(flat) else 0.0
    if len(flat) <= flat.shape[1] or not extent > 0.0:
        return 0.0
    try:
        size = float(ConvexHull(flat).volume)
    except QhullError:
        return 0.0
    return size if size > FLAT * extent ** flat.shape[1] else 0.0
