"""The body in a skeleton: which joint plays which role, whatever its name, unit or axis.

Edits speak of roles and of leg lengths, so they work on any humanoid.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..errors import BodyError, unknown
from ..motion import Motion
from ..typing import Array

SIDES = ("left", "right")
ARM, LEG = ("collar", "shoulder", "elbow", "wrist"), ("hip", "knee", "ankle", "toe")
TRUNK = ("hips", "spine", "chest", "neck", "head")
ROLES = (*TRUNK, *(f"{s}_{r}" for s in SIDES for r in ARM + LEG))
OPTIONAL = {*TRUNK[1:], *(f"{s}_{r}" for s in SIDES for r in ("collar", "wrist", "toe"))}

# Names a person may give to --parts; each is a set of the five limbs and the torso.
PARTS: Mapping[str, tuple[str, ...]] = {
    "head": ("head",),
    "torso": ("torso",),
    "left_arm": ("left_arm",),
    "right_arm": ("right_arm",),
    "left_leg": ("left_leg",),
    "right_leg": ("right_leg",),
    "arms": ("left_arm", "right_arm"),
    "legs": ("left_leg", "right_leg"),
    "upper": ("head", "torso", "left_arm", "right_arm"),
    "left": ("left_arm", "left_leg"),
    "right": ("right_arm", "right_leg"),
}


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

    @classmethod
    def of(cls, motion: Motion, *, map: Mapping[str, str] | None = None) -> Self:
        """Find the body in ``motion``; ``map`` (role -> joint name) overrides what would be found.

        Raises ``BodyError`` with the joints and the lines to add to a map file when a needed role
        is not found.
        """
        raise BodyError("not yet")

    def joints(self, parts: tuple[str, ...]) -> list[int]:
        """Return the joints of named body parts or roles; empty means every joint."""
        if not parts:
            return list(range(len(self.parts_of)))
        wanted: set[str] = set()
        chosen: set[int] = set()
        for part in parts:
            if part in PARTS:
                wanted.update(PARTS[part])
            elif part in self.roles:
                chosen.add(self.roles[part])
            else:
                raise BodyError(unknown("body part or role", part, [*PARTS, *self.roles]))
        chosen.update(j for j, name in enumerate(self.parts_of) if name in wanted)
        return sorted(chosen)

    @property
    def left(self) -> Array:
        """The unit vector to the body's left in the neutral stance: ``up x forward``."""
        return np.cross(self.up, self.forward)
