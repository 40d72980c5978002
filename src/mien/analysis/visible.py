"""How clearly two clips of one action differ: fourteen numbers that people can see, and their size.

Each stands for one thing that mien's edits change: how head, trunk, shoulders, arms and legs are held, how
far each limb goes, how quickly all is. They are measured on bodies that stand upright when neutral, in the
world for the arms, so that they mean the same on every skeleton (the turns of an elbow do not: its axis is
another on each).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..kinematics.body import SIDES, Body
from ..kinematics.fk import world
from ..kinematics.lead_in import still_before
from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .manner import Manner, difference

# Name -> how much is a clear change, in degrees, leg lengths, or as the logarithm of a factor.
VISIBLE: Mapping[str, float] = {
    "head": 10.0,
    "trunk": 10.0,
    "lean": 10.0,
    "shoulders": 10.0,
    "arms": 10.0,
    "arms_forward": 10.0,
    "elbows": 10.0,
    "legs": 10.0,
    "hips_height": 0.03,
    "head_swing": 0.33,
    "torso_swing": 0.33,
    "arm_swing": 0.33,
    "leg_swing": 0.33,
    "rate": 0.33,
}
SWINGS = (("head",), ("torso",), ("left_arm", "right_arm"), ("left_leg", "right_leg"))
DOWN, NO_TURN = np.array([0.0, -1.0, 0.0]), np.array([0.0, 0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Look:
    """How somebody looks in a clip: ``manner``, ``arms`` (3,) in degrees, ``height`` of the hips in legs."""

    manner: Manner
    arms: Array
    height: float

    @classmethod
    def of(cls, motion: Motion, *, body: Body | None = None) -> Self:
        """Return how somebody looks in a motion. Raises ``BodyError`` where no body is found."""
        body = body if body is not None else Body.of(motion)
        manner = Manner.of(motion, body=body)
        above = world(motion)[1][still_before(motion) :, body.roles["hips"]] @ body.up
        return cls(manner, _arms(manner), float(np.median(above) / body.leg_length))


def visible_change(before: Look, after: Look) -> Array:
    """Return what differs between two looks (14,): the numbers of ``VISIBLE``, in units of what is clear.

    ``size = sqrt(sum(x^2))`` says how clear the whole is; of nothing it is 0. Angles are positive forward,
    down, outwards and bent; what a body lacks has not changed.

    >>> from mien import samples
    >>> walk = samples.walk(seconds=3.0).motion
    >>> float(abs(visible_change(Look.of(walk), Look.of(walk))).max())
    0.0
    """
    change = difference(before.manner, after.manner)
    turns = change.pose.turns
    pitch = {s: turns.get(s, (0.0, 0.0, 0.0))[0] for s in ("hips", "trunk", "neck", "head")}
    held = [pitch["neck"] + pitch["head"], pitch["trunk"], pitch["hips"], _out(turns, "collar")]
    held += [*(after.arms - before.arms), _out(turns, "hip"), after.height - before.height]
    swings = [np.mean([np.log(change.swing.get(limb, 1.0)) for limb in limbs]) for limbs in SWINGS]
    return np.array([*held, *swings, np.log(change.rate)]) / list(VISIBLE.values())


def _out(turns: Mapping[str, tuple[float, float, float]], role: str) -> float:
    """Return how far a role of both sides is tilted outwards, in degrees."""
    left, right = (turns.get(f"{side}_{role}", (0.0, 0.0, 0.0))[2] for side in SIDES)
    return 0.5 * (left - right)


def _arms(manner: Manner) -> Array:
    """Return how far upper arms point out and forward and elbows are bent (3,), in degrees, mean of sides."""
    found = []
    for side, out in zip(SIDES, (1.0, -1.0), strict=True):
        turned = NO_TURN
        for segment in ("hips", "trunk", f"{side}_collar", f"{side}_shoulder"):
            turned = quaternion.multiply(turned, manner.pose.get(segment, NO_TURN))
        upper = quaternion.rotate(turned, DOWN)
        bent = quaternion.rotate(manner.pose.get(f"{side}_elbow", NO_TURN), DOWN) @ DOWN
        aside = np.arcsin(np.clip(out * upper[0], -1.0, 1.0))
        found.append(
            np.degrees([aside, np.arctan2(upper[2], -upper[1]), np.arccos(np.clip(bent, -1.0, 1.0))])
        )
    mean: Array = np.mean(found, axis=0)
    return mean
