"""A motion made ready to be drawn: its body (or none), where it stands, where it faces, its solids."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from ..errors import BodyError
from ..kinematics.body import Body
from ..kinematics.fk import end_positions, world
from ..motion import Motion, Skeleton, require_motion
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
    a unit, or None where it is not known. ``drawn`` are the joints of a stick figure that are drawn.
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
    drawn: Integers | None = None

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
        shared = like if like and _same_bones(like.motion.skeleton, motion.skeleton) else None
        rotations, positions = world(require_motion(motion))
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
        drawn = _real_joints(motion, positions)
        ends = end_positions(motion, rotations, positions)[:, np.isin(motion.skeleton.end_parents, drawn)]
        everything = np.concatenate([positions[:, drawn], ends], axis=1)
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
            _on_floor(positions[:, drawn[0]], up, floor),
            np.broadcast_to([0.0, 0.0, 1.0], (len(motion), 3)),
            STICK_PALETTE if palette is None else palette,
            drawn=drawn,
        )

    def made_from(self, other: "Figure") -> bool:
        """Return whether ``other`` is this one's original: its reference, or of its skeleton and name."""
        mine, its = self.motion, other.motion
        same = mine.skeleton.names == its.skeleton.names and mine.name == its.name
        return same or mine.reference is its

    def mean_facing(self) -> Array:
        """Return the mean direction faced, unit; of a body that turns all round, that of the middle frame."""
        mean = self.facing.mean(axis=0)
        length = float(np.linalg.norm(mean))
        return mean / length if length > 0.1 else self.facing[len(self.facing) // 2]

    def solids(self, frames: Integers) -> Solids:
        """Return the solids of some frames."""
        rotations, positions = self.rotations[frames], self.positions[frames]
        if self.body and self.soles:
            return mannequin(self.motion, self.body, rotations, positions, self.soles)
        drawn = np.arange(len(self.motion.skeleton)) if self.drawn is None else self.drawn
        return _bones(self.motion, rotations, positions, self.size, drawn)

    def steady_ground(self) -> Array:
        """Return ``ground`` without the sway of single steps (T, 3), for a camera to follow."""
        return _smooth(self.ground, self.motion.fps)


def _same_bones(a: Skeleton, b: Skeleton) -> bool:
    """Return whether two skeletons have the same joints and bones, in the same unit."""
    return a.names == b.names and np.allclose(a.offsets, b.offsets, rtol=1e-3, atol=1e-3 * np.ptp(a.offsets))


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


def _real_joints(motion: Motion, positions: Array) -> Integers:
    """Return the joints that are part of the figure: all but a root that stays at the world's origin.

    Exporters put such a root above the hips; the bone from there is as long as the figure is far away. It
    is told by its one child, which moves against it or is further off than half the rest is large.
    """
    keep = np.arange(len(motion.skeleton))
    while len(keep) > 2:
        root, rest = keep[0], keep[1:]
        children = motion.skeleton.children(int(root))
        away = np.linalg.norm(motion.translations[:, children[0]], axis=1) if len(children) == 1 else None
        if away is None or np.abs(positions[:, root]).max() > 0.0:
            break
        large = float(np.ptp(positions[:, rest], axis=1).max())
        if not (np.ptp(away) > 0.01 * large or away.max() > 0.5 * large):
            break
        keep = rest
    return keep


def _bones(motion: Motion, rotations: Array, positions: Array, size: float, drawn: Integers) -> Solids:
    """Return a stick from every joint drawn to its parent and its end sites, with a knob on every joint."""
    skeleton = motion.skeleton
    child = drawn[np.isin(skeleton.parents[drawn], drawn)]
    tips = np.flatnonzero(np.isin(skeleton.end_parents, drawn))
    ends = end_positions(motion, rotations, positions)[:, tips]
    knobs = positions[:, drawn]
    starts = [positions[:, skeleton.parents[child]], positions[:, skeleton.end_parents[tips]], knobs]
    stops = [positions[:, child], ends, knobs]
    sticks = len(child) + len(tips)
    radii = size * np.repeat([0.6 * STICK, STICK], [sticks, len(drawn)])
    frames = len(positions)
    return Solids(
        np.concatenate(starts, axis=1),
        np.concatenate(stops, axis=1),
        radii,
        radii,
        np.zeros((frames, 0, 3)),
        np.zeros((frames, 0, 3, 3)),
        np.repeat([0, 1], [sticks, len(drawn)]),
    )
