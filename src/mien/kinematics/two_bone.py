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
    wanted = np.arccos(np.clip((upper**2 + lower**2 - reach**2) / (2 * upper * lower), -1, 1))
    bend = np.zeros((len(root), 4)) + quaternion.IDENTITY
    for _ in range(3):  # the axis near full extension is not quite square to the bones: go on from there
        here = middle + quaternion.rotate(bend, tip - middle)
        angle, axis = _bend(root - middle, here - middle, hinge)
        bend = quaternion.multiply(quaternion.exp((wanted - angle)[:, None] * axis), bend)
    here = middle + quaternion.rotate(bend, tip - middle)
    aim = quaternion.between(here - root, target - root)
    return aim, quaternion.multiply(aim, bend)


def _bend(to_root: Array, to_tip: Array, hinge: Array) -> tuple[Array, Array]:
    """Return the inner angle (T,) of the joint, beyond pi when over-stretched, and its axis (T, 3)."""
    normal = np.cross(to_root, to_tip)
    sine = _length(normal) / np.maximum(_length(to_root) * _length(to_tip), 1e-300)
    line = to_tip - to_root
    square = hinge - (np.einsum("ti,ti->t", hinge, line) / np.einsum("ti,ti->t", line, line))[:, None] * line
    square /= np.maximum(_length(square), 1e-300)[:, None]
    side = np.where(np.einsum("ti,ti->t", normal, square) < 0, -1.0, 1.0)
    share = np.clip((sine - 0.05) / 0.15, 0, 1)
    share = share * share * (3 - 2 * share)
    plane = normal * (side / np.maximum(_length(normal), 1e-300))[:, None]
    axis = share[:, None] * plane + (1 - share)[:, None] * square
    axis /= np.maximum(_length(axis), 1e-300)[:, None]
    angle = np.arctan2(_length(normal), np.einsum("ti,ti->t", to_root, to_tip))
    return np.where(side < 0, 2 * np.pi - angle, angle), axis


def _length(v: Array) -> Array:
    return np.sqrt(np.einsum("...i,...i->...", v, v))
