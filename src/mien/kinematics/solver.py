"""Inverse kinematics of a whole clip: turn joints until all constraints are met, smoothly in time.

Damped least squares (Wampler 1986) on every frame at once. With ``J`` the change of all errors ``e`` with the
turns of the joints, each step is ``M J' (J M J' + d^2)^-1 (-e)``; ``M`` says how easily each joint turns. No
``J`` is ever built: joints above two points add ``(r_k . r_l) 1 - r_l r_k'`` to ``J M J'``, ``r`` from joint
to point, whose sums over the joints above are carried down the tree; and a turn is the torque that the
points' forces have about the joint, carried up the tree.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..typing import Array, Integers
from .constraints import ALL, AtPosition, Constraint, Point, SamePosition, of_frames
from .fk import fk_rows

CHUNK = 256  # frames worked on together: their rows stay in the cache
STRIDE = 8  # every so manieth frame is solved first; those between start from what was found there
ITERATIONS = 24
BETTER, PATIENCE = (
    0.995,
    5,
)  # a step helps if it leaves so much; after so many that do not, a frame is given up
DAMPING = 0.02  # of the leg length, or another length of the body's size; more where errors are large
LONGEST_TURN = 0.6  # radians a step
Limit = Callable[[Array, Integers], Array]  # local rotations (J, 4, F) at some frames -> those allowed


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
    -> how easily it turns (1 usual, 0 or left out not at all), ``travel`` how easily the root moves, by
    ``size``.
    ``limit`` returns the nearest allowed rotations of given ones. With ``smoothing`` seconds the change is
    smoothed in time between rounds, and only what is then missing is added. Where targets cannot be reached
    the nearest pose is kept. Bones keep their lengths.
    """
    task = _Task(motion, constraints, size, ease, travel, limit, tolerance)
    start = (np.moveaxis(motion.rotations, 0, -1), motion.translations[:, task.root].T)
    goals = task.goals(start)
    found = task.run(start, goals)
    if smoothing > 0.0:
        for _ in range(2):
            found = task.run(_smoothed(start, found, smoothing / motion.frame_time), goals)
    rotations, root, residual = found[0], found[1], task.residual(found, goals)
    translations = np.array(motion.translations)
    translations[:, task.root] = root.T
    turned = quaternion.continuous(np.ascontiguousarray(np.moveaxis(rotations, -1, 0)))
    return Solved(motion.with_(rotations=turned, translations=translations), residual)


State = tuple[Array, Array]  # local rotations (J, 4, T) and the root's translation (3, T)


def _smoothed(start: State, found: State, frames: float) -> State:
    """Return ``found`` with its difference from ``start`` smoothed over time."""
    before, after = (np.moveaxis(state[0], -1, 0) for state in (start, found))
    change = quaternion.log(quaternion.multiply(quaternion.conjugate(before), after))
    turned = quaternion.multiply(before, quaternion.exp(smooth(change, sigma=frames)))
    moved = start[1] + smooth((found[1] - start[1]).T, sigma=frames).T
    return np.moveaxis(turned, 0, -1), moved


class _Task:
    """What does not change while it is solved: the tree, the points, who moves, what is asked."""

    def __init__(
        self,
        motion: Motion,
        constraints: Sequence[Constraint],
        size: float,
        ease: Mapping[int, float],
        travel: float,
        limit: Limit | None,
        tolerance: float,
    ) -> None:
        self.constraints, self.limit, self.frames = constraints, limit, len(motion)
        self.parents, self.size, self.tolerance = motion.skeleton.parents, size, tolerance * size
        self.points: list[Point] = [p for c in constraints for p in c.points]
        self.spots = np.cumsum([0, *(len(c.points) for c in constraints)])
        self.root = _root(self.parents, [p.joint for p in self.points], ease)
        self.moves = np.zeros(len(self.parents))
        self.moves[list(ease)] = list(ease.values())
        self.travel = travel * size**2
        self.moved = np.ascontiguousarray(np.moveaxis(motion.translations, 0, -1))
        self.lines = [_line(self.parents, p.joint) for p in self.points]
        pairs = [(k, n) for k in range(len(self.points)) for n in range(k, len(self.points))]
        self.pairs = np.array(pairs).T
        # The last joint that both hang on; its parent's sums serve where they share nothing.
        self.shared = np.array([_last_common(self.lines[k], self.lines[n]) for k, n in pairs])
        self.plain = all(isinstance(c, AtPosition) for c in constraints)
        self.used = sorted({j for line in self.lines for j in line})

    def goals(self, start: State) -> list[Array]:
        """Return the error that each constraint may keep (T, m): what of the first is not to vanish."""
        if all(c.share is ALL for c in self.constraints):
            return [np.zeros((1, 1)) for _ in self.constraints]
        frames = np.arange(self.frames)
        errors = self.errors(self.places(start, frames)[0], frames)
        return [(1.0 - c.share)[:, None] * e for c, e in zip(self.constraints, errors, strict=True)]

    def residual(self, state: State, goals: list[Array]) -> Array:
        """Return the largest error left in each frame (T,)."""
        frames = np.arange(self.frames)
        return self.left(self.places(state, frames)[0], frames, goals)[1]

    def run(self, start: State, goals: list[Array]) -> State:
        """Return the state with the constraints met; frames in which they are already stay as they are.

        Every eighth of the others is solved first, and the change carried over to those between.
        """
        rotations, root = np.array(start[0]), np.array(start[1])
        before = self.residual(start, goals)
        wrong = np.flatnonzero(before > self.tolerance)
        if any(isinstance(c, SamePosition) for c in self.constraints):
            self.chunk(rotations, root, wrong, goals)  # its frames depend on each other
            return rotations, root
        keys, rest = wrong[::STRIDE], np.delete(wrong, np.s_[::STRIDE])
        self.chunks(rotations, root, keys, goals)
        if len(keys) > 1:
            _carry(start, rotations, root, keys, rest)
            worse = rest[self.residual((rotations, root), goals)[rest] > before[rest]]
            rotations[..., worse], root[:, worse] = start[0][..., worse], start[1][:, worse]
        self.chunks(rotations, root, rest, goals)
        return rotations, root

    def chunks(self, rotations: Array, root: Array, frames: Integers, goals: list[Array]) -> None:
        """In place: solve some frames, a few hundred at a time."""
        for first in range(0, len(frames), CHUNK):
            self.chunk(rotations, root, frames[first : first + CHUNK], goals)

    def chunk(self, rotations: Array, root: Array, frames: Integers, goals: list[Array]) -> None:
        """In place: solve some frames; those that are done are left out of further steps."""
        every, best = frames, np.full(len(frames), np.inf)
        kept_rotations, kept_root = rotations[..., frames], root[:, frames]
        here = np.arange(len(frames))  # where the frames that are still going stand among all
        idle, caution = np.zeros(len(frames), int), np.ones(len(frames))
        for _ in range(ITERATIONS):
            places, turned, at = self.places((rotations, root), frames)
            errors, worst = self.left(places, frames, goals)
            better = worst < BETTER * best[here]
            idle[here] = np.where(better, 0, idle[here] + 1)
            caution[here] *= np.where(better, 0.5, 4.0)
            best[here[better]] = worst[better]
            kept_rotations[..., here[better]] = rotations[..., frames[better]]
            kept_root[:, here[better]] = root[:, frames[better]]
            going = (worst > self.tolerance) & (idle[here] < PATIENCE)
            if not going.any():
                break
            if not going.all():
                frames, here, errors, worst = frames[going], here[going], errors[going], worst[going]
                places, turned, at = places[..., going], turned[..., going], at[..., going]
            self.step(rotations, root, frames, places, turned, at, errors, worst * caution[here])
        rotations[..., every], root[:, every] = kept_rotations, kept_root

    def places(self, state: State, frames: Integers) -> tuple[Array, Array, Array]:
        """Return the points (K, 3, F), and world rotations (J, 4, F) and places (J, 3, F) of the joints."""
        local, moved = state[0][..., frames], self.moved[..., frames]
        moved[self.root] = state[1][:, frames]
        turned, at = fk_rows(local, moved, self.parents, self.used)
        out = np.empty((len(self.points), 3, len(frames)))
        for k, point in enumerate(self.points):
            arm = point.offset if point.offset.ndim == 1 else point.offset[frames]
            seen = quaternion.rotate(turned[point.joint].T, arm) if arm.any() else 0.0
            out[k] = at[point.joint] + np.transpose(seen)
        return out, turned, at

    def errors(self, places: Array, frames: Integers) -> list[Array]:
        """Return the error of every constraint (F, m)."""
        rows = np.moveaxis(places, -1, 0)
        spots = zip(self.constraints, self.spots[:-1], self.spots[1:], strict=True)
        return [c.error(rows[:, a:b], frames) for c, a, b in spots]

    def left(self, places: Array, frames: Integers, goals: list[Array]) -> tuple[Array, Array]:
        """Return all errors (F, M) less what may stay, and the largest of each frame (F,)."""
        found = [e - of_frames(g, frames) for e, g in zip(self.errors(places, frames), goals, strict=True)]
        worst = [np.sqrt(np.einsum("fm,fm->f", e, e)) for e in found]
        return np.concatenate(found, axis=1), np.max(worst, axis=0)

    def step(
        self,
        rotations: Array,
        root: Array,
        frames: Integers,
        places: Array,
        turned: Array,
        at: Array,
        errors: Array,
        worst: Array,
    ) -> None:
        """In place: one step of damped least squares on some frames."""
        matrix = self.matrix(places, at)
        if not self.plain:
            jacobian = self.jacobian(places, frames)
            matrix = jacobian @ matrix @ np.swapaxes(jacobian, 1, 2)
        damping = (DAMPING * self.size) ** 2 * np.minimum(
            1.0, worst / (0.1 * self.size)
        ) + 1e-6 * self.size**2
        count = errors.shape[1]
        matrix[:, np.arange(count), np.arange(count)] += damping[:, None]
        forces = np.linalg.solve(matrix, -errors[..., None])
        pushes = forces if self.plain else np.swapaxes(jacobian, 1, 2) @ forces
        self.turn(rotations, root, frames, places, turned, at, pushes[..., 0].T.reshape(-1, 3, len(frames)))

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return how all errors change with all points (F, M, 3 K)."""
        rows = np.moveaxis(places, -1, 0)
        found = []
        for c, a, b in zip(self.constraints, self.spots[:-1], self.spots[1:], strict=True):
            own = c.jacobian(rows[:, a:b], frames)
            wide = np.zeros((*own.shape[:2], len(self.points), 3))
            wide[:, :, a:b] = own
            found.append(wide.reshape(len(frames), own.shape[1], -1))
        return np.concatenate(found, axis=1)

    def matrix(self, places: Array, at: Array) -> Array:
        """Return ``J M J'`` for the points (F, 3 K, 3 K)."""
        origin = at[self.root]
        x = places - origin
        zeroth, first, second = self.sums(at - origin)
        (k, n), size = self.pairs, len(self.points)
        weight, middle = zeroth[self.shared][:, None, None], first[self.shared]
        # sum m (x_n - p)(x_k - p)' = x_n (m x_k - sum m p)' - (sum m p) x_k' + sum m p p'
        product = x[n][:, :, None] * (weight * x[k] - middle)[:, None]
        product -= middle[:, :, None] * x[k][:, None]
        product += second[self.shared]
        trace = product[:, 0, 0] + product[:, 1, 1] + product[:, 2, 2] + self.travel
        out = np.empty((size, 3, size, 3, places.shape[-1]))
        np.negative(product, out=product)
        for i in range(3):
            product[:, i, i] += trace
        out[k, :, n] = product
        out[n, :, k] = np.swapaxes(product, 1, 2)
        return np.ascontiguousarray(np.moveaxis(out, -1, 0)).reshape(-1, 3 * size, 3 * size)

    def sums(self, at: Array) -> tuple[Array, Array, Array]:
        """Return the sums of ``m``, ``m p`` and ``m p p'`` over each joint and those above it.

        Shapes (J + 1,), (J + 1, 3, F), (J + 1, 3, 3, F); the last row is the empty sum.
        """
        joints, count = len(self.parents), at.shape[-1]
        zeroth = np.zeros(joints + 1)
        first, second = np.zeros((joints + 1, 3, count)), np.zeros((joints + 1, 3, 3, count))
        for j in self.used:
            above = int(self.parents[j])
            zeroth[j], first[j], second[j] = zeroth[above], first[above], second[above]
            if self.moves[j]:
                own = self.moves[j] * at[j]
                zeroth[j] += self.moves[j]
                first[j] += own
                second[j] += own[:, None] * at[j]
        return zeroth, first, second

    def turn(
        self,
        rotations: Array,
        root: Array,
        frames: Integers,
        places: Array,
        turned: Array,
        at: Array,
        pushes: Array,
    ) -> None:
        """In place: turn each joint by the torque that ``pushes`` (K, 3, F) on the points have about it."""
        joints, origin = len(self.parents), at[self.root]
        force, torque = np.zeros((2, joints, 3, len(frames)))
        for k, point in enumerate(self.points):
            force[point.joint] += pushes[k]
            torque[point.joint] += _cross(places[k] - origin, pushes[k])
        for j in reversed(self.used):
            above = int(self.parents[j])
            if above >= 0:
                force[above] += force[j]
                torque[above] += torque[j]
        movers = [j for j in self.used if self.moves[j]]
        arm = np.moveaxis(at[movers] - origin, 1, 0)
        turn = np.moveaxis(torque[movers], 1, 0) - _cross(arm, np.moveaxis(force[movers], 1, 0))
        self.apply(rotations, frames, movers, self.moves[movers][:, None] * turn, turned)
        if self.travel:
            shift, above = self.travel * force[self.root], int(self.parents[self.root])
            if above >= 0:
                shift = quaternion.rotate(quaternion.conjugate(turned[above].T), shift.T).T
            root[:, frames] += shift
        if self.limit is not None:
            rotations[..., frames] = self.limit(rotations[..., frames], frames)

    def apply(
        self, rotations: Array, frames: Integers, movers: list[int], turn: Array, turned: Array
    ) -> None:
        """In place: turn joints by rotation vectors (3, N, F) in world axes, no further than makes sense."""
        length = np.sqrt(turn[0] ** 2 + turn[1] ** 2 + turn[2] ** 2)
        turn = np.moveaxis(turn * np.minimum(1.0, LONGEST_TURN / np.maximum(length, 1e-300)), 0, -1)
        above = self.parents[movers]
        seen = np.where((above >= 0)[:, None, None], turned[above], quaternion.IDENTITY[:, None])
        inner = quaternion.rotate(quaternion.conjugate(np.moveaxis(seen, 1, -1)), turn)
        local = np.moveaxis(rotations[movers][..., frames], 1, -1)
        new = quaternion.normalise(quaternion.multiply(quaternion.exp(inner), local))
        for joint, found in zip(movers, new, strict=True):
            rotations[joint][:, frames] = found.T


def _carry(start: State, rotations: Array, root: Array, keys: Integers, rest: Integers) -> None:
    """In place: give the frames ``rest`` the change that was found at the ``keys`` around them."""
    later = np.clip(np.searchsorted(keys, rest), 1, len(keys) - 1)
    a, b = keys[later - 1], keys[later]
    share = np.clip((rest - a) / (b - a), 0.0, 1.0)
    before, after = (np.moveaxis(q, 1, -1) for q in (start[0][..., keys], rotations[..., keys]))
    change = quaternion.log(quaternion.multiply(quaternion.conjugate(before), after))
    between = change[:, later - 1] + share[:, None] * (change[:, later] - change[:, later - 1])
    here = np.moveaxis(start[0][..., rest], 1, -1)
    rotations[..., rest] = np.moveaxis(quaternion.multiply(here, quaternion.exp(between)), -1, 1)
    moved = root[:, keys] - start[1][:, keys]
    root[:, rest] += moved[:, later - 1] + share * (moved[:, later] - moved[:, later - 1])


def _cross(a: Array, b: Array) -> Array:
    """Return the cross product of vectors (3, ...)."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _line(parents: Integers, joint: int) -> list[int]:
    """Return the joints from the root down to ``joint``."""
    line = []
    while joint >= 0:
        line.append(joint)
        joint = int(parents[joint])
    return line[::-1]


def _last_common(one: Sequence[int], other: Sequence[int]) -> int:
    common = -1
    for a, b in zip(one, other, strict=False):
        if a != b:
            break
        common = a
    return common


def _root(parents: Integers, joints: Sequence[int], ease: Mapping[int, float]) -> int:
    """Return the topmost joint that may move, or the first that all points hang on."""
    lines = [_line(parents, j) for j in joints]
    shared = [j for j in lines[0] if all(j in line for line in lines)]
    free = [j for j in shared if ease.get(j)]
    return (free or shared or lines[0])[0]
