"""Inverse kinematics of a whole clip: turn joints until all constraints are met, smoothly in time.

Frames are solved many at a time (``descent``). Every eighth is solved first, and those between start from
what was found around them: quicker, and of all poses that meet the constraints neighbours take similar ones.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import MienError
from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..typing import Array, Integers
from .constraints import Constraint, check
from .descent import descend, look, stand
from .linkage import Linkage
from .task import Limit as Limit  # solve asks for it
from .task import State, Task, held, holds, pulled, put, take, task, with_goals

CHUNK = 512  # frames worked on together, fewer where there are many points
LARGEST = 2**21  # numbers in the matrices of a chunk
STRIDE = 8  # every so manieth frame is solved first
CLOSER = 0.25  # what was found around a frame is its start if it leaves less than so much of |e|^2
SMOOTHINGS = 3  # rounds of solving, with smoothing between them
SETTLINGS = 8  # rounds in which a place is looked for where a point can stay


@dataclass(frozen=True, eq=False)
class Solved:
    """``motion`` with the constraints met; ``residual`` (T,) the largest error left, in the clip's unit."""

    motion: Motion
    residual: Array


def solve(
    motion: Motion,
    constraints: Sequence[Constraint],
    *,
    size: float,
    ease: Mapping[int, float],
    travel: float = 0.0,
    limit: Limit | None = None,
    smoothing: float = 0.0,
    tolerance: float = 1e-3,
) -> Solved:
    """Return the motion with all ``constraints`` met as far as they can be.

    ``size`` is a length of the body's size, such as its legs, in which ``tolerance`` is told. ``ease`` joint
    -> how easily it turns (1 usual, 0 or left out not at all), ``travel`` how easily the body moves in place,
    by ``size``: at the topmost joint with ease that no bone holds, else at the root of the skeleton.
    ``limit`` returns the nearest allowed of given local rotations (J, 4, F) at the frames (F,). With
    ``smoothing`` seconds the change is smoothed in time between rounds, and what is then missing is added.
    Frames in which all is met already stay as they are. Where targets cannot be reached the pose with the
    least sum of squared errors is kept. Bones keep their lengths.

    ``MienError`` if a constraint does not fit the clip, or asks for something that is not a number.
    """
    _require(motion, ease, size=size, travel=travel, smoothing=smoothing, tolerance=tolerance)
    for number, constraint in enumerate(constraints):
        check(constraint, f"constraint {number}", frames=len(motion), joints=len(motion.skeleton))
    if not constraints:
        return Solved(motion, np.zeros(len(motion)))
    asked, start = task(
        motion, constraints, size=size, ease=ease, travel=travel, limit=limit, tolerance=tolerance
    )
    places = _places(asked, start)
    asked = with_goals(asked, places)
    settled, found = held(asked, places), start
    for number in range(SMOOTHINGS if smoothing > 0.0 else 1):
        if number:
            found = _smoothed(asked, start, found, smoothing / motion.frame_time)
        settled, found, residual = _settled(asked, settled, found)
    return Solved(_written(motion, asked.link, found), residual)


def _require(motion: Motion, ease: Mapping[int, float], **numbers: float) -> None:
    """Raise ``MienError`` for options that mean nothing."""
    for name, value in numbers.items():
        if not (np.isfinite(value) and value >= 0.0):
            raise MienError(f"{name} must be 0 or more, got {value}")
        if value == 0.0 and name in ("size", "tolerance"):
            raise MienError(f"{name} must be above 0")
    names = motion.skeleton.names
    for joint, value in ease.items():
        if not 0 <= joint < len(names):
            raise MienError(f"ease names joint {joint}; this skeleton has the joints 0 to {len(names) - 1}")
        if not (np.isfinite(value) and value >= 0.0):
            raise MienError(f"the ease of {names[joint]} must be 0 or more, got {value}")


def _settled(asked: Task, settled: Task, state: State) -> tuple[Task, State, Array]:
    """Return the task with the places found at which points stay, the state, and what is left (T,)."""
    state = _met(settled, state)
    best = settled, state, _seen(settled, state)[1]
    for _ in range(SETTLINGS if holds(asked) else 0):
        moved = pulled(asked, best[0], _places(best[0], best[1]))
        if moved is best[0]:
            break
        state = _met(moved, best[1])
        left = _seen(moved, state)[1]
        if left.max() >= best[2].max():
            break
        best = moved, state, left
    return best


def _met(asked: Task, state: State) -> State:
    """Return the state with the constraints met; frames in which they are already stay as they are."""
    out = (np.array(state[0]), np.array(state[1]))
    cost, worst = _seen(asked, state)
    wrong = np.flatnonzero(worst > asked.tolerance)
    keys, rest = wrong[::STRIDE], np.delete(wrong, np.s_[::STRIDE])
    _descend(asked, out, keys)
    if len(rest) and len(keys) > 1:
        between = _carried(state, out, keys, rest)
        closer = _seen(asked, between, rest)[0] < CLOSER * cost[rest]
        put(out, rest[closer], take(between, closer))
    _descend(asked, out, rest)
    return out


def _descend(asked: Task, state: State, frames: Integers) -> None:
    """In place: solve some frames."""
    for some in _chunks(asked, len(frames)):
        put(state, frames[some], descend(asked, take(state, frames[some]), frames[some]))


def _carried(start: State, found: State, keys: Integers, rest: Integers) -> State:
    """Return the frames ``rest`` with the change that was found at the ``keys`` around them."""
    later = np.clip(np.searchsorted(keys, rest), 1, len(keys) - 1)
    a, b = keys[later - 1], keys[later]
    share = np.clip((rest - a) / (b - a), 0.0, 1.0)
    turned, moved = _change(take(start, keys), take(found, keys))
    turned, moved = (c[later - 1] + share[:, None, None] * (c[later] - c[later - 1]) for c in (turned, moved))
    return _changed(take(start, rest), turned, moved)


def _smoothed(asked: Task, start: State, found: State, frames: float) -> State:
    """Return ``found`` with its difference from ``start`` smoothed over time."""
    turned, moved = (smooth(c, sigma=frames) for c in _change(start, found))
    out = _changed(start, turned, moved)
    if asked.limit is not None:
        out = (asked.limit(out[0], np.arange(len(turned))), out[1])
    still = np.all([np.abs(c).max(axis=(1, 2)) < 1e-12 for c in (turned, moved / asked.size)], axis=0)
    put(out, np.flatnonzero(still), take(start, still))
    return out


def _change(start: State, found: State) -> State:
    """Return the change of rotations as vectors (F, N, 3), and of translations (F, N, 3)."""
    before, after = (np.moveaxis(state[0], -1, 0) for state in (start, found))
    turned = quaternion.log(quaternion.multiply(quaternion.conjugate(before), after))
    return turned, np.moveaxis(found[1] - start[1], -1, 0)


def _changed(start: State, turned: Array, moved: Array) -> State:
    """Return the state with a change made to it."""
    after = quaternion.multiply(np.moveaxis(start[0], -1, 0), quaternion.exp(turned))
    return np.moveaxis(after, 0, -1), start[1] + np.moveaxis(moved, 0, -1)


def _chunks(asked: Task, frames: int) -> Iterator[slice]:
    """Yield parts of a number of frames that are worked on together."""
    step = max(1, min(CHUNK, LARGEST // (3 * len(asked.link.holders)) ** 2))
    yield from (slice(first, first + step) for first in range(0, frames, step))


def _seen(asked: Task, state: State, frames: Integers | None = None) -> tuple[Array, Array]:
    """Return the sum of the squares of all errors and the largest error (F,) of some frames, or of all."""
    every = np.arange(state[0].shape[-1]) if frames is None else frames
    looks = [look(asked, take(state, some), every[some]) for some in _chunks(asked, len(every))]
    return np.concatenate([seen.cost for seen in looks]), np.concatenate([seen.worst for seen in looks])


def _places(asked: Task, state: State) -> Array:
    """Return where the points are (K, 3, T)."""
    every = np.arange(state[0].shape[-1])
    parts = [stand(asked, take(state, some), every[some])[2] for some in _chunks(asked, len(every))]
    return np.concatenate(parts, axis=-1)


def _written(motion: Motion, link: Linkage, state: State) -> Motion:
    """Return the motion with the joints of a linkage as they are in a state."""
    rotations, translations = np.array(motion.rotations), np.array(motion.translations)
    turned, moved = np.flatnonzero(link.ease[:, 0]), np.flatnonzero(link.travel)
    rotations[:, link.joints[turned]] = quaternion.continuous(np.moveaxis(state[0][turned], -1, 0))
    translations[:, link.joints[moved]] = np.moveaxis(state[1][moved], -1, 0)
    return motion.with_(rotations=rotations, translations=translations)
