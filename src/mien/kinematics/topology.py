"""Roles from the shape of the skeleton: two pairs of like limbs, the trunk between them, the head.

Works on any names. Where names say something they weigh in: a right name settles what the shape
leaves open.
"""

from itertools import pairwise

import numpy as np

from ..typing import Array
from . import limbs, names
from .limbs import Limbs
from .tree import Tree, unit

SIDES = ("left", "right")
TRUNK = ("hips", "spine", "chest", "neck", "head")


def find(body: Tree) -> dict[str, int]:
    """Return role -> joint for what shape and names show, else names alone; roles not seen are absent."""
    both = _four_limbs(body)
    if both is None:
        return _by_name(body)
    leg, arm = _left_first(body, *both)
    roles = _trunk(body, leg, arm)
    for side, (hip, knee, ankle), (shoulder, elbow, wrist) in zip(SIDES, leg, arm, strict=True):
        roles |= {f"{side}_hip": hip, f"{side}_knee": knee, f"{side}_ankle": ankle}
        roles |= {f"{side}_shoulder": shoulder, f"{side}_elbow": elbow}
        if body.is_joint(wrist):
            roles[f"{side}_wrist"] = wrist
        toe = _toe(body, hip, ankle)
        collar = _collar(body, roles.get("chest", roles["hips"]), shoulder)
        roles |= {} if toe is None else {f"{side}_toe": toe}
        roles |= {} if collar is None else {f"{side}_collar": collar}
    return roles


def _four_limbs(body: Tree) -> tuple[Limbs, Limbs] | None:
    """Return both legs and both arms, each as its three nodes; sides not told apart yet."""
    pairs = limbs.pairs(body)
    if len(pairs) < 2:
        return None
    legs, arms = limbs.legs_first(body, *pairs)
    leg = limbs.two_bones(body, legs, "leg", float(body.reach[legs[0]]))
    arm = limbs.two_bones(body, arms, "arm", _leg_length(body, leg)) if leg else None
    return (leg, arm) if leg and arm else None


def _by_name(body: Tree) -> dict[str, int]:
    """Return the roles that the names alone speak of, from the root outward."""
    roles: dict[str, int] = {}
    for joint, name in enumerate(body.names):
        side, said = names.side_of(name), names.roles_of(name)
        order = ("hip", "knee", "ankle", "toe", "collar", "shoulder", "elbow", "wrist") if side else TRUNK
        free = [r for r in order if r in said and f"{side}_{r}".lstrip("_") not in roles]
        if free:
            roles[f"{side}_{free[0]}".lstrip("_")] = joint
    for side in SIDES:  # a "shoulder" with nothing between it and the elbow is the upper arm
        if f"{side}_shoulder" not in roles and {f"{side}_collar", f"{side}_elbow"} <= roles.keys():
            roles[f"{side}_shoulder"] = roles.pop(f"{side}_collar")
    return roles


def _leg_length(body: Tree, leg: Limbs) -> float:
    return sum(body.distance(a, b) for a, b in pairwise(leg[0]))


def _toe(body: Tree, hip: int, ankle: int) -> int | None:
    """Return the joint after the ankle on the way to the toes, if it stands apart from the ankle."""
    below = [n for n in body.main_path(ankle)[1:] if body.is_joint(n)]
    return next((n for n in below if body.distance(ankle, n) > 0.02 * body.reach[hip]), None)


def _collar(body: Tree, chest: int, shoulder: int) -> int | None:
    """Return the joint between chest and shoulder that carries the collar bone.

    Of those with a good part of the way beyond them: the one best named, then one that turns in the
    clip, then the first (the last where names say nothing against it: those above are helpers).
    """
    line = body.between(chest, shoulder)
    whole = sum(body.bones[n] for n in line[1:])
    long = [n for n, after in pairwise(line) if body.bones[after] > 0.25 * whole] or line[:-1]
    named = [limbs.name_score(body, n, "collar") for n in long]
    place = [i if score > 0 else -i for i, score in enumerate(named)]
    ranked = zip(named, [body.turning[n] > 1e-3 for n in long], place, long, strict=True)
    return max(ranked)[-1] if long else None


# ---- left and right ---------------------------------------------------------------------------


def _left_first(body: Tree, leg: Limbs, arm: Limbs) -> tuple[Limbs, Limbs]:
    """Order legs and arms left, right: by the names where they say so, else by where feet and knees point."""
    together = 1 if _same_side(body, leg, arm) else -1
    of_leg, of_arm = _named_left(body, leg), _named_left(body, arm)
    of_leg = of_leg or of_arm * together or (1 if _facing(body, leg) >= 0 else -1)
    of_arm = of_arm or of_leg * together
    return (leg if of_leg > 0 else leg[::-1]), (arm if of_arm > 0 else arm[::-1])


def _named_left(body: Tree, pair: Limbs) -> int:
    """Return 1 if the names call the first limb left, -1 if right, 0 if they do not say."""
    total = 0
    for sign, triple in zip((1, -1), pair, strict=True):
        for node in filter(body.is_joint, triple):
            side = names.side_of(body.names[node])
            total += sign * ((side == "left") - (side == "right"))
    return (total > 0) - (total < 0)


def _same_side(body: Tree, leg: Limbs, arm: Limbs) -> bool:
    """Say whether the first leg is on the side of the first arm: in the rest pose, else over the clip."""
    hips, shoulders = (leg[0][0], leg[1][0]), (arm[0][0], arm[1][0])
    rest = [unit(body.rest[a] - body.rest[b]) for a, b in (hips, shoulders)]
    if abs(float(rest[0] @ rest[1])) > 0.9:
        return bool(rest[0] @ rest[1] > 0)
    moving = [unit(body.points[a] - body.points[b]) for a, b in (hips, shoulders)]
    return bool((moving[0] * moving[1]).sum() >= 0)


def _facing(body: Tree, leg: Limbs) -> float:
    """Say how much feet and knees point to the front that follows if the first leg is the left one."""
    return _front(body, body.points, leg) + _front(body, body.rest[:, None], leg)


def _front(body: Tree, points: Array, leg: Limbs) -> float:
    """Return how far feet and knees reach to the front, in leg lengths, mean over frames.

    The front is left x up with up from the ankles to the hips in each frame, so a body that lies or
    turns over is no exception.
    """
    (hip, _, ankle), (other_hip, _, other_ankle) = leg
    up = points[hip] + points[other_hip] - points[ankle] - points[other_ankle]
    front = unit(np.cross(points[hip] - points[other_hip], up))
    total = 0.0
    for h, k, a in leg:
        foot = points[body.main_path(a)[-1]] - points[a]
        knee = points[k] - 0.5 * (points[h] + points[a])
        total += float(np.mean(np.einsum("fi,fi->f", foot + knee, front)))
    return total / _leg_length(body, leg)


# ---- trunk ------------------------------------------------------------------------------------


def _trunk(body: Tree, leg: Limbs, arm: Limbs) -> dict[str, int]:
    """Return hips, spine, chest, neck and head; of spine and neck the lowest joint."""
    chest = body.common([arm[0][0], arm[1][0]])
    hips = body.common([leg[0][0], leg[1][0], chest])
    roles, spine = {"hips": hips}, body.between(hips, chest)
    if spine:
        roles["chest"] = spine[-1]
    if len(spine) > 1:
        roles["spine"] = spine[0]
    middle = [0.5 * (body.points[a[0]] + body.points[b[0]]) for a, b in (leg, arm)]
    start = _neck_root(body, chest, arm, unit(middle[1] - middle[0]))
    neck = [] if start is None else _to_head(body, start, _leg_length(body, leg))
    if neck:
        roles["head"] = neck[-1]
    if len(neck) > 1:
        roles["neck"] = neck[0]
    return roles


def _neck_root(body: Tree, chest: int, arm: Limbs, along: Array) -> int | None:
    """Return the child of the chest that goes on upward along the trunk, or is named neck or head."""
    taken = {n for triple in arm for n in body.ancestors(triple[0])}
    best, most = None, 0.0
    for start in [n for n in body.children[chest] if body.is_joint(n) and n not in taken]:
        path = body.main_path(start)
        rise = max(np.einsum("fi,fi->f", body.points[n] - body.points[chest], along).mean() for n in path)
        named = any(names.roles_of(body.names[n]) & {"neck", "head"} for n in path if body.is_joint(n))
        score = float(rise) + (10.0 * body.reach[chest] if named else 0.0)
        best, most = (start, score) if score > most else (best, most)
    return best


def _to_head(body: Tree, start: int, leg: float) -> list[int]:
    """Return the joints up to the head: the one called so, else where the face branches off, else the last.

    Joints that do not turn and stand where their parent is (the face) or at the top of the skull,
    0.13 leg lengths or more above their parent with nothing beyond, are not the head.
    """
    chain: list[int] = []
    for node in filter(body.is_joint, body.main_path(start)):
        chain.append(node)
        if "head" in names.roles_of(body.names[node]):
            return chain
        if sum(body.is_joint(c) for c in body.children[node]) > 1:
            break
    while len(chain) > 1 and _is_tip(body, chain[-1], leg):
        chain.pop()
    return chain


def _is_tip(body: Tree, node: int, leg: float) -> bool:
    if body.turning[node] > 1e-3 or names.roles_of(body.names[node]):
        return False
    top = body.bones[node] > 0.13 * leg and body.reach[node] < 0.02 * leg
    return bool(top or body.bones[node] < 1e-3 * leg)
