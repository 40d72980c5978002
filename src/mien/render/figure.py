"""A motion made ready to be drawn: its body (or none), where it stands, where it faces, its solids."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from ..errors import BodyError
from ..kinematics.body import Body
from ..kinematics.fk import end_positions, world
from ..motion import Motion
from ..typing import Array, Integers
from .mannequin import PALETTE, Soles, mannequin, plain_palette
from .solids import Solids

LEGS_TALL = 2.0  # a person is about two leg lengths tall
STICK, STICK_PALETTE = 0.035, np.array([[196, 120, 78], [70, 84, 110]], float)


@dataclass(frozen=True, eq=False)
class Figure:
    """A motion with what a drawing needs.

    ``size`` is the leg length (half the height where no body is found), ``floor`` the height of the
    ground along ``up``, ``ground (T, 3)`` the point of the floor below the hips, ``facing (T, 3)`` the
    direction the body faces, smoothed over a second. Lengths in the clip's unit; ``metres`` is metres
    a unit, or None where it is not known.
    """

    motion: Motion
    body: Body | None
    rotations: Array
    positions: Array
    up: Array
    floor: float
    size: float
    metres: float | None
    ground: Array
    facing: Array
    palette: Array
    soles: Soles | None = None

    @classmethod
    def of(
        cls,
        motion: Motion,
        *,
        body: Body | None = None,
        colour: str | None = None,
        like: "Figure | None" = None,
    ) -> Self:
        """Make a figure of a motion: a mannequin, or sticks where no human body is found.

        ``like`` lends its body, floor and feet to a motion of the same skeleton: an edit moves the
        figure, not the floor, so a foot that sinks is seen to sink.
        """
        shared = like if like and like.motion.skeleton.names == motion.skeleton.names else None
        rotations, positions = world(motion)
        palette = None if colour is None else plain_palette(colour)
        try:
            body = body or (shared and shared.body) or Body.of(motion)
        except BodyError:
            return cls._sticks(motion, rotations, positions, palette)
        ground = _on_floor(positions[:, body.roles["hips"]], body.up, body.floor)
        return cls(
            motion,
            body,
            rotations,
            positions,
            body.up,
            body.floor,
            body.leg_length,
            body.metres_per_unit,
            ground,
            _facing(positions, body, motion.fps),
            PALETTE if palette is None else palette,
            (shared and shared.soles) or Soles.of(motion, body, positions),
        )

    @classmethod
    def _sticks(cls, motion: Motion, rotations: Array, positions: Array, palette: Array | None) -> Self:
        """Make a figure of any tree of joints, Y up and facing Z, as BVH has it by habit."""
        up = np.array([0.0, 1.0, 0.0])
        everything = np.concatenate([positions, end_positions(motion, rotations, positions)], axis=1)
        extent = np.ptp(everything, axis=1).max()
        floor = float(everything[..., 1].min())
        return cls(
            motion,
            None,
            rotations,
            positions,
            up,
            floor,
            float(extent) / LEGS_TALL or 1.0,
            None,
            _on_floor(positions[:, 0], up, floor),
            np.broadcast_to([0.0, 0.0, 1.0], (len(motion), 3)),
            STICK_PALETTE if palette is None else palette,
        )

    def solids(self, frames: Integers) -> Solids:
        """Return the solids of some frames."""
        rotations, positions = self.rotations[frames], self.positions[frames]
        if self.body and self.soles:
            return mannequin(self.motion, self.body, rotations, positions, self.soles)
        return _bones(self.motion, rotations, positions, self.size)

    def steady_ground(self) -> Array:
        """Return ``ground`` without the sway of single steps (T, 3), for a camera to follow."""
        return _smooth(self.ground, self.motion.fps)


def _facing(positions: Array, body: Body, fps: float) -> Array:
    """Return the level direction (T, 3) that hips and shoulders face on average over a second.

    The hips alone swing with every step and may be twisted far against the chest.
    """
    facing: Array = np.zeros((len(positions), 3))
    for role in ("hip", "shoulder"):
        side = positions[:, body.roles[f"left_{role}"]] - positions[:, body.roles[f"right_{role}"]]
        facing += np.cross(side, body.up) / np.maximum(np.linalg.norm(side, axis=1, keepdims=True), 1e-12)
    facing = _smooth(facing, fps)
    length = np.linalg.norm(facing, axis=1, keepdims=True)
    return np.where(length > 0.05, facing / np.maximum(length, 0.05), body.forward)


def _on_floor(points: Array, up: Array, floor: float) -> Array:
    return points + (floor - points @ up)[:, None] * up


def _smooth(values: Array, fps: float) -> Array:
    """Weigh values over about a second with a Gaussian; the ends are held."""
    sigma = min(0.35 * fps, len(values))
    reach = int(np.ceil(3 * sigma))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    weights /= weights.sum()
    flat = values.reshape(len(values), -1)
    padded = np.pad(flat, [(reach, reach), (0, 0)], mode="edge")
    columns = [np.convolve(column, weights, mode="valid") for column in padded.T]
    return np.stack(columns, axis=-1).reshape(values.shape)


def _bones(motion: Motion, rotations: Array, positions: Array, size: float) -> Solids:
    """Return a stick from every joint to its parent and to its end sites, with a knob on every joint."""
    skeleton = motion.skeleton
    child = np.flatnonzero(skeleton.parents >= 0)
    ends = end_positions(motion, rotations, positions)
    starts = [positions[:, skeleton.parents[child]], positions[:, skeleton.end_parents], positions]
    stops = [positions[:, child], ends, positions]
    sticks = len(child) + len(skeleton.end_parents)
    radii = size * np.repeat([0.6 * STICK, STICK], [sticks, len(skeleton)])
    frames = len(positions)
    return Solids(
        np.concatenate(starts, axis=1),
        np.concatenate(stops, axis=1),
        radii,
        radii,
        np.zeros((frames, 0, 3)),
        np.zeros((frames, 0, 3, 3)),
        np.repeat([0, 1], [sticks, len(skeleton)]),
    )
