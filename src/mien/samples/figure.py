"""One made-up adult in metres: its segments, proportions and joint centres.

Axes: x to the figure's left, y up, z forward. Every segment's frame is parallel to these axes when the
figure stands upright with the arms hanging, so a segment's world rotation says how it has moved from
there. Segment lengths are fractions of stature (Drillis & Contini 1966, in Winter, *Biomechanics and
Motor Control of Human Movement*, fig. 4.1); joint centres lie inside the breadths given there.
"""

from collections.abc import Mapping

import numpy as np

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
