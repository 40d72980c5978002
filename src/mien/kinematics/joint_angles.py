"""How far each joint turns, in anatomy's terms: read from rotations that no skeleton's axes need to match."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array, Integers
from .body import Body
from .joint_limits import JOINTS, NAMES, JointAngles, plain, range_of
from .poses import neutral_world

# A positive turn about the body's left swings a limb back and the trunk forward.
FORWARD: Mapping[str, float] = {"chest": 1.0, "head": 1.0}
BEND_BACK = 1.75  # radians that a hinge may seem bent the wrong way; beyond, it is bent too far the right way
CLEAR_BEND = 0.3  # sine of the bend from which a hinge's plane is plain to see


@dataclass(frozen=True, eq=False)
class Hinge:
    """A joint that bends in one plane.

    ``row`` among the joints; unit directions (3,) in the neutral stance: of the bones ``above`` and
    ``below`` it, and the ``axis`` it should bend about.
    """

    row: int
    above: Array
    below: Array
    axis: Array


@dataclass(frozen=True, eq=False)
class Joints:
    """The joints of a body that have angles.

    ``names`` (R), ``joints`` (R) and the ``bases`` (R) they are measured against; ``stances`` (2, R, 4), the
    world rotations of bases and joints in the neutral stance; ``signs`` (R, 3) of the three angles.
    """

    names: tuple[str, ...]
    joints: Integers
    bases: Integers
    stances: Array
    signs: Array
    hinges: tuple[Hinge, ...]
    body: Body

    @classmethod
    def of(cls, motion: Motion, body: Body) -> Self:
        """Return the joints that ``body`` has, the body of ``motion``."""
        names = tuple(n for n in NAMES if n in body.roles and (plain(n) != "chest" or body.spine))
        joints, bases = (
            np.array([f(n) for n in names]) for f in (body.roles.__getitem__, lambda n: _base(n, body))
        )
        stance, points = neutral_world(motion, body)
        hinges = [
            Hinge(r, *_bones(n, body, points), body.left if n.endswith("knee") else -body.left)
            for r, n in enumerate(names)
            if range_of(n).hinge
        ]
        signs = np.array([_signs(n) for n in names])
        return cls(
            names, joints, bases, np.stack([stance[bases], stance[joints]]), signs, tuple(hinges), body
        )

    def seen(self, turned: Array) -> Array:
        """Return how each joint is turned away from the stance (T, R, 4), in the world's axes of the stance.

        ``turned`` (T, R, 4) are the rotations of the joints as their bases see them.
        """
        bases, joints = self.stances
        return quaternion.multiply(bases, quaternion.multiply(turned, quaternion.conjugate(joints)))

    def turned(self, seen: Array) -> Array:
        """Return the rotations as the bases see them (T, R, 4): the inverse of ``seen``."""
        bases, joints = self.stances
        return quaternion.multiply(quaternion.conjugate(bases), quaternion.multiply(seen, joints))

    def axes(self, seen: Array) -> list[Array]:
        """Return the unit axis (3,) of each hinge: that of the plane the clip shows it to bend in."""
        return [_axis(seen[:, h.row], h) for h in self.hinges]

    def angles(self, seen: Array, axes: Sequence[Array]) -> Array:
        """Return flexion, abduction and rotation (T, R, 3) in radians; of hinges about their ``axes``."""
        twist = quaternion.twist(seen, self.body.up)
        swing = quaternion.log(quaternion.multiply(seen, quaternion.conjugate(twist)))
        out = np.stack(
            [swing @ self.body.left, swing @ self.body.forward, quaternion.log(twist) @ self.body.up], axis=-1
        )
        out *= self.signs
        for hinge, axis in zip(self.hinges, axes, strict=True):
            direction = quaternion.rotate(seen[:, hinge.row], hinge.below)
            bend = np.arctan2(np.cross(hinge.above, direction) @ axis, direction @ hinge.above)
            bend = np.where(bend < -BEND_BACK, bend + 2.0 * np.pi, bend)
            aside = np.arcsin(np.clip(direction @ axis, -1.0, 1.0))
            # Its twist is that of what is left without the bend: with it, twist turns over at 180 degrees.
            straight = quaternion.multiply(quaternion.exp(-bend[:, None] * axis), seen[:, hinge.row])
            twist = quaternion.log(quaternion.twist(straight, self.body.up)) @ self.body.up
            out[:, hinge.row] = self.signs[hinge.row] * np.stack([bend, aside, twist], axis=-1)
        return out


def joint_angles(
    motion: Motion, body: Body, rotations: Array, *, axes: Sequence[Array] | None = None
) -> JointAngles:
    """Return the angles of every joint that ``body`` has, from the world rotations (T, J, 4) of ``motion``.

    Rotation is positive outward (to the left, of the trunk); flexion of a hinge is measured about its axis
    of ``axes``, as ``hinge_axes`` gives them, or in the plane that the clip shows it to bend in.
    """
    joints, seen = _seen(motion, body, rotations)
    return JointAngles(joints.names, np.degrees(joints.angles(seen, axes or joints.axes(seen))))


def hinge_axes(motion: Motion, body: Body, rotations: Array) -> list[Array]:
    """Return the unit axis (3,) of each hinge, of the plane that the clip shows it to bend in.

    An edit is measured about the axes of the clip it was made from: a body keeps its hinges.
    """
    joints, seen = _seen(motion, body, rotations)
    return joints.axes(seen)


def _seen(motion: Motion, body: Body, rotations: Array) -> tuple[Joints, Array]:
    """Return the joints and how each is turned away from the stance (T, R, 4)."""
    joints = Joints.of(motion, body)
    turned = quaternion.multiply(
        quaternion.conjugate(rotations[:, joints.bases]), rotations[:, joints.joints]
    )
    return joints, joints.seen(turned)


def _base(name: str, body: Body) -> int:
    """Return the joint that a joint's angles are measured against."""
    above = JOINTS[plain(name)][0]
    if above in ("hips", "chest"):
        return body.spine[-1] if above == "chest" and body.spine else body.roles["hips"]
    return body.roles[f"{name.split('_')[0]}_{above}"]


def _signs(name: str) -> tuple[float, float, float]:
    side = -1.0 if name.startswith("right") else 1.0
    # A hinge's axis says which way it bends.
    return 1.0 if range_of(name).hinge else FORWARD.get(plain(name), -1.0), side, side


def _bones(name: str, body: Body, points: Array) -> tuple[Array, Array]:
    """Return the unit directions of the bones above and below a hinge in the neutral stance."""
    side, role = name.split("_")
    above = points[body.roles[name]] - points[body.roles[f"{side}_{JOINTS[role][0]}"]]
    tip = body.roles.get(f"{side}_{'wrist' if role == 'elbow' else 'ankle'}")
    below = above if tip is None else points[tip] - points[body.roles[name]]
    return _unit(above), _unit(below)


def _axis(seen: Array, hinge: Hinge) -> Array:
    """Return the axis (3,) that a hinge bends about in a clip, from where it is clearly bent."""
    normal = np.cross(hinge.above, quaternion.rotate(seen, hinge.below))
    usual = (np.sum(normal * normal, axis=-1, keepdims=True) / CLEAR_BEND**2 * normal).mean(axis=0)
    # A clip that bends a hinge only the wrong way does not make it the right way.
    return _unit(np.sign(usual @ hinge.axis) * usual + CLEAR_BEND * hinge.axis)


def _unit(v: Array) -> Array:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)
