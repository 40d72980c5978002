"""A jointed mannequin from the roles of a body: tapered limbs, rounded trunk, and a face that shows pitch.

Everything hangs on the neutral stance: a vector given there (forward, up, left, in leg lengths) is
turned with its joint, so that a head bowed through the whole clip is drawn bowed. Fingers are left out:
the hand is a mitten. Left is blue and right is orange.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from ..errors import MienError
from ..kinematics.body import SIDES, Body
from ..kinematics.fk import fk
from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .solids import Solids

# Half widths in leg lengths at the start and end of each limb bone.
THIGH, SHIN, UPPER_ARM, FOREARM = (0.098, 0.062), (0.064, 0.040), (0.058, 0.045), (0.046, 0.032)
SKULL, HAND = (0.094, 0.132, 0.114), (0.022, 0.095, 0.050)  # half axes: left, up or along, forward
SOLE = 0.036  # half thickness of the foot
BASE, DARK, HAIR = 0, 1, 2
SIDE, JOINT = {"left": 3, "right": 4}, {"left": 5, "right": 6}
PALETTE = np.array(
    [
        [222, 203, 172],
        [58, 46, 40],
        [110, 88, 72],
        [66, 140, 206],
        [232, 126, 62],
        [40, 98, 156],
        [178, 84, 34],
    ],
    float,
)


@dataclass(frozen=True, eq=False)
class Soles:
    """The feet as the floor shows them, in leg lengths: one number each for the left and right foot.

    ``depth`` from the ankle straight down to the sole when the foot is flat, ``length`` from the ankle
    forward to the ball of the foot.
    """

    depth: tuple[float, float]
    length: tuple[float, float]

    @classmethod
    def of(cls, motion: Motion, body: Body, positions: Array) -> Self:
        """Measure them: a foot that stands has its sole on ``body.floor``.

        How high the toe joint (or, without one, the ankle) is above the floor differs from skeleton
        to skeleton; the lowest tenth of the frames tells, within what a foot can be.
        """
        standing, depth, length = stance(motion, body)[1], [], []
        for side in SIDES:
            ankle = body.roles[f"{side}_ankle"]
            toe = body.roles.get(f"{side}_toe")
            joint, least, most = (ankle, 0.06, 0.13) if toe is None else (toe, 0.0, 0.05)
            low = (np.quantile(positions[:, joint] @ body.up, 0.1) - body.floor) / body.leg_length
            bone = (standing[joint] - standing[ankle]) / body.leg_length
            drop = -float(bone @ body.up)
            depth.append(float(np.clip(drop + np.clip(low, least, most), 0.04, 0.16)))
            ahead = float(np.linalg.norm(bone + drop * body.up))
            length.append(0.13 if toe is None else float(np.clip(ahead, 0.08, 0.17)))
        return cls((depth[0], depth[1]), (length[0], length[1]))


def stance(motion: Motion, body: Body) -> tuple[Array, Array]:
    """Return world rotations (J, 4) and positions (J, 3) of the neutral stance."""
    rest = np.median(motion.translations, axis=0)
    rotations, positions = fk(body.neutral[None], rest[None], motion.skeleton.parents)
    return rotations[0], positions[0]


def mannequin(motion: Motion, body: Body, rotations: Array, positions: Array, soles: Soles) -> Solids:
    """Return the solids of poses given by world ``rotations (F, J, 4)`` and ``positions (F, J, 3)``.

    ``motion``, ``body`` and ``soles`` tell the neutral stance and the measures; all poses share one shape.
    """
    build = _Builder(motion, body, rotations, positions, soles)
    for side in SIDES:
        _leg(build, side)
        _foot(build, side)
        _arm(build, side)
        _hand(build, side)
    _trunk(build)
    _head(build)
    return build.solids()


class _Builder:
    """Collects solids; knows where each role is and how it is turned from the neutral stance."""

    def __init__(self, motion: Motion, body: Body, rotations: Array, positions: Array, soles: Soles) -> None:
        self.body, self.positions, self.roles, self.soles = body, positions, body.roles, soles
        self.unit = body.leg_length
        turned, self.stance = stance(motion, body)
        self.turns = quaternion.multiply(rotations, quaternion.conjugate(turned))
        self.up, self.forward, self.left = body.up, body.forward, body.left
        self.cones: list[tuple[Array, Array, float, float, int]] = []
        self.ellipsoids: list[tuple[Array, Array, int]] = []

    def at(self, role: str) -> Array:
        """Return where a role's joint is in each pose (F, 3)."""
        return self.positions[:, self.roles[role]]

    def vector(self, left: float, up: float, forward: float) -> Array:
        """Return a vector of the neutral stance, given in leg lengths."""
        return self.unit * (left * self.left + up * self.up + forward * self.forward)

    def turned(self, joint: int, vector: Array) -> Array:
        """Turn a vector of the neutral stance with a joint (F, 3)."""
        return quaternion.rotate(self.turns[:, joint], vector)

    def cone(self, start: Array, end: Array, radii: tuple[float, float], colour: int) -> None:
        """Add a round cone; radii in leg lengths."""
        self.cones.append((start, end, radii[0] * self.unit, radii[1] * self.unit, colour))

    def ball(self, centre: Array, radius: float, colour: int) -> None:
        """Add a sphere; radius in leg lengths."""
        self.cone(centre, centre, (radius, radius), colour)

    def ellipsoid(self, centre: Array, axes: list[Array], half: tuple[float, ...], colour: int) -> None:
        """Add an ellipsoid with unit directions ``axes`` (F, 3) and half axes in leg lengths."""
        columns = np.stack([h * self.unit * a for h, a in zip(half, axes, strict=True)], axis=-1)
        self.ellipsoids.append((centre, columns, colour))

    def solids(self) -> Solids:
        """Return all that was added as arrays."""
        a, b, ra, rb, colours = zip(*self.cones, strict=True)
        centres, axes, more = zip(*self.ellipsoids, strict=True)
        return Solids(
            np.stack(a, axis=1),
            np.stack(b, axis=1),
            np.array(ra),
            np.array(rb),
            np.stack(centres, axis=1),
            np.stack(axes, axis=1),
            np.array([*colours, *more]),
        )


def _leg(build: _Builder, side: str) -> None:
    hip, knee, ankle = (build.at(f"{side}_{role}") for role in ("hip", "knee", "ankle"))
    build.cone(hip, knee, THIGH, SIDE[side])
    build.cone(knee, ankle, SHIN, SIDE[side])
    build.ball(knee, 1.08 * SHIN[0], JOINT[side])


def _foot(build: _Builder, side: str) -> None:
    """Heel to the two sides of the ball, ball to toes: flat, and it shows where the toes point."""
    ankle = build.roles[f"{side}_ankle"]
    toe = build.roles.get(f"{side}_toe", ankle)
    depth, length = (pair[SIDES.index(side)] for pair in (build.soles.depth, build.soles.length))
    along = _foot_direction(build, ankle, toe)
    across, unit = np.cross(build.up, along), build.unit
    start = build.positions[:, ankle]
    low = (SOLE - depth) * build.up
    heel = start + build.turned(ankle, unit * (low - 0.055 * along))
    instep = start + build.turned(ankle, unit * (low + 0.35 * length * along))
    build.cone(start, instep, (0.042, SOLE), SIDE[side])
    for sign in (-1.0, 1.0):
        aside = 0.024 * sign * across
        ball = start + build.turned(ankle, unit * (low + length * along + aside))
        tip = ball + build.turned(toe, unit * ((0.2 - length) * along - 0.012 * build.up - 0.3 * aside))
        build.cone(heel, ball, (SOLE, SOLE), SIDE[side])
        build.cone(ball, tip, (SOLE, 0.024), JOINT[side])


def _foot_direction(build: _Builder, ankle: int, toe: int) -> Array:
    """Return where the toes point in the neutral stance, level."""
    bone = (build.stance[toe] - build.stance[ankle]) / build.unit
    level = bone - (bone @ build.up) * build.up
    return _unit(level) if np.linalg.norm(level) > 0.05 else build.forward


def _arm(build: _Builder, side: str) -> None:
    shoulder, elbow, wrist = build.at(f"{side}_shoulder"), build.at(f"{side}_elbow"), _wrist(build, side)
    build.cone(shoulder, elbow, UPPER_ARM, SIDE[side])
    build.cone(elbow, wrist, FOREARM, SIDE[side])
    build.ball(elbow, 1.08 * FOREARM[0], JOINT[side])
    build.ball(shoulder, 1.12 * UPPER_ARM[0], SIDE[side])


def _wrist(build: _Builder, side: str) -> Array:
    """Return where the wrist is; a skeleton that ends at the elbow gets a forearm as long as the arm."""
    if f"{side}_wrist" in build.roles:
        return build.at(f"{side}_wrist")
    shoulder, elbow = build.roles[f"{side}_shoulder"], build.roles[f"{side}_elbow"]
    upper_arm = build.stance[elbow] - build.stance[shoulder]
    return build.positions[:, elbow] + build.turned(elbow, upper_arm)


def _hand(build: _Builder, side: str) -> None:
    elbow = build.roles[f"{side}_elbow"]
    joint = build.roles.get(f"{side}_wrist", elbow)
    before = elbow if joint != elbow else build.roles[f"{side}_shoulder"]
    along = _unit(build.stance[joint] - build.stance[before])
    wide = _unit(build.forward - (build.forward @ along) * along)
    wrist, unit = _wrist(build, side), build.unit
    axes = [build.turned(joint, v) for v in (np.cross(along, wide), along, wide)]
    build.ellipsoid(wrist + 0.08 * unit * axes[1], axes, HAND, SIDE[side])
    root = wrist + unit * (0.03 * axes[1] + 0.025 * axes[2])
    build.cone(root, root + unit * (0.05 * axes[1] + 0.045 * axes[2]), (0.018, 0.013), JOINT[side])


def _trunk(build: _Builder) -> None:
    """Pelvis, belly and ribs along the bend of the spine, turned from the hips' to the shoulders' line."""
    hips = [build.at(f"{s}_hip") for s in SIDES]
    shoulders = [build.at(f"{s}_shoulder") for s in SIDES]
    middle, top = 0.5 * (hips[0] + hips[1]), _trunk_top(build)
    line = np.stack([middle, *(build.positions[:, j] for j in build.body.spine[1:]), top], axis=1)
    wide = [_unit(hips[0] - hips[1]), _unit(shoulders[0] - shoulders[1])]
    length = _trunk_length(build)
    ribs = float(np.clip(0.43 * _width(build, "shoulder"), 0.13, 0.22))
    pelvis = float(np.clip(0.5 * _width(build, "hip") + 0.075, 0.13, 0.20))
    for share, half in (
        (0.06, (pelvis, 0.12, 0.112)),
        (0.38, (0.44 * (ribs + pelvis), 0.30 * length, 0.104)),
        (0.70, (ribs, 0.35 * length, 0.122)),
    ):
        centre, along = _sample(line, share)
        left = _unit((1 - share) * wide[0] + share * wide[1])
        left = _unit(left - np.einsum("fi,fi->f", left, along)[:, None] * along)
        build.ellipsoid(centre, [left, along, np.cross(left, along)], half, BASE)
    for shoulder in shoulders:
        build.cone(top, shoulder, (0.07, 0.056), BASE)


def _trunk_top(build: _Builder) -> Array:
    """Return the middle between the shoulders: skeletons differ in where their neck begins."""
    return 0.5 * (build.at("left_shoulder") + build.at("right_shoulder"))


def _trunk_length(build: _Builder) -> float:
    """Return how far the middle of the shoulders is from that of the hips in the stance, in leg lengths."""
    hips, shoulders = (
        sum(build.stance[build.roles[f"{side}_{role}"]] for side in SIDES) for role in ("hip", "shoulder")
    )
    return 0.5 * float(np.linalg.norm(shoulders - hips)) / build.unit


def _width(build: _Builder, role: str) -> float:
    left, right = (build.stance[build.roles[f"{s}_{role}"]] for s in SIDES)
    return float(np.linalg.norm(left - right)) / build.unit


def _sample(line: Array, share: float) -> tuple[Array, Array]:
    """Return the point at a share of the way along polylines (F, N, 3), and a smooth direction there."""
    bones = np.linalg.norm(np.diff(line, axis=1), axis=2)
    reach = np.concatenate([np.zeros((len(line), 1)), np.cumsum(bones, axis=1)], axis=1)

    def point(at: float) -> Array:
        goal = np.clip(at, 0.0, 1.0) * reach[:, -1:]
        bone = np.clip((reach[:, 1:] < goal).sum(axis=1), 0, bones.shape[1] - 1)
        rows = np.arange(len(line))
        part = (goal[:, 0] - reach[rows, bone]) / np.maximum(bones[rows, bone], 1e-12)
        return line[rows, bone] + part[:, None] * (line[rows, bone + 1] - line[rows, bone])

    return point(share), _unit(point(share + 0.25) - point(share - 0.25))


def _head(build: _Builder) -> None:
    joint, place = _head_joint(build)
    axes = [build.turned(joint, v) for v in (build.left, build.up, build.forward)]
    lift = _skull_lift(build, joint)

    def point(left: float, up: float, forward: float) -> Array:
        return place + build.turned(joint, build.vector(left, up + lift, forward))

    build.cone(_trunk_top(build), point(0, -0.06, -0.01), (0.062, 0.052), BASE)
    build.ellipsoid(point(0, 0, 0), axes, SKULL, BASE)
    build.ellipsoid(point(0, -0.07, 0.034), axes, (0.06, 0.058, 0.07), BASE)  # jaw
    build.ellipsoid(point(0, 0.024, -0.022), axes, (0.098, 0.121, 0.105), HAIR)
    build.ellipsoid(point(0, 0.018, 0.04), axes, (0.089, 0.034, 0.088), DARK)  # eye band
    build.cone(point(0, -0.022, 0.10), point(0, -0.042, 0.15), (0.024, 0.013), HAIR)  # nose
    for sign, side in ((1.0, "left"), (-1.0, "right")):
        build.ball(point(0.096 * sign, -0.008, -0.005), 0.024, JOINT[side])


def _head_joint(build: _Builder) -> tuple[int, Array]:
    """Return the joint that carries the head, and where the base of the skull is (F, 3)."""
    if "head" in build.roles:
        return build.roles["head"], build.at("head")
    if "neck" in build.roles:
        joint = build.roles["neck"]
    else:
        joint = build.body.spine[-1] if build.body.spine else build.roles["hips"]
    return joint, _trunk_top(build) + build.turned(joint, build.vector(0, 0.13, 0))


def _skull_lift(build: _Builder, joint: int) -> float:
    """Return how far the middle of the skull is above the head joint, in leg lengths."""
    if "head" not in build.roles:
        return 0.1
    feet = min(float(build.stance[build.roles[f"{s}_ankle"]] @ build.up) for s in SIDES)
    above = (build.body.height - float(build.stance[joint] @ build.up) + feet) / build.unit - 0.09
    return float(np.clip(above - SKULL[1], 0.05, 0.13))


def _unit(v: Array) -> Array:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)


def plain_palette(colour: str) -> Array:
    """Return a palette ``(K, 3)`` of shades of one colour, given by name or as ``#rrggbb``."""
    from PIL import ImageColor

    try:
        red, green, blue = ImageColor.getrgb(colour)[:3]
    except ValueError as error:
        raise MienError(f"{colour!r} is not a colour; give a name such as 'teal' or '#2a9d8f'") from error
    shades = np.array([1.0, 0.35, 0.62, 1.0, 1.0, 0.75, 0.75])
    return shades[:, None] * np.array([red, green, blue], float)
