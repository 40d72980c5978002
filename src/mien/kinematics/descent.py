"""Damped least squares on many frames at once: joints turn until points are where constraints ask for them.

With ``J`` the change of all errors ``e`` with the turns, and ``M`` how easily each joint turns, a step is::

    M J' (J M J' + d 1)^-1 (-e),        d = c e'e / 2 + 1e-6 size^2

(Wampler 1986). Damping that follows the square of the errors (Sugihara 2011) is careful far away and beside
targets that nothing reaches, and lets go where a few Newton steps remain; in it, no error counts as more than
a fifth of ``size``. Caution ``c`` halves after a step that helped and grows after one that did not; a step
that leads further away is not taken.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..rotations import quaternion
from ..typing import Array, Integers, Mask
from .constraints import AtPosition, Constraint, of_frames
from .fk import fk_rows
from .linkage import Linkage, response, turns
from .task import Rows, State, Task, errors, put, take

ITERATIONS = 24
FAR = 0.2  # sizes: an error beyond counts as no more, or one hand out of reach would hold back all else
# A step helps if it leaves less than so much of |e|^2; after so many that do not, a frame is given up.
BETTER, PATIENCE = 0.99, 4
LESS, MORE = 0.5, 8.0  # of caution after a step that helped, and after one that did not
DAMPING, LEAST_DAMPING = 0.5, 1e-6  # of |e|^2, of the square size
LONGEST_TURN = 0.6  # radians a step
HELD = 1e-9  # one minus the cosine of half the angle that a limit takes from a turn


class Look(NamedTuple):
    """A state seen from outside.

    ``world`` rotations (N, 4, F) and places ``at`` (N, 3, F) of the joints, ``places`` of the points
    (K, 3, F), ``errors`` (M, F), the sum of their squares ``cost`` (F,), the same with no constraint counted
    as more than ``FAR`` away, ``near`` (F,), and the largest error of a constraint, ``worst`` (F,).
    """

    world: Array
    at: Array
    places: Array
    errors: Array
    cost: Array
    near: Array
    worst: Array


def stand(asked: Task, state: State, frames: Integers) -> tuple[Array, Array, Array]:
    """Return ``world``, ``at`` and ``places`` of a ``Look`` at a state of some frames of the clip."""
    world, at = fk_rows(state[0], state[1], asked.link.above, range(len(asked.link.above)))
    places = at[asked.link.holders]
    if asked.arms is not None:
        arms = asked.arms if asked.arms.shape[-1] == 1 else asked.arms[..., frames]
        turned = np.moveaxis(world[asked.link.holders], 1, -1)
        places += np.moveaxis(quaternion.rotate(turned, np.moveaxis(arms, 1, -1)), -1, 1)
    return world, at, places


def look(asked: Task, state: State, frames: Integers) -> Look:
    """Return where everything is in a state of some frames of the clip, and what is still wrong."""
    world, at, places = stand(asked, state, frames)
    found = [
        _beyond(c, error, of_frames(goal, frames)).T
        for c, error, goal in zip(asked.constraints, errors(asked, places, frames), asked.goals, strict=True)
    ]
    squares = np.stack([np.einsum("mf,mf->f", e, e) for e in found])
    near = np.minimum(squares, (FAR * asked.size) ** 2)
    sums = squares.sum(axis=0), near.sum(axis=0), np.sqrt(squares.max(axis=0))
    return Look(world, at, places, np.concatenate(found), *sums)


def _beyond(constraint: Constraint, error: Array, goal: Array) -> Array:
    """Return the error beyond what may stay; of a bound, anything between that and none may."""
    if constraint.bound:
        goal = np.clip(error, np.minimum(goal, 0.0), np.maximum(goal, 0.0))
    return error - goal


def descend(asked: Task, state: State, frames: Integers) -> State:
    """Return the nearest state found for some frames, from ``state``; what is done takes no further steps."""
    if asked.limit is not None:
        state = (asked.limit(state[0], frames), state[1])
    out, seen = (np.array(state[0]), np.array(state[1])), look(asked, state, frames)
    here: Integers = np.arange(len(frames))  # where the frames that are still going stand among all
    idle, caution = np.zeros(len(frames)), np.ones(len(frames))
    free: Array = np.ones((len(state[0]), len(frames)))
    for _ in range(ITERATIONS):
        going = (seen.worst > asked.tolerance) & (idle < PATIENCE)
        if not going.all():
            put(out, here[~going], take(state, ~going))
            here, idle, caution = here[going], idle[going], caution[going]
            state, seen, free = take(state, going), Look(*take(seen, going)), free[:, going]
        if not len(here):
            break
        tried, free = _step(asked, state, seen, frames[here], caution, free)
        found = look(asked, tried, frames[here])
        nearer = (found.cost < seen.cost) | (found.worst <= asked.tolerance)
        helped = nearer & ((found.cost < BETTER * seen.cost) | (found.near < BETTER * seen.near))
        idle, caution = np.where(helped, 0.0, idle + 1.0), caution * np.where(helped, LESS, MORE)
        state, seen = _chosen(nearer, tried, state), Look(*_chosen(nearer, found, seen))
    put(out, here, state)
    return out


def _chosen(better: Mask, new: Rows, old: Rows) -> Rows:
    """Return the ``new`` rows in the frames in which they are better, and else the old."""
    return new if better.all() else tuple(np.where(better, a, b) for a, b in zip(new, old, strict=True))


def _step(
    asked: Task, state: State, seen: Look, frames: Integers, caution: Array, free: Array
) -> tuple[State, Array]:
    """Return the state after a step of the joints that are ``free``, and which are free in the next.

    What limits take from a step, the other joints make up for in the next, without those that were held.
    """
    link = replace(asked.link, ease=asked.link.ease * free)
    forces = _forces(asked, link, seen, frames, caution)
    turn, shift = turns(link, seen.places, seen.at, forces)
    turned, moved = _turned(link, state[0], seen.world, turn), _moved(link, state[1], seen.world, shift)
    if asked.limit is None:
        return (turned, moved), free
    allowed = asked.limit(turned, frames)
    along = np.abs(np.einsum("nif,nif->nf", turned, allowed))
    return (allowed, moved), (1.0 - along < HELD).astype(float)


def _forces(asked: Task, link: Linkage, seen: Look, frames: Integers, caution: Array) -> Array:
    """Return the forces on the points (K, 3, F) of which a step is the ``M J'``."""
    matrix = response(link, seen.places, seen.at)
    plain = all(isinstance(c, AtPosition) for c in asked.constraints)  # their Jacobian is the identity
    if not plain:
        jacobian = _jacobian(asked, seen, frames)
        matrix = jacobian @ matrix @ np.swapaxes(jacobian, 1, 2)
    count = np.arange(len(seen.errors))
    damping = DAMPING * caution * seen.near + LEAST_DAMPING * asked.size**2
    matrix[:, count, count] += damping[:, None]
    forces = np.linalg.solve(matrix, -seen.errors.T[..., None])
    pushes = forces if plain else np.swapaxes(jacobian, 1, 2) @ forces
    return np.ascontiguousarray(pushes[..., 0].T).reshape(seen.places.shape)


def _jacobian(asked: Task, seen: Look, frames: Integers) -> Array:
    """Return how all errors change with all points (F, M, 3 K); bounds that are kept do not count."""
    rows = np.moveaxis(seen.places, -1, 0)
    out = np.zeros((len(frames), len(seen.errors), len(seen.places), 3))
    first = 0
    for c, part in zip(asked.constraints, asked.parts, strict=True):
        own = c.jacobian(rows[:, part], frames)
        last = first + own.shape[1]
        if c.bound:
            own = own * (seen.errors[first:last].T != 0.0)[..., None, None]
        out[:, first:last, part], first = own, last
    return out.reshape(*out.shape[:2], -1)


def _turned(link: Linkage, local: Array, world: Array, turn: Array) -> Array:
    """Return local rotations turned by vectors (N, 3, F) in world axes, no further than makes sense."""
    movers = np.flatnonzero(link.ease.any(axis=1))
    vectors = _inward(link, world, movers, turn)
    length = np.sqrt(np.einsum("nfi,nfi->nf", vectors, vectors))
    vectors *= np.minimum(1.0, LONGEST_TURN / np.maximum(length, 1e-300))[..., None]
    new = quaternion.multiply(quaternion.exp(vectors), np.moveaxis(local[movers], 1, -1))
    out = np.array(local)
    out[movers] = np.moveaxis(quaternion.normalise(new), -1, 1)
    return out


def _moved(link: Linkage, translations: Array, world: Array, shift: Array) -> Array:
    """Return translations moved by vectors (N, 3, F) in world axes."""
    movers = np.flatnonzero(link.travel)
    if not len(movers):
        return translations
    out = np.array(translations)
    out[movers] += np.moveaxis(_inward(link, world, movers, shift), -1, 1)
    return out


def _inward(link: Linkage, world: Array, joints: Integers, vectors: Array) -> Array:
    """Return vectors (N, 3, F) of some joints in the axes of what each hangs on (n, F, 3)."""
    above = link.above[joints]
    around = np.where((above >= 0)[:, None, None], world[above], quaternion.IDENTITY[:, None])
    back = quaternion.conjugate(np.moveaxis(around, 1, -1))
    return quaternion.rotate(back, np.moveaxis(vectors[joints], 1, -1))
