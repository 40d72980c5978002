"""A motion in a dozen numbers that a person can picture: how it is held, how it travels, how feet stand.

Angles are those of anatomy, seen from the side of a body that may turn: the frame they are measured in
turns with the heading. Lengths are in centimetres, by the body's estimate of the clip's unit.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..kinematics.body import SIDES, Body
from ..kinematics.contacts import Contacts, detect, foot_points, slides
from ..kinematics.fk import world
from ..kinematics.heading import heading_rotation
from ..kinematics.lead_in import lead_in
from ..kinematics.poses import neutral_world
from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array

NAN = float("nan")


@dataclass(frozen=True)
class Measure:
    """What a measure is called, its unit and how many digits of it mean something."""

    label: str
    unit: str
    digits: int = 1


MEASURES: Mapping[str, Measure] = {
    "head_pitch": Measure("head down, against the floor", "degrees"),
    "trunk_flexion": Measure("trunk forward, from upright", "degrees"),
    "elbow_flexion": Measure("elbows bent", "degrees"),
    "arm_swing": Measure("arm swing", "degrees"),
    "hips_height": Measure("hips height", "cm"),
    "step_length": Measure("step length", "cm"),
    "speed": Measure("speed over ground", "m/s", 2),
    "travelled": Measure("distance travelled", "m", 2),
    "duration": Measure("duration", "s", 2),
    "foot_slide": Measure("foot slide a contact", "cm", 2),
    "foot_sink": Measure("feet below the floor", "cm", 2),
}


@dataclass(frozen=True, eq=False)
class Footing:
    """What the feet of a source clip do, from frame ``start`` on, after a T-pose that may come first.

    ``contacts``, and the standing height ``level`` (2, 2) of each point of the feet.
    """

    start: int
    contacts: Contacts
    level: Array

    @classmethod
    def of(cls, motion: Motion, body: Body) -> "Footing":
        """Return the footing of a motion; standing height is the 5th percentile of each point's."""
        start = lead_in(motion)
        motion = motion[start:]
        points = foot_points(motion, body, *world(motion))
        return cls(start, detect(motion, body=body), np.percentile(points @ body.up, 5, axis=0))


def measures(motion: Motion, *, body: Body | None = None, footing: Footing | None = None) -> dict[str, float]:
    """Return every measure of ``MEASURES``; what cannot be measured is not a number.

    Means over the clip: ``head_pitch`` of the face against the floor, 0 where the neutral stance looks,
    so a trunk that bends takes the head with it; ``trunk_flexion`` of the line from hips to shoulders from
    the vertical, ``elbow_flexion`` from straight. ``arm_swing`` is the range (5th to 95th percentile) of the
    angle by which the upper arm points in front of the body or behind it, at most 180 degrees.
    ``foot_slide`` is the mean over contacts, ``foot_sink`` the deepest. ``body`` and ``footing`` are those of
    the source clip when the motion was made from one: then slide and sink are judged where the source's
    feet stood. A T-pose before the motion is left out, but for ``duration``.
    """
    body = body or Body.of(motion)
    footing = footing or Footing.of(motion, body)
    duration, motion = motion.duration, motion[footing.start :]
    rotations, positions = world(motion)
    frame = quaternion.conjugate(heading_rotation(positions, body))
    centimetres = 100.0 * body.metres_per_unit
    way = _travelled(motion, body, positions) * body.metres_per_unit
    slid = slides(motion, footing.contacts, body)
    points = foot_points(motion, body, rotations, positions)
    height = positions[:, body.roles["hips"]] @ body.up - body.floor
    return {
        "head_pitch": _head_pitch(motion, body, rotations, frame),
        "trunk_flexion": _trunk_flexion(body, positions, frame),
        "elbow_flexion": _elbow_flexion(body, positions),
        "arm_swing": _arm_swing(body, positions, frame),
        "hips_height": float(height.mean()) * centimetres,
        "step_length": _step_length(points[:, :, 0], footing.contacts, body) * centimetres,
        "speed": way / motion.duration if motion.duration else NAN,
        "travelled": way,
        "duration": duration,
        "foot_slide": float(slid.mean()) * centimetres if len(slid) else NAN,
        "foot_sink": max(0.0, float((footing.level - points @ body.up).max())) * centimetres,
    }


def _head_pitch(motion: Motion, body: Body, rotations: Array, frame: Array) -> float:
    """Return the mean pitch of the face: 0 as in the neutral stance, positive down."""
    if "head" not in body.roles:
        return NAN
    head = body.roles["head"]
    stance = quaternion.conjugate(neutral_world(motion, body)[0][head])
    turned = quaternion.multiply(frame, quaternion.multiply(rotations[:, head], stance))
    face = quaternion.rotate(turned, body.forward)
    return float(np.degrees(np.arcsin(np.clip(-(face @ body.up), -1.0, 1.0))).mean())


def _trunk_flexion(body: Body, positions: Array, frame: Array) -> float:
    shoulders, hips = (_middle(body, positions, role) for role in ("shoulder", "hip"))
    seen = quaternion.rotate(frame, shoulders - hips)
    return float(np.degrees(np.arctan2(seen @ body.forward, seen @ body.up)).mean())


def _middle(body: Body, positions: Array, role: str) -> Array:
    return 0.5 * (positions[:, body.roles[f"left_{role}"]] + positions[:, body.roles[f"right_{role}"]])


def _elbow_flexion(body: Body, positions: Array) -> float:
    found = []
    for side in SIDES:
        if f"{side}_wrist" not in body.roles:
            continue
        shoulder, elbow, wrist = (
            positions[:, body.roles[f"{side}_{r}"]] for r in ("shoulder", "elbow", "wrist")
        )
        found.append(_angle(elbow - shoulder, wrist - elbow).mean())
    return float(np.mean(found)) if found else NAN


def _angle(a: Array, b: Array) -> Array:
    """Return the angle (T,) between vectors in degrees, exact for parallel ones too."""
    across = np.linalg.norm(np.cross(a, b), axis=-1)
    return np.asarray(np.degrees(np.arctan2(across, np.einsum("ti,ti->t", a, b))))


def _arm_swing(body: Body, positions: Array, frame: Array) -> float:
    """Return the range of the angle between each upper arm and the frontal plane.

    For an arm that swings at the side it is the angle seen from the side; unlike that one it does not turn
    over where the arm points to the side or goes overhead.
    """
    ranges = []
    for side in SIDES:
        arm = positions[:, body.roles[f"{side}_elbow"]] - positions[:, body.roles[f"{side}_shoulder"]]
        ahead = quaternion.rotate(frame, arm) @ body.forward / np.maximum(np.linalg.norm(arm, axis=1), 1e-12)
        angles = np.degrees(np.arcsin(np.clip(ahead, -1.0, 1.0)))
        low, high = np.percentile(angles, (5, 95))
        ranges.append(high - low)
    return float(np.mean(ranges))


def _travelled(motion: Motion, body: Body, positions: Array) -> float:
    """Return the length of the hips' way over the ground, in the clip's unit.

    Taken from one second to the next, so that the sway of a stride and noise do not count as travel.
    """
    count = max(2, round(motion.duration) + 1)
    stops = np.unique(np.linspace(0, len(motion) - 1, count).round().astype(int))
    hips = positions[stops, body.roles["hips"]]
    ground = hips - (hips @ body.up)[:, None] * body.up
    return float(np.linalg.norm(np.diff(ground, axis=0), axis=1).sum())


def _step_length(heels: Array, contacts: Contacts, body: Body) -> float:
    """Return the mean distance over the ground between one foot's place and the other's next.

    Along the line between two places of the same foot, so that the width of the stance does not count;
    not a number where no one walks.
    """
    ground = heels - (heels @ body.up)[..., None] * body.up
    places = sorted(
        (start, foot, ground[start:stop, foot].mean(axis=0))
        for foot in range(2)
        for start, stop in contacts.spans(foot)
    )
    steps = []
    for (_, a, first), (_, b, other), (_, c, last) in zip(places, places[1:], places[2:], strict=False):
        stride = last - first
        length = float(np.linalg.norm(stride))
        if a == c != b and length > 0.2 * body.leg_length:
            steps.append(abs(float((other - first) @ stride)) / length)
    return float(np.mean(steps)) if steps else NAN
