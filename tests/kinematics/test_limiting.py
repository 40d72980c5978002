"""Limits: what is inside stays, what is outside comes back softly, on any skeleton, also for the solver."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.constraints import AtPosition, Point
from mien.kinematics.fk import world
from mien.kinematics.joint_angles import joint_angles
from mien.kinematics.limiting import SOFT, limit, limited
from mien.kinematics.solver import solve
from mien.motion import Motion
from mien.rotations import quaternion

MAY = 3.0


def beyond(motion: Motion) -> tuple[tuple[str, ...], np.ndarray]:
    found = joint_angles(motion, Body.of(motion), world(motion)[0])
    return found.names, found.beyond()


def turned(motion: Motion, role: str, degrees: float, axis: np.ndarray) -> Motion:
    """Turn one joint about an axis of the world, more and more."""
    joint = Body.of(motion).roles[role]
    rotations = np.array(motion.rotations)
    inner = quaternion.rotate(quaternion.conjugate(world(motion)[0][:, joint]), axis)
    share = np.linspace(0.0, 1.0, len(motion))[:, None]
    turn = quaternion.exp(np.radians(degrees) * share * inner)
    rotations[:, joint] = quaternion.multiply(rotations[:, joint], turn)
    return motion.with_(rotations=rotations)


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@given(
    role=st.sampled_from(["left_elbow", "right_elbow", "left_knee", "right_knee", "head", "left_ankle"]),
    degrees=st.floats(-70.0, 70.0),
    axis=st.sampled_from([(1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0), (0.6, 0, 0.8)]),
)
def test_what_is_outside_comes_back_softly(
    skeleton: str, role: str, degrees: float, axis: tuple[float, float, float]
) -> None:
    still = samples.still(seconds=1.0, fps=30.0, skeleton=skeleton).motion
    broken = turned(still, role, degrees, np.array(axis))
    names, before = beyond(broken)
    mended = limited(broken, Body.of(still), np.full((1, len(names)), MAY))
    after = beyond(mended)[1]
    assert after.max() < max(MAY + SOFT + 0.7, 0.0)
    inside = before.max(axis=0) <= MAY
    np.testing.assert_allclose(after[:, inside], before[:, inside], atol=1e-6)


def test_what_is_inside_stays_to_the_last_bit() -> None:
    walk = samples.walk(seconds=2.0).motion
    names, before = beyond(walk)
    same = limited(walk, Body.of(walk), np.full((1, len(names)), before.max() + 0.1))
    np.testing.assert_array_equal(same.rotations, walk.rotations)


def test_the_way_back_is_short() -> None:
    """A knee bent back by 40 degrees comes back by what it is too far, and not further."""
    still = samples.still(seconds=1.0).motion
    broken = turned(still, "left_knee", -40.0, Body.of(still).left)
    names, before = beyond(broken)
    mended = limited(broken, Body.of(still), np.full((1, len(names)), MAY))
    joint = Body.of(still).roles["left_knee"]
    back = quaternion.multiply(quaternion.conjugate(broken.rotations[:, joint]), mended.rotations[:, joint])
    degrees = np.degrees(np.linalg.norm(quaternion.log(back), axis=-1))
    over = np.maximum(before[:, names.index("left_knee")] - MAY, 0.0)
    assert over.max() > 10.0
    assert np.abs(degrees - over).max() < 2.5


def test_the_solver_respects_it() -> None:
    """A hand is asked to where only a broken elbow could bring it; with the limit the elbow stays whole."""
    still = samples.still(seconds=0.5, fps=30.0).motion
    body = Body.of(still)
    wrist, elbow, shoulder = (body.roles[f"left_{r}"] for r in ("wrist", "elbow", "shoulder"))
    place = (
        world(still)[1][:, shoulder] - 0.45 * body.leg_length * body.forward - 0.2 * body.leg_length * body.up
    )
    asked = [AtPosition(Point(wrist), place)]
    ease = {elbow: 1.0}
    free = solve(still, asked, size=body.leg_length, ease=ease).motion
    names, found = beyond(free)
    assert found[:, names.index("left_elbow")].max() > 20.0
    keep = limit(still, body, np.full((1, len(names)), MAY))
    kept = solve(still, asked, size=body.leg_length, ease=ease, limit=keep).motion
    assert beyond(kept)[1][:, names.index("left_elbow")].max() < MAY + SOFT + 1.0
