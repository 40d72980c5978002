"""Direction vectors: six numbers a joint, in which signals may be filtered channel by channel.

A rotation ``R`` is coded as where it takes two fixed directions of the joint at rest, ``d = R u`` (along
the bone) and ``n = R v`` (across it), as in Förger 2011, section 3.3. The codes have no wrap-around, no
gimbal and no sign to choose, and only their directions matter, not their lengths. With ``u = x`` and
``v = y`` they are the first two columns of the matrix (Zhou et al. 2019).
"""

from typing import Literal

import numpy as np

from ..errors import MienError, unknown
from ..typing import Array, Mask
from . import quaternion

Orthogonalise = Literal["gram-schmidt", "svd"]
SHORTEST = 1e-8


def axes(bones: Array) -> tuple[Array, Array]:
    """Return the unit directions ``u`` and ``v`` (..., 3) of joints whose main bones are ``bones``.

    ``u`` lies along the bone, ``v`` across it, towards the coordinate axis least aligned with ``u``.
    A joint without a bone (zero vector) gets x and y.
    """
    length = np.sqrt(np.einsum("...i,...i->...", bones, bones))[..., None]
    u = np.where(length > 0.0, bones / np.where(length > 0.0, length, 1.0), [1.0, 0.0, 0.0])
    # Rounded, so that of two equal components the first is taken whatever their last bits are.
    e = np.eye(3)[np.argmin(np.round(np.abs(u), 6), axis=-1)]
    v = e - np.einsum("...i,...i->...", e, u)[..., None] * u
    return u, v / np.sqrt(np.einsum("...i,...i->...", v, v))[..., None]


def encode(q: Array, u: Array, v: Array) -> Array:
    """Return the codes ``(..., 6)`` = ``(R u, R v)`` of quaternions ``(..., 4)``."""
    return np.concatenate([quaternion.rotate(q, u), quaternion.rotate(q, v)], axis=-1)


def degenerate(codes: Array) -> Mask:
    """Return where ``(...)`` codes say nothing: a vanished direction, or both directions parallel."""
    d, n = codes[..., :3], codes[..., 3:]
    along, across = np.einsum("...i,...i->...", d, d), np.einsum("...i,...i->...", n, n)
    parallel = _square_of_cross(d, n) < SHORTEST**2 * along * across
    return (along < SHORTEST**2) | (across < SHORTEST**2) | parallel


def decode(
    codes: Array,
    u: Array,
    v: Array,
    *,
    orthogonalise: Orthogonalise = "gram-schmidt",
    fallback: Array | None = None,
) -> Array:
    """Return the quaternions ``(T, ..., 4)`` of codes ``(T, ..., 6)``, sign-continuous over the frames.

    ``gram-schmidt`` keeps the bone's direction exactly and lets the twist take the error of codes that
    are no longer orthogonal; ``svd`` shares it (the nearest rotation). Codes that say nothing (see
    ``degenerate``) repeat the previous frame, or before the first good frame take ``fallback``
    ``(T, ..., 4)`` (default: no rotation), the rotations before the codes were changed.
    """
    if orthogonalise not in ("gram-schmidt", "svd"):
        raise MienError(unknown("orthogonalisation", orthogonalise, ("gram-schmidt", "svd")))
    lost = degenerate(codes)
    if lost.any():
        codes = np.where(lost[..., None], [1.0, 0.0, 0.0, 0.0, 1.0, 0.0], codes)
    d, n = _nearest(codes) if orthogonalise == "svd" else _gram_schmidt(codes)
    rest = quaternion.from_matrix(np.stack([u, v, np.cross(u, v)], axis=-1))
    if fallback is None:
        frame = quaternion.from_matrix(np.stack([d, n, np.cross(d, n)], axis=-1))
    else:
        frame = quaternion.from_axes(d, n, np.cross(d, n), near=quaternion.multiply(fallback, rest))
    q = quaternion.multiply(frame, quaternion.conjugate(rest))
    if lost.any():
        q = _hold(q, lost, fallback)
    return quaternion.continuous(q)


def _gram_schmidt(codes: Array) -> tuple[Array, Array]:
    d, n = codes[..., :3], codes[..., 3:]
    d = d / np.sqrt(np.einsum("...i,...i->...", d, d))[..., None]
    n = n - np.einsum("...i,...i->...", n, d)[..., None] * d
    return d, n / np.sqrt(np.einsum("...i,...i->...", n, n))[..., None]


def _nearest(codes: Array) -> tuple[Array, Array]:
    """Return the columns of ``M (M'M)^-1/2``, ``M = [d n]``: the factor ``U V'`` of the SVD of ``M``."""
    d, n = codes[..., :3], codes[..., 3:]
    a, b, c = (np.einsum("...i,...i->...", p, q)[..., None] for p, q in ((d, d), (d, n), (n, n)))
    root = np.sqrt(_square_of_cross(d, n))[..., None]
    scale = 1.0 / (root * np.sqrt(a + c + 2.0 * root))
    return ((c + root) * d - b * n) * scale, ((a + root) * n - b * d) * scale


def _square_of_cross(d: Array, n: Array) -> Array:
    across = np.cross(d, n)
    return np.einsum("...i,...i->...", across, across)


def _hold(q: Array, lost: Mask, fallback: Array | None) -> Array:
    """Fill lost frames from the last good frame before, and those before any good one from ``fallback``."""
    frames = np.arange(len(q)).reshape(-1, *[1] * (lost.ndim - 1))
    good = np.maximum.accumulate(np.where(lost, -1, frames), axis=0)
    held = np.take_along_axis(q, np.maximum(good, 0)[..., None], axis=0)
    start = quaternion.IDENTITY if fallback is None else fallback
    return np.where((good < 0)[..., None], start, held)
