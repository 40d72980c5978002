"""The pelvis goes over the feet: against the centre of mass of a body that stands still."""

import numpy as np

from mien import samples
from mien.kinematics.balancing import MOST, astray, balanced
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect
from mien.kinematics.legs import Placed, over_feet
from mien.motion import Motion


def leaning(share: float, *, sway: float = 0.0) -> tuple[Motion, Body]:
    """A body that stands with its hips ``share`` leg lengths before its feet."""
    still = samples.still(seconds=3.0, sway=sway, unit="m").motion
    body = Body.of(still)
    away = np.tile(share * body.leg_length * body.forward, (len(still), 1))
    return over_feet(Placed.of(still, body), away, detect(still, body=body).feet, body), body


def outside(motion: Motion, body: Body) -> np.ndarray:
    return np.linalg.norm(astray(Placed.of(motion, body), body, detect(motion, body=body)), axis=1)


def test_who_stands_well_is_left_alone() -> None:
    motion, body = leaning(0.05)
    assert not outside(motion, body).any()
    same = balanced(motion, body, detect(motion, body=body), np.zeros(len(motion)))
    np.testing.assert_array_equal(same.rotations, motion.rotations)


def test_who_would_fall_comes_back_to_what_is_allowed() -> None:
    motion, body = leaning(0.4)
    before = outside(motion, body)
    assert before.min() > 0.04
    mended = balanced(motion, body, detect(motion, body=body), np.full(len(motion), 0.02))
    assert outside(mended, body).max() < 0.03


def test_it_is_not_moved_without_end() -> None:
    motion, body = leaning(0.7)
    hips = body.roles["hips"]
    mended = balanced(motion, body, detect(motion, body=body), np.zeros(len(motion)))
    there, here = (Placed.of(m, body).positions[:, hips] for m in (motion, mended))
    away = there - here
    level = away - (away @ body.up)[:, None] * body.up
    assert np.linalg.norm(level, axis=1).max() < MOST * body.leg_length + 1e-6
