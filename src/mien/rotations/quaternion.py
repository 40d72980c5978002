"""Unit quaternions as arrays ``(..., 4)``, order ``xyzw``, any leading axes, child-to-parent.

SciPy's ``Rotation`` does the same one object at a time; these few formulas work on whole clips
without building objects (SciPy is the oracle in the tests).
"""

import numpy as np

from ..typing import Array

IDENTITY = np.array([0.0, 0.0, 0.0, 1.0])


def multiply(a: Array, b: Array) -> Array:
    """Return the product ``a b``: first ``b``, then ``a``, as with matrices on column vectors."""
    ax, ay, az, aw = (a[..., i] for i in range(4))
    bx, by, bz, bw = (b[..., i] for i in range(4))
    out = np.empty(np.broadcast_shapes(a.shape, b.shape))
    out[..., 0] = aw * bx + ax * bw + ay * bz - az * by
    out[..., 1] = aw * by - ax * bz + ay * bw + az * bx
    out[..., 2] = aw * bz + ax * by - ay * bx + az * bw
    out[..., 3] = aw * bw - ax * bx - ay * by - az * bz
    return out


def conjugate(q: Array) -> Array:
    """Return the inverse rotation of unit quaternions."""
    return q * np.array([-1.0, -1.0, -1.0, 1.0])


def rotate(q: Array, v: Array) -> Array:
    """Rotate vectors ``v (..., 3)`` by ``q (..., 4)``: ``v + 2w (u x v) + 2 u x (u x v)``."""
    qx, qy, qz, qw = (q[..., i] for i in range(4))
    vx, vy, vz = (v[..., i] for i in range(3))
    tx = 2.0 * (qy * vz - qz * vy)
    ty = 2.0 * (qz * vx - qx * vz)
    tz = 2.0 * (qx * vy - qy * vx)
    out = np.empty((*np.broadcast_shapes(q.shape[:-1], v.shape[:-1]), 3))
    out[..., 0] = vx + qw * tx + qy * tz - qz * ty
    out[..., 1] = vy + qw * ty + qz * tx - qx * tz
    out[..., 2] = vz + qw * tz + qx * ty - qy * tx
    return out


def normalise(q: Array) -> Array:
    """Scale to unit length; a quaternion shorter than 1e-12 becomes the identity."""
    length = np.sqrt(np.einsum("...i,...i->...", q, q))[..., None]
    return np.where(length > 1e-12, q / np.maximum(length, 1e-12), IDENTITY)


def continuous(q: Array) -> Array:
    """Choose the sign of each quaternion nearest to the previous frame's (frames on axis 0)."""
    if len(q) < 2:
        return q
    flips = np.einsum("...i,...i->...", q[1:], q[:-1]) < 0
    if not flips.any():
        return q
    sign = np.ones(q.shape[:-1])
    sign[1:] = 1.0 - 2.0 * (np.cumsum(flips, axis=0) % 2)
    return q * sign[..., None]


def exp(v: Array) -> Array:
    """Return the quaternion of rotation vectors ``v (..., 3)`` in radians (exact near zero)."""
    angle = np.sqrt(np.einsum("...i,...i->...", v, v))[..., None]
    # np.sinc(x) = sin(pi x) / (pi x), so this is sin(angle / 2) / angle without a division by zero.
    return np.concatenate([0.5 * np.sinc(angle / (2.0 * np.pi)) * v, np.cos(0.5 * angle)], axis=-1)


def log(q: Array) -> Array:
    """Return the rotation vectors ``(..., 3)`` in radians of unit quaternions, angle in [0, pi]."""
    v, w = q[..., :3], q[..., 3:]
    sine = np.sqrt(np.einsum("...i,...i->...", v, v))[..., None]
    sign = np.where(w < 0, -1.0, 1.0)
    angle = 2.0 * np.arctan2(sine, np.abs(w))
    small = sine < 1e-12
    return sign * v * np.where(small, 2.0, angle / np.where(small, 1.0, sine))


def power(q: Array, weight: Array | float) -> Array:
    """Return the fraction (or multiple) ``weight`` of each rotation: ``exp(weight log q)``."""
    return exp(log(q) * np.asarray(weight)[..., None])


def slerp(a: Array, b: Array, weight: Array | float) -> Array:
    """Go from ``a`` (weight 0) towards ``b`` (weight 1) along the shorter arc; beyond 1 it goes on."""
    return multiply(a, power(multiply(conjugate(a), b), weight))


def between(a: Array, b: Array) -> Array:
    """Return the smallest rotation that takes the direction of ``a (..., 3)`` to that of ``b``.

    Opposite directions have no smallest rotation: a half turn about some perpendicular is taken.
    """
    la = np.sqrt(np.einsum("...i,...i->...", a, a))[..., None]
    lb = np.sqrt(np.einsum("...i,...i->...", b, b))[..., None]
    a, b = np.broadcast_arrays(a / np.maximum(la, 1e-300), b / np.maximum(lb, 1e-300))
    # a x b = a x (a + b) and 1 + a.b = |a + b|^2 / 2 keep their precision close to opposite.
    both = a + b
    square = np.einsum("...i,...i->...", both, both)[..., None]
    q = np.concatenate([np.cross(a, both), 0.5 * square], axis=-1)
    opposite = square < 1e-20
    if opposite.any():
        other = np.where(np.abs(a[..., :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
        half_turn = np.concatenate([np.cross(a, other), np.zeros_like(square)], axis=-1)
        q = np.where(opposite, half_turn, q)
    return normalise(q)


def twist(q: Array, axis: Array) -> Array:
    """Return the part of each rotation that turns about the unit ``axis`` (swing-twist)."""
    along = np.einsum("...i,...i->...", q[..., :3], axis)[..., None] * axis
    return normalise(np.concatenate([along, q[..., 3:]], axis=-1))


def to_matrix(q: Array) -> Array:
    """Return rotation matrices ``(..., 3, 3)`` acting on column vectors."""
    x, y, z, w = (q[..., i] for i in range(4))
    out = np.empty((*q.shape[:-1], 3, 3))
    out[..., 0, 0] = 1 - 2 * (y * y + z * z)
    out[..., 0, 1] = 2 * (x * y - z * w)
    out[..., 0, 2] = 2 * (x * z + y * w)
    out[..., 1, 0] = 2 * (x * y + z * w)
    out[..., 1, 1] = 1 - 2 * (x * x + z * z)
    out[..., 1, 2] = 2 * (y * z - x * w)
    out[..., 2, 0] = 2 * (x * z - y * w)
    out[..., 2, 1] = 2 * (y * z + x * w)
    out[..., 2, 2] = 1 - 2 * (x * x + y * y)
    return out


def from_matrix(m: Array) -> Array:
    """Return the unit quaternions of rotation matrices ``(..., 3, 3)`` (Shepperd's four cases)."""
    rows = _outer(m[..., :, 0], m[..., :, 1], m[..., :, 2])
    # Each row is the quaternion times four times one of its own parts: take the largest part's row.
    biggest = np.argmax(np.stack([row[i] for i, row in enumerate(rows)]), axis=0)
    q = np.empty((*m.shape[:-2], 4))
    for i in range(4):
        q[..., i] = np.choose(biggest, [row[i] for row in rows])
    return normalise(q)


def from_axes(x: Array, y: Array, z: Array, *, near: Array) -> Array:
    """Return the quaternions that take the coordinate axes to the unit vectors ``x``, ``y``, ``z``.

    Three times as fast as ``from_matrix``, where quaternions ``near (..., 4)`` are known: a rotation's
    matrix gives ``4 q q'``, and that times ``near`` is ``q`` but for its length. The sign is that of
    ``near``. Where the two are more than 170 degrees apart ``from_matrix`` is asked.
    """
    q = np.empty(near.shape)
    for i, row in enumerate(_outer(x, y, z)):
        q[..., i] = row[0] * near[..., 0]
        for j in range(1, 4):
            q[..., i] += row[j] * near[..., j]
    length = np.sqrt(np.einsum("...i,...i->...", q, q))
    far = length < 4.0 * np.cos(0.5 * np.radians(170.0))
    q /= np.where(far, 1.0, length)[..., None]
    if far.any():
        q[far] = from_matrix(np.stack([x[far], y[far], z[far]], axis=-1))
    return q


def _outer(x: Array, y: Array, z: Array) -> tuple[tuple[Array, ...], ...]:
    """Return the rows of ``4 q q'`` of the rotation whose matrix has the columns ``x``, ``y``, ``z``."""
    d0, d1, d2 = x[..., 0], y[..., 1], z[..., 2]
    wx, wy, wz = y[..., 2] - z[..., 1], z[..., 0] - x[..., 2], x[..., 1] - y[..., 0]
    xy, xz, yz = y[..., 0] + x[..., 1], z[..., 0] + x[..., 2], z[..., 1] + y[..., 2]
    return (
        (1 + d0 - d1 - d2, xy, xz, wx),
        (xy, 1 - d0 + d1 - d2, yz, wy),
        (xz, yz, 1 - d0 - d1 + d2, wz),
        (wx, wy, wz, 1 + d0 + d1 + d2),
    )
