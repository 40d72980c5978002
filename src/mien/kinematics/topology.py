"""Roles from the shape of the skeleton: two pairs of like limbs, the trunk between them, the head.

Works on any names. Where names say something they weigh in: a right name settles what the shape
leaves open. Nodes are the joints followed by the end sites, so that a hand or a foot without a
joint of its own still has a length.
"""

from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np

from ..motion import Skeleton
from ..typing import Array
from . import names

Pair = tuple[int, int]


@dataclass(frozen=True, eq=False)
class Tree:
    """Joints, then end sites, with their world positions over a few frames.

    ``points`` (N, F, 3); ``bones`` (N) the median distance to the parent; ``reach`` (N) the longest
    way down from a node; ``turning`` (J) how far each joint turns in the clip, radians.
    """

    names: tuple[str, ...]
    parents: tuple[int, ...]
    children: tuple[tuple[int, ...], ...]
    points: Array
    bones: Array
    reach: Array
    turning: Array

    def is_joint(self, node: int) -> bool:
        """Say whether a node is a joint and not an end site."""
        return node < len(self.names)

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


def tree(skeleton: Skeleton, positions: Array, ends: Array, turning: Array) -> Tree:
    """Join joint positions (F, J, 3) and end sites (F, E, 3) into one tree."""
    parents = (*skeleton.parents.tolist(), *skeleton.end_parents.tolist())
    points = np.ascontiguousarray(np.moveaxis(np.concatenate([positions, ends], axis=1), 1, 0))
    step = points - points[np.maximum(parents, 0)]
    bones = np.median(np.linalg.norm(step, axis=-1), axis=1)
    reach, children = np.zeros(len(parents)), [[] for _ in parents]  # type: tuple[Array, list[list[int]]]
    for node in range(len(parents) - 1, -1, -1):
        if parents[node] >= 0:
            children[parents[node]].insert(0, node)
            reach[parents[node]] = max(reach[parents[node]], bones[node] + reach[node])
    kept = tuple(tuple(c) for c in children)
    return Tree(skeleton.names, parents, kept, points, bones, reach, turning)


def find(body: Tree) -> dict[str, int]:
    """Return role -> joint for what the shape (and the names) show; roles not seen are absent."""
    pairs = _limb_pairs(body)
    if len(pairs) < 2:
        return {}
    legs, arms = _legs_first(body, pairs[0], pairs[1])
    leg, arm = _triples(body, legs, "leg"), _triples(body, arms, "arm")
    if leg is None or arm is None:
        return {}
    leg, arm = _left_first(body, leg, arm)
    roles = _trunk(body, leg, arm)
    for side, (hip, knee, ankle), (shoulder, elbow, wrist) in zip(("left", "right"), leg, arm, strict=True):
        roles |= {f"{side}_hip": hip, f"{side}_knee": knee, f"{side}_ankle": ankle}
        roles |= {f"{side}_shoulder": shoulder, f"{side}_elbow": elbow}
        if body.is_joint(wrist):
            roles[f"{side}_wrist"] = wrist
        toe = _toe(body, ankle, hip)
        collar = _collar(body, roles.get("chest", roles["hips"]), shoulder)
        roles |= {f"{side}_toe": toe} if toe is not None else {}
        roles |= {f"{side}_collar": collar} if collar is not None else {}
    return roles


# ---- limbs ------------------------------------------------------------------------------------


def _limb_pairs(body: Tree) -> list[Pair]:
    """Return the two pairs of like branches with the longest reach, none inside another."""
    found = []
    for joint in range(len(body.names)):
        branches = [c for c in body.children[joint] if body.is_joint(c)]
        for a, b in combinations(branches, 2):
            if _alike(body, a, b):
                found.append((min(body.reach[a], body.reach[b]), -joint, a, b))
    kept: list[Pair] = []
    for _, _, a, b in sorted(found, reverse=True):
        inside = set(body.ancestors(a)[1:]) | {a, b}
        if not any(inside & set(pair) for pair in kept):
            kept.append((a, b))
    return kept[:2]


def _alike(body: Tree, a: int, b: int) -> bool:
    """Say whether two branches are the two sides of one thing: by name, else by bone lengths."""
    side = names.side_of(body.names[a]), names.side_of(body.names[b])
    if all(side):
        return side[0] != side[1] and names.key_of(body.names[a]) == names.key_of(body.names[b])
    if any(side):
        return False
    long, short = max(body.reach[a], body.reach[b]), min(body.reach[a], body.reach[b])
    if short <= 0.7 * long or long == 0.0:
        return False
    first, second = (_big_bones(body, n, 0.03 * long) for n in (a, b))
    size = min(len(first), len(second))
    return size > 0 and float(np.abs(first[:size] - second[:size]).max()) < 0.12 * long


def _big_bones(body: Tree, node: int, least: float) -> Array:
    lengths = body.bones[body.main_path(node)[1:]]
    return lengths[lengths > least][:4]


def _legs_first(body: Tree, a: Pair, b: Pair) -> tuple[Pair, Pair]:
    """Order two limb pairs as legs, arms: by names, else the pair with the longer bones, else the upper."""
    vote = [_leg_names(body, p) for p in (a, b)]
    if vote[0] != vote[1]:
        return (a, b) if vote[0] > vote[1] else (b, a)
    size = [float(np.sort(body.bones[body.main_path(p[0])[1:]])[-2:].sum()) for p in (a, b)]
    if max(size) > 1.15 * min(size):
        return (a, b) if size[0] > size[1] else (b, a)
    above = body.parents[a[0]] in body.ancestors(body.parents[b[0]])
    return (a, b) if above else (b, a)


def _leg_names(body: Tree, pair: Pair) -> int:
    """Count names on the main path that speak of legs, minus those that speak of arms."""
    total = 0
    for node in body.main_path(pair[0]):
        roles = names.roles_of(body.names[node]) if body.is_joint(node) else set()
        total += bool(roles & {"hip", "knee", "ankle", "toe"}) - bool(roles & {"shoulder", "elbow", "wrist"})
    return total


_ROLES = {"leg": ("hip", "knee", "ankle"), "arm": ("shoulder", "elbow", "wrist")}
# Upper over lower segment: thigh to shank 0.245 / 0.246 and upper arm to forearm 0.186 / 0.146 of the
# height (Winter, Biomechanics and Motor Control, 2009, figure 4.1); skeletons stray around these.
_RATIO = {"leg": 1.0, "arm": 1.15}

Triple = tuple[int, int, int]


def _triples(body: Tree, pair: Pair, kind: str) -> tuple[Triple, Triple] | None:
    """Return (root, middle, end) of both limbs: the three nodes that make the best two-bone limb."""
    paths = [body.main_path(n) for n in pair]
    size = min(len(p) for p in paths)
    choices = [
        c
        for c in combinations(range(min(size, 12)), 3)
        if _fits(body, [[p[i] for i in c] for p in paths], kind)
    ]
    if not choices:
        return None
    best = max(choices, key=lambda c: sum(_limb_score(body, [p[i] for i in c], kind) for p in paths))
    first, second = (tuple(p[i] for i in best) for p in paths)
    return first, second  # type: ignore[return-value]


def _fits(body: Tree, triples: list[list[int]], kind: str) -> bool:
    """Say whether the joints are joints (a hand may be an end site) and the segments have a length."""
    joints = 3 if kind == "leg" else 2
    return all(
        all(body.is_joint(n) for n in t[:joints])
        and min(_chord(body, t[0], t[1])[0], _chord(body, t[1], t[2])[0]) > 0
        for t in triples
    )


def _chord(body: Tree, a: int, b: int) -> tuple[float, float]:
    """Return the median distance of two nodes and its spread relative to it."""
    length = np.linalg.norm(body.points[a] - body.points[b], axis=-1)
    middle = float(np.median(length))
    return middle, float(length.std()) / max(middle, 1e-12)


def _limb_score(body: Tree, triple: list[int], kind: str) -> float:
    """Rate a limb: long, two stiff straight segments of human proportion, a bend between, right names."""
    (upper, bend_upper), (lower, bend_lower) = _chord(body, *triple[:2]), _chord(body, *triple[1:])
    whole = body.bones[triple[0]] + body.reach[triple[0]]
    path = sum(body.bones[body.between(triple[i], triple[i + 1])].sum() for i in (0, 1))
    folded = _chord(body, triple[0], triple[2])[1]
    score = 4.0 * (upper + lower) / whole
    score -= 8.0 * (1.0 - (upper + lower) / path) + 10.0 * (bend_upper + bend_lower)
    score -= 12.0 * np.log(upper / lower / _RATIO[kind]) ** 2
    score += min(5.0 * folded, 0.5) + 1e-3 * triple[0]
    return float(score) + sum(_name_score(body, n, r) for n, r in zip(triple, _ROLES[kind], strict=True))


def _name_score(body: Tree, node: int, role: str) -> float:
    if not body.is_joint(node):
        return 0.0
    said = names.roles_of(body.names[node])
    if not said:
        return -1.0 if names.is_extra(body.names[node]) else 0.0
    return 3.0 / len(said) + 0.5 if role in said else -2.0


def _toe(body: Tree, ankle: int, hip: int) -> int | None:
    """Return the joint after the ankle on the way to the toes, if it stands apart from the ankle."""
    below = [n for n in body.main_path(ankle)[1:] if body.is_joint(n)]
    far = 0.04 * body.reach[hip]
    return next((n for n in below if _chord(body, ankle, n)[0] > far), None)


def _collar(body: Tree, chest: int, shoulder: int) -> int | None:
    """Return the joint between chest and shoulder that carries the collar bone: the first with a length."""
    line = body.between(chest, shoulder)
    if len(line) < 2:
        return None
    named = [n for n in line[:-1] if "collar" in names.roles_of(body.names[n])]
    whole = sum(body.bones[n] for n in line[1:])
    long = [n for n, after in pairwise(line) if body.bones[after] > 0.25 * whole]
    both = [n for n in named if n in long]
    return (both or long or named or line[:1])[0]


# ---- left and right ---------------------------------------------------------------------------


def _left_first(
    body: Tree, leg: tuple[Triple, Triple], arm: tuple[Triple, Triple]
) -> tuple[tuple[Triple, Triple], tuple[Triple, Triple]]:
    """Order both limb pairs left, right: by the names where they say so, else by feet and knees."""
    said = [_named_left(body, leg), _named_left(body, arm)]
    if not any(said):
        said[0] = 1 if _facing(body, leg) >= 0 else -1
    together = 1 if _same_side(body, leg, arm) else -1
    first = said[0] or said[1] * together
    second = said[1] or said[0] * together
    return (leg if first > 0 else leg[::-1]), (arm if second > 0 else arm[::-1])


def _named_left(body: Tree, pair: tuple[Triple, Triple]) -> int:
    """Return 1 if the names call the first limb left, -1 if right, 0 if they do not say."""
    total = 0
    for sign, triple in zip((1, -1), pair, strict=True):
        for node in triple:
            side = names.side_of(body.names[node]) if body.is_joint(node) else ""
            total += sign * ((side == "left") - (side == "right"))
    return (total > 0) - (total < 0)


def _same_side(body: Tree, leg: tuple[Triple, Triple], arm: tuple[Triple, Triple]) -> bool:
    across = body.points[leg[0][0]] - body.points[leg[1][0]]
    above = body.points[arm[0][0]] - body.points[arm[1][0]]
    return bool((_unit(across) * _unit(above)).sum() >= 0)


def _facing(body: Tree, leg: tuple[Triple, Triple]) -> float:
    """Say how much feet and knees point to the front that follows if the first leg is the left one.

    The front is left x up with up from the ankles to the hips in each frame, so a body that lies or
    turns over is no exception.
    """
    (hip, _, ankle), (other_hip, _, other_ankle) = leg
    points = body.points
    up = points[hip] + points[other_hip] - points[ankle] - points[other_ankle]
    front = _unit(np.cross(points[hip] - points[other_hip], up))
    size = max(_chord(body, hip, ankle)[0], 1e-12)
    total = 0.0
    for h, k, a in leg:
        foot = points[body.main_path(a)[-1]] - points[a]
        knee = points[k] - 0.5 * (points[h] + points[a])
        total += float(np.mean(np.einsum("fi,fi->f", foot + knee, front))) / size
    return total


def _unit(v: Array) -> Array:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)


# ---- trunk ------------------------------------------------------------------------------------


def _trunk(body: Tree, leg: tuple[Triple, Triple], arm: tuple[Triple, Triple]) -> dict[str, int]:
    """Return hips, spine, chest, neck and head."""
    junction = body.common([leg[0][0], leg[1][0]])
    chest = body.common([arm[0][0], arm[1][0]])
    hips = body.common([junction, chest])
    roles = {"hips": hips}
    spine = body.between(hips, chest)
    if spine:
        roles["chest"] = spine[-1]
    if len(spine) > 1:
        roles["spine"] = spine[0]
    middle = [0.5 * (body.points[p[0][0]] + body.points[p[1][0]]) for p in (leg, arm)]
    neck = _neck_chain(body, chest, arm, middle[1] - middle[0])
    if neck:
        roles["head"] = neck[-1]
    if len(neck) > 1:
        roles["neck"] = neck[0]
    return roles


def _neck_chain(body: Tree, chest: int, arm: tuple[Triple, Triple], trunk: Array) -> list[int]:
    """Return the joints from the first neck joint to the head: the branch that goes on upward."""
    taken = {n for triple in arm for n in body.ancestors(triple[0])}
    along = _unit(trunk)
    best: tuple[float, int] | None = None
    for start in [n for n in body.children[chest] if body.is_joint(n) and n not in taken]:
        path = body.main_path(start)
        rise = max(
            float(np.mean(np.einsum("fi,fi->f", body.points[n] - body.points[chest], along))) for n in path
        )
        named = any(names.roles_of(body.names[n]) & {"neck", "head"} for n in path if body.is_joint(n))
        score = rise + (10.0 * body.reach[chest] if named else 0.0)
        if score > 0 and (best is None or score > best[0]):
            best = score, start
    return [] if best is None else _to_head(body, best[1])


def _to_head(body: Tree, start: int) -> list[int]:
    """Cut the chain at the head: where the face branches off, else the last joint that is not a mere tip."""
    chain = [n for n in body.main_path(start) if body.is_joint(n)]
    for i, node in enumerate(chain):
        if "head" in names.roles_of(body.names[node]):
            return chain[: i + 1]
        if sum(body.is_joint(c) for c in body.children[node]) > 1:
            return chain[: i + 1]
    last = chain[-1]
    tip = body.reach[last] < 0.02 * body.reach[start] and body.turning[last] < 1e-3
    return chain[:-1] if tip and len(chain) > 1 else chain
