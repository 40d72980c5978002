"""Add a pose to every frame of a motion, joint by joint, in one of three ways.

All three work on ``B = N_p R N^-1``, a joint's rotation against its parent as seen from the neutral
stance (``N`` its world rotations), so that nothing depends on the local axes a file uses. With
``D = exp(turn)`` and weight ``w``:

* ``additive`` adds the change of two direction vectors, ``enc(B) + w (enc(D) - enc(1))``, and makes the
  sum a rotation again, the bone's direction first (Förger 2011, section 3.4.2);
* ``body_fixed`` turns each joint about its own axes, ``B exp(w turn)``;
* ``anatomical`` is ``body_fixed`` for trunk, head, hands and feet, but moves upper arms (as seen from
  the chest) and thighs by their direction alone, and bends elbows and knees about the hinge they show
  in the clip.
"""

from collections.abc import Mapping
from typing import Literal

import numpy as np

from ..motion import Motion
from ..rotations import directions, quaternion
from ..signal.waveshaping import soft_limit
from ..typing import Array
from .body import ARM, LEG, Body
from .heading import hips_frame
from .poses import HEIRS, Pose, anatomical_axes, neutral_world, segment_joints

Method = Literal["anatomical", "additive", "body_fixed"]
# Elbows bend to some 150 degrees, but a posture is not there to fold them: what is bent stays as it is.
MOST_BEND = np.radians(120.0)
# Sine of the bend from which the bones' own plane counts more as the hinge than what is usual. Nearly
# straight arms show their carrying angle and capture noise in that plane, not their hinge.
CLEAR_BEND = 0.5


def add_pose(
    motion: Motion, body: Body, pose: Pose, *, weights: Mapping[str, Array], method: Method
) -> Array:
    """Return the local rotations (T, J, 4) with ``pose`` added.

    ``weights`` limb (``left_arm``, ...) -> how much of the pose shows in each frame (T,); segments of
    limbs that it does not name get all of it. The hips are turned in the frame that turns with the
    heading. ``method`` as in the module's docstring.
    """
    turns = {segment: np.array(degrees) for segment, degrees in pose.turns.items()}
    return add_turns(motion, body, turns, weights=weights, method=method)


def add_turns(
    motion: Motion, body: Body, turns: Mapping[str, Array], *, weights: Mapping[str, Array], method: Method
) -> Array:
    """Return the local rotations (T, J, 4) with the turns of some segments added, as ``add_pose`` does.

    ``turns`` segment -> degrees about the body's left, up and forward axes, (3,) or one turn a frame (T, 3).
    """
    stance, positions = neutral_world(motion, body)
    bones, joints = _bones(body, positions), segment_joints(body)
    rotations = np.array(motion.rotations)
    everywhere = np.ones(1)
    for segment, turn in _shared(turns, body).items():
        for joint in joints[segment]:
            above = _above(motion, body, stance, segment, joint, method)
            seen = quaternion.multiply(above, rotations[:, joint])
            seen = quaternion.multiply(seen, quaternion.conjugate(stance[joint]))
            weight = weights.get(body.parts_of[joint], everywhere)
            seen = _changed(method, segment, seen, turn, weight, bones, body)
            local = quaternion.multiply(quaternion.conjugate(above), seen)
            rotations[:, joint] = quaternion.multiply(local, stance[joint])
    return quaternion.continuous(rotations)


def _above(motion: Motion, body: Body, stance: Array, segment: str, joint: int, method: Method) -> Array:
    """Return the rotations, (4,) or (T, 4), from the frame that a joint's turn is told in to its parent's."""
    if segment == "hips":
        return quaternion.conjugate(hips_frame(motion, body, steady=True))
    parent = int(motion.skeleton.parents[joint])
    between, chest = [], parent
    while method == "anatomical" and segment.endswith("_shoulder") and chest not in (*body.spine[-1:], -1):
        between.append(chest)
        chest = int(motion.skeleton.parents[chest])
    if chest < 0 or not between:
        return stance[parent]
    # Arms move out and forward as seen from the chest; collars may be held anyhow.
    above = stance[chest]
    for collar in reversed(between):
        above = quaternion.multiply(above, motion.rotations[:, collar])
    return above


def _changed(
    method: Method,
    segment: str,
    seen: Array,
    turn: Array,
    weight: Array,
    bones: Mapping[str, Array],
    body: Body,
) -> Array:
    """Return the rotations ``seen`` (T, 4) of one joint with ``turn`` (3,) or (T, 3) added."""
    if method == "additive":
        return _add_directions(seen, turn, weight, bones[segment], body)
    if segment == "hips":
        return quaternion.multiply(quaternion.exp(weight[:, None] * turn), seen)
    if method == "anatomical":
        if segment.endswith(("_shoulder", "_hip")):
            return _swing(seen, turn, weight, bones[segment])
        if segment.endswith("_elbow"):
            return _bend(seen, turn, weight, bones[segment], bones[f"{segment[:-5]}shoulder"], -body.left)
        if segment.endswith("_knee"):
            return _bend(seen, turn, weight, bones[segment], bones[f"{segment[:-4]}hip"], body.left)
    return quaternion.multiply(seen, quaternion.exp(weight[:, None] * turn))


def _shared(given: Mapping[str, Array], body: Body) -> dict[str, Array]:
    """Return segment -> the turn of each of its joints, rotation vectors in world axes at neutral."""
    joints, axes = segment_joints(body), anatomical_axes(body)
    turns: dict[str, Array] = {}
    for segment, degrees in given.items():
        owner = segment if segment in joints else HEIRS.get(segment, "")
        if owner in joints and degrees.any():
            turn = np.radians(degrees) @ axes / len(joints[owner])
            turns[owner] = turns[owner] + turn if owner in turns else turn
    return turns


def _bones(body: Body, positions: Array) -> dict[str, Array]:
    """Return segment -> the unit direction of its bone in the neutral stance, in world axes."""
    bones = dict.fromkeys(("hips", "trunk", "neck", "head"), body.up)
    for side in ("left", "right"):
        for chain in (ARM, LEG):
            roles = [f"{side}_{role}" for role in chain if f"{side}_{role}" in body.roles]
            points = positions[[body.roles[role] for role in roles]]
            lines = points[1:] - points[:-1]
            length = np.linalg.norm(lines, axis=-1)[:, None]
            lines = np.where(length > 1e-9 * body.leg_length, lines / np.maximum(length, 1e-300), -body.up)
            # The last segment has no bone of its own: it goes on with the one before.
            bones.update(zip(roles, [*lines, lines[-1]], strict=True))
    return bones


def _add_directions(seen: Array, turn: Array, weight: Array, bone: Array, body: Body) -> Array:
    """Add the change of the bone's direction and of a direction across it; the bone's is kept exactly."""
    across = body.forward if abs(bone @ body.forward) < 0.7 else body.up
    across = across - (across @ bone) * bone
    across = across / np.linalg.norm(across)
    neutral = directions.encode(quaternion.IDENTITY, bone, across)
    change = directions.encode(quaternion.exp(turn), bone, across) - neutral
    codes = directions.encode(seen, bone, across) + weight[:, None] * change
    return directions.decode(codes, bone, across, fallback=seen)


def _swing(seen: Array, turn: Array, weight: Array, bone: Array) -> Array:
    """Move the bone's direction as ``additive`` does, by the shortest way; twist about the bone apart."""
    whole = quaternion.exp(turn)
    there = quaternion.rotate(whole, bone)
    direction = quaternion.rotate(seen, bone)
    swing = quaternion.between(direction, direction + weight[:, None] * (there - bone))
    twist = quaternion.multiply(quaternion.conjugate(quaternion.between(bone, there)), whole)
    return quaternion.multiply(quaternion.multiply(swing, seen), quaternion.power(twist, weight))


def _bend(seen: Array, turn: Array, weight: Array, bone: Array, above: Array, hinge: Array) -> Array:
    """Bend about the joint's own hinge, softly stopped at straight and at 120 degrees.

    The hinge is the normal of the plane of the two bones where the bend is clear; towards straight it
    becomes the clip's usual one, and in clips without a clear bend the plain sideways ``hinge``.
    """
    bent = quaternion.rotate(seen, bone)
    normal = np.cross(above, bent)
    clear = np.sum(normal * normal, axis=-1, keepdims=True) / CLEAR_BEND**2 * normal
    usual = _unit(clear.mean(axis=0) + CLEAR_BEND * hinge)
    axis = _unit(clear + CLEAR_BEND * usual)
    angle = np.arctan2(np.einsum("ti,ti->t", normal, axis), bent @ above)
    about_hinge = turn @ hinge
    wanted = weight * about_hinge
    room = np.where(wanted < 0, angle, MOST_BEND - angle)
    bend = np.sign(wanted) * soft_stop(np.abs(wanted), np.maximum(room, 0.0))
    rest = quaternion.exp(weight[:, None] * (turn - about_hinge[..., None] * hinge))
    return quaternion.multiply(quaternion.multiply(quaternion.exp(axis * bend[:, None]), seen), rest)


def soft_stop(wanted: Array, room: Array) -> Array:
    """Return ``wanted`` (>= 0) kept below ``room``: unchanged to half of it, then ever more slowly.

    ``x`` for ``x <= s``, else ``2s - s exp(-(x - s) / s)`` with ``s = room / 2`` (after Bruderlin and
    Williams 1995): no kink, never beyond.
    """
    return soft_limit(wanted, room, 0.5 * room)


def _unit(v: Array) -> Array:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)
