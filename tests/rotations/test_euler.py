"""Euler angles against SciPy for all twelve orders BVH files use, and smooth in time everywhere."""

from itertools import permutations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mien.rotations import quaternion as quat
from mien.rotations.euler import from_euler, to_euler

ORDERS = ["".join(p) for p in permutations("XYZ")]


def same_rotation(a: np.ndarray, b: np.ndarray, tolerance: float = 1e-12) -> None:
    apart = np.linalg.norm(quat.log(quat.multiply(quat.conjugate(a), b)), axis=-1)
    assert apart.max() < tolerance


@pytest.mark.parametrize("shape", [(), (1,), (3, 1, 2)], ids=str)
@pytest.mark.parametrize("order", [*ORDERS, "X", "ZY", "YXY"])
def test_from_euler_agrees_with_scipy(order: str, shape: tuple[int, ...]) -> None:
    angles = np.random.default_rng(0).uniform(-4, 4, size=(*shape, len(order)))
    # SciPy: capital letters are intrinsic rotations, written from parent to child as in BVH.
    expected = Rotation.from_euler(order, angles.reshape(-1, len(order))).as_quat().reshape((*shape, 4))
    same_rotation(from_euler(angles, order), expected)


def test_no_axis_is_no_rotation() -> None:
    np.testing.assert_array_equal(from_euler(np.zeros((2, 0)), ""), [quat.IDENTITY] * 2)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("shape", [(1,), (3, 1, 2)], ids=str)
def test_to_euler_comes_back_to_the_same_rotation(order: str, shape: tuple[int, ...]) -> None:
    q = quat.normalise(np.random.default_rng(1).normal(size=(*shape, 4)))
    same_rotation(from_euler(to_euler(q, order), order), q)


@pytest.mark.parametrize("order", ORDERS)
def test_a_single_frame_gives_scipys_angles(order: str) -> None:
    for q in quat.normalise(np.random.default_rng(2).normal(size=(50, 1, 4))):
        expected = Rotation.from_quat(q).as_euler(order)
        np.testing.assert_allclose(to_euler(q, order), expected, atol=1e-9)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("tiny", [0.0, 1e-12, 1e-7])
def test_near_the_identity_angles_are_tiny(order: str, tiny: float) -> None:
    angles = tiny * np.random.default_rng(3).uniform(-1, 1, size=(20, 2, 3))
    np.testing.assert_allclose(to_euler(from_euler(angles, order), order), angles, atol=1e-15)


@pytest.mark.parametrize("order", ORDERS)
def test_whole_turns_do_not_jump(order: str) -> None:
    for axis in range(3):
        angles = np.zeros((400, 3))
        angles[:, axis] = np.linspace(0, 6 * np.pi, 400)
        out = to_euler(from_euler(angles, order), order)
        same_rotation(from_euler(out, order), from_euler(angles, order), 1e-9)
        if axis != 1:  # a whole turn of the middle angle goes through the gimbal: next test
            np.testing.assert_allclose(out, angles, atol=1e-9)


@pytest.mark.parametrize("order", ORDERS)
def test_a_middle_angle_swinging_past_a_quarter_turn_stays_smooth(order: str) -> None:
    t = np.linspace(0, 1, 300)
    angles = np.stack([0.3 * np.sin(5 * t), 2.4 * np.sin(2 * np.pi * t), 0.2 * np.cos(3 * t)], axis=-1)
    out = to_euler(from_euler(angles, order), order)
    same_rotation(from_euler(out, order), from_euler(angles, order), 1e-9)
    assert np.abs(np.diff(out, axis=0)).max() < 1.1 * np.abs(np.diff(angles, axis=0)).max() + 1e-9


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("off", [0.0, 1e-9, 1e-7, 1e-6])
def test_at_the_gimbal_the_rotation_is_right_and_the_first_angle_is_held(
    order: str, side: int, off: float
) -> None:
    angles = np.zeros((30, 3))
    angles[:, 0] = np.linspace(0.4, 0.5, 30)
    angles[:, 1] = side * np.pi / 2 * np.minimum(np.linspace(0, 2, 30), 1) - side * off
    angles[:, 2] = -0.2
    q = from_euler(angles, order)
    out = to_euler(q, order)
    same_rotation(from_euler(out, order), q, 1e-6)  # 1e-7 from the gimbal two angles melt into one
    if off == 0.0:
        held = np.abs(angles[:, 1]) == np.pi / 2
        assert np.ptp(out[held, 0]) < 1e-6
        same_rotation(from_euler(out, order), q, 1e-7)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("side", [-1, 1])
def test_a_clip_that_starts_at_the_gimbal(order: str, side: int) -> None:
    angles = np.array([[0.3, side * np.pi / 2, -0.8]])
    out = to_euler(from_euler(angles, order), order)
    assert out[0, 0] == 0.0
    same_rotation(from_euler(out, order), from_euler(angles, order), 1e-7)


@pytest.mark.parametrize("order", ORDERS)
def test_joints_are_smoothed_each_for_itself(order: str) -> None:
    q = quat.continuous(quat.normalise(np.cumsum(np.random.default_rng(4).normal(size=(60, 5, 4)), axis=0)))
    together = to_euler(q, order)
    for j in range(5):
        np.testing.assert_allclose(together[:, j], to_euler(q[:, j], order), atol=1e-12)


def test_the_sign_of_a_quaternion_changes_nothing() -> None:
    q = quat.normalise(np.random.default_rng(5).normal(size=(10, 4)))
    np.testing.assert_allclose(to_euler(q[:1], "ZXY"), to_euler(-q[:1], "ZXY"), atol=1e-14)
