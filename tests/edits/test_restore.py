"""restore: back to the original by degrees, per part and time, and not back along the way."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits.restore import restore
from mien.errors import MienError, RecipeError
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.recipe import Step


def sad(motion: Motion) -> Motion:
    return mien.apply(motion, [Step("path_length", {"mid": 0.5}), Step("posture", {"head": 25, "trunk": 12})])


def test_all_of_it_is_the_original_but_for_the_way() -> None:
    walk = samples.walk(seconds=3.0).motion
    edited = mien.apply(walk, [Step("path_length", {"mid": 0.5}), Step("foot_plant")])
    back = mien.apply(edited, [Step("restore", {"amount": 1.0})])
    np.testing.assert_allclose(back.rotations, walk.rotations, atol=1e-12)
    body = Body.of(walk)
    hips = body.roles["hips"]
    here, there, own = (world(m)[1][:, hips] for m in (back, edited, walk))
    np.testing.assert_allclose(here @ body.up, own @ body.up, atol=1e-9)
    np.testing.assert_allclose(here @ body.forward, there @ body.forward, atol=1e-9)


def test_with_travel_all_of_it_is_the_original_to_the_last_number() -> None:
    walk = samples.walk(seconds=3.0).motion
    edited = mien.apply(walk, [Step("path_length", {"mid": 0.5}), Step("foot_plant")])
    back = mien.apply(edited, [Step("restore", {"amount": 1.0, "travel": True})])
    np.testing.assert_allclose(back.rotations, walk.rotations, atol=1e-12)
    np.testing.assert_allclose(world(back)[1], world(walk)[1], atol=1e-9 * Body.of(walk).leg_length)


def test_nothing_of_it_is_the_edit() -> None:
    edited = sad(samples.walk(seconds=2.0).motion)
    np.testing.assert_array_equal(mien.apply(edited, [Step("restore")]).rotations, edited.rotations)


def test_halfway_is_the_mean() -> None:
    """Oracle: of two rotations about one axis, the one of half the angle."""
    still = samples.still(seconds=1.0).motion
    edited, half = (mien.apply(still, [Step("posture", {"head": angle})]) for angle in (30.0, 15.0))
    back = mien.apply(edited, [Step("restore", {"amount": 0.5})])
    np.testing.assert_allclose(world(back)[1], world(half)[1], atol=2e-3 * Body.of(still).leg_length)


def test_one_part_for_a_while() -> None:
    walk = samples.walk(seconds=3.0).motion
    edited = sad(walk)
    curve = ((1.0, 0.0), (1.2, 1.0), (2.0, 1.0), (2.2, 0.0))
    back = mien.apply(edited, [Step("restore", {"amount": curve}, parts=("head",))])
    head = list(Body.of(walk).joints(("head",)))
    others = [j for j in range(len(walk.skeleton)) if j not in head]
    np.testing.assert_array_equal(back.rotations[:, others], edited.rotations[:, others])
    np.testing.assert_allclose(back.rotations[75:115, head], walk.rotations[75:115, head], atol=1e-12)
    np.testing.assert_array_equal(back.rotations[:55], edited.rotations[:55])


def test_what_makes_no_sense_is_refused() -> None:
    walk = samples.walk(seconds=1.0).motion
    with pytest.raises(RecipeError, match="amount"):
        mien.apply(walk, [Step("restore", {"amount": 2.0})])
    with pytest.raises(MienError, match="frames"):
        restore.__wrapped__(walk, original=walk[:10], amount=0.5)
