"""How a person moves, whatever they do: how they hold themselves, how far and how fast each limb goes.

What differs between two clips of the same action is their manner, and what differs can be done to any other
clip: Amaya, Bruderlin and Calvert (1996) took speed and spatial amplitude; here posture is measured as well,
amplitude for each limb, and the evenness of movement. Skeletons, units, frame rates and headings may differ.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ..errors import MienError
from ..kinematics.body import ARM, LEG, SIDES, Body
from ..kinematics.fk import world
from ..kinematics.lead_in import still_before
from ..kinematics.poses import Pose, mean_rotation, segment_rotations
from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..typing import Array

# Which segments' turns are the movement of a limb.
LIMBS: Mapping[str, tuple[str, ...]] = {
    "head": ("neck", "head"),
    "torso": ("hips", "trunk"),
    **{f"{side}_arm": tuple(f"{side}_{role}" for role in ARM) for side in SIDES},
    **{f"{side}_leg": tuple(f"{side}_{role}" for role in LEG[:3]) for side in SIDES},
}
SLOWEST, FASTEST = 0.3, 6.0  # Hz: slower is posture, faster is noise
STILL = np.radians(0.5)  # less movement of a limb than this says nothing
ALIKE = 0.9  # cosine from which on two bones point the same way
SAME_SIZE = 0.02  # bodies whose legs differ by less are of one size
MOST_GAIN, MOST_RATE = 4.0, 2.5  # what differs more is another action


@dataclass(frozen=True, eq=False)
class Manner:
    """How someone moves in a clip.

    ``pose`` segment -> mean rotation (4,) against its parent segment; ``hips_height`` over the lower ankle,
    median, in leg lengths; ``swing`` limb -> how far its segments turn about their slow mean, root mean
    square in radians; ``rate`` limb -> how quickly they go to and fro, in radians a second: speed over swing;
    ``sharpness`` limb -> acceleration over speed, in units of the rate: 1 for a sine, more where movement
    jerks. Limbs that keep still have no rate and no sharpness.
    """

    pose: Mapping[str, Array]
    hips_height: float
    swing: Mapping[str, float]
    rate: Mapping[str, float]
    sharpness: Mapping[str, float]

    @classmethod
    def of(cls, motion: Motion, *, body: Body | None = None) -> Self:
        """Return the manner of a motion; a T-pose that comes first is left out.

        Raises ``BodyError`` where no body is found.
        """
        body = body if body is not None else Body.of(motion)
        start = still_before(motion)
        motion = motion[start:] if start else motion
        turned = segment_rotations(motion, body)
        pose = {segment: mean_rotation(q) for segment, q in turned.items()}
        moved = {
            limb: np.concatenate([_turns(turned[s], pose[s], motion.frame_time) for s in segments], axis=-1)
            for limb, segments in ((limb, [s for s in own if s in turned]) for limb, own in LIMBS.items())
            if segments
        }
        quick = {limb: _quickness(way, motion.frame_time) for limb, way in moved.items()}
        return cls(
            pose,
            _hips_height(motion, body),
            {limb: _size(_to_and_fro(way, motion.frame_time)) for limb, way in moved.items()},
            {limb: found[0] for limb, found in quick.items() if found},
            {limb: found[1] for limb, found in quick.items() if found},
        )


@dataclass(frozen=True, eq=False)
class Change:
    """What differs in manner: what to do to one motion to make it move like another.

    ``pose`` turns in degrees, ``hips_height`` and ``hips_forward`` in leg lengths (added); ``swing`` limb ->
    gain, ``rate`` and ``sharpness`` as factors.
    """

    pose: Pose
    hips_height: float
    swing: Mapping[str, float]
    rate: float
    sharpness: float
    hips_forward: float = 0.0

    def __mul__(self, amount: float) -> Self:
        """Return so much of the change: 0 is none, 2 twice as much."""
        return type(self)(
            self.pose * amount,
            self.hips_height * amount,
            {limb: gain**amount for limb, gain in self.swing.items()},
            self.rate**amount,
            self.sharpness**amount,
            self.hips_forward * amount,
        )

    def symmetric(self) -> Self:
        """Return the change with both sides alike: the mean of itself and its mirror image."""
        turns: dict[str, tuple[float, float, float]] = {}
        for segment, (x, y, z) in self.pose.turns.items():
            side, _, role = segment.partition("_")
            if side not in SIDES:
                turns[segment] = (x, 0.0, 0.0)
                continue
            u, v, w = self.pose.turns.get(f"{'right' if side == 'left' else 'left'}_{role}", (x, -y, -z))
            turns[segment] = (0.5 * (x + u), 0.5 * (y - v), 0.5 * (z - w))
        swing = dict(self.swing)
        for limb in ("arm", "leg"):
            sides = [f"{side}_{limb}" for side in SIDES]
            if all(name in swing for name in sides):
                swing |= dict.fromkeys(sides, float(np.sqrt(swing[sides[0]] * swing[sides[1]])))
        return replace(self, pose=Pose(turns), swing=swing)


def change_between(rest: Motion, motion: Motion) -> Change:
    """Return what differs in manner between a neutral clip and another, best of one person and one action.

    Raises ``BodyError`` where no body is found.
    """
    body = Body.of(rest)
    other = Manner.of(motion, body=body_beside(body, rest, motion))
    return difference(Manner.of(rest, body=body), other)


def body_beside(body: Body, rest: Motion, motion: Motion) -> Body:
    """Return the body to measure ``motion`` with beside ``rest``, a neutral clip with ``body``.

    On the same bones it is that of the neutral clip, at the motion's own size: a bowed clip would hide its
    own bow. On others it is the motion's own. Raises ``BodyError`` where no body is found.
    """
    if motion.skeleton is rest.skeleton:
        return body
    own = Body.of(motion)
    if motion.skeleton.names != rest.skeleton.names or own.roles != body.roles:
        return own
    if own.up @ body.up < ALIKE or not _same_directions(rest, motion, body.roles["hips"]):
        return own
    size = own.leg_length / body.leg_length
    if abs(size - 1.0) < SAME_SIZE:
        return body
    return replace(
        body,
        leg_length=own.leg_length,
        height=size * body.height,
        floor=own.floor,
        metres_per_unit=own.metres_per_unit,
    )


def _same_directions(one: Motion, other: Motion, hips: int) -> bool:
    """Return whether the bones below the hips of two skeletons point the same way in their joints.

    The offset of the hips themselves is where a clip begins, and no bone.
    """
    joints = one.skeleton.descendants(hips)[1:]
    a, b = one.skeleton.offsets[joints], other.skeleton.offsets[joints]
    long = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return bool((np.einsum("ji,ji->j", a, b) >= ALIKE * long).all())


def difference(before: Manner, after: Manner) -> Change:
    """Return what differs between two manners (Amaya, Bruderlin & Calvert 1996, generalised).

    What only one of the bodies has is left out. Gains are at most 4 either way, the rate 2.5.
    """
    turns = {}
    for segment in before.pose:
        if segment in after.pose:
            apart = quaternion.multiply(quaternion.conjugate(before.pose[segment]), after.pose[segment])
            x, y, z = np.degrees(quaternion.log(apart))
            # The heading is what the pose is told against.
            turns[segment] = (float(x), 0.0 if segment == "hips" else float(y), float(z))
    swing = {
        limb: _ratio(before.swing[limb], after.swing[limb], STILL, MOST_GAIN)
        for limb in before.swing
        if limb in after.swing
    }
    return Change(
        Pose(turns),
        after.hips_height - before.hips_height,
        swing,
        _mean_ratio(before, after, "rate"),
        _mean_ratio(before, after, "sharpness"),
    )


def mean_change(changes: Iterable[Change]) -> Change:
    """Return the mean of several changes: arithmetic of angles and heights, geometric of factors.

    Raises ``MienError`` where there are none.
    """
    found = list(changes)
    if not found:
        raise MienError("the mean of no changes is not defined; give one or more")
    pose, height, ahead, rate, sharpness = Pose(), 0.0, 0.0, 1.0, 1.0
    swing: dict[str, float] = {}
    for change in found:
        part = change * (1.0 / len(found))
        pose, height = pose + part.pose, height + part.hips_height
        ahead += part.hips_forward
        rate, sharpness = rate * part.rate, sharpness * part.sharpness
        swing = {limb: swing.get(limb, 1.0) * gain for limb, gain in part.swing.items()} | {
            limb: gain for limb, gain in swing.items() if limb not in part.swing
        }
    return Change(pose, height, swing, rate, sharpness, ahead)


def usual_manner(manners: Iterable[Manner]) -> Manner:
    """Return the mean of several manners: mean rotations, geometric means of sizes and rates.

    Segments and limbs that any of them lacks are left out. Raises ``MienError`` where there are none.
    """
    found = list(manners)
    if not found:
        raise MienError("the mean of no manners is not defined; give one or more")
    first = found[0]
    segments = [s for s in first.pose if all(s in other.pose for other in found)]
    qualities = [
        {
            limb: float(np.exp(np.mean([np.log(max(getattr(m, name)[limb], 1e-6)) for m in found])))
            for limb in getattr(first, name)
            if all(limb in getattr(m, name) for m in found)
        }
        for name in ("swing", "rate", "sharpness")
    ]
    pose = {s: mean_rotation(np.array([m.pose[s] for m in found])) for s in segments}
    return Manner(pose, float(np.mean([m.hips_height for m in found])), *qualities)


def _turns(q: Array, mean: Array, frame_time: float) -> Array:
    """Return how a segment turns about its mean (T, 3), in radians, without noise."""
    turns = quaternion.log(quaternion.multiply(quaternion.conjugate(mean), q))
    return smooth(turns, sigma=_sigma(FASTEST) / frame_time)


def _to_and_fro(turns: Array, frame_time: float) -> Array:
    """Return turns (T, K) about their slow mean."""
    moved: Array = turns - smooth(turns, sigma=_sigma(SLOWEST) / frame_time)
    return moved


def _sigma(hertz: float) -> float:
    """Return the seconds of the Gaussian that leaves half of a wave of ``hertz``."""
    return float(np.sqrt(0.5 * np.log(2.0)) / (np.pi * hertz))


def _size(moved: Array) -> float:
    """Return the root mean square of vectors (T, K)."""
    return float(np.sqrt(np.mean((moved**2).sum(axis=-1)))) if len(moved) else 0.0


def _quickness(moved: Array, frame_time: float) -> tuple[float, float] | None:
    """Return the rate and the sharpness of movement (T, K); None where there is none to speak of."""
    if len(moved) < 3:
        return None
    around = moved - moved.mean(axis=0)
    way, fast, hard = (_size(np.diff(around, order, axis=0) / frame_time**order) for order in range(3))
    return (fast / way, hard * way / fast**2) if way > STILL and fast > 0.0 else None


def _hips_height(motion: Motion, body: Body) -> float:
    height = world(motion)[1] @ body.up
    ankles = [body.roles[f"{side}_ankle"] for side in SIDES]
    above = height[:, body.roles["hips"]] - height[:, ankles].min(axis=1)
    return float(np.median(above) / body.leg_length)


def _ratio(before: float, after: float, least: float, most: float) -> float:
    if min(before, after) < least:
        return 1.0
    return float(np.clip(after / before, 1.0 / most, most))


def _mean_ratio(before: Manner, after: Manner, what: str) -> float:
    """Return the geometric mean of a quality's ratio over limbs, by how far each moves in both."""
    old, new = getattr(before, what), getattr(after, what)
    limbs = [limb for limb in old if limb in new]
    if not limbs:
        return 1.0
    logs = [np.log(new[limb] / old[limb]) for limb in limbs]
    weights = [np.sqrt(before.swing[limb] * after.swing[limb]) for limb in limbs]
    return float(np.clip(np.exp(np.average(logs, weights=weights)), 1.0 / MOST_RATE, MOST_RATE))
