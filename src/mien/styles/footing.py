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
AXES = np.eye(3)[0], np.eye(3)[1]  # the axes of a foot that its direction vectors show
BRIDGE, LIFT = 0.25, 0.05  # seconds in which a correction along, and one off, the ground sets in and ends


@dataclass(frozen=True, eq=False)
class Feet:
    """``ankles`` (T, 2, 3) and their rotations ``turns`` (T, 2, 4) seen in the heading, from below the hips.

    ``over`` (T, 2, 3) and ``turned`` (T, 2, 4) are the same in the world; ``stands`` (T, 2) says whether
    each foot stands on the floor; ``lowest`` (2,) is how low each foot comes.
    """

    ankles: Array
    turns: Array
    over: Array
    turned: Array
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
        turned=rotations[:, joints],
        stands=detect_points(points, body, motion.frame_time).feet,
        lowest=_lowest(motion, rotations, positions, body).min(axis=0),
    )


def with_feet(
    made: Motion, feet: Sequence[Feet], routes: Sequence[Route], way: Route, parts: Shares, body: Body
) -> Motion:
    """Return the motion ``made`` with its feet where the blended feet are, off their legs if need be."""
    turn = way.turn(body)[:, None]
    ankles = way.ground[:, None] + quaternion.rotate(turn, parts.mixed([f.ankles for f in feet], made.fps))
    codes = parts.mixed([directions.encode(f.turns, *AXES) for f in feet], made.fps)
    turns = quaternion.multiply(turn, directions.decode(codes, *AXES, fallback=feet[parts.heaviest].turns))
    stands = np.all([f.stands for f, w in zip(feet, parts.mid, strict=True) if abs(w) >= LIGHT], axis=0)
    reach = round(BRIDGE * made.fps)
    for foot in range(2):
        shift, astray = np.zeros((2, len(made), 3))
        for start, stop in spans(stands[:, foot]):
            span = slice(start, stop), foot
            moved, turned = _standing(feet, routes, way, parts, span, body)
            shift[start:stop] = moved - _from_mean(ankles[span], body.up)
            astray[start:stop] = quaternion.log(
                quaternion.multiply(turned, quaternion.conjugate(turns[span]))
            )
        ankles[:, foot] += curve_gaps(shift, stands[:, foot], reach=reach)
        bridged = quaternion.exp(curve_gaps(astray, stands[:, foot], reach=reach))
        turns[:, foot] = quaternion.multiply(bridged, turns[:, foot])
    return _off_the_floor(made, feet, ankles, turns, parts, body)


def _standing(
    feet: Sequence[Feet],
    routes: Sequence[Route],
    way: Route,
    parts: Shares,
    span: tuple[slice, int],
    body: Body,
) -> tuple[Array, Array]:
    """Return how a foot that stands in every clip goes (n, 3) around its mean, and how it is turned (n, 4).

    It does what the clips' feet do on the ground (they roll, or slide), with the weights of mid:
    ``R(psi) sum_i w_i R(-psi_i) (a_i - mean a_i)``, psi the mean heading of that time; turned likewise.
    """
    frames = span[0]
    moved, codes = 0.0, 0.0
    for weight, f, route in zip(parts.mid, feet, routes, strict=True):
        back = _yaw(-route.heading[frames].mean(), body)
        moved = moved + weight * quaternion.rotate(back, _from_mean(f.over[span], body.up))
        turned = quaternion.multiply(back, f.turned[span])
        codes = codes + weight * directions.encode(turned, *AXES)
    ahead = _yaw(way.heading[frames].mean(), body)
    turned = directions.decode(np.asarray(codes), *AXES, fallback=feet[parts.heaviest].turns[span])
    return quaternion.rotate(ahead, np.asarray(moved)), quaternion.multiply(ahead, turned)


def _off_the_floor(
    made: Motion, feet: Sequence[Feet], ankles: Array, turns: Array, parts: Shares, body: Body
) -> Motion:
    """Return the motion with its feet as given, lifted where they come lower than the blend of the clips."""
    put = _with_ankles(made, ankles, turns, body)
    floor = parts.mid @ np.stack([f.lowest for f in feet])
    sunk = np.maximum(floor - _lowest(put, *world(put), body), 0.0)
    if not sunk.any():
        return put
    lift = np.stack([envelope(under, reach=round(LIFT * made.fps)) for under in sunk.T], axis=1)
    return _with_ankles(made, ankles + lift[..., None] * body.up, turns, body)


def _from_mean(places: Array, up: Array) -> Array:
    """Return places (n, 3) along the ground from their mean, their height as it is."""
    mean = places.mean(axis=0)
    return places - mean + (mean @ up) * up


def _yaw(angle: float, body: Body) -> Array:
    return quaternion.exp(angle * body.up)


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
