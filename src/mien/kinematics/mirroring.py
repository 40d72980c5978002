"""Left and right: which joints are partners, and a whole motion seen in a mirror.

Partners come from the roles, then down the limbs by name (``LeftHandThumb1`` and ``RightHandThumb1``),
then by where they sit among their siblings.
"""

import re
from functools import cache
from itertools import permutations, product

import numpy as np

from ..motion import Motion, Skeleton
from ..rotations import quaternion
from ..typing import Array, Integers, Mask
from .body import Body
from .fk import world
from .poses import neutral_world

_SWAPS = {"left": "right", "lft": "rgt", "l": "r", "左": "右"}
_SWAPS |= {b: a for a, b in _SWAPS.items()}
_SIDE = re.compile(r"left|right|lft|rgt|左|右|(?<![a-z])[lr](?![a-z])", re.IGNORECASE)
_CAPITAL = re.compile(r"(?<![A-Z])[LR](?=[A-Z][a-z])|(?<=[a-z0-9])[LR](?![a-z])|^[lr](?=[A-Z])")

# How far bones (share of their length) and neutral stance may be off for axes to lie along axes.
MISFIT, OFF = 0.05, np.radians(35.0)


def partners(skeleton: Skeleton, body: Body) -> Integers:
    """Return for each joint (J,) its partner: itself in the middle; -1 where it has none."""
    partner = np.full(len(skeleton), -1)
    for role, joint in body.roles.items():
        other = role.replace("left", "\0").replace("right", "left").replace("\0", "right")
        partner[joint] = body.roles.get(other, -1)
    for joint, part in enumerate(body.parts_of):
        if (
            part in ("", "torso", "head")
            and partner[joint] < 0
            and not _mirrored_names(skeleton.names[joint])
        ):
            partner[joint] = joint
    _pair_by_name(skeleton, partner)
    _pair_by_place(skeleton, partner)
    return partner


def _mirrored_names(name: str) -> list[str]:
    """Return the names that ``name`` may have on the other side; none for a name without a side."""
    found = []
    for pattern in (_SIDE, _CAPITAL):
        for match in pattern.finditer(name):
            word = match.group()
            swap = _SWAPS[word.lower()]
            swap = swap.upper() if word.isupper() else swap.title() if word[0].isupper() else swap
            found.append(name[: match.start()] + swap + name[match.end() :])
    return found


def _pair_by_name(skeleton: Skeleton, partner: Integers) -> None:
    """In place: pair joints without a partner whose names differ in the side alone."""
    index = {name: j for j, name in enumerate(skeleton.names)}
    for joint in np.flatnonzero(partner < 0):
        for name in _mirrored_names(skeleton.names[joint]):
            other = index.get(name, -1)
            if other >= 0 and other != joint and partner[other] < 0 and partner[joint] < 0:
                partner[joint], partner[other] = other, joint


def _pair_by_place(skeleton: Skeleton, partner: Integers) -> None:
    """In place: pair the children of partners that have equally many left, in their order."""
    for joint in range(len(skeleton)):
        other = int(partner[joint])
        if other <= joint:
            continue
        mine = [j for j in skeleton.children(joint) if partner[j] < 0]
        theirs = [j for j in skeleton.children(other) if partner[j] < 0]
        if len(mine) == len(theirs):
            partner[mine], partner[theirs] = theirs, mine


def mirrored(motion: Motion, body: Body) -> tuple[Array, Array]:
    """Return the local rotations (T, J, 4) and translations (T, J, 3) of the motion seen in a mirror.

    The mirror stands upright through the hips of the first frame, along the way they face there. A
    reflection is a half turn and an inversion, so each joint gets ``h W_m q``: ``h`` the half turn about
    the mirror's normal, ``W_m`` the partner's world rotations, ``q`` the half turn that takes the
    partner's own axes to the joint's (``own_axes``). Joints without a partner keep their local rotation;
    joints above the hips are mirrored if they move.
    """
    hips = body.roles["hips"]
    rotations, positions = world(motion)
    pairs = _pairs(motion, body)
    axes = own_axes(motion, body, pairs)
    normal = _level(quaternion.rotate(rotations[0, hips], axes[hips, :3]), body)
    half_turn = np.append(normal, 0.0)
    flipped = quaternion.multiply(half_turn, quaternion.multiply(rotations[:, pairs], axes))
    turned, local = _hang(motion, pairs >= 0, flipped)

    translations = _flip_stretch(motion, pairs, axes)
    points = positions - 2.0 * ((positions - positions[0, hips]) @ normal)[..., None] * normal
    points = np.where((pairs >= 0)[:, None], points, positions)
    joint, parents = hips, motion.skeleton.parents
    while joint >= 0 and pairs[joint] >= 0:
        above = int(parents[joint])
        base = points[:, above] if above >= 0 else 0.0
        frame = quaternion.conjugate(turned[:, above]) if above >= 0 else quaternion.IDENTITY
        translations[:, joint] = quaternion.rotate(frame, points[:, joint] - base)
        joint = above
    return quaternion.continuous(local), translations


def _level(sideways: Array, body: Body) -> Array:
    """Return the unit horizontal part of a vector (3,), or the body's left where it stands upright."""
    level = sideways - (sideways @ body.up) * body.up
    length = float(np.linalg.norm(level))
    return level / length if length > 1e-6 else body.left


def own_axes(motion: Motion, body: Body, pairs: Integers) -> Array:
    """Return rotations ``q`` (J, 4): ``-q^-1 v`` is what a partner's own vector ``v`` is in the mirror.

    Bones tell: of the 24 ways in which axes can lie along axes, the one that takes the partner's bones
    to the joint's and agrees with the neutral stance. Where none does, the stance itself, turned to fit
    the bone.
    """
    stance = neutral_world(motion, body)[0]
    usual = motion.translations.mean(axis=0)  # a mirror keeps it, unlike the first frame
    q = np.tile(np.append(body.left, 0.0), (len(pairs), 1))
    for joint, other in enumerate(pairs):
        if other < 0:
            continue
        if other < joint:
            q[joint] = quaternion.conjugate(q[other])
            continue
        above, beside = int(motion.skeleton.parents[joint]), int(motion.skeleton.parents[other])
        paired = joint != body.roles["hips"] and above >= 0 and pairs[above] == beside
        start = q[above] if paired else np.append(body.left, 0.0)
        mine, theirs = (
            quaternion.multiply(quaternion.conjugate(stance[p]), stance[j]) if paired else stance[j]
            for p, j in ((above, joint), (beside, other))
        )
        guess = quaternion.multiply(quaternion.conjugate(theirs), quaternion.multiply(start, mine))
        q[joint] = _fitted(guess, *_bones(motion.skeleton, usual, pairs, joint, other), middle=joint == other)
    joint = body.roles["hips"]
    while (above := int(motion.skeleton.parents[joint])) >= 0:
        # What carries the hips has no shape: its axes leave their first local rotation as it is.
        first = motion.rotations[0, joint]
        q[above] = quaternion.multiply(first, quaternion.multiply(q[joint], quaternion.conjugate(first)))
        joint = above
    return q


def _bones(skeleton: Skeleton, usual: Array, pairs: Integers, joint: int, other: int) -> tuple[Array, Array]:
    """Return the bones (N, 3) below a joint in its own axes, and those of its partner in theirs."""
    known = [c for c in skeleton.children(joint) if pairs[c] in skeleton.children(other)]
    ends = [np.flatnonzero(skeleton.end_parents == j)[:1] for j in (joint, other)]
    mine = np.concatenate([usual[known], skeleton.end_offsets[ends[0]]])
    theirs = np.concatenate([usual[pairs[known]], skeleton.end_offsets[ends[1]]])
    return (mine, theirs) if len(ends[0]) == len(ends[1]) else (mine[: len(known)], theirs[: len(known)])


def _fitted(guess: Array, mine: Array, theirs: Array, *, middle: bool) -> Array:
    """Return the way axes lie along axes that fits the bones and is near ``guess``; else ``guess`` fitted."""
    ways = _half_turns() if middle else _axis_turns()
    size = max(float(np.sum(mine * mine)), 1e-300)
    seen = -quaternion.rotate(quaternion.conjugate(ways)[:, None], theirs)
    misfit = np.sum((seen - mine) ** 2, axis=(1, 2)) / size
    angle = 2.0 * np.arccos(np.clip(np.abs(ways @ guess), 0.0, 1.0))
    cost = np.minimum(misfit, 1.0) + 0.1 * angle**2
    best = int(np.argmin(cost))
    if misfit[best] < MISFIT**2 and angle[best] < OFF:
        return ways[best]
    if not len(mine):
        return guess
    if middle:
        return _sideways(guess, mine, theirs)
    back = quaternion.conjugate(guess)
    longest = int(np.argmax(np.sum(mine * mine, axis=-1)))
    fit = quaternion.between(-quaternion.rotate(back, theirs[longest]), mine[longest])
    return quaternion.conjugate(quaternion.multiply(fit, back))


def _sideways(guess: Array, mine: Array, theirs: Array) -> Array:
    """Return the half turn about a middle joint's sideways axis: from its left to its right bones.

    Where bones do not spread to the sides, it is ``guess`` made square to them.
    """
    apart = mine - theirs
    across = np.where(apart @ guess[:3] < 0.0, -1.0, 1.0) @ apart
    if float(np.linalg.norm(across)) < 0.1 * float(np.linalg.norm(mine)):
        along = mine.sum(axis=0)
        across = guess[:3] - (guess[:3] @ along) / max(float(along @ along), 1e-300) * along
    return quaternion.normalise(np.append(across, 0.0))


@cache
def _axis_turns() -> Array:
    """Return the 24 rotations (24, 4) that lay coordinate axes along coordinate axes."""
    turns = []
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), order] = signs
            if np.linalg.det(matrix) > 0:
                turns.append(quaternion.from_matrix(matrix))
    return np.stack(turns)


@cache
def _half_turns() -> Array:
    """Return those of the 24 that undo themselves: the nine half turns."""
    turns = _axis_turns()
    return turns[np.abs(turns[:, 3]) < 1e-9]


def _pairs(motion: Motion, body: Body) -> Integers:
    """Return the partners (J,), -1 also for joints outside the body, unless they carry it and move."""
    pairs = partners(motion.skeleton, body)
    outside = np.array([not part for part in body.parts_of])
    outside[body.roles["hips"]] = False
    joint = int(motion.skeleton.parents[body.roles["hips"]])
    carriers = []
    while joint >= 0:
        carriers.append(joint)
        joint = int(motion.skeleton.parents[joint])
    pairs[outside] = -1
    arrays = motion.rotations[:, carriers], motion.translations[:, carriers]
    if any((array != array[0]).any() for array in arrays):
        pairs[carriers] = carriers
    return pairs


def _hang(motion: Motion, known: Mask, flipped: Array) -> tuple[Array, Array]:
    """Return world and local rotations: ``flipped`` in the world where ``known``, else local as before."""
    turned, local = np.array(flipped), np.array(motion.rotations)
    for joint, parent in enumerate(motion.skeleton.parents):
        above = quaternion.IDENTITY if parent < 0 else turned[:, parent]
        if known[joint]:
            local[:, joint] = quaternion.multiply(quaternion.conjugate(above), turned[:, joint])
        else:
            turned[:, joint] = quaternion.multiply(above, local[:, joint])
    return turned, local


def _flip_stretch(motion: Motion, pairs: Integers, axes: Array) -> Array:
    """Return the translations with what bones stretch and slide handed to the partner, lengths kept."""
    translations, parents = np.array(motion.translations), motion.skeleton.parents
    moving = np.ptp(translations, axis=0).any(axis=-1)
    for joint, other in enumerate(pairs):
        above = int(parents[joint])
        if other < 0 or above < 0 or pairs[above] != parents[other] or not (moving[joint] or moving[other]):
            continue
        mean = motion.translations[:, [joint, other]].mean(axis=0)
        slide = motion.translations[:, other] - mean[1]
        translations[:, joint] = mean[0] - quaternion.rotate(quaternion.conjugate(axes[above]), slide)
    return translations
