"""Damped least squares on many frames, against the same step worked out with a Jacobian of all joints."""

import numpy as np
import pytest

from mien.kinematics.constraints import AtDistance, AtPosition, InRegion, Orientation, Point
from mien.kinematics.descent import DAMPING, ITERATIONS, LEAST_DAMPING, PATIENCE, descend, look
from mien.kinematics.fk import fk
from mien.kinematics.task import State, Task, task
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion as quat

PARENTS = np.array([-1, 0, 1, 2, 1, 4, 5])
FRAMES = 5
EASE = {0: 0.5, 1: 1.0, 2: 2.0, 4: 1.0, 5: 0.25}


def pose(seed: int = 0, frames: int = FRAMES) -> Motion:
    rng = np.random.default_rng(seed)
    skeleton = Skeleton(tuple("abcdefg"), PARENTS, rng.normal(size=(7, 3)))
    rotations = quat.exp(rng.normal(size=(frames, 7, 3)) * 0.4)
    translations = np.tile(skeleton.offsets, (frames, 1, 1))
    translations[:, 0] = rng.normal(size=(frames, 3))
    return Motion(skeleton, rotations, translations, 0.1)


def places(motion: Motion) -> np.ndarray:
    return fk(motion.rotations, motion.translations, PARENTS)[1]


def asked(motion: Motion, by: float, limit=None, kinds: str = "plain") -> tuple[Task, State]:
    """Points ``by`` away from where they are."""
    at, rng = places(motion), np.random.default_rng(7)
    away = rng.normal(size=(2, len(motion), 3)) * by
    wanted = [AtPosition(Point(3), at[:, 3] + away[0]), AtPosition(Point(6), at[:, 6] + away[1])]
    if kinds != "plain":
        apart = np.linalg.norm(at[:, 6] - at[:, 3], axis=1)
        line = at[:, 6] - at[:, 1] + 2.0 * by
        wanted[1:] = [
            AtDistance(Point(3), Point(6), apart + by),
            InRegion(Point(6), np.eye(3)[1], at[:, 6, 1] - by),  # it is, and stays, on the right side
            Orientation(Point(6), Point(1), line / np.linalg.norm(line, axis=1, keepdims=True), 0.7),
        ]
    return task(motion, wanted, size=1.5, ease=EASE, travel=0.3, limit=limit, tolerance=1e-4)


def moved(motion: Motion, q: np.ndarray) -> np.ndarray:
    """Joints (F, 7, 3) after they turn by ``q`` (8, 3) in world axes; the root moves by its last row."""
    rotations, translations = motion.rotations.copy(), motion.translations.copy()
    world = fk(rotations, translations, PARENTS)[0]
    for j, p in enumerate(PARENTS):
        back = quat.conjugate(quat.IDENTITY if p < 0 else world[:, p])
        rotations[:, j] = quat.multiply(quat.exp(quat.rotate(back, q[j])), rotations[:, j])
    translations[:, 0] += q[7]
    return fk(rotations, translations, PARENTS)[1]


@pytest.mark.parametrize("kinds", ["plain", "mixed"])
def test_a_step_is_that_of_damped_least_squares_over_all_joints(kinds: str, monkeypatch) -> None:
    """``min |J q + e|^2 + d q' M^-1 q``, solved for the turns of all joints with ``J`` by differences."""
    monkeypatch.setattr("mien.kinematics.descent.ITERATIONS", 1)
    motion = pose()
    given, start = asked(motion, 0.02, kinds=kinds)
    frames = np.arange(FRAMES)
    seen = look(given, start, frames)
    after = look(given, descend(given, start, frames), frames)

    def errors(q: np.ndarray) -> np.ndarray:
        at = moved(motion, q)
        points = np.stack([at[:, p.joint] for c in given.constraints for p in c.points], axis=1)
        return np.concatenate(
            [
                c.error(points[:, part], frames)
                for c, part in zip(given.constraints, given.parts, strict=True)
            ],
            axis=1,
        )

    units = np.eye(24).reshape(24, 8, 3) * 1e-6
    jacobian = np.stack([(errors(u) - errors(-u)) / 2e-6 for u in units], axis=-1)
    ease = np.zeros((8, 3))
    ease[list(EASE)] = np.array(list(EASE.values()))[:, None] / 2.0
    ease[7] = 0.3 * 1.5**2 / 2.0
    free = ease.ravel() > 0.0
    error = errors(np.zeros((8, 3)))
    expected = np.zeros((FRAMES, 24))
    for f in range(FRAMES):
        damping = DAMPING * (error[f] @ error[f]) + LEAST_DAMPING * 1.5**2
        j = jacobian[f][:, free]
        normal = j.T @ j + damping * np.diag(1.0 / ease.ravel()[free])
        expected[f, free] = np.linalg.solve(normal, -j.T @ error[f])
    assert 1e-3 < np.abs(expected).max() < 0.3  # no joint is held back for turning too far
    for f in range(FRAMES):
        points = moved(motion, expected[f].reshape(8, 3))[f]
        held = [p.joint for c in given.constraints for p in c.points]
        np.testing.assert_allclose(after.places[..., f], points[held], atol=1e-9)
    assert (after.cost < 0.2 * seen.cost).all()


def test_frames_do_not_depend_on_those_beside_them() -> None:
    motion = pose(frames=40)
    given, start = asked(motion, 0.4)
    together = descend(given, start, np.arange(40))
    some = np.array([3, 17, 30])
    alone = descend(given, (start[0][..., some], start[1][..., some]), some)
    for one, all_ in zip(alone, together, strict=True):
        np.testing.assert_array_equal(one, all_[..., some])


def test_what_is_kept_is_never_worse_than_the_start() -> None:
    motion = pose(frames=60)
    given, start = asked(motion, 30.0)  # nothing reaches that far, and no travel brings both there
    frames = np.arange(60)
    after = look(given, descend(given, start, frames), frames)
    assert (after.cost <= look(given, start, frames).cost).all()


def test_given_up_after_steps_that_do_not_help(monkeypatch) -> None:
    """Contradicting targets: after the middle is found, not all steps there might be are taken."""
    motion = pose(frames=1)
    at = places(motion)[:, 6]
    wanted = [AtPosition(Point(6), at + [0.2, 0.0, 0.0]), AtPosition(Point(6), at - [0.2, 0.0, 0.0])]
    given, start = task(motion, wanted, size=1.5, ease=EASE, travel=0.0, limit=None, tolerance=1e-4)
    looks = []
    monkeypatch.setattr("mien.kinematics.descent.look", lambda *args: looks.append(1) or look(*args))
    after = descend(given, start, np.arange(1))
    assert PATIENCE < len(looks) < ITERATIONS // 2
    np.testing.assert_allclose(look(given, after, np.arange(1)).worst, 0.2, rtol=1e-3)


def test_what_a_limit_takes_the_others_make_up_for() -> None:
    """Four joints, of which the most willing may hardly turn: the others still reach what they can reach."""
    skeleton = Skeleton(tuple("abcde"), [-1, 0, 1, 2, 3], [[0, 0, 0], *[[1, 0, 0]] * 4])
    motion = Motion(skeleton, np.tile(quat.IDENTITY, (1, 5, 1)), skeleton.offsets[None], 0.1)
    steps = []

    def limit(local: np.ndarray, frames: np.ndarray) -> np.ndarray:
        steps.append(1)
        out = local.copy()
        turn = quat.log(out[1].T)
        angle = np.linalg.norm(turn, axis=1, keepdims=True)
        out[1] = quat.exp(turn * np.minimum(1.0, 0.05 / np.maximum(angle, 1e-9))).T
        return out

    wanted = [AtPosition(Point(4), np.array([[2.0, 2.0, 0.5]]))]
    ease = {0: 0.3, 1: 10.0, 2: 0.3, 3: 0.3}
    given, start = task(motion, wanted, size=1.0, ease=ease, travel=0.0, limit=limit, tolerance=1e-4)
    after = descend(given, start, np.arange(1))
    assert look(given, after, np.arange(1)).worst.max() < 1e-4
    assert np.linalg.norm(quat.log(after[0][1].T)) < 0.05 + 1e-9
    assert len(steps) < ITERATIONS
