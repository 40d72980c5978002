"""The way of a body: where it goes over the ground, where it faces, how high the hips are."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..kinematics.body import Body
from ..kinematics.heading import heading
from ..rotations import quaternion
from ..typing import Array
from .shares import Shares


@dataclass(frozen=True, eq=False)
class Route:
    """``ground`` (T, 3) below the hips, ``heading`` (T,) in radians, ``height`` (T,) of the hips along up."""

    ground: Array
    heading: Array
    height: Array

    def turn(self, body: Body) -> Array:
        """Return the rotations (T, 4) from the neutral facing to the heading."""
        return quaternion.exp(self.heading[:, None] * body.up)

    def hips(self, body: Body) -> Array:
        """Return the places (T, 3) of the hips."""
        return self.ground + self.height[:, None] * body.up


def route_of(positions: Array, body: Body) -> Route:
    """Return the way of a body whose joints are at ``positions`` (T, J, 3)."""
    hips = positions[:, body.roles["hips"]]
    height = hips @ body.up
    return Route(hips - height[:, None] * body.up, heading(positions, body), height)


def blended(routes: Sequence[Route], parts: Shares, body: Body, fps: float) -> Route:
    """Return the blended way: steps and turns with the weights of mid, the height band by band.

    ``p(k + 1) = p(k) + R(psi) sum_i w_i R(-psi_i) (p_i(k + 1) - p_i(k))``, ``psi = sum_i w_i psi_i`` half way
    from frame to frame: what one clip goes ahead is added to what another goes ahead, wherever they face.
    """
    headings = _from_one_side(np.stack([route.heading for route in routes]))
    facing = parts.mid @ headings
    ahead = np.zeros((len(facing) - 1, 3))
    for weight, route, own in zip(parts.mid, routes, headings, strict=True):
        ahead += weight * _turned(np.diff(route.ground, axis=0), -_half_way(own), body)
    start = np.einsum("n,ni->i", parts.mid, np.stack([route.ground[0] for route in routes]))
    ground = np.concatenate([start[None], _turned(ahead, _half_way(facing), body)]).cumsum(axis=0)
    return Route(ground, facing, parts.mixed([route.height for route in routes], fps))


def _from_one_side(headings: Array) -> Array:
    """Return the headings (N, T) with whole turns added, so that all start within half a turn of the mean."""
    starts = headings[:, 0]
    mean = np.arctan2(np.sin(starts).mean(), np.cos(starts).mean())
    return headings - (2.0 * np.pi * np.round((starts - mean) / (2.0 * np.pi)))[:, None]


def _half_way(angles: Array) -> Array:
    return 0.5 * (angles[1:] + angles[:-1])


def _turned(vectors: Array, angles: Array, body: Body) -> Array:
    return quaternion.rotate(quaternion.exp(angles[:, None] * body.up), vectors)
