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

from typing import Annotated

import numpy as np

from ..errors import MienError
from ..kinematics.body import SIDES, Body
from ..kinematics.contacts import Contacts, detect_points
from ..kinematics.fk import end_positions
from ..kinematics.heading import heading_rotation
from ..kinematics.legs import Goal, Placed, clear_of, put_feet, shifted
from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import curve_gaps, envelope, hold_gaps, smooth
from ..typing import Array
from .registry import Param, edit

CLEARANCE = 0.7  # the share of the original's swing height that is kept


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
    turn: Annotated[
        float, Param("how much of what the edit turned feet out or in stays as they stand", 0.0, 1.0)
    ] = 0.0,
) -> Motion:
    """Keep planted feet where they stand, after any edit of the pose.

    ``original`` is the motion before the edits, with the same skeleton and frames; its contacts and its
    foot placements are kept; the history does not hold it, so that only what was planted against the
    motion's own beginning replays. Without it the motion itself is taken, which changes nothing. With
    ``turn`` each foot stands turned about the vertical by that share of what the edit turned it on average of
    the contact: toes out or in. Bone lengths are kept; a target out of reach lowers the hips. Raises
    ``MienError`` when the frames differ.
    """
    original = original or motion
    if motion.rotations.shape != original.rotations.shape:
        raise MienError(
            f"foot_plant: the original has {len(original)} frames of {len(original.skeleton)} joints, "
            f"the edited motion {len(motion)} of {len(motion.skeleton)}; both must be the same"
        )
    body = Body.of(original)
    before, after = Placed.of(original, body), Placed.of(motion, body)
    contacts = detect_points(before.feet, body, motion.frame_time)
    shift = _hips_shift(before, after, contacts, body, travel)
    after = shifted(after, shift, body)
    goals = [_goal(before, after, contacts, body, foot, blend, turn) for foot in range(2)]
    return put_feet(before, after, goals, contacts.feet, body)


def _hips_shift(before: Placed, after: Placed, contacts: Contacts, body: Body, travel: bool) -> Array:
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


def _on_belt(before: Placed, weight: Array, body: Body) -> bool:
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


def _goal(
    before: Placed, after: Placed, contacts: Contacts, body: Body, foot: int, blend: float, keep: float
) -> Goal:
    """Return the path of one ankle: planted as in the original, moved with the step; else the edit's own.

    ``keep`` is the share of the edit's turns about the vertical that stays.
    """
    ankle, dt = body.roles[f"{SIDES[foot]}_ankle"], after.motion.frame_time
    here, there = after.positions[:, ankle], before.positions[:, ankle]
    planted = contacts.feet[:, foot]
    wrong = there - here
    astray = quaternion.multiply(before.rotations[:, ankle], quaternion.conjugate(after.rotations[:, ankle]))
    for start, stop in contacts.spans(foot):
        moved = (here - there)[start:stop].mean(axis=0)
        wrong[start:stop] += moved - (moved @ body.up) * body.up
        if keep:  # the whole step, as it rolls from heel to toe, turns about one place
            yaw = float((quaternion.log(astray[start:stop]) @ body.up).mean())
            left = quaternion.exp(-keep * yaw * body.up)
            arm = there[start:stop] - there[start:stop].mean(axis=0)
            wrong[start:stop] += quaternion.rotate(left, arm) - arm
            astray[start:stop] = quaternion.multiply(left, astray[start:stop])
    reach = round(blend / dt)
    offset = curve_gaps(wrong, planted, reach=reach)
    turned = curve_gaps(quaternion.log(astray), planted, reach=reach)
    turn = quaternion.multiply(quaternion.exp(turned), after.rotations[:, ankle])
    stands = curve_gaps(planted.astype(float), planted, reach=reach)
    goal = here + offset
    scraping = np.where(planted, 0.0, _sunk(before, after, goal, turn, body, foot, CLEARANCE))
    goal += (envelope(scraping, reach=round(0.12 / dt)) * clear_of(planted, dt, 0.06))[:, None] * body.up
    sunk = np.where(planted, 0.0, _sunk(before, after, goal, turn, body, foot, 0.0))
    goal += envelope(sunk, reach=round(0.05 / dt))[:, None] * body.up
    met = np.abs(goal - here).max() <= 1e-9 * body.leg_length and np.abs(turned).max() <= 1e-9
    return Goal(goal, turn, stands, bool(met))


def _sunk(
    before: Placed, after: Placed, ankle: Array, turn: Array, body: Body, foot: int, clearance: float
) -> Array:
    """Return how far (T,) the foot is below where it must be.

    Looks at the ankle and at every joint and end site below it. Each must keep the share
    ``clearance`` of the height that it has in the original above its own lowest level.
    """
    skeleton = after.motion.skeleton
    root = body.roles[f"{SIDES[foot]}_ankle"]
    below = [j for j in skeleton.descendants(root) if j != root]
    tips = np.flatnonzero(np.isin(skeleton.end_parents, [root, *below]))

    def rigid(pose: Placed) -> Array:
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
