"""Where the ankles are and how they are turned, and legs bent a little so that they are somewhere else."""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .body import SIDES, Body
from .fk import chain
from .two_bone import nudge


@dataclass(frozen=True, eq=False)
class Ankles:
    """World positions (T, 2, 3) and rotations (T, 2, 4) of the left and right ankle."""

    positions: Array
    rotations: Array

    @classmethod
    def of(cls, motion: Motion, body: Body) -> Self:
        """Return the ankles of a motion."""
        joints = [body.roles[f"{side}_ankle"] for side in SIDES]
        order, rotations, positions = chain(motion, joints)
        at = [order.index(joint) for joint in joints]
        return cls(positions[:, at], rotations[:, at])

    def __getitem__(self, frames: Any) -> Self:
        """Return the ankles at some frames."""
        return type(self)(self.positions[frames], self.rotations[frames])

    def towards(self, other: Self, share: Array | float) -> Self:
        """Return ankles on the straight way to others, turned the shorter way.

        ``share`` from 0 to 1, for all or for each frame and foot (T, 2).
        """
        part = np.asarray(share)[..., None]
        same = np.einsum("tfi,tfi->tf", self.rotations, other.rotations)
        sign = np.where(same < 0.0, -1.0, 1.0)[..., None]
        turned = (1.0 - part) * self.rotations + part * sign * other.rotations
        positions = self.positions + part * (other.positions - self.positions)
        return type(self)(positions, quaternion.normalise(turned))


def move_ankles(motion: Motion, body: Body, goal: Ankles, *, share: Array | float = 1.0) -> Motion:
    """Return the motion with its legs bent a little so that the ankles are where ``goal`` has them.

    For goals some centimetres away at most: see ``nudge``. ``share`` is how much of the way each ankle goes
    (T, 2): 0 changes nothing. What hangs on an ankle keeps its local rotation.
    """
    legs = [[body.roles[f"{side}_{role}"] for role in ("hip", "knee", "ankle")] for side in SIDES]
    order, world, positions = chain(motion, [joint for leg in legs for joint in leg])
    place = {joint: i for i, joint in enumerate(order)}
    at = [place[leg[-1]] for leg in legs]
    goal = Ankles(positions[:, at], world[:, at]).towards(goal, share)
    rotations = np.array(motion.rotations)
    for foot, (hip, knee, ankle) in enumerate(legs):
        root, middle, tip = (positions[:, place[joint]] for joint in (hip, knee, ankle))
        upper, lower = nudge(root, middle, tip, goal.positions[:, foot])
        turned = (
            (hip, quaternion.IDENTITY, quaternion.multiply(upper, world[:, place[hip]])),
            (knee, upper, quaternion.multiply(lower, world[:, place[knee]])),
            (ankle, lower, goal.rotations[:, foot]),
        )
        for joint, above, wanted in turned:
            parent = int(motion.skeleton.parents[joint])
            outer = quaternion.multiply(above, world[:, place[parent]]) if parent >= 0 else above
            rotations[:, joint] = quaternion.multiply(quaternion.conjugate(outer), wanted)
    return motion.with_(rotations=rotations)
