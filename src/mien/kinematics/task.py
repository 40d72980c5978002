"""What the solver works on: a clip and its constraints as rows over frames, of the joints that matter."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..motion import Motion
from ..typing import Array, Integers, Mask
from .constraints import ALL, Constraint, Point, SamePosition, require_finite
from .linkage import Linkage, line, linkage

LOOSE = 0.01  # sizes: a joint whose translation leaves its offset further than that is not held by a bone

Rows = tuple[Array, ...]  # over frames
State = Rows  # local rotations (N, 4, F) and translations (N, 3, F) of a linkage's joints
Limit = Callable[[Array, Integers], Array]  # local rotations (J, 4, F) at some frames -> those allowed


@dataclass(frozen=True, eq=False)
class Task:
    """What does not change while it is solved: who moves, what is asked, and when it is done.

    ``arms`` (K, 3, T) or (K, 3, 1) from joint to point in the joint's axes, None if all are zero. ``parts``
    which points each constraint is about, ``goals`` the error of each that may stay (T, m) or (1, m).
    ``size`` a length of the body's size, ``tolerance`` the largest error of a frame that is done. ``limit``
    is about the joints of the linkage.
    """

    link: Linkage
    arms: Array | None
    constraints: Sequence[Constraint]
    parts: Sequence[slice]
    goals: Sequence[Array]
    size: float
    tolerance: float
    limit: Limit | None


def task(
    motion: Motion,
    constraints: Sequence[Constraint],
    *,
    size: float,
    ease: Mapping[int, float],
    travel: float,
    limit: Limit | None,
    tolerance: float,
) -> tuple[Task, State]:
    """Return what is to be solved, with no error that may stay, and the clip as it is."""
    points = [p for c in constraints for p in c.points]
    stops = np.cumsum([len(c.points) for c in constraints])
    parts = [slice(int(stop) - len(c.points), int(stop)) for c, stop in zip(constraints, stops, strict=True)]
    holders = [p.joint for p in points]
    turning, moving = np.zeros((2, len(motion.skeleton)))
    turning[list(ease)] = list(ease.values())
    moving[travellers(motion, holders, ease, size)] = travel
    scale = max(turning.max(), moving.max()) or 1.0  # only how easily they move beside each other matters
    link = linkage(motion.skeleton.parents, holders, turning / scale, moving * (size**2 / scale))
    every = np.moveaxis(motion.rotations, 0, -1)
    start = (every[link.joints], np.moveaxis(motion.translations, 0, -1)[link.joints])
    goals = [np.zeros((1, 1))] * len(constraints)
    allowed = limit and _allowed(limit, link, every)
    return Task(link, _arms(points), constraints, parts, goals, size, tolerance * size, allowed), start


def travellers(motion: Motion, holders: Sequence[int], ease: Mapping[int, float], size: float) -> list[int]:
    """Return, for each tree, the joint at which the body on it moves in place without stretching a bone.

    That is the topmost joint above all ``holders`` of the tree that has ease and that no bone holds, because
    it is the root or moves in the clip; or else the root.
    """
    paths = [line(motion.skeleton.parents, j) for j in holders]
    found = []
    for root in sorted({path[0] for path in paths}):
        own = [path for path in paths if path[0] == root]
        shared = [j for j in own[0] if all(j in path for path in own)]
        free = [j for j in shared if ease.get(j) and (j == root or _loose(motion, j, size))]
        found.append((free or shared)[0])
    return found


def _loose(motion: Motion, joint: int, size: float) -> bool:
    away = motion.translations[:, joint] - motion.skeleton.offsets[joint]
    return bool(np.abs(away).max() > LOOSE * size)


def _arms(points: Sequence[Point]) -> Array | None:
    """Return the offsets of points (K, 3, T) or (K, 3, 1); None if all are zero."""
    offsets = [np.atleast_2d(p.offset).T for p in points]
    if not any(o.any() for o in offsets):
        return None
    frames = max(o.shape[1] for o in offsets)
    return np.stack([np.broadcast_to(o, (3, frames)) for o in offsets])


def _allowed(limit: Limit, link: Linkage, every: Array) -> Limit:
    """Return ``limit`` for the joints of a linkage; of those that do not turn it changes nothing."""
    movers = np.flatnonzero(link.ease[:, 0])

    def allowed(local: Array, frames: Integers) -> Array:
        whole, out = every[..., frames], np.array(local)
        whole[link.joints] = local
        out[movers] = limit(whole, frames)[link.joints[movers]]
        return out

    return allowed


def take(rows: Rows, frames: Integers | Mask | slice) -> Rows:
    """Return some frames of rows over frames."""
    return tuple(row[..., frames] for row in rows)


def put(rows: Rows, frames: Integers, new: Rows) -> None:
    """In place: set some frames of rows over frames."""
    for row, values in zip(rows, new, strict=True):
        row[..., frames] = values


def errors(asked: Task, places: Array, frames: Integers) -> list[Array]:
    """Return the whole error (F, m) of each constraint on the points ``places`` (K, 3, F)."""
    rows = np.moveaxis(places, -1, 0)
    return [c.error(rows[:, part], frames) for c, part in zip(asked.constraints, asked.parts, strict=True)]


def with_goals(asked: Task, places: Array) -> Task:
    """Return the task with what may stay of the errors of the clip as it is, where points are at ``places``.

    ``MienError`` if one is not a number: before any work is done.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        found = errors(asked, places, np.arange(places.shape[-1]))
    for number, (c, error) in enumerate(zip(asked.constraints, found, strict=True)):
        require_finite(error, f"what constraint {number} ({type(c).__name__}) asks for")
    if all(c.share is ALL for c in asked.constraints):
        return asked
    goals = [(1.0 - c.share)[:, None] * e for c, e in zip(asked.constraints, found, strict=True)]
    return replace(asked, goals=goals)


def holds(asked: Task) -> bool:
    """Say whether a point is asked to stay, wherever that is."""
    return any(isinstance(c, SamePosition) and c.place is None for c in asked.constraints)


def held(asked: Task, places: Array) -> Task:
    """Return the task in which points that are to stay somewhere do so in the middle of where they are."""
    fixed = [
        c.held(places[part.start].T) if isinstance(c, SamePosition) else c
        for c, part in zip(asked.constraints, asked.parts, strict=True)
    ]
    return replace(asked, constraints=fixed)


def pulled(asked: Task, found: Task, places: Array) -> Task:
    """Return the task ``found``, which ``held`` made of ``asked``, with better places for points to stay at.

    ``places`` (K, 3, T) are where the points came to. Where none was held away, it is ``found`` itself.
    """
    moved, frames = list(found.constraints), np.arange(places.shape[-1])
    for number, error in enumerate(errors(found, places, frames)):
        before, now = asked.constraints[number], moved[number]
        if isinstance(before, SamePosition) and isinstance(now, SamePosition) and before.place is None:
            away = error - found.goals[number]
            pulling = np.sqrt((away**2).sum(axis=1)) > found.tolerance
            moved[number] = now.pulled(away, pulling) if pulling.any() else now
    same = all(a is b for a, b in zip(moved, found.constraints, strict=True))
    return found if same else replace(found, constraints=moved)
