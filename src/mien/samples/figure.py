"""One made-up adult in metres: proportions, joint rotations of the trunk and limbs, leg placement.

Axes: x to the figure's left, y up, z forward. Every segment's frame is parallel to these axes when the
figure stands upright with the arms hanging, so a segment's world rotation says how it has moved from
there. Segment lengths are fractions of stature (Drillis & Contini 1966, in Winter, *Biomechanics and
Motor Control of Human Movement*, fig. 4.1); joint centres lie inside the breadths given there.
"""

from collections.abc import Mapping

import numpy as np

from ..rotations import quaternion
from ..typing import Array

STATURE = 1.75
SIDES = {"left": 1.0, "right": -1.0}

# Joint centres in fractions of stature, for the left side; the right side is mirrored.
_TRUNK = {
    "hips": (0.0, 0.553, 0.0),
    "spine": (0.0, 0.595, -0.008),
    "waist": (0.0, 0.655, -0.008),
    "chest": (0.0, 0.720, -0.014),
    "neck": (0.0, 0.838, -0.016),
    "head": (0.0, 0.898, 0.000),
}
_LIMBS = {
    "collar": (0.014, 0.818, -0.004),
    "shoulder": (0.106, 0.818, -0.014),
    "elbow": (0.106, 0.632, -0.014),
    "wrist": (0.106, 0.486, -0.014),
    "hip": (0.052, 0.530, 0.0),
    "knee": (0.052, 0.285, 0.0),
    "ankle": (0.052, 0.039, 0.0),
    "toe": (0.052, 0.011, 0.078),
}
_TIPS = {"hand_tip": (0.106, 0.378, -0.014), "toe_tip": (0.052, 0.006, 0.121)}
_ABOVE = {
    "hips": "",
    "spine": "hips",
    "waist": "spine",
    "chest": "waist",
    "neck": "chest",
    "head": "neck",
    "collar": "chest",
    "shoulder": "collar",
    "elbow": "shoulder",
    "wrist": "elbow",
    "hip": "hips",
    "knee": "hip",
    "ankle": "knee",
    "toe": "ankle",
}

SEGMENTS = (*_TRUNK, *(f"{side}_{name}" for side in SIDES for name in _LIMBS))
INDEX: Mapping[str, int] = {name: i for i, name in enumerate(SEGMENTS)}


def _points() -> dict[str, Array]:
    points: dict[str, Array] = {name: STATURE * np.array(p) for name, p in _TRUNK.items()}
    points["head_tip"] = STATURE * np.array([0.0, 1.0, 0.0])
    for side, sign in SIDES.items():
        for name, p in {**_LIMBS, **_TIPS}.items():
            points[f"{side}_{name}"] = STATURE * np.array(p) * [sign, 1.0, 1.0]
    return points


def _parent(segment: str) -> int:
    side, _, name = segment.rpartition("_")
    above = _ABOVE[name]
    return -1 if not above else INDEX.get(above, INDEX.get(f"{side}_{above}", -1))


STANCE: Mapping[str, Array] = _points()  # where each joint centre and tip is in the upright stance
PARENTS = np.array([_parent(s) for s in SEGMENTS])
THIGH = float(STANCE["left_hip"][1] - STANCE["left_knee"][1])
SHANK = float(STANCE["left_knee"][1] - STANCE["left_ankle"][1])
LEG = THIGH + SHANK
HIP_HEIGHT = float(STANCE["hips"][1])
# The sole, from the floor point under the ankle: it rolls about the heel, then about the toe joint.
FOOT_LENGTH = 0.152 * STATURE
HEEL = np.array([0.0, 0.0, -0.2 * FOOT_LENGTH])
ANKLE = np.array([0.0, STANCE["left_ankle"][1], 0.0])
TOE = STANCE["left_toe"] - STANCE["left_ankle"] + ANKLE

Angles = tuple[
    Array | float, Array | float, Array | float
]  # yaw to the left, lean forward, list to the right


def about(axis: int, angle: Array | float, frames: int | None = None) -> Array:
    """Return the rotations (T, 4) by ``angle`` (T,) radians about x (0), y (1) or z (2)."""
    half = 0.5 * np.broadcast_to(np.asarray(angle, float), np.shape(angle) if frames is None else (frames,))
    q = np.zeros((*half.shape, 4))
    q[..., axis], q[..., 3] = np.sin(half), np.cos(half)
    return q


def turned(yaw: Array | float, lean: Array | float, tip: Array | float) -> Array:
    """Return yaw (to the left), then lean (forward), then list (top to the right), about moving axes."""
    q = quaternion.multiply(about(1, yaw), about(0, lean))
    return quaternion.multiply(q, about(2, tip))


def trunk(pelvis: Angles, thorax: Angles, head: Angles) -> dict[str, Array]:
    """Return the rotations of hips, spine, waist, chest, neck and head.

    The bend from pelvis to thorax is shared evenly by three joints, that from thorax to head by two.
    """
    low, high, top = (np.stack(np.broadcast_arrays(*a), axis=-1) for a in (pelvis, thorax, head))
    shares = {
        "hips": low,
        "spine": low + (high - low) / 3.0,
        "waist": low + (high - low) / 1.5,
        "chest": high,
        "neck": 0.5 * (high + top),
        "head": top,
    }
    return {name: turned(a[..., 0], a[..., 1], a[..., 2]) for name, a in shares.items()}


def arm(
    chest: Array,
    side: str,
    *,
    flexion: Array | float,
    abduction: Array | float,
    rotation: Array | float,
    elbow: Array | float,
    pronation: Array | float = 0.0,
    wrist: Array | float = 0.0,
    collar: tuple[Array | float, Array | float] = (0.0, 0.0),
) -> dict[str, Array]:
    """Return the rotations of collar, shoulder, elbow and wrist from joint angles in radians.

    At the shoulder: turn about the upper arm (outwards), then raise it forward, then sideways.
    ``pronation`` turns the hand about the forearm (thumb inwards), ``wrist`` bends it to the palm,
    ``collar`` is how far the shoulder goes up and forward.
    """
    s = SIDES[side]
    shrug = quaternion.multiply(about(2, s * _array(collar[0])), about(1, -s * _array(collar[1])))
    clavicle = quaternion.multiply(chest, np.broadcast_to(shrug, chest.shape))
    raised = quaternion.multiply(about(2, s * _array(abduction)), about(0, -_array(flexion)))
    upper = quaternion.multiply(chest, quaternion.multiply(raised, about(1, s * _array(rotation))))
    fore = quaternion.multiply(upper, about(0, -_array(elbow)))
    turn = quaternion.multiply(about(1, -s * _array(pronation)), about(2, -s * _array(wrist)))
    hand = quaternion.multiply(fore, np.broadcast_to(turn, fore.shape))
    return {
        f"{side}_collar": clavicle,
        f"{side}_shoulder": upper,
        f"{side}_elbow": fore,
        f"{side}_wrist": hand,
    }


def _array(x: Array | float) -> Array:
    return np.asarray(x, float)


def leg(
    hips: Array, pelvis: Array, side: str, ankle: Array, foot: Array
) -> tuple[dict[str, Array], dict[str, Array]]:
    """Place one leg: return the rotations of thigh and shank, and the angles in radians.

    ``hips`` and ``ankle`` (T, 3) positions, ``pelvis`` and ``foot`` (T, 4) rotations. The knee bends in
    the plane of the leg that faces halfway between pelvis and foot; its angle follows from the three
    sides of the triangle. Angles: hip flexion, knee flexion (0 straight), ankle dorsiflexion.
    """
    hip = hips + quaternion.rotate(pelvis, STANCE[f"{side}_hip"] - STANCE["hips"])
    line = hip - ankle
    reach = np.sqrt(np.einsum("ti,ti->t", line, line))
    forward = np.array([0.0, 0.0, 1.0])
    facing = quaternion.rotate(pelvis, forward) + _level(quaternion.rotate(foot, forward))
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
    sole = quaternion.rotate(quaternion.multiply(quaternion.conjugate(shank), foot), forward)
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


def posed(parts: Mapping[str, Array], frames: int) -> Array:
    """Stack the world rotations of all segments (T, 22, 4)."""
    out = np.empty((frames, len(SEGMENTS), 4))
    for name, i in INDEX.items():
        out[:, i] = parts[name]
    return out
