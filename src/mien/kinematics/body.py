"""The body in a skeleton: which joint plays which role, whatever its name, unit or axis.

Edits speak of roles and of leg lengths, so they work on any humanoid.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self
from weakref import WeakKeyDictionary

import numpy as np

from ..errors import BodyError, unknown
from ..motion import Motion
from ..typing import Array, Integers
from . import measures, stance, topology
from . import roles as naming
from .lead_in import lead_in
from .parts import PARTS as PARTS
from .roles import ARM as ARM
from .roles import LEG as LEG
from .roles import OPTIONAL as OPTIONAL
from .roles import ROLES as ROLES
from .roles import SIDES as SIDES
from .roles import TRUNK as TRUNK
from .roles import read_map as read_map
from .tree import Tree
from .tree import tree as make_tree


@dataclass(frozen=True, eq=False)
class Body:
    """The roles and measures of a humanoid.

    ``roles`` role -> joint. ``spine`` the joints above the hips up to and with the chest, in order.
    ``neck`` the joints between chest and head, in order. ``limbs`` name -> joints from root to tip
    (roles only: ``left_arm`` is collar, shoulder, elbow, wrist where present; ``head`` is neck and
    head). ``up`` unit vector in world axes; ``forward`` where the neutral stance faces, unit.
    ``leg_length`` hip to knee to ankle, ``height`` floor to top of the head in the neutral stance,
    ``floor`` the height of the ground along ``up``: all in the clip's unit. ``metres_per_unit`` is
    an estimate. ``neutral`` (J, 4): local rotations of a calm upright stance, arms at the sides,
    facing ``forward``. ``parts_of`` (J): for each joint which of head, torso and the four limbs it
    belongs to (fingers go with the arm, eyes with the head), "" for joints above the hips.
    """

    roles: Mapping[str, int]
    spine: tuple[int, ...]
    neck: tuple[int, ...]
    limbs: Mapping[str, tuple[int, ...]]
    up: Array
    forward: Array
    leg_length: float
    height: float
    floor: float
    metres_per_unit: float
    neutral: Array
    parts_of: tuple[str, ...]

    def __repr__(self) -> str:
        metres = self.metres_per_unit
        size = f"{self.height * metres:.2f} m tall, legs {self.leg_length * metres:.2f} m"
        return f"Body({len(self.roles)} roles, {size}, {metres:g} m a unit)"

    @classmethod
    def of(cls, motion: Motion, *, map: Mapping[str, str] | None = None) -> Self:
        """Find the body in ``motion``; ``map`` (role -> joint name) overrides what would be found.

        Without it, the roles that the motion's skeleton keeps from a map file do. An edited motion has
        the body of the motion it was made from: a head that an edit has bowed is not taken for upright.
        Raises ``BodyError`` with the joints and the lines to add to a map file when a needed role
        is not found.
        """
        chosen = map or motion.skeleton.roles
        key = (cls, tuple(sorted(chosen.items())))
        before = motion.reference
        source = before if before is not None and before.skeleton is motion.skeleton else motion
        known = _FOUND.setdefault(source, {})
        if key not in known:
            known[key] = cls(**_find(source, chosen))
        return known[key]

    def joints(self, parts: tuple[str, ...]) -> list[int]:
        """Return the joints of named body parts or roles; empty means every joint.

        A role that this body lacks has none. Raises ``BodyError`` for a name that is no part or role.
        """
        if not parts:
            return list(range(len(self.parts_of)))
        wanted: set[str] = set()
        chosen: set[int] = set()
        for part in parts:
            if part in PARTS:
                wanted.update(PARTS[part])
            elif part in self.roles:
                chosen.add(self.roles[part])
            elif part not in ROLES:
                raise BodyError(unknown("body part or role", part, [*PARTS, *ROLES]))
        chosen.update(j for j, name in enumerate(self.parts_of) if name in wanted)
        return sorted(chosen)

    @property
    def left(self) -> Array:
        """The unit vector to the body's left in the neutral stance: ``up x forward``."""
        return np.cross(self.up, self.forward)


def guessed(motion: Motion) -> dict[str, str]:
    """Return role -> joint name as they are found without a map; roles that are not seen are absent."""
    tree, _, _ = _seen(motion)
    found = topology.find(tree)
    return {role: tree.names[found[role]] for role in ROLES if role in found}


# A motion never changes, so what was found in it stays true for as long as it lives.
_FOUND: WeakKeyDictionary[Motion, dict[Any, Any]] = WeakKeyDictionary()

_FRAMES = 64  # evenly spaced frames that the shape is read from


def _find(motion: Motion, chosen: Mapping[str, str]) -> dict[str, Any]:
    """Return the fields of the body: first the roles, then what follows from them."""
    skeleton = motion.skeleton
    tree, local, moved = _seen(motion)
    found = topology.find(tree) | naming.chosen(skeleton, chosen)
    roles = {role: found[role] for role in ROLES if role in found and chosen.get(role) != ""}
    naming.require(skeleton, roles)
    naming.check(tree, roles)
    leg = measures.leg_length(tree, roles)
    chains = _chains(tree, roles)
    stood = stance.neutral(skeleton, tree, local, np.median(moved, axis=0), roles)
    sole = measures.soles(skeleton, stood.heights, roles, leg)
    for shared in (stood.up, stood.forward, stood.rotations):
        shared.setflags(write=False)
    return {
        "roles": roles,
        **chains,
        "limbs": naming.limbs(roles),
        "up": stood.up,
        "forward": stood.forward,
        "leg_length": leg,
        "height": measures.height(skeleton, stood.heights, roles, leg, sole),
        "floor": measures.floor(motion[lead_in(motion) :], roles, stood.up, sole),
        "metres_per_unit": measures.metres_per_unit(leg),
        "neutral": stood.rotations,
        "parts_of": naming.parts(tree, roles, chains["neck"]),
    }


def _seen(motion: Motion) -> tuple[Tree, Array, Array]:
    """Return the tree that roles are read from, with the rotations and translations of its frames."""
    pick = measures.evenly(len(motion), _FRAMES)
    local, moved = motion.rotations[pick], _shape(motion, pick)
    return make_tree(motion.skeleton, local, moved), local, moved


def _chains(tree: Tree, roles: Mapping[str, int]) -> dict[str, tuple[int, ...]]:
    """Return the spine, hips to chest, and the neck, chest to head."""
    top = roles.get("chest", roles["hips"])
    neck = tree.between(top, roles["head"])[:-1] if "head" in roles else []
    return {"spine": tuple(tree.between(roles["hips"], top)), "neck": tuple(neck)}


def _shape(motion: Motion, pick: Integers) -> Array:
    """Return the translations of some frames, with the offset where a joint sits on its parent instead.

    Some exporters write zeros into position channels that they mean to be added to the offset; a body
    folded into one point would have no shape to read.
    """
    moved, offsets = motion.translations[pick], motion.skeleton.offsets
    size, least = np.linalg.norm(offsets, axis=-1), np.linalg.norm(moved, axis=-1).max(axis=0)
    folded = (least < 1e-3 * size) & (motion.skeleton.parents >= 0)
    return np.where(folded[:, None], offsets, moved) if folded.any() else moved
