"""Laban features of control points, quickly: only those that the rules can change, on some keyframes.

Points are the nineteen landmarks in heights of the body, so that they are the features of ``analysis.laban``
with two differences that a search for coefficients needs. Hands go smoothly from zone to zone, as a count of
frames has no slope. The torso's height is told along the vertical: to its length no rule does anything, as
bones keep theirs.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..analysis.hulls import faces_volumes, hull_faces
from ..analysis.laban import PACE, VOLUMES
from ..analysis.laban_table import SELECTED
from ..kinematics.body import SIDES, Body
from ..kinematics.control_points import rest_height, rest_torso
from ..kinematics.control_rules import REFERENCES, hand_position, pelvis_height, torso_vector
from ..kinematics.landmarks import INDEX, LANDMARKS, landmarks
from ..motion import Motion
from ..typing import Array, Integers

# Numbers of the selected features that a rule can change: table 2, without 17, the jerk, which is printed
# among the volumes of g1. Feature 5, between the feet, is changed by none.
AFFECTED = {
    "pelvis": (4, 18, 19, 27, 28, 29),
    "torso": (18, 19, 20, 26, 28, 29),
    "hands": (1, 2, 3, 18, 19, 21, 22, 23, 26, 28, 29, 30, 31),
}
POSE = tuple(sorted({number for numbers in AFFECTED.values() for number in numbers}))
NUMBERS = (*POSE, *PACE)  # of the thirty features that rules change: of poses, and of pace
# Unit of a feature -> a change so small that nobody sees it: no feature is told apart more finely.
FLOOR = {
    "heights": 0.005,
    "heights^2/s": 0.005,
    "heights^3": 0.001,
    "heights/s": 0.05,
    "heights/s^2": 0.5,
    "heights/s^3": 5.0,
    "per window": 0.2,
    "share": 0.05,
}
_PACE_FLOOR = np.array([FLOOR[SELECTED[number - 1].feature.unit] for number in PACE])
# Which derivative each feature of pace is, so to which power of the tempo it goes.
ORDER = np.array([{**dict.fromkeys(range(12, 17), 2), 17: 3}.get(number, 1) for number in PACE])
KEYFRAMES = 6.0  # a second: every fifth frame of 30
CURVED = 0.4  # per radian squared; measured 0.2 to 0.6 on three skeletons
SOFT = 0.02  # heights: around the border between two zones
# Pairs of places whose distance is a feature: its number.
_PAIRS = {
    1: ("left_hand", "right_hand"),
    2: ("left_hand", "pelvis"),
    3: ("right_hand", "pelvis"),
    30: ("left_hand", "chest"),
    31: ("right_hand", "chest"),
}
VOLUME = (18, 19, 26, 27, 28, 29)  # features that are volumes, in the order of VOLUMES
_GROUPS = tuple(tuple(INDEX[name] for name in group) for group in VOLUMES)
# How far a place goes with the pelvis: knees half, feet not.
_LIFT = np.array(
    [{"knee": 0.5, "foot": 0.0, "toe": 0.0}.get(name.rpartition("_")[2], 1.0) for name in LANDMARKS]
)
# Whether a place goes with the torso, and the place that says how far up the torso it is.
_FOLLOWS = np.array(
    [
        name in ("spine", "chest", "neck", "head") or name.endswith(("shoulder", "elbow", "hand"))
        for name in LANDMARKS
    ]
)
_LEVEL = [
    INDEX[f"{name.partition('_')[0]}_shoulder"] if name.endswith(("elbow", "hand")) else INDEX[name]
    for name in LANDMARKS
]


@dataclass(frozen=True, eq=False)
class Poses:
    """The poses at the keyframes, before any rule: ``points`` (K, 19, 3) in heights of the body.

    ``up`` (3,), the ``floor`` along it, the height of the pelvis and the torso (K, 3) of the calm stance.
    """

    points: Array
    up: Array
    floor: float
    rest_height: float
    rest_torso: Array

    @classmethod
    def of(cls, motion: Motion, body: Body) -> Self:
        """Return the poses of all frames of a motion; give it only the keyframes."""
        found, size = landmarks(motion, body), body.height
        torso = rest_torso(motion, body, found.positions) / size
        return cls(found.points / size, body.up, body.floor / size, rest_height(motion, body) / size, torso)

    def ruled(self, coefficients: Array) -> Array:
        """Return the points (N, K, 19, 3) after the rules g1 to g3.

        ``coefficients`` (N, 10), or (N, K, 10) for each pose, are in the order of
        ``kinematics.control_points.NAMES``. No body is asked whether it can do that. Elbows bend as arms do.
        """
        many, keys = len(coefficients), len(self.points)
        each = coefficients if coefficients.ndim == 3 else np.repeat(coefficients[:, None], keys, axis=1)
        c = each.reshape(many * keys, -1)
        points = self._with_pelvis(np.tile(self.points, (many, 1, 1)), c[:, 0])
        points = self._with_torso(points, np.tile(self.rest_torso, (many, 1)), c[:, 1])
        return self._with_hands(points, c[:, 2:]).reshape(many, keys, -1, 3)

    def _with_pelvis(self, points: Array, c: Array) -> Array:
        height = points[:, INDEX["pelvis"]] @ self.up - self.floor
        shift = pelvis_height(height, self.rest_height, c) - height
        return points + (shift[:, None] * _LIFT)[..., None] * self.up

    def _with_torso(self, points: Array, rest: Array, c: Array) -> Array:
        """Move the trunk by how far up it each place is, arms with their shoulder.

        Of what g2 wants the direction counts: bones keep their length, and a spine that bends by an angle d
        gets shorter from end to end, by about ``CURVED d^2`` of its length.
        """
        pelvis, head = points[:, INDEX["pelvis"]], points[:, INDEX["head"]]
        torso = head - pelvis
        aim = torso_vector(torso, rest, c)
        length, wanted = (np.sqrt(np.einsum("ti,ti->t", v, v))[:, None] for v in (torso, aim))
        cosine = np.einsum("ti,ti->t", torso, aim)[:, None] / np.maximum(length * wanted, 1e-12)
        bend = np.arccos(np.clip(cosine, -1.0, 1.0))
        change = aim * ((1.0 - CURVED * bend**2) * length / np.maximum(wanted, 1e-9)) - torso
        along = np.einsum("tni,ti->tn", points - pelvis[:, None], torso)
        share = np.clip(along / np.maximum(length, 1e-9) ** 2, 0.0, 1.0)
        return points + (share[:, _LEVEL] * _FOLLOWS)[..., None] * change[:, None]

    def _with_hands(self, points: Array, c: Array) -> Array:
        for i, side in enumerate(SIDES):
            hand = points[:, INDEX[f"{side}_hand"]]
            ground = hand - (hand @ self.up - self.floor)[:, None] * self.up
            places = [ground if name == "ground" else points[:, INDEX[name]] for name in REFERENCES]
            moved = hand_position(hand, np.stack(places, axis=1), c[:, 4 * i : 4 * i + 4]) - hand
            points[:, INDEX[f"{side}_elbow"]] = _elbow(points, side, hand + moved)
            points[:, INDEX[f"{side}_hand"]] = hand + moved
        return points


def _elbow(points: Array, side: str, hand: Array) -> Array:
    """Return where the elbow (T, 3) is when the hand is elsewhere: on its side of the line, bones as long.

    A hand out of reach has it on the line.
    """
    shoulder, elbow, before = (points[:, INDEX[f"{side}_{p}"]] for p in ("shoulder", "elbow", "hand"))
    upper, lower = elbow - shoulder, before - elbow
    line = hand - shoulder
    square = np.maximum(_dot(line, line), 1e-12)
    share = 0.5 * (1.0 + (_dot(upper, upper) - _dot(lower, lower)) / square)
    share = np.clip(share, -1.0, 2.0)
    aside = upper - (_dot(upper, line) / square)[:, None] * line
    height = np.sqrt(np.maximum(_dot(upper, upper) - share**2 * square, 0.0))
    out = aside / np.maximum(np.sqrt(_dot(aside, aside)), 1e-9)[:, None]
    return np.asarray(shoulder + share[:, None] * line + height[:, None] * out)


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(np.einsum("ti,ti->t", a, b))


def faces(points: Array) -> list[Integers]:
    """Return the faces of the six hulls of points (K, 19, 3): see ``analysis.hulls.hull_faces``."""
    return hull_faces(points, _GROUPS)


def measured(
    points: Array, up: Array, *, found: Sequence[Integers] | None = None, volumes: bool = True
) -> Array:
    """Return the features (K, 16) numbered ``POSE`` of points (K, 19, 3), each in its own unit of heights.

    ``found`` are the faces of nearby points: quicker than to look for them; without ``volumes`` those are 0.
    The height of the floor is taken
    as 0 along ``up`` (3,): it matters to differences only as it stays.

    >>> still = np.random.default_rng(0).normal(size=(2, 19, 3))
    >>> measured(still, np.array([0.0, 1.0, 0.0])).shape
    (2, 16)
    """
    out = np.empty((len(points), len(POSE)))
    for number, (one, other) in _PAIRS.items():
        away = points[:, INDEX[one]] - points[:, INDEX[other]]
        out[:, POSE.index(number)] = np.sqrt(np.einsum("ti,ti->t", away, away))
    height = points @ up
    pelvis, head, chest = (height[:, INDEX[name]] for name in ("pelvis", "head", "chest"))
    out[:, POSE.index(4)] = pelvis
    out[:, POSE.index(20)] = head - pelvis
    hands = height[:, [INDEX["left_hand"], INDEX["right_hand"]]]
    above = _step(hands - head[:, None])
    below = (1.0 - above) * _step(chest[:, None] - hands)
    for number, zone in zip((21, 22, 23), (above, 1.0 - above - below, below), strict=True):
        out[:, POSE.index(number)] = zone.mean(axis=1)
    hulls = [POSE.index(number) for number in VOLUME]
    out[:, hulls] = faces_volumes(points, found or faces(points)) if volumes else 0.0
    return out


def _step(distance: Array) -> Array:
    """Return 0 far below 0, 1 far above it, smoothly."""
    return 0.5 * (1.0 + np.tanh(distance / (2.0 * SOFT)))


def keyframes(frames: int, frame_time: float) -> Integers:
    """Return every fifth frame of 30 a second, or as many a second.

    >>> keyframes(16, 1 / 30).tolist()
    [0, 5, 10, 15]
    """
    return np.arange(0, frames, max(1, round(1.0 / (KEYFRAMES * frame_time))))


def toned(pace: Array) -> Array:
    """Return features of pace (..., 14) so that a tempo adds to them: ``log(v + floor)``.

    How much faster somebody is compares between a walk and a wave, how many metres a second do not.
    """
    return np.asarray(np.log(np.maximum(pace, 0.0) + _PACE_FLOOR))
