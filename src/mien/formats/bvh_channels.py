"""Channels of a BVH file to rotations and translations, and back.

Position channels replace the joint's offset (as in Blender and Maya). What no edit touched keeps the
file's own numbers; what was edited is converted on the branch (of the two Euler triples, and of whole
turns) that the numbers before it are on, so that curves do not jump.
"""

from dataclasses import dataclass

import numpy as np

from ..errors import FormatError
from ..motion import Motion, Skeleton
from ..rotations import quaternion
from ..rotations.euler import from_euler, to_euler
from ..typing import Array, Integers, Mask
from .bvh_header import POSITIONS

_BLOCK = 1024  # frames at a time, so that the work stays in the cache


@dataclass(frozen=True, eq=False)
class BvhSource:
    """The numbers ``values`` (T, C) of a file and the rotations and translations they stand for."""

    channels: tuple[tuple[str, ...], ...]
    values: Array
    rotations: Array
    translations: Array

    def __repr__(self) -> str:
        frames, width = self.values.shape
        return f"BvhSource({frames} frames, {width} channels)"


@dataclass(frozen=True)
class _Turns:
    """Joints (n) that turn in the same order of axes, and their columns (n, len(order))."""

    order: str
    joints: Integers
    columns: Integers


@dataclass(frozen=True)
class _Columns:
    """Where in a row each joint's channels are; ``moves`` (m, 3) lists joint, axis, column."""

    turns: tuple[_Turns, ...]
    moves: Integers


def columns(channels: tuple[tuple[str, ...], ...]) -> _Columns:
    """Sort the channels of all joints by what they do."""
    moves: list[tuple[int, int, int]] = []
    groups: dict[str, list[tuple[int, list[int]]]] = {}
    column = 0
    for joint, names in enumerate(channels):
        turning = {}
        for name in names:
            if name in POSITIONS:
                moves.append((joint, POSITIONS.index(name), column))
            else:
                turning[column] = name[0]
            column += 1
        groups.setdefault("".join(turning.values()), []).append((joint, list(turning)))
    turns = [
        _Turns(order, np.array([j for j, _ in found]), np.array([c for _, c in found], np.int64))
        for order, found in groups.items()
    ]
    return _Columns(tuple(turns), np.array(moves, np.int64).reshape(-1, 3))


def to_motion(
    values: Array, skeleton: Skeleton, channels: tuple[tuple[str, ...], ...]
) -> tuple[Array, Array]:
    """Return rotations ``(T, J, 4)`` and translations ``(T, J, 3)`` of rows ``values`` (T, C)."""
    where = columns(channels)
    rotations = np.empty((len(values), len(skeleton), 4))
    for start in range(0, len(values), _BLOCK):
        block = slice(start, start + _BLOCK)
        for group in where.turns:
            angles = np.radians(values[block][:, group.columns])
            rotations[block, _range(group.joints)] = from_euler(angles, group.order)
    translations = np.empty((len(values), len(skeleton), 3))
    translations[:] = skeleton.offsets
    joints, axes, taken = where.moves.T
    translations[:, joints, axes] = values[:, taken]
    return quaternion.continuous(rotations), translations


def _range(indices: Integers) -> Integers | slice:
    """Return the indices as a slice where they follow one another: NumPy copies that much faster."""
    first, last = int(indices[0]), int(indices[-1]) + 1
    return slice(first, last) if last - first == len(indices) else indices


def to_values(motion: Motion, channels: tuple[tuple[str, ...], ...], *, decimals: int) -> Array:
    """Return the rows ``(T, C)`` that hold ``motion``: the inverse of ``to_motion``.

    Numbers of what was edited are rounded to ``decimals``. Raises ``FormatError`` where a joint moves
    or turns in a way its channels cannot hold.
    """
    source = motion.source
    if not (
        isinstance(source, BvhSource) and source.channels == channels and len(source.values) == len(motion)
    ):
        source = None
    values = np.zeros((len(motion), sum(map(len, channels)))) if source is None else np.array(source.values)
    where = columns(channels)
    turned = _edited(motion.rotations, source.rotations if source else None)
    for group in where.turns:
        _put_turns(values, motion, group, turned, source, decimals)
    _put_moves(values, motion, where.moves, source, decimals)
    return values


def _edited(now: Array, before: Array | None) -> Mask:
    """Return which joints in which frames (T, J) are not bit for bit what was loaded."""
    if before is None:
        return np.ones(now.shape[:2], bool)
    return (now != before).any(axis=-1)


def _put_turns(
    values: Array, motion: Motion, group: _Turns, turned: Mask, source: BvhSource | None, decimals: int
) -> None:
    chosen = np.flatnonzero(turned[:, group.joints].any(axis=0))
    if not len(chosen):
        return
    joints, taken = group.joints[chosen], group.columns[chosen]
    order, used = _full(group.order)
    angles = np.degrees(to_euler(motion.rotations[:, joints], order))
    if len(used) < 3:
        angles = _without(angles, [i for i in range(3) if i not in used], motion, joints, group.order)
    rows, edited = values[:, taken], turned[:, joints]
    if source is not None:
        wanted = np.zeros_like(angles)
        wanted[..., used] = rows
        angles = _follow(angles, wanted, edited)
    values[:, taken] = np.where(edited[..., None], np.round(angles[..., used], decimals), rows)


def _full(order: str) -> tuple[str, list[int]]:
    """Complete an order of fewer axes to three, and return where its own angles stand in it.

    The missing axis of two goes in the middle, where an angle near 0 is never ambiguous.
    """
    missing = [axis for axis in "XYZ" if axis not in order]
    full = order[:1] + missing[0] + order[1:] if len(order) == 2 else order + "".join(missing)
    return full, [full.index(axis) for axis in order]


def _without(angles: Array, unused: list[int], motion: Motion, joints: Integers, order: str) -> Array:
    """Return the angles (degrees) on the branch where the ``unused`` ones are 0, or raise if none is."""
    turn = _gap(angles[..., unused], 0.0)
    other = _other(angles)
    other_turn = _gap(other[..., unused], 0.0)
    for joint in joints[(np.minimum(turn, other_turn) > 1e-4).any(axis=0)]:
        has = f"only {order} rotation" if order else "no rotation"
        raise FormatError(
            f"joint {motion.skeleton.names[joint]!r} has {has} channels and cannot hold the edited rotation; "
            f"leave it out of the edit (--parts)"
        )
    return np.unwrap(np.where((other_turn < turn)[..., None], other, angles), axis=0, period=360.0)


def _follow(angles: Array, source: Array, edited: Mask) -> Array:
    """Put each run of edited frames on the branch of the source's numbers before it (degrees).

    ``angles`` (T, n, 3) are continuous over the whole clip, so one choice for each run, made at the
    unedited frame before it (or at frame 0), carries through.
    """
    frames = np.arange(len(angles))[:, None]
    anchor = np.maximum.accumulate(np.where(edited, 0, frames), axis=0)
    anchor = anchor if anchor.any() else anchor[:1]  # one choice for all, if all frames are edited
    own = np.take_along_axis(angles, anchor[..., None], axis=0)
    wanted = np.take_along_axis(source, anchor[..., None], axis=0)
    flip = (_gap(_other(own), wanted) < _gap(own, wanted))[..., None]
    turns = np.round((wanted - np.where(flip, _other(own), own)) / 360.0)
    followed = np.where(flip, _other(angles), angles) if flip.any() else angles
    return followed + 360.0 * turns if turns.any() else followed


def _other(angles: Array) -> Array:
    """Return the other triple of the same rotation: ``(a + 180, 180 - b, c + 180)``."""
    return angles * [1.0, -1.0, 1.0] + 180.0


def _gap(a: Array, b: Array | float) -> Array:
    return (np.abs(np.remainder(a - b + 180.0, 360.0) - 180.0)).sum(axis=-1)


def _put_moves(
    values: Array, motion: Motion, moves: Integers, source: BvhSource | None, decimals: int
) -> None:
    joints, axes, taken = moves.T
    if source is not None and np.array_equal(motion.translations, source.translations):
        return
    movable = np.zeros((len(motion.skeleton), 3), bool)
    movable[joints, axes] = True
    translations = _carry(motion, movable)
    edited = _edited(translations, source.translations if source else None)[:, joints]
    now = np.round(translations[:, joints, axes], decimals)
    values[:, taken] = np.where(edited, now, values[:, taken])


def _carry(motion: Motion, movable: Mask) -> Array:
    """Return the translations with those that have no channels handed to the parent, where that is exact.

    A parent with one child may take over that child's movement: ``t_p + R_p (t - offset)`` puts the
    child, and all below it, where they were. So a dummy root carries the hips of some exporters.
    """
    skeleton, translations = motion.skeleton, np.array(motion.translations)
    size = 1e-7 * np.abs(skeleton.offsets).max()  # what is below is the rounding of an edit
    away = (np.abs(translations - skeleton.offsets) > size).any(axis=0)
    for joint in range(len(skeleton) - 1, -1, -1):
        if not (away[joint] & ~movable[joint]).any():
            continue
        parent = int(skeleton.parents[joint])
        if parent < 0 or skeleton.children(parent) != [joint]:
            raise FormatError(
                f"joint {skeleton.names[joint]!r} was moved, but has no position channels in the file; "
                f"leave it out of the edit (--parts)"
            )
        shift = translations[:, joint] - skeleton.offsets[joint]
        translations[:, joint] = skeleton.offsets[joint]
        translations[:, parent] += quaternion.rotate(motion.rotations[:, parent], shift)
        away[parent] = True
    return translations
