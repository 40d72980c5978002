"""The solid parts a figure is drawn with, and the camera that sees them: plain arrays, no drawing."""

from dataclasses import dataclass

import numpy as np

from ..errors import MienError, unknown
from ..typing import Array, Integers


@dataclass(frozen=True, eq=False)
class Solids:
    """Round cones (the hull of two spheres) and ellipsoids over ``F`` poses, in world axes.

    ``starts``, ``ends`` (F, C, 3) and their ``start_radii``, ``end_radii`` (C); ``centres`` (F, E, 3)
    and ``axes`` (F, E, 3, 3), whose columns are the three half axes; ``colours`` (C + E) indexes a
    palette. Lengths in the clip's unit.
    """

    starts: Array
    ends: Array
    start_radii: Array
    end_radii: Array
    centres: Array
    axes: Array
    colours: Integers

    def bounds(self, pose: int, directions: Array) -> tuple[Array, Array]:
        """Return the lowest and highest reach ``(D,)`` of a pose along unit ``directions (D, 3)``."""
        a, b = self.starts[pose] @ directions.T, self.ends[pose] @ directions.T
        ra, rb = self.start_radii[:, None], self.end_radii[:, None]
        c = self.centres[pose] @ directions.T
        reach = np.linalg.norm(np.swapaxes(self.axes[pose], 1, 2) @ directions.T, axis=1)
        low = np.concatenate([a - ra, b - rb, c - reach]).min(axis=0)
        high = np.concatenate([a + ra, b + rb, c + reach]).max(axis=0)
        return low, high


@dataclass(frozen=True, eq=False)
class Camera:
    """A parallel projection: ``axes (3, 3)`` rows right, up and towards the viewer, in world axes.

    ``centre (3)`` is the world point drawn at pixel ``(x, y)``; ``scale`` is pixels a unit of length.
    """

    axes: Array
    centre: Array
    x: float
    y: float
    scale: float

    def project(self, points: Array) -> Array:
        """Return pixels right, pixels down and pixels towards the viewer ``(..., 3)`` of world points."""
        seen = (points - self.centre) @ self.axes.T * self.scale
        return seen * [1.0, -1.0, 1.0] + [self.x, self.y, 0.0]

    def turn(self, vectors: Array) -> Array:
        """Return world vectors, as columns ``(..., 3, n)``, in pixels as ``project`` has them."""
        flip = np.array([[1.0], [-1.0], [1.0]]) * self.scale
        return (flip * self.axes) @ vectors


# Where each named view looks from: turned from the front to the body's right, and raised (degrees).
VIEWS = {
    "front": (0.0, 0.0),
    "side": (90.0, 0.0),
    "right": (90.0, 0.0),
    "left": (-90.0, 0.0),
    "back": (180.0, 0.0),
    "three-quarter": (40.0, 12.0),
    "top": (0.0, 90.0),
}


def view_axes(view: str, up: Array, forward: Array) -> Array:
    """Return the camera axes ``(3, 3)`` of a named view of a body that faces ``forward``.

    ``side`` looks from the body's right, so that a walk goes from left to right. Raises ``MienError``
    for an unknown name.
    """
    if view not in VIEWS:
        raise MienError(unknown("view", view, VIEWS))
    turn, rise = np.radians(VIEWS[view])
    left = np.cross(up, forward)
    away = np.cos(turn) * forward - np.sin(turn) * left
    toward = np.cos(rise) * away + np.sin(rise) * up
    right = np.cross(up, away)
    return np.stack([right, np.cross(toward, right), toward])
