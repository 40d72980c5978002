"""Where the feet of a blend stand: the blend of where the clips' own feet stand.

Blended rotations do not put the feet quite where the blend of the feet would be, and so planted feet
slide. Here the feet themselves are blended, seen from the hips in the heading of each clip: feet that all
stand make a foot that stands. ``foot_plant`` then bends the legs to them.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..kinematics.body import SIDES, Body
from ..kinematics.contacts import detect_points, foot_points, spans
from ..kinematics.fk import end_positions, world
from ..motion import Motion
from ..rotations import directions, quaternion
from ..signal.bridging import curve_gaps, envelope
from ..typing import Array, Mask
from .route import Route
from .shares import Shares

# A clip with less weight than this does not say when the feet of the blend stand.
LIGHT = 0.02
BRIDGE, LIFT = 0.25, 0.05  # seconds in which a correction along, and one off, the ground sets in and ends


@dataclass(frozen=True, eq=False)
class Feet:
    """``ankles`` (T, 2, 3) and their rotations ``turns`` (T, 2, 4) seen in the heading, from below the hips.

    ``over`` (T, 2, 3) are the ankles in the world; ``stands`` (T, 2) says whether each foot stands on the
    floor; ``lowest`` (2,) is how low each foot comes.
    """

    ankles: Array
    turns: Array
    over: Array
    stands: Mask
    lowest: Array


def feet_of(motion: Motion, spots: tuple[Array, Array], route: Route, body: Body) -> Feet:
    """Return the feet of a motion; ``spots`` are its world rotations and positions."""
    rotations, positions = spots
    joints = [body.roles[f"{side}_ankle"] for side in SIDES]
    back = quaternion.conjugate(route.turn(body))[:, None]
    points = foot_points(motion, body, rotations, positions)
    return Feet(
        ankles=quaternion.rotate(back, positions[:, joints] - route.ground[:, None]),
        turns=quaternion.multiply(back, rotations[:, joints]),
        over=positions[:, joints],
        stands=detect_points(points, body, motion.frame_time).feet,
        lowest=_lowest(motion, rotations, positions, body).min(axis=0),
    )


def with_feet(
    made: Motion, feet: Sequence[Feet], routes: Sequence[Route], way: Route, parts: Shares, body: Body
) -> Motion:
    """Return the motion ``made`` with its feet where the blended feet are, off their legs if need be."""
    turn = way.turn(body)[:, None]
    ankles = way.ground[:, None] + quaternion.rotate(turn, parts.mixed([f.ankles for f in feet], made.fps))
    ankles += _standing(feet, routes, way, ankles, parts, body, reach=round(BRIDGE * made.fps))
    x, y = np.eye(3)[:2]
    codes = parts.mixed([directions.encode(f.turns, x, y) for f in feet], made.fps)
    facing = quaternion.multiply(turn, directions.decode(codes, x, y, fallback=feet[parts.heaviest].turns))
    floor = parts.mid @ np.stack([f.lowest for f in feet])
    sunk = floor - _lowest(put := _with_ankles(made, ankles, facing, body), *world(put), body)
    if (sunk <= 0.0).all():
        return put
    lift = [envelope(np.maximum(under, 0.0), reach=round(LIFT * made.fps)) for under in sunk.T]
    return _with_ankles(made, ankles + np.stack(lift, axis=1)[..., None] * body.up, facing, body)


def _standing(
    feet: Sequence[Feet],
    routes: Sequence[Route],
    way: Route,
    ankles: Array,
    parts: Shares,
    body: Body,
    *,
    reach: int,
) -> Array:
    """Return how far to move the blended ankles (T, 2, 3) along the ground, so that feet that stand do.

    While the foot of every clip stands, the blended foot moves as the clips' feet do over the ground (as
    they roll, or slide): by ``R(psi) sum_i w_i R(-psi_i) (a_i - mean a_i)`` from the mean of where it is.
    """
    stands = np.all([f.stands for f, w in zip(feet, parts.mid, strict=True) if abs(w) >= LIGHT], axis=0)
    shift = np.zeros_like(ankles)
    for foot in range(2):
        for start, stop in spans(stands[:, foot]):
            span = slice(start, stop)
            own = np.zeros((stop - start, 3))
            for weight, f, route in zip(parts.mid, feet, routes, strict=True):
                own += weight * _facing(_from_mean(f.over[span, foot]), -route.heading[span].mean(), body)
            off = _facing(own, way.heading[span].mean(), body) - _from_mean(ankles[span, foot])
            shift[span, foot] = off - (off @ body.up)[:, None] * body.up
        shift[:, foot] = curve_gaps(shift[:, foot], stands[:, foot], reach=reach)
    return shift


def _from_mean(places: Array) -> Array:
    return places - places.mean(axis=0)


def _facing(vectors: Array, angle: float, body: Body) -> Array:
    return quaternion.rotate(quaternion.exp(angle * body.up), vectors)


def _with_ankles(made: Motion, ankles: Array, turns: Array, body: Body) -> Motion:
    """Return the motion with its ankles at places (T, 2, 3), turned (T, 2, 4), in world axes."""
    rotations, positions = world(made)
    local, moved = np.array(made.rotations), np.array(made.translations)
    for foot, side in enumerate(SIDES):
        ankle = body.roles[f"{side}_ankle"]
        parent = int(made.skeleton.parents[ankle])
        back = quaternion.conjugate(rotations[:, parent])
        local[:, ankle] = quaternion.multiply(back, turns[:, foot])
        moved[:, ankle] = quaternion.rotate(back, ankles[:, foot] - positions[:, parent])
    return made.with_(rotations=quaternion.continuous(local), translations=moved, reference=made)


def _lowest(motion: Motion, rotations: Array, positions: Array, body: Body) -> Array:
    """Return the height (T, 2) of the lowest joint or tip of each foot."""
    skeleton, ends = motion.skeleton, end_positions(motion, rotations, positions)
    out = []
    for side in SIDES:
        joints = skeleton.descendants(body.roles[f"{side}_ankle"])
        tips = np.isin(skeleton.end_parents, joints)
        out.append((np.concatenate([positions[:, joints], ends[:, tips]], axis=1) @ body.up).min(axis=1))
    return np.stack(out, axis=1)
