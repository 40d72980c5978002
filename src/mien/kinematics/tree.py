"""Joints and end sites as one tree, with where they are in a few frames: what shapes are read from.

Nodes are the joints followed by the end sites, so that a hand or a foot without a joint of its own
still has a length.
"""

from dataclasses import dataclass

import numpy as np

from ..motion import Skeleton
from ..rotations import quaternion
from ..typing import Array
from .fk import fk


@dataclass(frozen=True, eq=False)
class Tree:
    """Joints, then end sites, over a few frames.

    ``points`` (N, F, 3) world positions; ``world`` (F, J, 4) world rotations of the joints;
    ``bones`` (N) the median distance to the parent; ``reach`` (N) the longest way down from a node;
    ``rest`` (N, 3) the positions with all rotations zero; ``turning`` (N) how far each joint turns
    in the clip, radians, 0 for end sites.
    """

    names: tuple[str, ...]
    parents: tuple[int, ...]
    children: tuple[tuple[int, ...], ...]
    points: Array
    world: Array
    bones: Array
    reach: Array
    rest: Array
    turning: Array

    def is_joint(self, node: int) -> bool:
        """Say whether a node is a joint and not an end site."""
        return node < len(self.names)

    def distance(self, a: int, b: int) -> float:
        """Return the median distance of two nodes."""
        return float(np.median(np.linalg.norm(self.points[a] - self.points[b], axis=-1)))

    def main_path(self, node: int) -> list[int]:
        """Return ``node`` and the nodes below it, always on along the longest branch."""
        path = [node]
        while self.children[path[-1]]:
            path.append(max(self.children[path[-1]], key=lambda c: self.bones[c] + self.reach[c]))
        return path

    def ancestors(self, node: int) -> list[int]:
        """Return ``node``, its parent, and so on up to a root."""
        line = [node]
        while self.parents[line[-1]] >= 0:
            line.append(self.parents[line[-1]])
        return line

    def common(self, nodes: list[int]) -> int:
        """Return the lowest joint that is above (or is) all ``nodes``; -1 if they share no root."""
        shared = [set(self.ancestors(n)) for n in nodes]
        return next((n for n in self.ancestors(nodes[0]) if all(n in s for s in shared)), -1)

    def between(self, top: int, bottom: int) -> list[int]:
        """Return the nodes below ``top`` down to and with ``bottom``; empty if it is not below."""
        line = self.ancestors(bottom)
        return line[: line.index(top)][::-1] if top in line else []


def tree(skeleton: Skeleton, rotations: Array, translations: Array) -> Tree:
    """Build the tree from some frames: rotations (F, J, 4) and translations (F, J, 3)."""
    parents = (*skeleton.parents.tolist(), *skeleton.end_parents.tolist())
    world, joints = fk(rotations, translations, skeleton.parents)
    ends = quaternion.rotate(world[:, skeleton.end_parents], skeleton.end_offsets)
    points = np.concatenate([joints, joints[:, skeleton.end_parents] + ends], axis=1)
    points = np.ascontiguousarray(np.moveaxis(points, 1, 0))
    bones = np.median(np.linalg.norm(points - points[np.maximum(parents, 0)], axis=-1), axis=1)
    children, reach = _branches(parents, bones)
    offsets = np.concatenate([np.median(translations, axis=0), skeleton.end_offsets])
    turning = np.concatenate([_turning(rotations), np.zeros(len(skeleton.end_parents))])
    rest = _rest(parents, offsets)
    return Tree(skeleton.names, parents, children, points, world, bones, reach, rest, turning)


def _branches(parents: tuple[int, ...], bones: Array) -> tuple[tuple[tuple[int, ...], ...], Array]:
    """Return the children of each node and the longest way down from it."""
    reach = np.zeros(len(parents))
    children: list[list[int]] = [[] for _ in parents]
    for node in range(len(parents) - 1, -1, -1):  # end sites come last and hang on joints: tips first
        if parents[node] >= 0:
            children[parents[node]].insert(0, node)
            reach[parents[node]] = max(reach[parents[node]], bones[node] + reach[node])
    return tuple(tuple(c) for c in children), reach


def _rest(parents: tuple[int, ...], offsets: Array) -> Array:
    rest = np.array(offsets)
    for node, parent in enumerate(parents):
        rest[node] += rest[parent] if parent >= 0 else 0.0
    return rest


def _turning(rotations: Array) -> Array:
    """Return the largest angle (J,) between a joint's rotation and its first, radians."""
    cosine = np.abs(np.einsum("tji,ji->tj", rotations, rotations[0]))
    return np.asarray(2.0 * np.arccos(np.minimum(cosine, 1.0)).max(axis=0))


def unit(v: Array) -> Array:
    """Scale vectors (..., 3) to length 1; a zero vector stays zero."""
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)
