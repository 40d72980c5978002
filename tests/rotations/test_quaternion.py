"""Quaternions against SciPy's Rotation, and their laws, over batch shapes and kinds of rotation."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mien.rotations import quaternion as quat

SHAPES = [(), (1,), (3, 1, 2)]
KINDS = ["uniform", "near identity", "near half turn", "exact"]


def sample(kind: str, shape: tuple[int, ...], seed: int = 0) -> np.ndarray:
    """Unit quaternions of a kind that breaks careless formulas, made without the code under test."""
    random = np.random.default_rng(seed)
    axis = random.normal(size=(*shape, 3))
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    if kind == "exact":  # half turns and the identity, without rounding
        table = np.vstack([np.eye(4), -np.eye(4)])
        return table[random.integers(0, len(table), size=shape)]
    angle = {
        "uniform": random.uniform(0, np.pi, size=(*shape, 1)),
        "near identity": random.uniform(0, 1e-7, size=(*shape, 1)),
        "near half turn": np.pi - random.uniform(0, 1e-7, size=(*shape, 1)),
    }[kind]
    sign = random.choice([-1.0, 1.0], size=(*shape, 1))
    return sign * np.concatenate([np.sin(angle / 2) * axis, np.cos(angle / 2)], axis=-1)


def scipy(q: np.ndarray) -> Rotation:
    return Rotation.from_quat(np.reshape(q, (-1, 4)))


def same_rotation(a: np.ndarray, b: np.ndarray, tolerance: float = 1e-12) -> None:
    """``q`` and ``-q`` are the same rotation."""
    assert a.shape == b.shape
    nearest = np.minimum(np.abs(a - b).max(-1), np.abs(a + b).max(-1))
    assert nearest.max(initial=0.0) < tolerance


@pytest.fixture(params=SHAPES, ids=str)
def shape(request: pytest.FixtureRequest) -> tuple[int, ...]:
    return request.param


@pytest.fixture(params=KINDS)
def q(request: pytest.FixtureRequest, shape: tuple[int, ...]) -> np.ndarray:
    return sample(request.param, shape)


def test_product_agrees_with_scipy(q: np.ndarray, shape: tuple[int, ...]) -> None:
    other = sample("uniform", shape, seed=1)
    same_rotation(quat.multiply(q, other), (scipy(q) * scipy(other)).as_quat().reshape((*shape, 4)))


def test_rotating_a_vector_agrees_with_scipy(q: np.ndarray, shape: tuple[int, ...]) -> None:
    v = np.random.default_rng(2).normal(size=(*shape, 3))
    np.testing.assert_allclose(
        quat.rotate(q, v), scipy(q).apply(v.reshape(-1, 3)).reshape((*shape, 3)), atol=1e-14
    )


def test_matrix_agrees_with_scipy_and_comes_back(q: np.ndarray, shape: tuple[int, ...]) -> None:
    matrix = quat.to_matrix(q)
    np.testing.assert_allclose(matrix, scipy(q).as_matrix().reshape((*shape, 3, 3)), atol=1e-14)
    same_rotation(quat.from_matrix(matrix), q)


def test_log_agrees_with_scipy_and_exp_undoes_it(q: np.ndarray, shape: tuple[int, ...]) -> None:
    vector = quat.log(q)
    assert (np.linalg.norm(vector, axis=-1) <= np.pi + 1e-15).all()
    expected = scipy(q).as_rotvec().reshape((*shape, 3))
    # At exactly a half turn either axis is right; there only the rotation is compared.
    half = np.abs(q[..., 3:]) < 1e-15
    np.testing.assert_allclose(np.where(half, 0, vector), np.where(half, 0, expected), atol=1e-14)
    same_rotation(quat.exp(vector), q)


def test_log_keeps_relative_precision_of_tiny_rotations() -> None:
    for angle in (1e-3, 1e-7, 1e-11, 1e-13, 1e-100):
        q = np.array([np.sin(angle / 2), 0.0, 0.0, np.cos(angle / 2)])
        assert quat.log(q)[0] == pytest.approx(angle, rel=1e-12)
        assert quat.log(-q)[0] == pytest.approx(angle, rel=1e-12)


def test_exp_of_zero_is_the_identity() -> None:
    np.testing.assert_array_equal(quat.exp(np.zeros((2, 3))), [[0, 0, 0, 1]] * 2)


def test_conjugate_undoes(q: np.ndarray) -> None:
    same_rotation(quat.multiply(q, quat.conjugate(q)), np.broadcast_to(quat.IDENTITY, q.shape))


def test_normalise_keeps_direction_and_mends_zero() -> None:
    q = sample("uniform", (5,))
    np.testing.assert_allclose(quat.normalise(3.0 * q), q, atol=1e-15)
    np.testing.assert_array_equal(quat.normalise(np.zeros((2, 4))), [quat.IDENTITY] * 2)


def test_power_is_a_fraction_of_the_turn(q: np.ndarray) -> None:
    third = quat.power(q, 1 / 3)
    same_rotation(quat.multiply(third, quat.multiply(third, third)), q)
    same_rotation(quat.power(q, 0.0), np.broadcast_to(quat.IDENTITY, q.shape))
    same_rotation(quat.power(q, -1.0), quat.conjugate(q))


def test_power_takes_one_weight_for_each_rotation() -> None:
    q = sample("uniform", (4, 2))
    weight = np.linspace(0, 1, 8).reshape(4, 2)
    together = quat.power(q, weight)
    for index in np.ndindex(4, 2):
        np.testing.assert_allclose(together[index], quat.power(q[index], float(weight[index])), atol=1e-15)


def test_slerp_agrees_with_scipy() -> None:
    from scipy.spatial.transform import Slerp

    a, b = sample("uniform", (), seed=3), sample("uniform", (), seed=4)
    weights = np.linspace(0, 1, 11)
    expected = Slerp([0, 1], Rotation.from_quat([a, b]))(weights).as_quat()
    ours = quat.slerp(np.tile(a, (11, 1)), np.tile(b, (11, 1)), weights)
    same_rotation(ours, expected)


def test_slerp_takes_the_shorter_arc_whatever_the_sign() -> None:
    a, b = sample("uniform", (6,), seed=3), sample("uniform", (6,), seed=4)
    same_rotation(quat.slerp(a, b, 0.3), quat.slerp(a, -b, 0.3))
    step = quat.log(quat.multiply(quat.conjugate(a), quat.slerp(a, b, 0.5)))
    assert (np.linalg.norm(step, axis=-1) <= np.pi / 2 + 1e-12).all()


def test_continuous_only_changes_signs_and_leaves_no_jump() -> None:
    angle = np.linspace(0, 6 * np.pi, 200)[:, None]
    smooth = np.concatenate([np.sin(angle / 2), 0 * angle, 0 * angle, np.cos(angle / 2)], axis=-1)
    flipped = np.stack([smooth, smooth], axis=1) * np.random.default_rng(5).choice([-1, 1], size=(200, 2, 1))
    mended = quat.continuous(flipped)
    np.testing.assert_array_equal(np.abs(mended), np.abs(flipped))
    np.testing.assert_array_equal(mended[0], flipped[0])
    assert (np.einsum("tji,tji->tj", mended[1:], mended[:-1]) > 0).all()


@pytest.mark.parametrize("frames", [0, 1, 2])
def test_continuous_of_very_short_clips(frames: int) -> None:
    q = np.tile(quat.IDENTITY, (frames, 3, 1))
    np.testing.assert_array_equal(quat.continuous(q), q)


def test_between_turns_one_direction_into_the_other_by_the_smallest_angle(shape: tuple[int, ...]) -> None:
    random = np.random.default_rng(6)
    a, b = random.normal(size=(*shape, 3)), random.normal(size=(*shape, 3))
    q = quat.between(a, b)
    unit = b / np.linalg.norm(b, axis=-1, keepdims=True) * np.linalg.norm(a, axis=-1, keepdims=True)
    np.testing.assert_allclose(quat.rotate(q, a), unit, atol=1e-12)
    cosine = np.sum(a * b, -1) / np.linalg.norm(a, axis=-1) / np.linalg.norm(b, axis=-1)
    np.testing.assert_allclose(np.linalg.norm(quat.log(q), axis=-1), np.arccos(cosine), atol=1e-9)


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-9, 1e-7, 1e-5])
@pytest.mark.parametrize("a", [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0], [0.95, 0.3, -0.1]])
def test_between_opposite_and_equal_directions(a: list[float], off: float) -> None:
    start = np.array(a)
    aside = np.cross(start, [0.3, 0.5, 0.7])
    for sign in (-1.0, 1.0):
        goal = sign * start + off * aside
        turned = quat.rotate(quat.between(start, goal), start)
        np.testing.assert_allclose(turned / np.linalg.norm(turned), goal / np.linalg.norm(goal), atol=1e-9)


def test_between_without_a_direction_turns_nothing() -> None:
    np.testing.assert_array_equal(quat.between(np.zeros(3), np.array([1.0, 0, 0])), quat.IDENTITY)


def test_twist_and_swing_make_the_rotation(q: np.ndarray) -> None:
    axis = np.array([0.6, 0.0, 0.8])
    twist = quat.twist(q, axis)
    np.testing.assert_allclose(np.cross(twist[..., :3], axis), 0, atol=1e-15)
    swing = quat.multiply(q, quat.conjugate(twist))
    np.testing.assert_allclose(np.linalg.norm(swing, axis=-1), 1, atol=1e-12)
    # The swing turns about an axis at right angles to the twist, where the split is defined.
    defined = np.hypot(q[..., :3] @ axis, q[..., 3]) > 1e-6
    assert np.abs(np.where(defined, swing[..., :3] @ axis, 0)).max(initial=0) < 1e-9


def test_batch_equals_loop() -> None:
    a, b = sample("uniform", (4, 3)), sample("uniform", (4, 3), seed=9)
    v = np.random.default_rng(1).normal(size=(4, 3, 3))
    for together, one in [
        (quat.multiply(a, b), lambda i: quat.multiply(a[i], b[i])),
        (quat.rotate(a, v), lambda i: quat.rotate(a[i], v[i])),
        (quat.log(a), lambda i: quat.log(a[i])),
        (quat.exp(v), lambda i: quat.exp(v[i])),
        (quat.slerp(a, b, 0.7), lambda i: quat.slerp(a[i], b[i], 0.7)),
        (quat.between(v, v[::-1]), lambda i: quat.between(v[i], v[::-1][i])),
        (quat.to_matrix(a), lambda i: quat.to_matrix(a[i])),
    ]:
        for index in np.ndindex(4, 3):
            np.testing.assert_allclose(together[index], one(index), atol=1e-15)


def test_broadcasting_one_rotation_over_many_vectors() -> None:
    q = sample("uniform", ())
    v = np.random.default_rng(1).normal(size=(5, 2, 3))
    np.testing.assert_allclose(quat.rotate(q, v), v @ quat.to_matrix(q).T, atol=1e-14)
    many = sample("uniform", (5, 2))
    assert quat.multiply(q, many).shape == (5, 2, 4)


@pytest.mark.parametrize("apart", [0.0, 1e-7, 1.0, 3.1, np.pi])
def test_from_axes_is_from_matrix_with_the_sign_of_near(apart: float) -> None:
    rng = np.random.default_rng(5)
    q = quat.normalise(rng.normal(size=(50, 3, 4)))
    axis = rng.normal(size=(50, 3, 3))
    axis *= apart / np.linalg.norm(axis, axis=-1, keepdims=True)
    near = quat.multiply(q, quat.exp(axis))
    m = quat.to_matrix(q)
    found = quat.from_axes(m[..., 0], m[..., 1], m[..., 2], near=near)
    np.testing.assert_allclose(np.abs(np.sum(found * q, axis=-1)), 1.0, atol=1e-12)
    if apart < 2.9:
        assert (np.sum(found * near, axis=-1) > 0).all()
