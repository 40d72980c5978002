"""From joint angles and foot placement to the world rotations of every segment.

Trunk and arms turn by angles; the legs follow from where hips and feet are. All in radians and metres,
in the figure's axes (x left, y up, z forward).
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..rotations import quaternion
from ..typing import Array, Mask
from .figure import ANKLE, HEEL, INDEX, PARENTS, SEGMENTS, SHANK, SIDES, STANCE, THIGH, TOE

Curve = Array | float


@dataclass(frozen=True, eq=False)
class Turn:
    """How a part of the trunk is turned: ``yaw`` to the left, ``lean`` forward, ``tip`` to the right."""

    yaw: Curve = 0.0
    lean: Curve = 0.0
    tip: Curve = 0.0


@dataclass(frozen=True, eq=False)
class Arm:
    """Joint angles of an arm.

    At the shoulder: ``rotation`` about the upper arm (outwards), then ``abduction`` sideways, then
    ``flexion`` forward (so abduction takes a forward arm outwards). ``pronation`` turns the hand
    inwards, ``wrist`` bends it to the palm; ``shrug`` and ``reach`` take the shoulder up and forward.
    """

    flexion: Curve = 0.0
    abduction: Curve = 0.0
    rotation: Curve = 0.0
    elbow: Curve = 0.0
    pronation: Curve = 0.0
    wrist: Curve = 0.0
    shrug: Curve = 0.0
    reach: Curve = 0.0


@dataclass(frozen=True, eq=False)
class Foot:
    """A foot: place of the ankle (T, 3), rotations (T, 4) of foot and toes."""

    ankle: Array
    rotation: Array
    toes: Array


@dataclass(frozen=True, eq=False)
class Pose:
    """All that decides the figure: ``hips`` (T, 3), trunk, and for each side arm and foot."""

    hips: Array
    pelvis: Turn
    thorax: Turn
    head: Turn
    arms: Mapping[str, Arm]
    feet: Mapping[str, Foot]


@dataclass(frozen=True, eq=False)
class Figure:
    """The figure moving: world rotations (T, 22, 4) of its segments, place of the hips (T, 3)."""

    rotations: Array
    hips: Array


def about(axis: int, angle: Curve) -> Array:
    """Return the rotations (..., 4) by ``angle`` (...) about x (0), y (1) or z (2)."""
    half = 0.5 * np.asarray(angle, float)
    q = np.zeros((*half.shape, 4))
    q[..., axis], q[..., 3] = np.sin(half), np.cos(half)
    return q


def turned(yaw: Curve, lean: Curve, tip: Curve) -> Array:
    """Return the rotations (..., 4) of a yaw, then a lean and a tip about the axes so turned."""
    return quaternion.multiply(quaternion.multiply(about(1, yaw), about(0, lean)), about(2, tip))


def build(pose: Pose) -> tuple[Figure, dict[str, Array]]:
    """Return the figure in that pose and its joint angles (T,) by name."""
    parts, frames = trunk(pose), len(pose.hips)
    angles = {
        "trunk_yaw": pose.thorax.yaw - pose.pelvis.yaw,
        "trunk_lean": pose.thorax.lean,
        "head_lean": pose.head.lean,
    }
    for side in SIDES:
        arm, foot = pose.arms[side], pose.feet[side]
        parts |= _arm(parts["chest"], side, arm)
        legs, known = _leg(pose.hips, parts["hips"], side, foot)
        parts |= legs | {f"{side}_ankle": foot.rotation, f"{side}_toe": foot.toes}
        angles |= known | {f"{side}_shoulder": arm.flexion, f"{side}_elbow": arm.elbow}
        angles |= {f"{side}_abduction": arm.abduction}
    rotations = np.empty((frames, len(SEGMENTS), 4))
    for name, i in INDEX.items():
        rotations[:, i] = parts[name]
    known = {name: np.broadcast_to(np.asarray(angle, float), (frames,)) for name, angle in angles.items()}
    return Figure(rotations, pose.hips), known


def trunk(pose: Pose) -> dict[str, Array]:
    """Return the rotations (T, 4) of hips, spine, waist, chest, neck and head.

    The bend from pelvis to thorax is shared evenly by three joints, that from thorax to head by two.
    """
    frames = len(pose.hips)
    low, high, top = (
        np.stack([np.broadcast_to(a, (frames,)) for a in (t.yaw, t.lean, t.tip)])
        for t in (pose.pelvis, pose.thorax, pose.head)
    )
    shares = {
        "hips": low,
        "spine": low + (high - low) / 3.0,
        "waist": low + (high - low) / 1.5,
        "chest": high,
        "neck": 0.5 * (high + top),
        "head": top,
    }
    return {name: turned(*angles) for name, angles in shares.items()}


def positions(figure: Figure) -> Array:
    """Return the joint centres of the figure (T, 22, 3)."""
    out = np.empty((*figure.rotations.shape[:2], 3))
    out[:, 0] = figure.hips
    for j, p in enumerate(PARENTS[1:], start=1):
        bone = STANCE[SEGMENTS[j]] - STANCE[SEGMENTS[p]]
        out[:, j] = out[:, p] + quaternion.rotate(figure.rotations[:, p], bone)
    return out


def rolled(point: Array, pitch: Array) -> Array:
    """Return a point of a planted foot (T, 3) in its footprint, whose origin is under the flat ankle.

    With the toes up (``pitch`` above 0) the foot rolls about the heel, else about the toe joint.
    """
    pivot = np.where(pitch[:, None] > 0.0, HEEL, TOE)
    return pivot + quaternion.rotate(about(0, -pitch), point - pivot)


def planted(place: Array, heading: Curve, pitch: Array) -> Foot:
    """Return a foot that stands at ``place`` and rolls by ``pitch`` (T,), toes flat on the floor or up."""
    yaw = about(1, heading)
    ankle = place + quaternion.rotate(yaw, rolled(ANKLE, pitch))
    toes = turned(np.broadcast_to(heading, pitch.shape), -np.maximum(pitch, 0.0), 0.0)
    return Foot(ankle, turned(heading, -pitch, 0.0), toes)


def standing(pitch: Array) -> Mask:
    """Return the contacts (T, 2) of heel and toe of a planted foot with that pitch."""
    return np.stack([pitch >= 0.0, pitch <= 0.0], axis=-1)


def _arm(chest: Array, side: str, arm: Arm) -> dict[str, Array]:
    s = SIDES[side]
    q = quaternion.multiply
    clavicle = q(chest, q(about(2, s * np.asarray(arm.shrug)), about(1, -s * np.asarray(arm.reach))))
    raised = q(about(0, -np.asarray(arm.flexion)), about(2, s * np.asarray(arm.abduction)))
    upper = q(chest, q(raised, about(1, s * np.asarray(arm.rotation))))
    fore = q(upper, about(0, -np.asarray(arm.elbow)))
    hand = q(fore, q(about(1, -s * np.asarray(arm.pronation)), about(2, -s * np.asarray(arm.wrist))))
    return {
        f"{side}_collar": clavicle,
        f"{side}_shoulder": upper,
        f"{side}_elbow": fore,
        f"{side}_wrist": hand,
    }


def _leg(hips: Array, pelvis: Array, side: str, foot: Foot) -> tuple[dict[str, Array], dict[str, Array]]:
    """Return the rotations of thigh and shank, and the angles of hip, knee and ankle.

    The knee bends in the plane of the leg that faces halfway between pelvis and foot; its angle
    (0 straight) follows from the three sides of the triangle.
    """
    hip = hips + quaternion.rotate(pelvis, STANCE[f"{side}_hip"] - STANCE["hips"])
    line = hip - foot.ankle
    reach = np.sqrt(np.einsum("ti,ti->t", line, line))
    forward = np.array([0.0, 0.0, 1.0])
    facing = quaternion.rotate(pelvis, forward) + _level(quaternion.rotate(foot.rotation, forward))
    up = line / reach[:, None]
    across = np.cross(up, facing)
    across /= np.sqrt(np.einsum("ti,ti->t", across, across))[:, None]
    frame = quaternion.from_matrix(np.stack([across, up, np.cross(across, up)], axis=-1))
    ahead = np.arccos(_cosine(THIGH, reach, SHANK))
    behind = np.arccos(_cosine(SHANK, reach, THIGH))
    thigh = quaternion.multiply(frame, about(0, -ahead))
    shank = quaternion.multiply(frame, about(0, behind))
    down = quaternion.rotate(
        quaternion.multiply(quaternion.conjugate(pelvis), thigh), np.array([0.0, -1.0, 0.0])
    )
    sole = quaternion.rotate(quaternion.multiply(quaternion.conjugate(shank), foot.rotation), forward)
    angles = {
        f"{side}_hip": np.arctan2(down[:, 2], -down[:, 1]),
        f"{side}_knee": ahead + behind,
        f"{side}_ankle": np.arctan2(sole[:, 1], sole[:, 2]),
    }
    return {f"{side}_hip": thigh, f"{side}_knee": shank}, angles


def _level(v: Array) -> Array:
    flat = v * np.array([1.0, 0.0, 1.0])
    return flat / np.maximum(np.sqrt(np.einsum("ti,ti->t", flat, flat)), 1e-9)[:, None]


def _cosine(near: float, reach: Array, far: float) -> Array:
    """Return the cosine of the angle between the sides ``near`` and ``reach`` of a triangle."""
    return np.clip((near * near + reach * reach - far * far) / (2.0 * near * reach), -1.0, 1.0)
