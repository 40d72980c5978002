"""Direction vectors: round trips, what filtering may do to them, and SciPy and an SVD as oracles."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from mien.errors import MienError
from mien.rotations import directions, euler, quaternion

numbers = st.floats(-3.0, 3.0, allow_subnormal=False)
rotation_vectors = arrays(np.float64, (5, 2, 3), elements=numbers)


def apart(a, b):
    """The largest angle between two sets of rotations, whatever their signs."""
    turn = quaternion.multiply(quaternion.conjugate(a), b)
    return 2.0 * np.arcsin(np.clip(np.linalg.norm(turn[..., :3], axis=-1).max(), 0.0, 1.0))


@pytest.fixture
def clip():
    rng = np.random.default_rng(3)
    return quaternion.continuous(quaternion.exp(np.cumsum(rng.normal(size=(60, 4, 3)) * 0.2, axis=0)))


@pytest.fixture
def axes():
    return directions.axes(np.random.default_rng(4).normal(size=(4, 3)))


def test_axes_are_a_unit_pair_at_right_angles():
    bones = np.array([[0.0, -43.0, 0.0], [1.0, 1.0, 1.0], [0.0, 0.0, 0.0], [0.1, -0.2, 5.0]])
    u, v = directions.axes(bones)
    np.testing.assert_allclose(np.linalg.norm(u, axis=-1), 1.0, atol=1e-15)
    np.testing.assert_allclose(np.linalg.norm(v, axis=-1), 1.0, atol=1e-15)
    np.testing.assert_allclose((u * v).sum(-1), 0.0, atol=1e-15)
    np.testing.assert_allclose(u[0], [0, -1, 0])
    np.testing.assert_allclose((u[2], v[2]), ([1, 0, 0], [0, 1, 0]))
    assert np.abs(v[3]).argmax() == 0  # across the bone, towards the axis least aligned with it


def test_with_axes_x_and_y_the_codes_are_the_first_two_matrix_columns(clip):
    codes = directions.encode(clip, np.array([1.0, 0, 0]), np.array([0, 1.0, 0]))
    matrix = Rotation.from_quat(clip.reshape(-1, 4)).as_matrix().reshape(*clip.shape[:2], 3, 3)
    np.testing.assert_allclose(codes, np.concatenate([matrix[..., 0], matrix[..., 1]], -1), atol=1e-14)


@pytest.mark.parametrize("method", ["gram-schmidt", "svd"])
@given(rotation_vectors, st.floats(1e-6, 1e6))
@settings(max_examples=40, deadline=None)
def test_lengths_carry_no_information(method, vectors, scale):
    q = quaternion.exp(vectors)
    u, v = directions.axes(np.array([[0.0, 0.4, 0.1], [-0.2, 0.0, 0.0]]))
    back = directions.decode(scale * directions.encode(q, u, v), u, v, orthogonalise=method)
    assert apart(back, q) < 1e-12


def test_decoded_signs_are_continuous(clip, axes):
    back = directions.decode(directions.encode(clip, *axes), *axes)
    assert (np.einsum("tji,tji->tj", back[1:], back[:-1]) > 0).all()


def test_gram_schmidt_keeps_the_bone_direction_of_bent_codes(clip, axes):
    codes = directions.encode(clip, *axes) + np.random.default_rng(5).normal(size=(60, 4, 6)) * 0.2
    back = directions.decode(codes, *axes)
    wanted = codes[..., :3] / np.linalg.norm(codes[..., :3], axis=-1, keepdims=True)
    np.testing.assert_allclose(quaternion.rotate(back, axes[0]), wanted, atol=1e-12)
    across = quaternion.rotate(back, axes[1])
    assert (np.einsum("tji,tji->tj", across, codes[..., 3:]) > 0).all()


def test_svd_finds_the_nearest_rotation_of_bent_codes(clip, axes):
    codes = directions.encode(clip, *axes) + np.random.default_rng(6).normal(size=(60, 4, 6)) * 0.2
    back = directions.decode(codes, *axes, orthogonalise="svd")
    left, _, right = np.linalg.svd(np.stack([codes[..., :3], codes[..., 3:]], -1), full_matrices=False)
    nearest = left @ right
    np.testing.assert_allclose(quaternion.rotate(back, axes[0]), nearest[..., 0], atol=1e-10)
    np.testing.assert_allclose(quaternion.rotate(back, axes[1]), nearest[..., 1], atol=1e-10)


def test_two_whole_turns_are_smooth():
    angle = np.linspace(0.0, 4.0 * np.pi, 200)
    q = quaternion.exp(angle[:, None] * np.array([1.0, 2.0, 2.0]) / 3.0)
    codes = directions.encode(q, *directions.axes(np.array([0.0, 1.0, 0.0])))
    step = np.abs(np.diff(codes.reshape(200, 2, 3), axis=0))
    assert np.linalg.norm(step, axis=-1).max() <= 2.0 * np.sin(0.5 * (angle[1] - angle[0])) + 1e-12


def test_passing_the_gimbal_is_smooth():
    middle = np.linspace(80.0, 100.0, 41)
    angles = np.radians(np.stack([np.full(41, 30.0), middle, np.full(41, -50.0)], -1))
    codes = directions.encode(euler.from_euler(angles, "ZXY"), *directions.axes(np.array([0.0, 1.0, 0.0])))
    assert np.abs(np.diff(codes, axis=0)).max() <= 2.0 * np.sin(np.radians(0.25)) + 1e-12
    assert np.abs(np.diff(codes, n=2, axis=0)).max() < 2e-4


@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-160, 1e-12, 1e-8, 1e-4])
def test_near_the_identity(size):
    q = quaternion.exp(np.full((3, 1, 3), size))
    u, v = directions.axes(np.array([[0.3, -0.2, 0.1]]))
    back = directions.decode(directions.encode(q, u, v), u, v)
    assert np.isfinite(back).all()
    assert apart(back, q) < 1e-14


def test_codes_that_say_nothing_repeat_the_last_good_frame_or_fall_back(clip, axes):
    codes = directions.encode(clip, *axes)
    codes[0, 0] = 0.0  # before any good frame
    codes[5:8, 1, :3] = 1e-9  # no direction
    codes[20, 2, 3:] = -2.0 * codes[20, 2, :3]  # both directions parallel
    lost = directions.degenerate(codes)
    assert lost.sum() == 5
    assert lost[0, 0]
    assert lost[5:8, 1].all()
    assert lost[20, 2]
    back = directions.decode(codes, *axes, fallback=clip)
    assert apart(back[0, 0], clip[0, 0]) < 1e-12
    assert apart(back[5:8, 1], clip[4:5, 1]) < 1e-12
    assert apart(back[20, 2], clip[19, 2]) < 1e-12
    assert apart(back[~lost], clip[~lost]) < 1e-12
    np.testing.assert_allclose(np.abs(directions.decode(codes, *axes)[0, 0]), quaternion.IDENTITY)


def test_unknown_orthogonalisation_is_refused(clip, axes):
    with pytest.raises(MienError, match="gram-schmidt"):
        directions.decode(directions.encode(clip, *axes), *axes, orthogonalise="gram")
