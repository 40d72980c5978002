"""How far joints turn, in anatomy's terms, and how far beyond what bodies can do.

Angles are those of each segment against the one it hangs on, from the calm stance: flexion and abduction
(how the bone is swung) and rotation (its twist). They say the same for every skeleton, and swing and twist
have no gimbal (the thesis could not define limits on Euler angles: Förger 2011, section 3.5).

Ranges: American Academy of Orthopaedic Surgeons, *Joint motion* (1965) and Norkin & White, *Measurement of
joint motion* (2016), the widest of the means for adults given there; the neck of Youdas et al. (1992). A foot
on the ground bends further than one in the air (50 degrees), and a hand's joint also turns the forearm.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .body import SIDES, Body
from .poses import neutral_world

Pair = tuple[float, float]


@dataclass(frozen=True)
class Range:
    """What a joint can do, in degrees: (least, most) of flexion, of abduction and of rotation outward.

    A ``hinge`` bends in one plane: its ``abduction`` is how far the bone leaves that plane.
    """

    flexion: Pair
    abduction: Pair
    rotation: Pair
    hinge: bool = False


# Role -> the role it hangs on and its range. Of the trunk, flexion is forward and abduction to the left.
JOINTS: Mapping[str, tuple[str, Range]] = {
    "chest": ("hips", Range((-35, 85), (-40, 40), (-50, 50))),
    "head": ("chest", Range((-80, 60), (-50, 50), (-85, 85))),
    "shoulder": ("chest", Range((-70, 188), (-75, 188), (-110, 110))),
    "elbow": ("shoulder", Range((-15, 158), (-30, 30), (-100, 100), hinge=True)),
    "wrist": ("elbow", Range((-90, 90), (-90, 90), (-120, 120))),
    "hip": ("hips", Range((-40, 130), (-40, 60), (-60, 60))),
    "knee": ("hip", Range((-10, 158), (-20, 20), (-40, 40), hinge=True)),
    "ankle": ("knee", Range((-65, 50), (-45, 45), (-45, 45))),
}
SIDELESS = ("chest", "head")
# A positive turn about the body's left swings a limb back and the trunk forward.
FORWARD = {"chest": 1.0, "head": 1.0, "knee": 1.0}
OVERHEAD = 120.0  # degrees: beyond, swing and twist of a ball joint say nothing (they turn over at 180)
CLEAR_BEND = 0.3  # sine of the bend from which a hinge's plane is plain to see


@dataclass(frozen=True, eq=False)
class JointAngles:
    """``names`` (R) such as ``left_knee``; ``angles`` (T, R, 3) flexion, abduction, rotation, in degrees."""

    names: tuple[str, ...]
    angles: Array

    def beyond(self) -> Array:
        """Return how far beyond its range each joint is (T, R), in degrees; 0 inside.

        Swing is bounded by an ellipse through the four limits, twist by its two; the larger excess counts.
        """
        ranges = [JOINTS[_plain(name)][1] for name in self.names]
        flexion, abduction = self.angles[..., 0], self.angles[..., 1]
        limits = np.array([[r.flexion, r.abduction, r.rotation] for r in ranges], float)  # (R, 3, 2)
        hinge = np.array([r.hinge for r in ranges])
        over = np.maximum(limits[:, :, 0] - self.angles, self.angles - limits[:, :, 1])
        bent = np.where(flexion < 0, -limits[:, 0, 0], limits[:, 0, 1])
        aside = np.where(abduction < 0, -limits[:, 1, 0], limits[:, 1, 1])
        radius = np.hypot(flexion / bent, abduction / aside)
        swung = np.hypot(flexion, abduction) * (1.0 - 1.0 / np.maximum(radius, 1.0))
        swing = np.where(hinge, np.maximum(over[..., 0], over[..., 1]), swung)
        ball = np.array([_plain(name) in ("shoulder", "hip") for name in self.names])
        raised = ball & (np.hypot(flexion, abduction) > OVERHEAD)
        return np.where(raised, 0.0, np.maximum(np.maximum(swing, over[..., 2]), 0.0))


def _plain(name: str) -> str:
    return name.removeprefix("left_").removeprefix("right_")


def joint_angles(motion: Motion, body: Body, rotations: Array) -> JointAngles:
    """Return the angles of every joint that ``body`` has, from the world rotations (T, J, 4) of ``motion``.

    Rotation is positive outward (to the left, of the trunk); flexion of a hinge is measured in the plane that
    the clip shows it to bend in.
    """
    names = [n for n in _names() if n in body.roles and (_plain(n) != "chest" or body.spine)]
    joints = [body.roles[n] for n in names]
    bases = [_base(n, body) for n in names]
    stance, points = neutral_world(motion, body)
    turned = quaternion.multiply(quaternion.conjugate(rotations[:, bases]), rotations[:, joints])
    seen = quaternion.multiply(
        stance[bases], quaternion.multiply(turned, quaternion.conjugate(stance[joints]))
    )
    twist = quaternion.twist(seen, body.up)
    swing = quaternion.log(quaternion.multiply(seen, quaternion.conjugate(twist)))
    out = np.stack([swing @ body.left, swing @ body.forward, quaternion.log(twist) @ body.up], axis=-1)
    out *= np.array([_signs(n) for n in names])
    for r, name in enumerate(names):
        if JOINTS[_plain(name)][1].hinge:
            found = _hinge(seen[:, r], _bones(name, body, points), _expected(name, body))
            out[:, r, :2] = found * [1.0, _signs(name)[1]]
    return JointAngles(tuple(names), np.degrees(out))


def _names() -> list[str]:
    sided = [r for r in JOINTS if r not in SIDELESS]
    return [*SIDELESS, *(f"{side}_{role}" for side in SIDES for role in sided)]


def _base(name: str, body: Body) -> int:
    """Return the joint that a joint's angles are measured against."""
    above = JOINTS[_plain(name)][0]
    if above in ("hips", "chest"):
        return body.spine[-1] if above == "chest" and body.spine else body.roles["hips"]
    return body.roles[f"{name.split('_')[0]}_{above}"]


def _signs(name: str) -> tuple[float, float, float]:
    side = -1.0 if name.startswith("right") else 1.0
    return FORWARD.get(_plain(name), -1.0), side, side


def _bones(name: str, body: Body, points: Array) -> tuple[Array, Array]:
    """Return the unit directions of the bones above and below a hinge in the neutral stance."""
    side, role = name.split("_")
    above = points[body.roles[name]] - points[body.roles[f"{side}_{JOINTS[role][0]}"]]
    tip = body.roles.get(f"{side}_{'wrist' if role == 'elbow' else 'ankle'}")
    below = above if tip is None else points[tip] - points[body.roles[name]]
    return _unit(above), _unit(below)


def _expected(name: str, body: Body) -> Array:
    """Return the axis that a hinge bends about where a clip does not show it."""
    return body.left if name.endswith("knee") else -body.left


def _hinge(seen: Array, bones: tuple[Array, Array], expected: Array) -> Array:
    """Return flexion and deviation (T, 2) in radians: the bone below in and out of the hinge's plane."""
    above, below = bones
    direction = quaternion.rotate(seen, below)
    normal = np.cross(above, direction)
    clear = np.sum(normal * normal, axis=-1, keepdims=True) / CLEAR_BEND**2 * normal
    usual = clear.mean(axis=0)
    # A clip that bends a hinge only the wrong way does not make it the right way.
    axis = _unit(np.sign(usual @ expected) * usual + CLEAR_BEND * expected)
    flexion = np.arctan2(np.cross(above, direction) @ axis, direction @ above)
    return np.stack([flexion, np.arcsin(np.clip(direction @ axis, -1.0, 1.0))], axis=-1)


def _unit(v: Array) -> Array:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)
