"""How heavy the parts of a body are, where their mass lies, and so where the body's centre of mass is.

Shares of the body's mass, centres and radii of gyration: P. de Leva, *Adjustments to Zatsiorsky-Seluyanov's
segment inertia parameters*, Journal of Biomechanics 29 (1996), men, measured between joint centres. The
total mass is never needed: forces come out in body weights.

Every segment is rigid and moves with one joint. Its place is told in the neutral stance, so nothing depends
on a skeleton's own axes; of a hand or a foot without a joint the joint above carries the mass.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array, Integers
from .body import SIDES, Body
from .contacts import BEHIND
from .poses import neutral_world

GRAVITY = 9.81  # metres a second squared


@dataclass(frozen=True)
class Part:
    """One segment of the table: the share of the mass, where its centre lies between its ends, and its radii.

    ``centre`` from the upper end, ``across`` (mean of sagittal and transverse) and ``along`` in lengths of
    the segment.
    """

    share: float
    centre: float
    across: float
    along: float


# The trunk's parts are told from the middle of the hip joints up, on the line to the middle of the shoulder
# joints, which is 51.6 cm in the table: the navel lies at 14.6 cm, the end of the sternum at 36.1 cm.
PARTS: Mapping[str, Part] = {
    "head": Part(0.0694, 0.5976, 0.369, 0.312),
    "upper_trunk": Part(0.1596, 0.932, 0.194, 0.218),
    "middle_trunk": Part(0.1633, 0.512, 0.181, 0.196),
    "lower_trunk": Part(0.1117, 0.110, 0.165, 0.166),
    "upper_arm": Part(0.0271, 0.5772, 0.277, 0.158),
    "forearm": Part(0.0162, 0.4574, 0.2705, 0.121),
    "hand": Part(0.0061, 0.3624, 0.2615, 0.184),
    "thigh": Part(0.1416, 0.4095, 0.329, 0.149),
    "shank": Part(0.0433, 0.4395, 0.2485, 0.102),
    "foot": Part(0.0137, 0.4415, 0.251, 0.124),
}
# Lengths of what may have no joint at its end, in leg lengths (the table's, whose legs are 85.6 cm).
HEAD, HEAD_CENTRE, FOREARM, HAND, FOOT = 0.237, 0.096, 0.314, 0.222, 0.301


@dataclass(frozen=True, eq=False)
class MassModel:
    """The segments of one body.

    ``names`` (S). ``shares`` (S) of the body's mass, sum 1. ``joints`` (S) that carry them. ``offsets``
    (S, 3) of their centres from the joint, ``axes`` (S, 3) unit along the segment: in the joint's own axes.
    ``across`` and ``along`` (S): radii of gyration, in the clip's unit.
    """

    names: tuple[str, ...]
    shares: Array
    joints: Integers
    offsets: Array
    axes: Array
    across: Array
    along: Array

    def centres(self, rotations: Array, positions: Array) -> Array:
        """Return the centres of the segments (T, S, 3) from the world transforms of the joints."""
        return positions[:, self.joints] + quaternion.rotate(rotations[:, self.joints], self.offsets)

    def centre_of_mass(self, rotations: Array, positions: Array) -> Array:
        """Return the body's centre of mass (T, 3): ``c = sum share x centre``."""
        return np.einsum("s,tsi->ti", self.shares, self.centres(rotations, positions))


def mass_model(motion: Motion, body: Body) -> MassModel:
    """Return the segments of ``body``, the body of ``motion``."""
    stance, points = neutral_world(motion, body)
    found = [*_trunk(body, points), _head(body, points)]
    for side in SIDES:
        found += [*arm(body, points, side), *_leg(body, points, side)]
    names, joints, starts, ends = zip(*found, strict=True)
    parts = [PARTS[name.removeprefix("left_").removeprefix("right_")] for name in names]
    carriers, start = np.array(joints), np.array(starts)
    line = np.array(ends) - start
    length = np.maximum(np.linalg.norm(line, axis=1), 1e-9 * body.leg_length)
    centre = start + np.array([p.centre for p in parts])[:, None] * line
    inner = quaternion.conjugate(stance[carriers])
    return MassModel(
        names=tuple(names),
        shares=np.array([p.share for p in parts]),
        joints=carriers,
        offsets=quaternion.rotate(inner, centre - points[carriers]),
        axes=quaternion.rotate(inner, line / length[:, None]),
        across=np.array([p.across for p in parts]) * length,
        along=np.array([p.along for p in parts]) * length,
    )


Segment = tuple[str, int, Array, Array]  # name, the joint that carries it, its ends in the neutral stance


def _trunk(body: Body, points: Array) -> list[Segment]:
    """Return the three parts of the trunk, each told on the line from hip joints to shoulder joints."""
    low, high = (
        0.5 * (points[body.roles[f"left_{r}"]] + points[body.roles[f"right_{r}"]])
        for r in ("hip", "shoulder")
    )
    chest = body.spine[-1] if body.spine else body.roles["hips"]
    middle = body.spine[(len(body.spine) - 1) // 2] if body.spine else chest
    carriers = {"lower_trunk": body.roles["hips"], "middle_trunk": middle, "upper_trunk": chest}
    return [(name, joint, low, high) for name, joint in carriers.items()]


def head_carrier(body: Body) -> int:
    """Return the joint that the head moves with: its own, else the next below that there is."""
    above = body.spine[-1] if body.spine else body.roles["hips"]
    return body.roles.get("head", body.roles.get("neck", above))


def _head(body: Body, points: Array) -> Segment:
    """Return the head, from the top down to the jaw; its centre lies a tenth of a leg above the joint."""
    joint = head_carrier(body)
    centre = points[joint] + HEAD_CENTRE * body.leg_length * body.up
    down = -HEAD * body.leg_length * body.up
    top = centre - PARTS["head"].centre * down
    return "head", joint, top, top + down


def arm(body: Body, points: Array, side: str, *, hand: float = HAND) -> list[Segment]:
    """Return upper arm, forearm and a hand of so many leg lengths, from the joints' ``points`` (J, 3).

    Where there is no wrist, the forearm has the table's length and its elbow carries the hand.
    """
    shoulder, elbow = (body.roles[f"{side}_{r}"] for r in ("shoulder", "elbow"))
    wrist = body.roles.get(f"{side}_wrist")
    down = points[elbow] - points[shoulder]
    down = down / max(float(np.linalg.norm(down)), 1e-9 * body.leg_length)
    end = points[wrist] if wrist is not None else points[elbow] + FOREARM * body.leg_length * down
    tip = end + hand * body.leg_length * down
    return [
        (f"{side}_upper_arm", shoulder, points[shoulder], points[elbow]),
        (f"{side}_forearm", elbow, points[elbow], end),
        (f"{side}_hand", elbow if wrist is None else wrist, end, tip),
    ]


def _leg(body: Body, points: Array, side: str) -> list[Segment]:
    hip, knee, ankle = (body.roles[f"{side}_{r}"] for r in ("hip", "knee", "ankle"))
    heel = points[ankle] - body.leg_length * (BEHIND * body.forward + 0.04 * body.up)
    return [
        (f"{side}_thigh", hip, points[hip], points[knee]),
        (f"{side}_shank", knee, points[knee], points[ankle]),
        (f"{side}_foot", ankle, heel, heel + FOOT * body.leg_length * body.forward),
    ]
