"""Left and right: which joints are partners, and a whole motion seen in a mirror.

Partners come from the roles, then down the limbs by name (``LeftHandThumb1`` and ``RightHandThumb1``),
then by where they sit among their siblings.
"""

import re

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

    The mirror stands upright through the hips of the first frame, along the way they face there. With
    ``A = Y^-1 W N^-1`` (world rotations from the neutral stance ``N``, start yaw ``Y`` taken out) each
    joint gets ``S A S`` of its partner, ``S`` the reflection left to right: so no local axes matter,
    and doing it twice gives the motion back. Joints without a partner keep their local rotation;
    joints above the hips are mirrored if they move.
    """
    hips = body.roles["hips"]
    rotations, positions = world(motion)
    stance = neutral_world(motion, body)[0]
    undone = quaternion.conjugate(stance)
    yaw = quaternion.twist(quaternion.multiply(rotations[0, hips], undone[hips]), body.up)
    pairs = _pairs(motion, body)
    seen = quaternion.multiply(quaternion.conjugate(yaw), quaternion.multiply(rotations, undone))
    flipped = quaternion.multiply(yaw, quaternion.multiply(_flip_turn(seen[:, pairs], body.left), stance))
    turned, local = _hang(motion, pairs >= 0, flipped)

    translations = _flip_stretch(motion, pairs, stance, body.left)
    points = _flip_points(positions, positions[0, hips], quaternion.rotate(yaw, body.left))
    points = np.where((pairs >= 0)[:, None], points, positions)
    joint, parents = hips, motion.skeleton.parents
    while joint >= 0 and pairs[joint] >= 0:
        above = int(parents[joint])
        base = points[:, above] if above >= 0 else 0.0
        frame = quaternion.conjugate(turned[:, above]) if above >= 0 else quaternion.IDENTITY
        translations[:, joint] = quaternion.rotate(frame, points[:, joint] - base)
        joint = above
    return quaternion.continuous(local), translations


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


def _flip_stretch(motion: Motion, pairs: Integers, stance: Array, normal: Array) -> Array:
    """Return the translations with what bones stretch and slide handed to the partner, lengths kept."""
    translations, parents = np.array(motion.translations), motion.skeleton.parents
    moving = np.ptp(translations, axis=0).any(axis=-1)
    for joint, other in enumerate(pairs):
        above, beside = int(parents[joint]), int(parents[other])
        if other < 0 or above < 0 or beside < 0 or not (moving[joint] or moving[other]):
            continue
        mean = motion.translations[:, [joint, other]].mean(axis=0)
        slide = quaternion.rotate(stance[beside], motion.translations[:, other] - mean[1])
        slide = _flip_points(slide, 0.0, normal)
        translations[:, joint] = mean[0] + quaternion.rotate(quaternion.conjugate(stance[above]), slide)
    return translations


def _flip_turn(q: Array, normal: Array) -> Array:
    """Return rotations seen in a mirror: of their axis only the part along ``normal`` keeps its sign."""
    along = np.einsum("...i,i->...", q[..., :3], normal)[..., None] * normal
    return np.concatenate([2.0 * along - q[..., :3], q[..., 3:]], axis=-1)


def _flip_points(points: Array, origin: Array | float, normal: Array) -> Array:
    """Return points seen in the mirror through ``origin`` with unit ``normal``."""
    return points - 2.0 * np.einsum("...i,i->...", points - origin, normal)[..., None] * normal
