"""Euler angles in any order of three axes, as BVH uses them: intrinsic, radians.

``order`` is a string such as ``"ZXY"``: the rotation is ``R_Z R_X R_Y`` on column vectors, so the
last letter turns the child first.
"""

import numpy as np

from ..typing import Array, Mask
from .quaternion import multiply

AXES = {"X": 0, "Y": 1, "Z": 2}
TURN = 2.0 * np.pi


def from_euler(angles: Array, order: str) -> Array:
    """Return the quaternions ``(..., 4)`` of ``angles (..., n)``, one angle for each letter of ``order``."""
    half = 0.5 * np.asarray(angles)
    sine, cosine = np.sin(half), np.cos(half)
    if len(set(order)) == len(order) == 3:
        return _three_axes(sine, cosine, order)
    out = np.zeros((*half.shape[:-1], 4))
    out[..., 3] = 1.0
    for n, axis in enumerate(order):
        q = np.zeros((*half.shape[:-1], 4))
        q[..., AXES[axis]] = sine[..., n]
        q[..., 3] = cosine[..., n]
        out = multiply(out, q)
    return out


def _three_axes(sine: Array, cosine: Array, order: str) -> Array:
    """Multiply out ``q_i q_j q_k`` of three different axes, from the sines and cosines of half angles."""
    i, j, k = (AXES[a] for a in order)
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    si, sj, sk = (sine[..., n] for n in range(3))
    ci, cj, ck = (cosine[..., n] for n in range(3))
    ss, cc, sc, cs = sign * si * sj, ci * cj, si * cj, ci * sj
    out = np.empty((*sine.shape[:-1], 4))
    out[..., i] = sc * ck + sign * cs * sk
    out[..., j] = cs * ck - sign * sc * sk
    out[..., k] = cc * sk + ss * ck
    out[..., 3] = cc * ck - ss * sk
    return out


def to_euler(q: Array, order: str) -> Array:
    """Return angles ``(T, ..., 3)`` in radians for quaternions ``(T, ..., 4)``.

    Of the two triples that make the same rotation, and of their whole turns, the one nearest to the
    previous frame is taken, so that the curves do not jump. At the gimbal, where only the sum of
    the outer angles is defined, the first angle is held from the frame before.
    """
    k, j, i = (AXES[a] for a in order)
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    # Half sum and half difference of the outer angles are plain arctangents (Bernardes & Viollet 2022).
    a, b = q[..., 3] - q[..., j], q[..., i] + sign * q[..., k]
    c, d = q[..., 3] + q[..., j], sign * q[..., k] - q[..., i]
    middle = 2.0 * np.arctan2(np.hypot(c, d), np.hypot(a, b)) - 0.5 * np.pi
    plus, minus = np.arctan2(b, a), np.arctan2(d, c)
    angles = np.stack([sign * (plus + minus), middle, plus - minus], axis=-1)
    gimbal = np.abs(np.abs(middle) - 0.5 * np.pi) < 1e-7
    return _smooth(angles, gimbal, np.where(middle > 0, minus, plus), sign)


def _smooth(angles: Array, gimbal: Mask, total: Array, sign: float) -> Array:
    """Choose the branch nearest to the frame before; only frames where it matters are looped over."""
    angles = _wrap(angles)
    if gimbal.any():
        _hold_gimbal(angles, gimbal, total, sign)
    if len(angles) < 2:
        return angles
    other = _wrap(np.pi + angles * np.array([1.0, -1.0, 1.0]))
    # Which of the two triples follows: a chain of yes/no, as both choices see the same step cost.
    stay = _gap(angles[1:], angles[:-1]) <= _gap(other[1:], angles[:-1])
    if not stay.all():
        swapped = np.zeros(angles.shape[:-1], bool)
        swapped[1:] = np.cumsum(~stay, axis=0) % 2 == 1
        angles = np.where(swapped[..., None], other, angles)
    turns = np.rint(np.diff(angles, axis=0) / TURN)
    if turns.any():
        angles[1:] -= TURN * np.cumsum(turns, axis=0)
    return angles


def _wrap(angles: Array) -> Array:
    """Return the angles in [-pi, pi]."""
    return angles - TURN * np.rint(angles / TURN)


def _gap(a: Array, b: Array) -> Array:
    difference = _wrap(a - b)
    return np.einsum("...i,...i->...", difference, difference)


def _hold_gimbal(angles: Array, gimbal: Mask, half: Array, sign: float) -> None:
    """In place: at the gimbal take the first angle from the frame before, give the rest to the third.

    There only ``half`` is defined: with the middle angle up it is half of ``sign first - third``,
    with it down half of ``sign first + third``.
    """
    for index in np.argwhere(gimbal):
        here = tuple(index)
        first = angles[(here[0] - 1, *here[1:], 0)] if here[0] > 0 else 0.0
        up = angles[(*here, 1)] > 0
        angles[(*here, 0)] = first
        angles[(*here, 2)] = sign * first - 2 * half[here] if up else 2 * half[here] - sign * first
