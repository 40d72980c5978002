"""The body's volume as capsules (round rods), and how deep its parts are inside each other.

Radii come from the mean girths of 252 men 1.78 m tall (Johnson 1996, *Fitting percentage of body fat to
simple body measurements*, Journal of Statistics Education 4), as ``girth / 2 pi``; the trunk is two rods side
by side that together have the girth of chest or abdomen. They grow with the body's height; lengths are the
skeleton's own.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array, Integers
from .body import SIDES, Body
from .mass import HAND, arm, head_carrier
from .poses import neutral_world

STATURE = 1.78
# Metres at that height. Girths: chest 100.8, abdomen 92.6, thigh 59.4, knee 38.6, ankle 23.1, upper arm 32.3,
# forearm 28.7, wrist 18.2 cm. A limb's rod has the mean of its ends; a thigh's is thinner, as it is soft.
RADII: Mapping[str, float] = {
    "head": 0.085,
    "chest": 0.115,
    "belly": 0.11,
    "upper_arm": 0.048,
    "forearm": 0.037,
    "hand": 0.03,
    "thigh": 0.07,
    "shank": 0.047,
    "foot": 0.035,
}
APART = 0.045  # metres from the middle to each of the trunk's rods: their girth is 2 pi r + 4 times this
FIST = 0.6  # of the hand's length that is not fingers

# What must not meet, by kind. Parts that touch where they join, or lie against each other in a body at rest
# (upper arm and trunk, both thighs, a folded arm), are not looked at.
MEETINGS: Mapping[str, tuple[str, ...]] = {
    "hand": ("head", "chest", "belly", "thigh", "shank", "upper_arm", "forearm", "hand"),
    "forearm": ("head", "chest", "belly", "thigh", "shank", "upper_arm", "forearm"),
    "upper_arm": ("head", "upper_arm"),
    "shank": ("thigh", "shank", "foot"),
    "foot": ("thigh", "foot"),
}
LIMBS = {"hand": "arm", "forearm": "arm", "upper_arm": "arm", "thigh": "leg", "shank": "leg", "foot": "leg"}


@dataclass(frozen=True, eq=False)
class Capsules:
    """The capsules of one body, lengths in the clip's unit.

    ``names`` (C); ``joints`` (C) that carry them; ``ends`` (C, 2, 3) of the rod's line in the joint's own
    axes; ``radii`` (C); ``pairs`` (P, 2) of capsules that must not meet.
    """

    names: tuple[str, ...]
    joints: Integers
    ends: Array
    radii: Array
    pairs: Integers

    def lines(self, rotations: Array, positions: Array) -> Array:
        """Return the ends of the rods' lines (T, C, 2, 3) in world axes."""
        turned = quaternion.rotate(rotations[:, self.joints, None], self.ends)
        return positions[:, self.joints, None] + turned

    def contacts(self, rotations: Array, positions: Array) -> "Contact":
        """Return where each pair is nearest, and how deep they are inside each other."""
        lines = self.lines(rotations, positions)
        one, other = (lines[:, self.pairs[:, k]] for k in range(2))
        s, t = nearest(one, other)
        gap = _at(one, s) - _at(other, t)
        apart = np.sqrt(np.einsum("tpi,tpi->tp", gap, gap))
        reach = self.radii[self.pairs].sum(axis=1)
        return Contact(reach - apart, np.stack([s, t], axis=-1), gap, apart)

    def pair_names(self) -> tuple[str, ...]:
        """Return the pairs in words, such as ``left_hand-right_chest`` (P)."""
        return tuple(f"{self.names[a]}-{self.names[b]}" for a, b in self.pairs.tolist())


@dataclass(frozen=True, eq=False)
class Contact:
    """Where the capsules of each pair are nearest.

    ``depth`` (T, P) of each pair, negative when apart; ``at`` (T, P, 2) where along each line (0 to 1) they
    are nearest; ``gap`` (T, P, 3) from the second line to the first there, ``apart`` (T, P) its length.
    """

    depth: Array
    at: Array
    gap: Array
    apart: Array


def capsules(motion: Motion, body: Body) -> Capsules:
    """Return the capsules of ``body``, the body of ``motion``."""
    stance, points = neutral_world(motion, body)
    size = body.height / STATURE
    found = [*_trunk(body, points, size), _head(body, points, size)]
    for side in SIDES:
        found += [*arm(body, points, side, hand=FIST * HAND), *_leg(body, points, side)]
    names, joints, starts, stops = zip(*found, strict=True)
    carriers = np.array(joints)
    ends = np.stack([np.array(starts), np.array(stops)], axis=1) - points[carriers, None]
    kinds = [name.split("_", 1)[1] if name != "head" else name for name in names]
    radii = size * np.array([RADII[kind] for kind in kinds])
    ends = quaternion.rotate(quaternion.conjugate(stance[carriers])[:, None], ends)
    return Capsules(tuple(names), carriers, ends, radii, _pairs(names))


Rod = tuple[str, int, Array, Array]  # name, the joint that carries it, its line's ends in the neutral stance


def _trunk(body: Body, points: Array, size: float) -> list[Rod]:
    """Return two rods side by side for the belly, carried by the hips, and two for the chest."""
    low, high = (
        0.5 * (points[body.roles[f"left_{r}"]] + points[body.roles[f"right_{r}"]])
        for r in ("hip", "shoulder")
    )
    chest = body.spine[-1] if body.spine else body.roles["hips"]
    waist, top = low + 0.5 * (high - low), low + 0.85 * (high - low)
    out = []
    for side, sign in zip(SIDES, (1.0, -1.0), strict=True):
        aside = sign * APART * size * body.left
        out += [
            (f"{side}_belly", body.roles["hips"], low + aside, waist + aside),
            (f"{side}_chest", chest, waist + aside, top + aside),
        ]
    return out


def _head(body: Body, points: Array, size: float) -> Rod:
    joint = head_carrier(body)
    chin = points[joint] + size * (0.04 * body.up + 0.02 * body.forward)
    return "head", joint, chin, chin + size * 0.07 * body.up


def _leg(body: Body, points: Array, side: str) -> list[Rod]:
    hip, knee, ankle = (body.roles[f"{side}_{r}"] for r in ("hip", "knee", "ankle"))
    heel = points[ankle] - body.leg_length * 0.04 * body.up
    return [
        (f"{side}_thigh", hip, points[hip], points[knee]),
        (f"{side}_shank", knee, points[knee], points[ankle]),
        (f"{side}_foot", ankle, heel, heel + 0.2 * body.leg_length * body.forward),
    ]


def _kind(name: str) -> str:
    return name.removeprefix("left_").removeprefix("right_")


def _pairs(names: tuple[str, ...]) -> Integers:
    """Return the pairs (P, 2) of ``MEETINGS``, none of two parts of one limb; the limb's end stands first."""
    rank = list(MEETINGS)
    found = []
    for one, other in combinations(range(len(names)), 2):
        kinds = _kind(names[one]), _kind(names[other])
        same = names[one].split("_")[0] == names[other].split("_")[0]
        if same and LIMBS.get(kinds[0]) == LIMBS.get(kinds[1]) is not None:
            continue
        for a, b in ((one, other), (other, one)):
            if _kind(names[b]) in MEETINGS.get(_kind(names[a]), ()):
                found.append((rank.index(_kind(names[a])), a, b))
                break
    return np.array([(a, b) for _, a, b in sorted(found)])


def _at(lines: Array, share: Array) -> Array:
    return lines[..., 0, :] + share[..., None] * (lines[..., 1, :] - lines[..., 0, :])


def nearest(one: Array, other: Array) -> tuple[Array, Array]:
    """Return where two line segments ``(..., 2, 3)`` are nearest, as shares (0 to 1) of each: closed form.

    C. Ericson, *Real-time collision detection* (2005), section 5.1.9; a segment without length is a point.
    """
    d, e = one[..., 1, :] - one[..., 0, :], other[..., 1, :] - other[..., 0, :]
    r = one[..., 0, :] - other[..., 0, :]
    dd, ee, de = _dot(d, d), _dot(e, e), _dot(d, e)
    dr, er = _dot(d, r), _dot(e, r)
    point = ee < 1e-24
    dd, ee = np.maximum(dd, 1e-300), np.maximum(ee, 1e-300)
    across = dd * ee - de * de  # zero where the lines are parallel: any s will do, t and the ends decide
    s = np.clip((de * er - dr * ee) / np.maximum(across, 1e-300), 0, 1)
    s = np.where(across > 1e-12 * dd * ee, s, 0)
    t = np.where(point, -1.0, (de * s + er) / ee)
    s = np.where(t < 0, np.clip(-dr / dd, 0, 1), np.where(t > 1, np.clip((de - dr) / dd, 0, 1), s))
    return s, np.clip(t, 0, 1)


def _dot(u: Array, v: Array) -> Array:
    return np.asarray(np.einsum("...i,...i->...", u, v))
