"""Put the feet back on the floor after an edit.

To the motion: the hips travel so that planted feet do not slide, rise or sink so that they reach the
floor, and the legs are bent so that every planted foot stands exactly as it stood in the original,
moved only by the distance that the edited steps are longer or shorter. To the viewer: nothing, which is
the point.

Contacts come from the original motion (Förger 2011, section 3.5). The thesis moves the hips only,
against the slip of the planted foot; with both feet down that leaves a residue, so leg IK follows
(Kovar et al. 2002). Where the thesis lets the hips keep their velocity in flight, here they keep the
original's flight plus a steady drift: what falls still falls with gravity.
"""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ..errors import MienError
from ..kinematics.body import Body
from ..kinematics.contacts import Contacts, detect_points, foot_points
from ..kinematics.fk import end_positions, world
from ..kinematics.heading import heading_rotation
from ..kinematics.poses import neutral_world
from ..kinematics.two_bone import two_bone
from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import curve_gaps, envelope, hold_gaps, smooth
from ..typing import Array, Mask
from .registry import Param, edit

SIDES = ("left", "right")
UNTOUCHED = 0.003  # leg lengths: a swinging foot nearer than this to its goal is moved only in part
CLEARANCE = 0.7  # the share of the original's swing height that is kept


@dataclass(frozen=True, eq=False)
class _Pose:
    """A motion with its world rotations (T, J, 4), positions (T, J, 3) and foot points (T, 2, 2, 3)."""

    motion: Motion
    rotations: Array
    positions: Array
    feet: Array


@edit(
    kind="repair",
    paper="Förger 2011, section 3.5; Kovar, Schreiner & Gleicher 2002",
    equation="hips(t) = hips(t-1) - mean over planted feet of the change of (foot - hips)",
    deviations="the correction is measured against the original's own slip, so an unedited clip comes back "
    "unchanged; leg IK removes what is left in double support; flight keeps gravity",
)
def foot_plant(
    motion: Motion,
    *,
    original: Motion | None = None,
    travel: Annotated[bool, Param("let longer or shorter steps change the distance travelled")] = True,
    blend: Annotated[float, Param("blends corrections in and out", low=0.02, high=1.0, unit="s")] = 0.25,
) -> Motion:
    """Keep planted feet where they stand, after any edit of the pose.

    ``original`` is the motion before the edits, with the same skeleton and frames; its contacts and its
    foot placements are kept; the history does not hold it, so that only what was planted against the
    motion's own beginning replays. Without it the motion itself is taken, which changes nothing. Bone lengths
    are kept; a target out of reach lowers the hips. Raises ``MienError`` when the frames differ.
    """
    original = original or motion
    if motion.rotations.shape != original.rotations.shape:
        raise MienError(
            f"foot_plant: the original has {len(original)} frames of {len(original.skeleton)} joints, "
            f"the edited motion {len(motion)} of {len(motion.skeleton)}; both must be the same"
        )
    body = Body.of(original)
    before, after = _pose(original, body), _pose(motion, body)
    contacts = detect_points(before.feet, body, motion.frame_time)
    shift = _hips_shift(before, after, contacts, body, travel)
    after = _shifted(after, shift, body)
    goals = [_goal(before, after, contacts, body, foot, blend) for foot in range(2)]
    drop = _drop(before, after, goals, contacts, body)
    after = _shifted(after, -drop[:, None] * body.up, body)
    rotations = np.array(after.motion.rotations)
    for foot, goal in enumerate(goals):
        if goal.met and not drop.any():
            continue
        _bend_leg(rotations, before, after, goal, contacts.feet[:, foot], body, foot)
    return after.motion.with_(rotations=quaternion.continuous(rotations))


def _pose(motion: Motion, body: Body) -> _Pose:
    rotations, positions = world(motion)
    return _Pose(motion, rotations, positions, foot_points(motion, body, rotations, positions))


def _shifted(pose: _Pose, shift: Array, body: Body) -> _Pose:
    """Move the hips, and with them the body, by ``shift`` (T, 3) in world axes."""
    if not shift.any():
        return pose
    hips = body.roles["hips"]
    parent = int(pose.motion.skeleton.parents[hips])
    turned = (
        quaternion.rotate(quaternion.conjugate(pose.rotations[:, parent]), shift) if parent >= 0 else shift
    )
    translations = np.array(pose.motion.translations)
    translations[:, hips] += turned
    positions = np.array(pose.positions)
    positions[:, pose.motion.skeleton.descendants(hips)] += shift[:, None]
    return _Pose(
        pose.motion.with_(translations=translations),
        pose.rotations,
        positions,
        pose.feet + shift[:, None, None],
    )


def _hips_shift(before: _Pose, after: _Pose, contacts: Contacts, body: Body, travel: bool) -> Array:
    """Return how far the hips must move (T, 3): along the ground by the slip, upward to reach the floor."""
    hips, dt = body.roles["hips"], after.motion.frame_time
    own = after.positions[:, hips] - before.positions[:, hips]  # what was done to the hips before
    astray = before.feet - after.feet
    slip = astray + own[:, None, None]  # the same seen from the hips
    if not contacts.points.any() or not np.abs(slip).max() > 1e-9 * body.leg_length:
        return np.zeros((len(slip), 3))
    weight = _settled(contacts, dt)
    total = weight.sum(axis=(1, 2))
    known = total > 0
    share = weight / np.where(known, total, 1.0)[:, None, None]
    rate = (
        np.einsum("tfp,tfpi->ti", share, np.gradient(astray, axis=0)) if len(slip) > 1 else np.zeros((1, 3))
    )
    rate = smooth(hold_gaps(rate, known), sigma=0.04 / dt)
    on_belt = _on_belt(before, weight, body)
    along = np.cumsum(rate, axis=0) - rate[0] if travel and not on_belt else np.zeros_like(rate)
    along -= (along @ body.up)[:, None] * body.up
    needed, seen = (np.einsum("tfp,tfpi->ti", share, way) @ body.up for way in (astray, slip))
    # Hips that were lowered on purpose stay low; hips that were repaired before are not moved twice.
    rise = np.where(needed * seen > 0, np.sign(seen) * np.minimum(np.abs(needed), np.abs(seen)), 0.0)
    return along + smooth(hold_gaps(rise, known), sigma=0.04 / dt)[:, None] * body.up


def _on_belt(before: _Pose, weight: Array, body: Body) -> bool:
    """Say whether the original walks on the spot: planted feet all slide back while the hips stay.

    So it is when planted feet go over the ground at more than 0.1 leg lengths a second on average, seen
    from the body, and more than three times as fast as the hips.
    """
    if len(weight) < 2 or not weight.any():
        return False
    back = quaternion.conjugate(heading_rotation(before.positions, body))
    dt = before.motion.frame_time
    feet = quaternion.rotate(back[:, None, None], np.gradient(before.feet, dt, axis=0))
    hips = quaternion.rotate(back, np.gradient(before.positions[:, body.roles["hips"]], dt, axis=0))
    ground = np.eye(3) - np.outer(body.up, body.up)
    belt = ground @ (np.einsum("tfp,tfpi->i", weight, feet) / weight.sum())
    speed = float(np.linalg.norm(belt))
    return speed > max(0.1 * body.leg_length, 3.0 * float(np.linalg.norm(ground @ hips.mean(axis=0))))


def _settled(contacts: Contacts, frame_time: float) -> Array:
    """Return weights (T, 2, 2): 0 off the floor, growing to 1 within 0.1 s from the ends of a contact."""
    from scipy.ndimage import distance_transform_edt

    out = np.zeros(contacts.points.shape)
    for index in np.ndindex(2, 2):
        mask = contacts.points[(slice(None), *index)]
        inside = distance_transform_edt(mask) if not mask.all() else np.full(len(mask), np.inf)
        out[(slice(None), *index)] = np.clip(inside * frame_time / 0.1, 0, 1)
    return out


@dataclass(frozen=True, eq=False)
class _Goal:
    """Where an ankle must be (T, 3), how its foot must be turned (T, 4), and how much it stands (T,).

    ``met`` says that the edited leg is there already.
    """

    ankle: Array
    turn: Array
    stands: Array
    met: bool


def _goal(before: _Pose, after: _Pose, contacts: Contacts, body: Body, foot: int, blend: float) -> _Goal:
    """Return the path of one ankle: planted as in the original, moved with the step; else the edit's own."""
    ankle, dt = body.roles[f"{SIDES[foot]}_ankle"], after.motion.frame_time
    here, there = after.positions[:, ankle], before.positions[:, ankle]
    planted = contacts.feet[:, foot]
    wrong = there - here
    for start, stop in contacts.spans(foot):
        moved = (here - there)[start:stop].mean(axis=0)
        wrong[start:stop] += moved - (moved @ body.up) * body.up
    astray = quaternion.multiply(before.rotations[:, ankle], quaternion.conjugate(after.rotations[:, ankle]))
    reach = round(blend / dt)
    offset = curve_gaps(wrong, planted, reach=reach)
    turned = curve_gaps(quaternion.log(astray), planted, reach=reach)
    turn = quaternion.multiply(quaternion.exp(turned), after.rotations[:, ankle])
    stands = curve_gaps(planted.astype(float), planted, reach=reach)
    goal = here + offset
    scraping = np.where(planted, 0.0, _sunk(before, after, goal, turn, body, foot, CLEARANCE))
    goal += (envelope(scraping, reach=round(0.12 / dt)) * _clear(planted, dt, 0.06))[:, None] * body.up
    sunk = np.where(planted, 0.0, _sunk(before, after, goal, turn, body, foot, 0.0))
    goal += envelope(sunk, reach=round(0.05 / dt))[:, None] * body.up
    met = np.abs(goal - here).max() <= 1e-9 * body.leg_length and np.abs(turned).max() <= 1e-9
    return _Goal(goal, turn, stands, bool(met))


def _clear(planted: Mask, frame_time: float, seconds: float) -> Array:
    """Return 0 while planted, growing to 1 within some seconds of swing (T,)."""
    from scipy.ndimage import distance_transform_edt

    if not planted.any():
        return np.ones(len(planted))
    share = np.clip(distance_transform_edt(~planted) * frame_time / seconds, 0, 1)
    return np.asarray(share * share * (3 - 2 * share))


def _sunk(
    before: _Pose, after: _Pose, ankle: Array, turn: Array, body: Body, foot: int, clearance: float
) -> Array:
    """Return how far (T,) the foot is below where it must be.

    Looks at the ankle and at every joint and end site below it. Each must keep the share
    ``clearance`` of the height that it has in the original above its own lowest level.
    """
    skeleton = after.motion.skeleton
    root = body.roles[f"{SIDES[foot]}_ankle"]
    below = [j for j in skeleton.descendants(root) if j != root]
    tips = np.flatnonzero(np.isin(skeleton.end_parents, [root, *below]))

    def rigid(pose: _Pose) -> Array:
        ends = end_positions(pose.motion, pose.rotations, pose.positions)[:, tips]
        arms = np.concatenate([pose.positions[:, below], ends], axis=1) - pose.positions[:, [root]]
        return quaternion.rotate(quaternion.conjugate(pose.rotations[:, [root]]), arms)

    start = before.positions[:, [root]]
    points = start + quaternion.rotate(before.rotations[:, [root]], rigid(before))
    lowest = np.concatenate([start, points], axis=1) @ body.up
    reached = ankle[:, None] + quaternion.rotate(turn[:, None], rigid(after))
    height = np.concatenate([ankle[:, None], reached], axis=1) @ body.up
    floor = np.percentile(lowest, 2, axis=0)
    needed = np.minimum(lowest, floor) + clearance * np.maximum(lowest - floor, 0.0)
    return np.maximum((needed - height).max(axis=1), 0.0)


def _drop(before: _Pose, after: _Pose, goals: list[_Goal], contacts: Contacts, body: Body) -> Array:
    """Return how far the hips must come down (T,) for the planted feet to be within reach."""
    dt = after.motion.frame_time
    need = np.zeros(len(after.motion))
    for foot, goal in enumerate(goals):
        hip, knee, ankle = (body.roles[f"{SIDES[foot]}_{r}"] for r in ("hip", "knee", "ankle"))
        length = _bones(after, hip, knee) + _bones(after, knee, ankle)
        line = after.positions[:, hip] - goal.ankle
        source = before.positions[:, hip] - before.positions[:, ankle]
        # A leg that the edit hardly moves may be as straight as it was; the others keep a little bend.
        moved = np.linalg.norm(line - source, axis=1) / (0.02 * body.leg_length)
        straight = np.clip(np.linalg.norm(source, axis=1) / length, 0.995, 1.0)
        reach = length * (0.995 + (straight - 0.995) * np.exp(-(moved**2)))
        up = line @ body.up
        across = np.linalg.norm(line - up[:, None] * body.up, axis=1)
        standing = np.sqrt(np.maximum(reach**2 - across**2, (0.3 * reach) ** 2))
        need = np.maximum(need, np.where(contacts.feet[:, foot], up - standing, 0.0))
    if not (need > 1e-9 * body.leg_length).any():
        return np.zeros_like(need)
    return envelope(need, reach=round(0.12 / dt))


def _bones(pose: _Pose, a: int, b: int) -> Array:
    return np.linalg.norm(pose.positions[:, b] - pose.positions[:, a], axis=1)


def _reachable(before: _Pose, after: _Pose, goal: _Goal, planted: Mask, body: Body, foot: int) -> Array:
    """Return the ankle's goal (T, 3), drawn in softly where a swinging leg would have to over-stretch.

    Up to a stretch of 0.97 (or the edited pose's own) nothing changes; from there it tends to 0.995
    without reaching it. At a contact the softness is gone: planted feet are met exactly.
    """
    hip, knee, ankle = (body.roles[f"{SIDES[foot]}_{r}"] for r in ("hip", "knee", "ankle"))
    length = _bones(after, hip, knee) + _bones(after, knee, ankle)
    own = _bones(after, hip, ankle) / length
    limit = np.clip(own, 0.995, 1.0)
    soft = np.maximum(0.025 * _clear(planted, after.motion.frame_time, 0.1), 1e-9)
    line = goal.ankle - after.positions[:, hip]
    stretch = np.linalg.norm(line, axis=1) / length
    knee_point = np.maximum(limit - soft, np.minimum(own, limit - 1e-9))
    over = np.maximum(stretch - knee_point, 0.0) / (limit - knee_point)
    drawn = np.where(over > 0, knee_point + (limit - knee_point) * -np.expm1(-over), stretch)
    return after.positions[:, hip] + line * np.where(planted, 1.0, drawn / stretch)[:, None]


def _bend_leg(
    rotations: Array, before: _Pose, after: _Pose, goal: _Goal, planted: Mask, body: Body, foot: int
) -> None:
    """In place: bend one leg so that its ankle and foot reach the goal; the toes stand as in the original."""
    hip, knee, ankle = (body.roles[f"{SIDES[foot]}_{r}"] for r in ("hip", "knee", "ankle"))
    world, parents = after.rotations, after.motion.skeleton.parents
    target = _reachable(before, after, goal, planted, body, foot)
    upper, lower = two_bone(
        after.positions[:, hip],
        after.positions[:, knee],
        after.positions[:, ankle],
        target,
        quaternion.rotate(world[:, hip], _hinge(before, body, foot)),
    )
    # A swinging leg that is where it should be is not touched: an over-stretched knee stays as it was.
    away = np.linalg.norm(target - after.positions[:, ankle], axis=1) / (UNTOUCHED * body.leg_length)
    share = np.where(planted, 1.0, np.clip(away, 0.0, 1.0))
    upper, lower = quaternion.power(upper, share), quaternion.power(lower, share)
    turn = quaternion.slerp(world[:, ankle], goal.turn, share)

    def local(parent: int, above: Array, turned: Array) -> Array:
        outer = quaternion.multiply(above, world[:, parent]) if parent >= 0 else above
        return quaternion.multiply(quaternion.conjugate(outer), turned)

    rotations[:, hip] = local(
        int(parents[hip]), quaternion.IDENTITY, quaternion.multiply(upper, world[:, hip])
    )
    rotations[:, knee] = local(int(parents[knee]), upper, quaternion.multiply(lower, world[:, knee]))
    rotations[:, ankle] = local(int(parents[ankle]), lower, turn)
    stands = np.clip(goal.stands, 0.0, 1.0)
    for joint in after.motion.skeleton.descendants(ankle)[1:]:
        rotations[:, joint] = quaternion.slerp(rotations[:, joint], before.motion.rotations[:, joint], stands)


def _hinge(before: _Pose, body: Body, foot: int) -> Array:
    """Return the axis (3,) about which the knee bends, in the thigh's own axes.

    It comes from the frames of the original in which the knee is clearly bent; a leg that never bends
    has the hinge of the neutral stance, square to the walking direction.
    """
    hip, knee, ankle = (body.roles[f"{SIDES[foot]}_{r}"] for r in ("hip", "knee", "ankle"))
    thigh = before.positions[:, hip] - before.positions[:, knee]
    shank = before.positions[:, ankle] - before.positions[:, knee]
    normal: Array = np.cross(thigh, shank)
    lengths = np.linalg.norm(thigh, axis=1) * np.linalg.norm(shank, axis=1)
    size = np.linalg.norm(normal, axis=1) / np.maximum(lengths, 1e-300)
    clear = np.clip((size - 0.25) / 0.25, 0.0, 1.0)
    normal = quaternion.rotate(quaternion.conjugate(before.rotations[:, hip]), normal * clear[:, None])
    standing = quaternion.conjugate(neutral_world(before.motion, body)[0][hip])
    mean = normal.mean(axis=0) + 0.01 * body.leg_length**2 * quaternion.rotate(standing, -body.left)
    return np.asarray(mean / np.linalg.norm(mean))
