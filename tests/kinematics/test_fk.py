"""Forward kinematics against a slow twin of 4 x 4 matrices, and its inverse."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mien.kinematics.fk import end_positions, fk, to_local, world
from mien.motion import Motion, Skeleton

PARENTS = np.array([-1, 0, 1, 0, 3, 3, -1, 6])  # two roots, a fork, a chain


def random_clip(frames: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    count = frames * len(PARENTS)
    rotations = Rotation.random(count, rng=random).as_quat().reshape(frames, len(PARENTS), 4)
    return rotations, random.normal(size=(frames, len(PARENTS), 3))


def matrices(rotations: np.ndarray, translations: np.ndarray) -> np.ndarray:
    """The slow twin: one homogeneous matrix for each frame and joint, multiplied from the root down."""
    out = np.empty((*rotations.shape[:2], 4, 4))
    for t in range(len(rotations)):
        for j, parent in enumerate(PARENTS):
            local = np.eye(4)
            local[:3, :3] = Rotation.from_quat(rotations[t, j]).as_matrix()
            local[:3, 3] = translations[t, j]
            out[t, j] = local if parent < 0 else out[t, parent] @ local
    return out


@pytest.mark.parametrize("frames", [1, 2, 7])
def test_agrees_with_matrices(frames: int) -> None:
    rotations, translations = random_clip(frames)
    world_rotations, positions = fk(rotations, translations, PARENTS)
    expected = matrices(rotations, translations)
    np.testing.assert_allclose(positions, expected[..., :3, 3], atol=1e-13)
    found = Rotation.from_quat(world_rotations.reshape(-1, 4)).as_matrix()
    np.testing.assert_allclose(found, expected[..., :3, :3].reshape(-1, 3, 3), atol=1e-13)
    np.testing.assert_allclose(np.linalg.norm(world_rotations, axis=-1), 1, atol=1e-14)


def test_an_elbow_by_hand() -> None:
    """Upper arm 2 along x, forearm 1 along x; a quarter turn about z at both joints."""
    quarter = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]
    rotations = np.array([[quarter, quarter, [0, 0, 0, 1.0]]])
    translations = np.array([[[5.0, 0, 0], [2, 0, 0], [1, 0, 0]]])
    _, positions = fk(rotations, translations, np.array([-1, 0, 1]))
    np.testing.assert_allclose(positions[0], [[5, 0, 0], [5, 2, 0], [4, 2, 0]], atol=1e-15)


def test_to_local_is_the_inverse() -> None:
    rotations, translations = random_clip(6)
    back = to_local(*fk(rotations, translations, PARENTS), PARENTS)
    np.testing.assert_allclose(back[0], rotations, atol=1e-13)
    np.testing.assert_allclose(back[1], translations, atol=1e-13)


def test_input_is_not_written() -> None:
    rotations, translations = random_clip(3)
    before = rotations.copy(), translations.copy()
    rotations.setflags(write=False)
    translations.setflags(write=False)
    to_local(*fk(rotations, translations, PARENTS), PARENTS)
    np.testing.assert_array_equal(rotations, before[0])
    np.testing.assert_array_equal(translations, before[1])


def test_end_sites_are_joints_that_do_not_turn() -> None:
    rotations, translations = random_clip(4)
    random = np.random.default_rng(1)
    ends, parents = random.normal(size=(2, 3)), np.array([2, 7])
    skeleton = Skeleton(tuple("abcdefgh"), PARENTS, np.zeros((8, 3)), parents, ends)
    motion = Motion(skeleton, rotations, translations, 0.01)
    found = end_positions(motion, *world(motion))
    still = np.tile([0, 0, 0, 1.0], (4, 2, 1))
    longer = np.concatenate([rotations, still], axis=1)
    moved = np.concatenate([translations, np.tile(ends, (4, 1, 1))], axis=1)
    _, expected = fk(longer, moved, np.concatenate([PARENTS, parents]))
    np.testing.assert_allclose(found, expected[:, 8:], atol=1e-13)
