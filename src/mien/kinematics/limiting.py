"""Turn joints back that are further than they may be, softly: swing and twist, each on the shortest way."""

from collections.abc import Sequence

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array, Integers
from .body import Body
from .joint_angles import Joints
from .joint_limits import OVERHEAD, range_of
from .smoothing import calm_change
from .solver import Limit

SOFT = 2.0  # degrees beyond what is allowed that an excess without end comes to
CALM = 0.04  # seconds over which the change is smoothed
ROUNDS = 12  # as what is smoothed gets smaller, and some is left
RAISED = 20.0  # degrees below OVERHEAD in which the limits of swing and twist fade


def limited(motion: Motion, body: Body, allowed: Array, *, axes: Sequence[Array] | None = None) -> Motion:
    """Return the motion with no joint more than ``allowed`` degrees, and 2 softly, beyond its range.

    ``allowed`` (T, R) or (1, R), for the joints of ``joint_angles``. Only joints beyond it are turned. Of a
    limb raised overhead, whose swing and twist say little, nothing is. Hinges bend about ``axes``
    (``joint_angles.hinge_axes``), or as the motion shows them to.
    """
    joints = Joints.of(motion, body)
    allowed = np.broadcast_to(allowed, (len(motion), len(joints.names)))
    rotations, parents = np.array(motion.rotations), motion.skeleton.parents
    # What many smooth changes leave is little, and is taken as it is.
    for sigma in (*[CALM / motion.frame_time] * ROUNDS, 0.0):
        seen = joints.seen(_turned(rotations, joints, parents))
        back = _back(seen, joints, axes or joints.axes(seen), allowed)
        wrong = joints.joints[back.any(axis=(0, 2))]
        if not len(wrong):
            break
        before = np.array(rotations)
        turned = quaternion.multiply(rotations[:, joints.joints], quaternion.exp(back))
        rotations[:, joints.joints] = turned
        rotations[:, wrong] = calm_change(before[:, wrong], rotations[:, wrong], sigma=sigma)
    return motion.with_(rotations=quaternion.continuous(rotations))


def limit(motion: Motion, body: Body, allowed: Array) -> Limit:
    """Return what the solver asks: local rotations (J, 4, F) at some frames -> the nearest within limits.

    ``allowed`` as for ``limited``; the planes of hinges are those that ``motion`` shows.
    """
    joints = Joints.of(motion, body)
    parents = motion.skeleton.parents
    axes = joints.axes(joints.seen(_turned(motion.rotations, joints, parents)))

    def nearest(rotations: Array, frames: Integers) -> Array:
        """Return rotations (J, 4, F) within the limits, nearest to those given."""
        local = np.moveaxis(rotations, -1, 0)
        seen = joints.seen(_turned(local, joints, parents))
        some = allowed[frames] if len(allowed) > 1 else allowed
        back = quaternion.exp(_back(seen, joints, axes, np.broadcast_to(some, seen.shape[:2])))
        out = np.array(rotations)
        turned = quaternion.multiply(local[:, joints.joints], back)
        out[joints.joints] = np.moveaxis(turned, 0, -1)
        return out

    return nearest


def _turned(local: Array, joints: Joints, parents: Integers) -> Array:
    """Return the rotations of joints as their bases see them (T, R, 4): products of local rotations."""
    out = np.empty((len(local), len(joints.joints), 4))
    for r, (joint, base) in enumerate(zip(joints.joints.tolist(), joints.bases.tolist(), strict=True)):
        found, above = local[:, joint], int(parents[joint])
        while above not in (base, -1):
            found, above = quaternion.multiply(local[:, above], found), int(parents[above])
        out[:, r] = found
    return out


def _back(seen: Array, joints: Joints, axes: Sequence[Array], allowed: Array) -> Array:
    """Return the rotation vectors (T, R, 3), in each joint's own axes, that turn it back to what it may."""
    angles = np.degrees(joints.angles(seen, axes))
    hinges = {h.row: (h.below, axis) for h, axis in zip(joints.hinges, axes, strict=True)}
    new = np.array(seen)
    for r, name in enumerate(joints.names):
        wanted = (_bent if r in hinges else _swung)(angles[:, r], name, allowed[:, r])
        change = np.radians(joints.signs[r] * (wanted - angles[:, r]))
        if not change.any():
            continue
        up = joints.body.up
        twisted = quaternion.exp(change[:, 2:] * up)
        if r in hinges:
            new[:, r] = quaternion.multiply(seen[:, r], twisted)
            direction = quaternion.rotate(seen[:, r], hinges[r][0])
            new[:, r] = quaternion.multiply(_tilted(change, direction, hinges[r][1]), new[:, r])
        else:
            twist = quaternion.twist(seen[:, r], up)
            swing = quaternion.log(quaternion.multiply(seen[:, r], quaternion.conjugate(twist)))
            swing += change[:, :1] * joints.body.left + change[:, 1:2] * joints.body.forward
            new[:, r] = quaternion.multiply(quaternion.exp(swing), quaternion.multiply(twist, twisted))
    turned, fixed = joints.turned(seen), joints.turned(new)
    return np.where(
        (new == seen).all(axis=-1, keepdims=True),
        0.0,
        quaternion.log(quaternion.multiply(quaternion.conjugate(turned), fixed)),
    )


def _soft(excess: Array, allowed: Array) -> Array:
    """Return an excess that ends a little above what is allowed, however large it was, and below as it is."""
    over = np.maximum(excess - allowed, 0.0)
    return np.asarray(np.where(over > 0.0, allowed - SOFT * np.expm1(-over / SOFT), excess))


def _clipped(angle: Array, within: tuple[float, float], allowed: Array) -> Array:
    """Return an angle (T,) that is within a range, and what is allowed beyond it, softly."""
    low, high = within
    below, above = low - angle, angle - high
    angle = np.where(above > allowed, high + _soft(above, allowed), angle)
    return np.where(below > allowed, low - _soft(below, allowed), angle)


def _swung(angles: Array, name: str, allowed: Array) -> Array:
    """Return the angles (T, 3) with the swing drawn in towards the ellipse of its limits, and the twist."""
    able = range_of(name)
    flexion, abduction = angles[:, 0], angles[:, 1]
    bent = np.where(flexion < 0, -able.flexion[0], able.flexion[1])
    aside = np.where(abduction < 0, -able.abduction[0], able.abduction[1])
    length, radius = np.hypot(flexion, abduction), np.hypot(flexion / bent, abduction / aside)
    edge = length / np.maximum(radius, 1.0)
    k = np.where(radius > 1.0, (edge + _soft(length - edge, allowed)) / np.maximum(length, 1e-9), 1.0)
    twist = _clipped(angles[:, 2], able.rotation, allowed)
    wanted = np.stack([k * flexion, k * abduction, twist], axis=1)
    if not name.endswith(("shoulder", "hip")):
        return wanted
    low = np.clip((OVERHEAD - length) / RAISED, 0.0, 1.0)
    return np.asarray(angles + (low * low * (3.0 - 2.0 * low))[:, None] * (wanted - angles))


def _bent(angles: Array, name: str, allowed: Array) -> Array:
    """Return the angles (T, 3) of a hinge, each within its range."""
    able = range_of(name)
    ranges = (able.flexion, able.abduction, able.rotation)
    return np.stack([_clipped(angles[:, i], ranges[i], allowed) for i in range(3)], axis=1)


def _tilted(change: Array, direction: Array, axis: Array) -> Array:
    """Return the rotation (T, 4) that bends a bone along ``direction`` (T, 3) and tilts it."""
    tilt = np.cross(direction, axis)
    tilt = tilt / np.maximum(np.linalg.norm(tilt, axis=1, keepdims=True), 1e-9)
    return quaternion.multiply(quaternion.exp(change[:, :1] * axis), quaternion.exp(change[:, 1:2] * tilt))
