"""The limbs in a tree of joints: two pairs of like branches, and in each the two long bones.

A limb is two stiff straight segments of human proportion with a bend between them. Names weigh in
where they say something.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ..typing import Array
from . import names
from .tree import Tree, unit

Pair = tuple[int, int]
Triple = tuple[int, int, int]  # root, middle, end: hip, knee, ankle or shoulder, elbow, wrist
Limbs = tuple[Triple, Triple]

_ROLES = {"leg": ("hip", "knee", "ankle"), "arm": ("shoulder", "elbow", "wrist")}
# Upper arm and forearm over the leg: 0.186 and 0.146 over 0.491 of the height (Winter, Biomechanics and
# Motor Control, 2009, figure 4.1); in exporters' skeletons the upper arm is shorter (they put the
# shoulder further out), so the middle of both habits is taken.
_ARM_BONES = (0.32, 0.28)
_LONGEST = 12  # nodes of a limb looked at: with twist joints a hip to toe takes eight


def pairs(body: Tree) -> list[Pair]:
    """Return the two pairs of like branches with the longest reach, none inside another."""
    found = []
    for joint in range(len(body.names)):
        branches = [c for c in body.children[joint] if body.is_joint(c) and body.reach[c] > 0.0]
        for a, b in combinations(branches, 2):
            likeness = _likeness(body, a, b)
            if likeness > 0.0:
                found.append((likeness * min(body.reach[a], body.reach[b]), -joint, a, b))
    kept: list[Pair] = []
    for _, _, a, b in sorted(found, reverse=True):
        line = {*body.ancestors(a)[1:], a, b}
        if not any(line & set(pair) for pair in kept):
            kept.append((a, b))
    return kept[:2]


def _likeness(body: Tree, a: int, b: int) -> float:
    """Say from 0 to 1 how far two branches are two sides of one thing: by name, else by bone lengths."""
    side = names.side_of(body.names[a]), names.side_of(body.names[b])
    if all(side):
        same = names.key_of(body.names[a]) == names.key_of(body.names[b])
        return float(side[0] != side[1] and same)
    if any(side):
        return 0.0
    long = max(body.reach[a], body.reach[b])
    first, second = (_big_bones(body, n, 0.05 * long) for n in (a, b))
    size = min(len(first), len(second))
    if size == 0 or min(body.reach[a], body.reach[b]) < 0.7 * long:
        return 0.0
    apart = np.abs(first[:size] - second[:size]) / np.maximum(first[:size], second[:size])
    return max(0.0, 1.0 - 5.0 * float(apart.max()))


def _big_bones(body: Tree, node: int, least: float) -> Array:
    lengths = body.bones[body.main_path(node)]
    return lengths[lengths > least][:4]


def legs_first(body: Tree, a: Pair, b: Pair) -> tuple[Pair, Pair]:
    """Order two pairs as legs, arms: by the names, else by the longer bones, else nearer to the root."""
    vote = [_leg_names(body, pair) for pair in (a, b)]
    if vote[0] != vote[1]:
        return (a, b) if vote[0] > vote[1] else (b, a)
    size = [float(np.sort(body.bones[body.main_path(pair[0])[1:]])[-2:].sum()) for pair in (a, b)]
    if max(size) > 1.15 * min(size):
        return (a, b) if size[0] > size[1] else (b, a)
    above = body.parents[a[0]] in body.ancestors(body.parents[b[0]])
    return (a, b) if above else (b, a)


def _leg_names(body: Tree, pair: Pair) -> int:
    """Count the names on the main path that speak of legs, minus those that speak of arms."""
    total = 0
    for node in filter(body.is_joint, body.main_path(pair[0])):
        roles = names.roles_of(body.names[node])
        total += bool(roles & {"hip", "knee", "ankle", "toe"}) - bool(roles & {"shoulder", "elbow", "wrist"})
    return total


def two_bones(body: Tree, pair: Pair, kind: str, scale: float) -> Limbs | None:
    """Return root, middle and end of both limbs: the nodes that make the best two-bone limbs.

    ``kind`` is ``leg`` or ``arm``; ``scale`` is the leg length for arms and the whole length of the
    limb for legs. ``None`` if there are not three nodes in a row with a length between them.
    """
    paths = [_Path.of(body, node) for node in pair]
    size = min(len(p.nodes) for p in paths)
    best, most = None, -np.inf
    for choice in combinations(range(size), 3):
        if all(p.fits(choice, kind) for p in paths):
            score = sum(p.score(choice, kind, scale) for p in paths)
            apart = body.distance(paths[0].nodes[choice[0]], paths[1].nodes[choice[0]])
            score -= 8.0 * max(0.0, 0.3 - apart / scale) if kind == "arm" else 0.0  # shoulders, not collars
            best, most = (choice, score) if score > most else (best, most)
    if best is None:
        return None
    i, j, k = best
    first, second = (p.nodes for p in paths)
    return (first[i], first[j], first[k]), (second[i], second[j], second[k])


@dataclass(frozen=True, eq=False)
class _Path:
    """The main path of a limb with the median and the spread (over the median) of all distances in it."""

    body: Tree
    nodes: list[int]
    length: Array
    spread: Array

    @classmethod
    def of(cls, body: Tree, node: int) -> "_Path":
        nodes = body.main_path(node)[:_LONGEST]
        points = body.points[nodes]
        distance = np.linalg.norm(points[:, None] - points[None], axis=-1)
        length = np.median(distance, axis=-1)
        return cls(body, nodes, length, distance.std(axis=-1) / np.maximum(length, 1e-12))

    def fits(self, choice: Triple, kind: str) -> bool:
        """Say whether the joints are joints (a hand may be an end site) and both bones have a length."""
        i, j, k = choice
        last = self.nodes[k if kind == "leg" else j]
        return (
            self.body.is_joint(last) and min(self.length[i, j], self.length[j, k]) > 0.02 * self.length.max()
        )

    def turns(self, place: int) -> bool:
        """Say whether a node of the path turns in the clip at all: helpers and file axes do not."""
        return bool(self.body.turning[self.nodes[place]] > 1e-3)

    def bend(self, a: int, middle: int, b: int) -> float:
        """Return how crooked a bone with a joint inside is: its bend in the typical frame, 0.4 at most."""
        sides = self.length[a, middle], self.length[middle, b]
        if min(sides) < 1e-9 * self.length[a, b]:
            return 0.0
        cosine = (sides[0] ** 2 + sides[1] ** 2 - self.length[a, b] ** 2) / (2.0 * sides[0] * sides[1])
        return min(0.4, float(np.pi - np.arccos(np.clip(cosine, -1.0, 1.0))))

    def score(self, choice: Triple, kind: str, scale: float) -> float:
        """Rate a choice: stiff, straight, bending in the middle, of human size, rightly named."""
        i, j, k = choice
        root, middle, end = (self.nodes[n] for n in choice)
        upper, lower = float(self.length[i, j]), float(self.length[j, k])
        path = float(self.body.bones[self.nodes[i + 1 : k + 1]].sum())
        beyond = float(self.body.reach[end]) / (upper + lower if kind == "leg" else scale)
        total = -8.0 * (1.0 - (upper + lower) / path) - 10.0 * (self.spread[i, j] + self.spread[j, k])
        total += min(5.0 * self.spread[i, k], 0.5) + 0.5 * (self.turns(i) + self.turns(k))
        total -= sum(self.bend(a, n, b) for a, b in ((i, j), (j, k)) for n in range(a + 1, b))
        total += 1e-3 * root - 3.0 * max(0.0, 0.1 - beyond)
        if kind == "leg":
            total += 2.0 * (upper + lower) / scale - 12.0 * np.log(upper / lower) ** 2
            total += _foot_angle(self.body, middle, end)
        else:
            usual = np.log([upper / scale / _ARM_BONES[0], lower / scale / _ARM_BONES[1]])
            total -= 8.0 * float(usual @ usual)
        said = zip((root, middle, end), _ROLES[kind], strict=True)
        return float(total) + sum(name_score(self.body, node, role) for node, role in said)


def _foot_angle(body: Tree, knee: int, ankle: int) -> float:
    """Return how far the foot stands off the line of the shank, 0 to 1: an ankle is a corner, a toe not."""
    below = [n for n in body.main_path(ankle)[1:] if body.bones[n] > 0.0]
    if not below:
        return 0.0
    shank, foot = body.points[ankle] - body.points[knee], body.points[below[0]] - body.points[ankle]
    return float(np.mean(1.0 - np.einsum("fi,fi->f", unit(shank), unit(foot)).clip(0.0, 1.0)))


def name_score(body: Tree, node: int, role: str) -> float:
    """Rate a name for a role: the fewer other roles it may mean, the more it counts."""
    if not body.is_joint(node):
        return 0.0
    said = names.roles_of(body.names[node])
    if not said:
        return -1.0 if names.is_extra(body.names[node]) else 0.0
    return 3.0 / len(said) + 0.5 if role in said else -2.0
