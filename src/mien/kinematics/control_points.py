"""Move pelvis, head and hands by the four rules, and let the body follow, with the feet where they were.

The rules say where the control points are to be (``control_rules``). The spine is bent so that the head lies
where it should, seen from the pelvis; arms go on hanging as they hung and then bend so that each hand gets
where it should; the hips are moved in place, and legs bend so that each foot stays. Bones keep their lengths;
what is out of an arm's reach is approached softly. Each limb is solved by itself and exactly, as elbows and
knees near to straight bend their own way, and in a tenth of the time of the general solver.
"""

from dataclasses import replace
from math import cos, radians, sin

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import envelope
from ..typing import Array, Mask
from .body import SIDES, Body
from .contacts import SOLE, foot_points
from .control_rules import REFERENCES, hand_position, pelvis_height, torso_vector
from .fk import chain
from .heading import heading_rotation
from .landmarks import Landmarks, landmarks
from .legs import Goal, Placed, put_feet, shifted
from .poses import neutral_world
from .two_bone import mean_hinge, softened, two_bone

# The coefficients of the rules, in order: g1, g2, and g3 for both hands.
NAMES: tuple[str, ...] = ("pelvis", "torso", *(f"{side}_{place}" for side in SIDES for place in REFERENCES))
BACK = 10.0  # degrees
SOFT = 0.03  # of an arm's length, before it is straight
STRAIGHT = 0.994  # of a leg's length: as straight as a planted leg gets when the pelvis rises
NECK = 1.75  # times the turn of the top of the spine that the head makes: acted takes have 1.2 to 2.4
BENDS = 6  # rounds in which the spine is bent: each leaves less than a third


def rest_height(motion: Motion, body: Body) -> float:
    """Return how high the pelvis is above the floor in the calm stance, in the clip's unit."""
    place = neutral_world(motion, body)[1]
    ankles = 0.5 * (place[body.roles["left_ankle"]] + place[body.roles["right_ankle"]])
    return float((place[body.roles["hips"]] - ankles) @ body.up) + SOLE * body.leg_length


def rest_torso(motion: Motion, body: Body, positions: Array) -> Array:
    """Return the vectors (T, 3) from pelvis to head that count as upright, in the heading of each frame.

    They are as long as in the calm stance, and ``BACK`` degrees behind the vertical. Captured people stand
    within 3 degrees of the vertical, on either side, and so does a T-pose: measured from there, further bent
    would be backwards as often as forwards.
    """
    still = motion[:1].with_(rotations=body.neutral[None])
    found = landmarks(still, body)
    length = float(np.linalg.norm(found["head"][0] - found["pelvis"][0]))
    torso = length * (cos(radians(BACK)) * body.up - sin(radians(BACK)) * body.forward)
    return quaternion.rotate(heading_rotation(positions, body), torso)


def moved(motion: Motion, body: Body, coefficients: Array, planted: Mask) -> Motion:
    """Return the motion with its control points moved by the rules g1 to g3.

    ``coefficients`` (10,), or (T, 10) for each frame, in the order of ``NAMES``; ``planted`` (T, 2) is when
    each foot stands. Rules with 1 in all frames change nothing.
    """
    values = np.broadcast_to(coefficients, (len(motion), len(NAMES)))
    before = landmarks(motion, body)
    now = motion
    if (values[:, 1] != 1.0).any() and body.spine:
        now = _bent(now, body, before, values[:, 1])
    if (values[:, 2:] != 1.0).any():
        now = _reached(now, body, before if now is motion else landmarks(now, body), values[:, 2:])
    if (values[:, 0] != 1.0).any():
        now = _sunk(motion, now, body, before, values[:, 0], planted)
    return now if now is motion else now.with_(rotations=quaternion.continuous(now.rotations))


def _sunk(motion: Motion, now: Motion, body: Body, before: Landmarks, c: Array, planted: Mask) -> Motion:
    """Return the motion with the pelvis at its height (g1), and both feet where they were.

    What was done to spine and arms moved neither hips nor legs.
    """
    height = before["pelvis"] @ body.up - body.floor
    shift = pelvis_height(height, rest_height(motion, body), c) - height
    feet = foot_points(motion, body, before.rotations, before.positions)
    source = Placed(motion, before.rotations, before.positions, feet)
    shift *= _share_of_rise(source, shift, body, planted)
    pose = shifted(replace(source, motion=now), shift[:, None] * body.up, body)
    goals = []
    for foot, side in enumerate(SIDES):
        ankle = body.roles[f"{side}_ankle"]
        stands = planted[:, foot].astype(float)
        goals.append(Goal(source.positions[:, ankle], source.rotations[:, ankle], stands, met=False))
    return put_feet(source, pose, goals, planted, body)


def _share_of_rise(source: Placed, shift: Array, body: Body, planted: Mask) -> Array:
    """Return the share (T,) of a rise that planted legs allow before they are straight; 1 on the way down."""
    room = np.full(len(shift), np.inf)
    for foot, side in enumerate(SIDES):
        hip, knee, ankle = (source.positions[:, body.roles[f"{side}_{r}"]] for r in ("hip", "knee", "ankle"))
        length = np.linalg.norm(hip - knee, axis=1) + np.linalg.norm(knee - ankle, axis=1)
        up = (hip - ankle) @ body.up
        across = np.linalg.norm(hip - ankle - up[:, None] * body.up, axis=1)
        standing = np.sqrt(np.maximum((STRAIGHT * length) ** 2 - across**2, 0.0))
        room = np.where(planted[:, foot], np.minimum(room, np.maximum(standing - up, 0.0)), room)
    lost = np.maximum(1.0 - room / np.maximum(shift, 1e-9 * body.leg_length), 0.0)
    return 1.0 - envelope(np.where(shift > 0.0, lost, 0.0), reach=round(0.12 / source.motion.frame_time))


def _bent(motion: Motion, body: Body, before: Landmarks, c: Array) -> Motion:
    """Return the motion with the spine bent so that the head is where g2 wants it, seen from the pelvis.

    The turn is shared evenly by the joints of the spine, and the neck bends on, as people's does. Only the
    direction can be met, as the spine has the length it has. Arms go on hanging as they did.
    """
    head, pelvis = before["head"], before["pelvis"]
    wanted = torso_vector(head - pelvis, rest_torso(motion, body, before.positions), c)
    necks = body.neck or tuple(body.roles[role] for role in ("head",) if role in body.roles)
    joints = np.array([*body.spine, *necks])
    ramp = [np.arange(1, len(body.spine) + 1) / len(body.spine)]
    ramp += [1.0 + (NECK - 1.0) * np.arange(1, len(necks) + 1) / max(len(necks), 1)]
    shares = np.concatenate(ramp)
    knots = np.concatenate([pelvis[:, None], before.positions[:, joints], head[:, None]], axis=1)
    turn = _spine_turn(np.diff(knots, axis=1), wanted, np.concatenate([[0.0], shares]))
    rotations = np.array(motion.rotations)
    for joint, own in zip(joints, np.diff(shares, prepend=0.0), strict=True):
        above = before.rotations[:, motion.skeleton.parents[joint]]
        added = quaternion.exp(turn * own)
        inner = quaternion.multiply(quaternion.multiply(quaternion.conjugate(above), added), above)
        rotations[:, joint] = quaternion.multiply(inner, rotations[:, joint])
    return _hanging(motion.with_(rotations=rotations), body, before)


def _spine_turn(parts: Array, wanted: Array, shares: Array) -> Array:
    """Return the rotation vectors (T, 3) of the top of a spine whose head then lies along ``wanted``.

    ``parts`` (T, N + 1, 3) leads from the pelvis over its N joints to the head; what is above joint i
    turns by ``shares`` (N + 1,) of it.
    """
    turn = np.zeros_like(wanted)
    for _ in range(BENDS):
        turned = quaternion.rotate(quaternion.exp(turn[:, None] * shares[:, None]), parts)
        turn = turn + 1.2 * quaternion.log(quaternion.between(turned.sum(axis=1), wanted))
    return turn


def _hanging(motion: Motion, body: Body, before: Landmarks) -> Motion:
    """Return the motion with both upper arms turned in the world as they were before the spine was bent."""
    shoulders = [body.roles[f"{side}_shoulder"] for side in SIDES]
    parents = motion.skeleton.parents[shoulders].tolist()
    joints, turned, _ = chain(motion, parents)
    rotations = np.array(motion.rotations)
    for joint, parent in zip(shoulders, parents, strict=True):
        above = turned[:, joints.index(parent)]
        rotations[:, joint] = quaternion.multiply(quaternion.conjugate(above), before.rotations[:, joint])
    return motion.with_(rotations=rotations)


def _reached(motion: Motion, body: Body, now: Landmarks, c: Array) -> Motion:
    """Return the motion with both hands where g3 wants them, seen from where the trunk is ``now``."""
    rotations = np.array(motion.rotations)
    for i, side in enumerate(SIDES):
        own = c[:, 4 * i : 4 * i + 4]
        if (own != 1.0).any():
            hand = now[f"{side}_hand"]
            ground = hand - (hand @ body.up - body.floor)[:, None] * body.up
            places = np.stack([now["head"], now["chest"], now["pelvis"], ground], axis=1)
            _bend_arm(rotations, motion, body, now, hand_position(hand, places, own), side)
    return motion.with_(rotations=rotations)


def _bend_arm(rotations: Array, motion: Motion, body: Body, now: Landmarks, target: Array, side: str) -> None:
    """In place: turn shoulder and elbow so that the hand is at ``target`` (T, 3), softly within reach."""
    shoulder, elbow = (body.roles[f"{side}_{role}"] for role in ("shoulder", "elbow"))
    root, middle, tip = now.positions[:, shoulder], now.positions[:, elbow], now[f"{side}_hand"]
    turned, parents = now.rotations, motion.skeleton.parents
    standing = quaternion.conjugate(neutral_world(motion, body)[0][shoulder])
    usual = 0.01 * body.leg_length**2 * quaternion.rotate(standing, body.left)
    hinge = mean_hinge(root - middle, tip - middle, turned[:, shoulder], usual)
    goal = _within_reach(root, middle, tip, target)
    upper, lower = two_bone(root, middle, tip, goal, quaternion.rotate(turned[:, shoulder], hinge))
    for joint, above, turn in ((shoulder, quaternion.IDENTITY, upper), (elbow, upper, lower)):
        outer = quaternion.multiply(above, turned[:, parents[joint]])
        rotations[:, joint] = quaternion.multiply(
            quaternion.conjugate(outer), quaternion.multiply(turn, turned[:, joint])
        )


def _within_reach(root: Array, middle: Array, tip: Array, target: Array) -> Array:
    """Return the targets (T, 3), drawn in softly where the arm would be straighter than arms get."""
    length = np.linalg.norm(middle - root, axis=1) + np.linalg.norm(tip - middle, axis=1)
    own = np.linalg.norm(tip - root, axis=1) / length
    limit = np.clip(own, 0.995, 1.0)
    line = target - root
    stretch = np.maximum(np.linalg.norm(line, axis=1) / length, 1e-9)
    drawn = softened(stretch, np.maximum(limit - SOFT, np.minimum(own, limit - 1e-9)), limit)
    return root + line * (drawn / stretch)[:, None]
