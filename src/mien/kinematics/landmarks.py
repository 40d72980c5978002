"""Nineteen places on a body that every humanoid has, whichever joints its skeleton lacks or has too many of.

What is measured on them is comparable between skeletons: fingers, twist joints and long spines do not count.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .body import SIDES, Body
from .contacts import foot_points
from .fk import end_positions, world
from .mass import FOREARM
from .poses import neutral_world

TRUNK = ("pelvis", "spine", "chest", "neck", "head")
LIMB = ("shoulder", "elbow", "hand", "hip", "knee", "foot", "toe")
LANDMARKS: tuple[str, ...] = (*TRUNK, *(f"{side}_{place}" for side in SIDES for place in LIMB))
INDEX: Mapping[str, int] = {name: i for i, name in enumerate(LANDMARKS)}
HEAD_ABOVE = 0.18  # leg lengths from the middle of the shoulders to the head joint, where both are
_ROLES = {"hand": "wrist", "foot": "ankle"}  # the joint that stands for a hand or foot


@dataclass(frozen=True, eq=False)
class Landmarks:
    """Where the places are: ``points`` (T, 19, 3), world axes, clip's unit, in the order of ``LANDMARKS``.

    ``rotations`` (T, J, 4) and ``positions`` (T, J, 3) are the world transforms they come from.
    """

    points: Array
    rotations: Array
    positions: Array

    def __getitem__(self, name: str) -> Array:
        """Return one place (T, 3), such as ``left_hand``."""
        return self.points[:, INDEX[name]]


def landmarks(motion: Motion, body: Body) -> Landmarks:
    """Return the places of a body in every frame.

    A hand is the wrist joint and a foot the ankle joint. Without a wrist the hand is the forearm's end site
    or, without one, as far from the elbow as people's; without a toe joint the toe is the foot's end site,
    or the ankle. Without a chest the top of the spine is taken, or the middle of the shoulders; without a
    neck the middle of the shoulders; without a head a point above that, which neck or chest carries.

    >>> from mien.samples import walk
    >>> motion = walk(seconds=1.0).motion
    >>> landmarks(motion, Body.of(motion))["left_hand"].shape
    (61, 3)
    """
    rotations, positions = world(motion)
    points = np.empty((len(motion), len(LANDMARKS), 3))
    toes = foot_points(motion, body, rotations, positions)[:, :, 1]
    for foot, side in enumerate(SIDES):
        for place in LIMB:
            joint = body.roles.get(f"{side}_{_ROLES.get(place, place)}")
            if joint is not None:
                points[:, INDEX[f"{side}_{place}"]] = positions[:, joint]
        points[:, INDEX[f"{side}_toe"]] = toes[:, foot]
        if f"{side}_wrist" not in body.roles:
            points[:, INDEX[f"{side}_hand"]] = _hand(motion, body, side, rotations, positions)
    _trunk(motion, body, points, rotations, positions)
    return Landmarks(points, rotations, positions)


def _trunk(motion: Motion, body: Body, points: Array, rotations: Array, positions: Array) -> None:
    """Fill in the five places of the trunk; the shoulders are known."""
    roles = body.roles
    shoulders = 0.5 * (points[:, INDEX["left_shoulder"]] + points[:, INDEX["right_shoulder"]])
    pelvis = positions[:, roles["hips"]]
    top = body.spine[-1] if body.spine else roles.get("chest")
    chest = shoulders if top is None else positions[:, top]
    middle = body.spine[(len(body.spine) - 1) // 2] if len(body.spine) > 1 else None
    points[:, INDEX["pelvis"]] = pelvis
    points[:, INDEX["spine"]] = 0.5 * (pelvis + chest) if middle is None else positions[:, middle]
    points[:, INDEX["chest"]] = chest
    points[:, INDEX["neck"]] = positions[:, roles["neck"]] if "neck" in roles else shoulders
    points[:, INDEX["head"]] = (
        positions[:, roles["head"]] if "head" in roles else _head(motion, body, top, rotations, positions)
    )


def _hand(motion: Motion, body: Body, side: str, rotations: Array, positions: Array) -> Array:
    """Return the hand (T, 3) of an arm that ends at the elbow joint."""
    elbow, shoulder = body.roles[f"{side}_elbow"], body.roles[f"{side}_shoulder"]
    tips = np.flatnonzero(motion.skeleton.end_parents == elbow)
    if len(tips):
        return end_positions(motion, rotations, positions)[:, tips[0]]
    place = neutral_world(motion, body)[1]
    arm = place[elbow] - place[shoulder]
    length = max(float(np.linalg.norm(arm)), 1e-9 * body.leg_length)
    return _carried(motion, body, elbow, FOREARM * body.leg_length / length * arm, rotations, positions)


def _head(motion: Motion, body: Body, top: int | None, rotations: Array, positions: Array) -> Array:
    """Return the head (T, 3) of a body without one: above its shoulders, carried by the neck."""
    joint = body.roles.get("neck", body.roles["hips"] if top is None else top)
    stance = neutral_world(motion, body)[1]
    shoulders = 0.5 * (stance[body.roles["left_shoulder"]] + stance[body.roles["right_shoulder"]])
    place = shoulders + HEAD_ABOVE * body.leg_length * body.up
    return _carried(motion, body, joint, place - stance[joint], rotations, positions)


def _carried(
    motion: Motion, body: Body, joint: int, offset: Array, rotations: Array, positions: Array
) -> Array:
    """Return a point (T, 3) that a joint carries, ``offset`` from it in the neutral stance, world axes."""
    own = quaternion.rotate(quaternion.conjugate(neutral_world(motion, body)[0][joint]), offset)
    return positions[:, joint] + quaternion.rotate(rotations[:, joint], own)
