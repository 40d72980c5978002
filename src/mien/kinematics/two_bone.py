"""Analytic two-bone inverse kinematics: bend the knee, then aim the leg; the knee plane stays.

Near full extension the bend plane of the pose itself is undefined, so it fades into the leg's own
hinge axis: the knee neither flips nor snaps.
"""

import numpy as np

from ..rotations import quaternion
from ..typing import Array


def two_bone(root: Array, middle: Array, tip: Array, target: Array, hinge: Array) -> tuple[Array, Array]:
    """Return the world rotations (T, 4) to apply to the upper and the lower bone.

    ``root``, ``middle``, ``tip`` and ``target`` are world positions (T, 3); ``hinge`` (T, 3) is the
    axis about which the middle joint bends in a natural pose. A target out of reach is approached
    with the limb stretched towards it. Law of cosines on the triangle root, middle, target.
    """
    upper, lower = _length(middle - root), _length(tip - middle)
    reach = np.clip(_length(target - root), np.abs(upper - lower) * (1 + 1e-9), (upper + lower) * (1 - 1e-12))
    sides = np.maximum(2 * upper * lower, 1e-300)  # a bone without length bends nothing
    wanted = np.arccos(np.clip((upper**2 + lower**2 - reach**2) / sides, -1, 1))
    bend = np.zeros((len(root), 4)) + quaternion.IDENTITY
    for step in range(4):  # the first turn may not be square to the bones: go on from where it led
        here = middle + quaternion.rotate(bend, tip - middle)
        angle, axis = _bend(root - middle, here - middle, hinge, trusting=step > 0)
        bend = quaternion.multiply(quaternion.exp((wanted - angle)[:, None] * axis), bend)
    here = middle + quaternion.rotate(bend, tip - middle)
    aim = quaternion.between(here - root, target - root)
    return aim, quaternion.multiply(aim, bend)


def nudge(root: Array, middle: Array, tip: Array, target: Array) -> tuple[Array, Array]:
    """Return the world rotations (T, 4) to apply to both bones so that the tip moves a little to ``target``.

    All are world positions (T, 3). The joint stays in its own plane and on its own side, also where it is
    bent the wrong way, and a target where the tip is already changes nothing: so there is no jump where a
    correction sets in. A joint within 17 degrees of straight is bent only in part (within 3 not at all), as
    it would have to bend far for little, in a plane that is not known; what remains lies along the limb.
    """
    up, down = root - middle, tip - middle
    upper, lower = _length(up), _length(down)
    normal = np.cross(up, down)
    size = _length(normal)
    angle = np.arctan2(size, np.einsum("ti,ti->t", up, down))
    sides = np.maximum(2 * upper * lower, 1e-300)
    reach = _length(target - root)
    wanted = np.arccos(np.clip((upper**2 + lower**2 - reach**2) / sides, -1, 1))
    turn = (wanted - angle) * _ramp(2 * size / sides, 0.05, 0.3)
    bend = quaternion.exp((turn / np.maximum(size, 1e-300))[:, None] * normal)
    here = middle + quaternion.rotate(bend, down)
    aim = quaternion.between(here - root, target - root)
    return aim, quaternion.multiply(aim, bend)


def mean_hinge(to_root: Array, to_tip: Array, turned: Array, usual: Array) -> Array:
    """Return the axis (3,) about which a limb's middle joint bends, in the axes of its upper bone.

    It comes from the frames in which the joint is clearly bent: ``to_root`` and ``to_tip`` (T, 3) are its
    bones in world axes, ``turned`` (T, 4) the world rotations of the upper one. ``usual`` (3,), in that
    bone's axes and as long as it weighs, is the axis of a joint that never bends.
    """
    normal: Array = np.cross(to_root, to_tip)
    lengths = _length(to_root) * _length(to_tip)
    clear = np.clip((_length(normal) / np.maximum(lengths, 1e-300) - 0.25) / 0.25, 0.0, 1.0)
    own = quaternion.rotate(quaternion.conjugate(turned), normal * clear[:, None])
    mean = own.mean(axis=0) + usual
    return np.asarray(mean / np.linalg.norm(mean))


def softened(stretch: Array, start: Array, limit: Array) -> Array:
    """Return how far (T,) a limb is stretched, which from ``start`` on tends to ``limit`` and not beyond."""
    over = np.maximum(stretch - start, 0.0) / (limit - start)
    return np.where(over > 0.0, start - (limit - start) * np.expm1(-over), stretch)


def _bend(to_root: Array, to_tip: Array, hinge: Array, *, trusting: bool) -> tuple[Array, Array]:
    """Return the inner angle (T,) of the joint, beyond pi when over-stretched, and its axis (T, 3).

    The axis is the normal of the pose's own plane, as far as that is clear: near full extension, and
    (unless ``trusting``) in a joint bent sideways, the hinge takes over without a jump.
    """
    normal = np.cross(to_root, to_tip)
    size = _length(normal)
    sine = size / np.maximum(_length(to_root) * _length(to_tip), 1e-300)
    square = _unit(hinge - _along(hinge, to_tip - to_root))
    plane = normal / np.maximum(size, 1e-300)[:, None]
    aligned = np.einsum("ti,ti->t", plane, square)
    side = np.where(aligned < 0, -1.0, 1.0)
    share = _ramp(sine, 0.02, 0.1) if trusting else _ramp(sine, 0.1, 0.45) * _ramp(np.abs(aligned), 0.3, 0.8)
    axis = _unit((share * side)[:, None] * plane + (1 - share)[:, None] * square)
    across = np.einsum("ti,ti->t", normal, axis)
    flat = np.einsum("ti,ti->t", to_root - _along(to_root, axis), to_tip - _along(to_tip, axis))
    return np.arctan2(across, flat) % (2 * np.pi), axis


def _along(v: Array, line: Array) -> Array:
    """Return the part of ``v`` (T, 3) along ``line`` (T, 3)."""
    share = np.einsum("ti,ti->t", v, line) / np.maximum(np.einsum("ti,ti->t", line, line), 1e-300)
    return share[:, None] * line


def _ramp(x: Array, low: float, high: float) -> Array:
    s = np.clip((x - low) / (high - low), 0, 1)
    return s * s * (3 - 2 * s)


def _unit(v: Array) -> Array:
    return v / np.maximum(_length(v), 1e-300)[:, None]


def _length(v: Array) -> Array:
    return np.sqrt(np.einsum("...i,...i->...", v, v))
