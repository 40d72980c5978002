"""Arms that are inside the body, or each other, come out, smoothly, by no more than they must."""

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.capsules import capsules
from mien.kinematics.fk import world
from mien.kinematics.separation import separated
from mien.motion import Motion
from mien.rotations import quaternion


def turned(motion: Motion, role: str, degrees: float, axis: np.ndarray) -> Motion:
    """Turn one joint about an axis of the world, softly in and out over the clip."""
    joint = Body.of(motion).roles[role]
    rotations = np.array(motion.rotations)
    inner = quaternion.rotate(quaternion.conjugate(world(motion)[0][:, joint]), axis)
    share = np.sin(np.pi * np.linspace(0.0, 1.0, len(motion)))[:, None] ** 2
    turn = quaternion.exp(np.radians(degrees) * share * inner)
    rotations[:, joint] = quaternion.multiply(rotations[:, joint], turn)
    return motion.with_(rotations=rotations)


def depth(motion: Motion) -> np.ndarray:
    return capsules(motion, Body.of(motion)).contacts(*world(motion)).depth


def folded(motion: Motion, *, side: str = "left", by: float = 75.0) -> Motion:
    """Bend an elbow and turn the arm in, so that the forearm is in the belly."""
    body, way = Body.of(motion), 1.0 if side == "left" else -1.0
    motion = turned(motion, f"{side}_elbow", -75.0, body.left)
    return turned(motion, f"{side}_shoulder", -by * way, body.up)


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("side", ["left", "right"])
def test_a_forearm_comes_out_of_the_belly(side: str, skeleton: str) -> None:
    still = samples.still(seconds=4.0, skeleton=skeleton, unit="m").motion
    broken = folded(still, side=side)
    before = depth(broken)
    assert before.max() > 0.03
    may = np.full((1, before.shape[1]), 0.01)
    mended = separated(broken, Body.of(still), np.maximum(may, depth(still)))
    assert depth(mended).max() < 0.0145
    # By about as much as it was too deep, and nowhere in a jump.
    moved = np.linalg.norm(world(mended)[1] - world(broken)[1], axis=-1)
    assert moved.max() < 4.0 * before.max()
    assert np.abs(np.diff(moved, n=2, axis=0)).max() * still.fps**2 < 6.0  # m/s2


def test_arms_off_the_body_are_left_alone() -> None:
    walk = samples.walk(seconds=2.0).motion
    may = np.maximum(depth(walk), 0.0) + 1e-6
    np.testing.assert_array_equal(separated(walk, Body.of(walk), may).rotations, walk.rotations)
