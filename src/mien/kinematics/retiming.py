"""A whole body in another time: maps of time, flights that keep gravity, steps that keep their speed.

A rate says for every frame of a motion how many times as fast it is shown.
"""

from itertools import pairwise

import numpy as np

from ..motion import Motion
from ..signal.bridging import curve_gaps, hold_gaps, nearness
from ..typing import Array
from .body import SIDES, Body
from .contacts import Contacts, detect_points
from .dynamics import acceleration
from .fk import end_positions
from .flights import airborne, falling
from .legs import Goal, Placed, put_feet, shifted
from .mass import GRAVITY, mass_model
from .travel import slow_path

LIFT = 0.05  # leg lengths: a flight's height changes by no more than this
AROUND = 0.1  # seconds in which the rate of a flight goes over to that of the steps around it


def frames_at(rates: Array) -> Array:
    """Return the frames of the source, in fractions (M,), that are shown one frame time after the other.

    ``rates`` (T,) at the frames of the source. The time shown up to a frame is the integral of ``1 / rate``.
    It is stretched to whole frames, so that first and last are shown and a loop stays one.
    """
    slow = 1.0 / rates
    shown = np.concatenate([[0.0], np.cumsum(0.5 * (slow[1:] + slow[:-1]))])
    last = max(round(float(shown[-1])), 1)
    return np.interp(np.arange(last + 1), shown * (last / shown[-1]), np.arange(len(rates)))


def of_length(rates: Array) -> Array:
    """Return rates (T,) in the same proportions that show the motion in as many frames as it has."""
    slow = 1.0 / rates
    mean = 0.5 * float((slow[1:] + slow[:-1]).mean())
    return rates * mean


def free_flight(motion: Motion, original: Motion, body: Body, rates: Array) -> tuple[Motion, Array]:
    """Return the motion and rates with which flights, shown at those rates, fall by gravity.

    A flight shown ``r`` times as fast falls by gravity if its height above the line from take-off to landing
    is ``1 / r^2`` times what it was: ``h = g T^2 / 8``. So much of the asked rate is used as changes the
    height by at most 0.05 leg lengths.
    """
    placed = Placed.of(original, body)
    found = flights(placed, body)
    if not found:
        return motion, rates
    centre = mass_model(original, body).centre_of_mass(placed.rotations, placed.positions) @ body.up
    known, wanted, lift = np.zeros(len(rates), bool), np.array(rates), np.zeros(len(rates))
    for start, stop in found:
        frames = slice(max(start - 1, 0), min(stop + 1, len(rates)))
        height = _above_line(centre[frames])
        room = LIFT * body.leg_length / max(float(height.max()), 1e-9)
        asked = float(rates[start:stop].mean())
        rate = np.clip(asked, 1.0 / np.sqrt(1.0 + room), 1.0 / np.sqrt(max(1.0 - room, 1.0 / 16.0)))
        known[start:stop], wanted[start:stop] = True, rate
        lift[frames] = (1.0 / rate**2 - 1.0) * height
    near = nearness(known, reach=AROUND / motion.frame_time)
    eased = rates + near * (hold_gaps(wanted, known) - rates)
    return _moved(motion, body, lift[:, None] * body.up), eased


def flights(placed: Placed, body: Body) -> list[tuple[int, int]]:
    """Return when a body is in free flight, as ``(first frame, frame after the last)``."""
    motion, scale = placed.motion, body.metres_per_unit
    skeleton, below = motion.skeleton, motion.skeleton.descendants(body.roles["hips"])
    tips = np.isin(skeleton.end_parents, below)
    ends = end_positions(motion, placed.rotations, placed.positions)[:, tips] @ body.up
    low = np.concatenate([placed.positions[:, below] @ body.up, ends], axis=1).min(axis=1)
    low = np.minimum(low, (placed.feet @ body.up).min(axis=(1, 2))) - body.floor
    planted = detect_points(placed.feet, body, motion.frame_time).feet
    air = airborne(low, planted, body.leg_length, motion.frame_time, runs=True)
    if not air:
        return []
    centre = mass_model(motion, body).centre_of_mass(placed.rotations, placed.positions) * scale
    held = np.linalg.norm(acceleration(centre, motion.frame_time) + GRAVITY * body.up, axis=1)
    return falling(air, held, GRAVITY)


def _above_line(height: Array) -> Array:
    """Return how far heights (F,) are above the straight line from the first to the last; never below."""
    line = np.linspace(height[0], height[-1], len(height))
    return np.maximum(height - line, 0.0)


def kept_speed(motion: Motion, original: Motion, body: Body, rates: Array) -> Motion:
    """Return the motion with steps ``1 / rate`` times as long, so that shown so it goes as fast as before.

    The hips' way over the ground is scaled, sway and bounce are not. Each planted foot stands where that puts
    the middle of its contact, and in between goes along; the legs follow.
    """
    before = Placed.of(original, body)
    contacts = detect_points(before.feet, body, motion.frame_time)
    path = slow_path(before.positions[:, body.roles["hips"]], body.up, motion.fps)
    share = 1.0 / rates - 1.0
    steps = 0.5 * (share[1:] + share[:-1])[:, None] * np.diff(path, axis=0)
    way = np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
    after = Placed.of(motion, body)
    goals = [_step_goal(after, way, contacts, body, foot) for foot in range(2)]
    return put_feet(before, shifted(after, way, body), goals, contacts.feet, body)


def _step_goal(after: Placed, way: Array, contacts: Contacts, body: Body, foot: int) -> Goal:
    """Return where an ankle must be when the hips go along ``way`` (T, 3) and planted feet do not."""
    ankle = body.roles[f"{SIDES[foot]}_ankle"]
    planted = contacts.feet[:, foot]
    goal = after.positions[:, ankle] + way + _lag(way, contacts.spans(foot))
    return Goal(goal, after.rotations[:, ankle], planted.astype(float), met=False)


def _lag(way: Array, stands: list[tuple[int, int]]) -> Array:
    """Return how far a foot is ahead of where ``way`` (T, 3) takes the body: (T, 3), behind below 0.

    While it stands it waits where the middle of its contact put it; in the air it goes from the one place to
    the next. Beyond its first and last contact it goes on as if another came after a swing like the nearest.
    """
    count = len(way)
    if not stands:
        return np.zeros_like(way)
    swings = [b[0] - a[1] for a, b in pairwise(stands)] or [stands[0][1] - stands[0][0]]
    first, last = max(swings[0], stands[0][0]), max(swings[-1], count - stands[-1][1])
    front, back = first - stands[0][0] + 2, last - (count - stands[-1][1]) + 2
    lag, known = np.zeros((front + count + back, 3)), np.zeros(front + count + back, bool)
    for (start, stop), place in zip(stands, _middles(way, stands), strict=True):
        frames = slice(front + start, front + stop)
        lag[frames], known[frames] = place - way[start:stop], True
    (start, stop), (begin, _) = stands[0], stands[-1]
    if stop - start > 1:
        lag[:2], known[:2] = lag[front + stop - 2 : front + stop], True
    if stands[-1][1] - begin > 1:
        lag[-2:], known[-2:] = lag[front + begin : front + begin + 2], True
    return curve_gaps(lag, known, reach=len(lag))[front : front + count]


def _middles(way: Array, stands: list[tuple[int, int]]) -> list[Array]:
    """Return where ``way`` is in the middle of each contact.

    A contact that the clip's first or last frame cuts short counts as long as whole ones are, on a way that
    goes straight on.
    """
    count = len(way)
    whole = [b - a for a, b in stands if a > 0 and b < count]
    usual = float(np.median(whole)) if whole else 0.0
    out = []
    for start, stop in stands:
        begins = stop - usual if start == 0 and stop < count else start
        ends = start + usual if stop == count and start > 0 else stop
        at = 0.5 * (min(begins, start) + max(ends, stop) - 1.0)
        inside = min(max(at, 0.0), count - 1.0)
        frame = min(int(inside), count - 2)
        out.append(way[frame] + (at - frame) * (way[frame + 1] - way[frame]))
    return out


def _moved(motion: Motion, body: Body, shift: Array) -> Motion:
    """Return the motion with the hips, and so the body, moved by ``shift`` (T, 3) in world axes."""
    return shifted(Placed.of(motion, body), shift, body).motion if shift.any() else motion
