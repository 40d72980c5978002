"""How points on a body move when its joints turn: products with their Jacobian, which is never built.

Turning a joint at ``p`` by a small vector ``w`` moves a point at ``x`` that hangs on it by ``w x r``, where
``r = x - p``. So, with the ease ``m_j`` of the joints above two points ``k`` and ``n``,

    (J M J')_kn = sum_j m_j ((r_k . r_n) 1 - r_n r_k'),        J' f: torque_j = sum_k r_k x f_k.

The sum is made from ``sum m``, ``sum m p`` and ``sum m p p'`` over each joint and those above it, carried
down the tree once; torques are carried up it. The work grows with the joints plus the pairs of points, not
with their product. Rows over frames throughout, as in ``fk``.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..typing import Array, Integers


@dataclass(frozen=True, eq=False)
class Linkage:
    """The joints (N) that some points (K) hang on, parents first.

    ``joints`` (N,) are their numbers in the skeleton; ``above`` (N,) where among them the parent of each is
    (-1 of a root), ``holders`` (K,) the joint that each point is fixed to. ``ease`` (N, 1) or (N, F) is how
    easily each turns, ``travel`` (N,) how easily it moves in place, in square lengths. Of every two points
    ``pairs`` (2, P), and each with itself, ``shared`` (P,) is the last joint that both hang on, -1 if none.
    """

    joints: Integers
    above: Integers
    holders: Integers
    ease: Array
    travel: Array
    pairs: Integers
    shared: Integers


def linkage(parents: Integers, holders: Sequence[int], ease: Array, travel: Array) -> Linkage:
    """Return the linkage of points fixed to the joints ``holders``; ``ease`` and ``travel`` (J,) of all."""
    paths = [line(parents, j) for j in holders]
    joints = np.array(sorted({j for path in paths for j in path}), int)
    place = {-1: -1} | {int(j): i for i, j in enumerate(joints)}
    pairs = [(k, n) for k in range(len(paths)) for n in range(k, len(paths))]
    return Linkage(
        joints,
        np.array([place[int(parents[j])] for j in joints], int),
        np.array([place[j] for j in holders], int),
        ease[joints, None],
        travel[joints],
        np.array(pairs, int).T,
        np.array([place[_last_common(paths[k], paths[n])] for k, n in pairs], int),
    )


def response(link: Linkage, points: Array, at: Array) -> Array:
    """Return ``J M J'`` (F, 3 K, 3 K) of ``points`` (K, 3, F) and joints ``at`` (N, 3, F).

    Travelling joints add their ``travel`` to the diagonal of the points that hang on them both.
    """
    origin = points.mean(axis=0)  # near the body, so that the sums lose no digits far from the world's origin
    x = points - origin
    zeroth, first, second, travel = _sums(link, at - origin)
    (k, n), size = link.pairs, len(x)
    middle = first[link.shared]
    # sum m (x_n - p)(x_k - p)' = x_n (m x_k - sum m p)' - (sum m p) x_k' + sum m p p'
    product = x[n][:, :, None] * (zeroth[link.shared][:, None] * x[k] - middle)[:, None]
    product -= middle[:, :, None] * x[k][:, None]
    product += second[link.shared]
    trace = product[:, 0, 0] + product[:, 1, 1] + product[:, 2, 2] + travel[link.shared][:, None]
    np.negative(product, out=product)
    for i in range(3):
        product[:, i, i] += trace
    out = np.empty((size, 3, size, 3, x.shape[-1]))
    out[k, :, n] = product
    out[n, :, k] = np.swapaxes(product, 1, 2)
    return np.ascontiguousarray(np.moveaxis(out, -1, 0)).reshape(-1, 3 * size, 3 * size)


def _sums(link: Linkage, at: Array) -> tuple[Array, Array, Array, Array]:
    """Return the sums of ``m``, ``m p``, ``m p p'`` and ``travel`` over each joint and those above it.

    Shapes (N + 1, 1 or F), (N + 1, 3, F), (N + 1, 3, 3, F) and (N + 1,); the last row is the empty sum.
    """
    joints, count = len(at), at.shape[-1]
    zeroth, travel = np.pad(link.ease, ((0, 1), (0, 0))), np.pad(link.travel, (0, 1))
    first, second = np.zeros((joints + 1, 3, count)), np.zeros((joints + 1, 3, 3, count))
    np.multiply(link.ease[:, None], at, out=first[:-1])
    np.multiply(first[:-1, :, None], at[:, None], out=second[:-1])
    for j, above in enumerate(link.above):
        if above >= 0:
            zeroth[j] += zeroth[above]
            travel[j] += travel[above]
            first[j] += first[above]
            second[j] += second[above]
    return zeroth, first, second, travel


def turns(link: Linkage, points: Array, at: Array, forces: Array) -> tuple[Array, Array]:
    """Return ``M J' f``: how ``forces`` (K, 3, F) on the points turn and move the joints, each (N, 3, F)."""
    origin = points.mean(axis=0)
    load = np.zeros((len(at), 6, at.shape[-1]))  # force, and its torque about the origin
    arm = points - origin
    for holder, force, torque in zip(link.holders, forces, _cross(arm, forces), strict=True):
        load[holder, :3] += force
        load[holder, 3:] += torque
    for j in range(len(at) - 1, 0, -1):
        if link.above[j] >= 0:
            load[link.above[j]] += load[j]
    turn = load[:, 3:] - _cross(at - origin, load[:, :3])
    return link.ease[:, None] * turn, link.travel[:, None, None] * load[:, :3]


def _cross(a: Array, b: Array) -> Array:
    """Return the cross products of vectors (N, 3, F)."""
    out = np.empty(b.shape)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(a[:, j], b[:, k], out=out[:, i])
        out[:, i] -= a[:, k] * b[:, j]
    return out


def line(parents: Integers, joint: int) -> list[int]:
    """Return the joints from the root down to ``joint``."""
    line = []
    while joint >= 0:
        line.append(joint)
        joint = int(parents[joint])
    return line[::-1]


def _last_common(one: Sequence[int], other: Sequence[int]) -> int:
    """Return the last joint that two lines from the root have in common; -1 if they have different roots."""
    common = -1
    for a, b in zip(one, other, strict=False):
        if a != b:
            break
        common = a
    return common
