"""Clusters of poses: a distance that is one, groups that k-means finds too, and stays without flicker."""

import numpy as np
import pytest
from scipy.cluster.vq import kmeans2
from scipy.spatial.transform import Rotation

from mien import samples
from mien.emotion.pose_clusters import HEIGHT, WEIGHTS, PoseSet, distances, medoids, nearest, settled
from mien.kinematics.body import Body
from mien.motion import Motion
from mien.rotations import quaternion

SEGMENTS = ("hips", "trunk", "left_shoulder", "right_shoulder")


def poses(vectors: np.ndarray, heights: np.ndarray) -> PoseSet:
    """Poses with rotation vectors (N, S, 3) in radians."""
    return PoseSet(heights, {s: quaternion.exp(vectors[:, i]) for i, s in enumerate(SEGMENTS)})


def some(seed: int, count: int) -> PoseSet:
    rng = np.random.default_rng(seed)
    return poses(rng.normal(size=(count, len(SEGMENTS), 3)), rng.normal(1.0, 0.1, count))


def test_it_is_a_distance_and_signs_of_quaternions_do_not_matter() -> None:
    one, other = some(1, 6), some(2, 4)
    np.testing.assert_allclose(distances(one, other), distances(other, one).T)
    np.testing.assert_allclose(np.diag(distances(one, one)), 0.0, atol=1e-6)
    turned = PoseSet(other.heights, {s: -q for s, q in other.turns.items()})
    np.testing.assert_allclose(distances(one, turned), distances(one, other))


def test_it_is_equation_5_pose_by_pose() -> None:
    one, other = some(3, 3), some(4, 5)
    for i in range(3):
        for j in range(5):
            total = WEIGHTS["hips"] * ((one.heights[i] - other.heights[j]) / HEIGHT) ** 2
            for s in SEGMENTS:
                u, v = (Rotation.from_quat(p.turns[s][k]) for p, k in ((one, i), (other, j)))
                total += WEIGHTS[s] * (u.inv() * v).magnitude() ** 2
            total /= WEIGHTS["hips"] + sum(WEIGHTS[s] for s in SEGMENTS)
            assert distances(one, other)[i, j] == pytest.approx(total)


def test_groups_that_are_apart_are_those_of_k_means() -> None:
    rng = np.random.default_rng(5)
    centres = 1.2 * rng.normal(size=(5, len(SEGMENTS), 3))
    truth = np.repeat(np.arange(5), [40, 35, 30, 25, 20])
    vectors = centres[truth] + rng.normal(scale=0.05, size=(150, len(SEGMENTS), 3))
    every = poses(vectors, np.ones(150))
    found = nearest(every, every[medoids(every)])
    _, theirs = kmeans2(vectors.reshape(150, -1), centres.reshape(5, -1), minit="matrix")
    assert len({*zip(found.tolist(), theirs.tolist(), strict=True)}) == 5
    np.testing.assert_array_equal(np.bincount(found), [40, 35, 30, 25, 20])  # largest first


def test_a_few_odd_poses_are_no_cluster() -> None:
    rng = np.random.default_rng(6)
    vectors = rng.normal(scale=0.05, size=(301, len(SEGMENTS), 3))
    vectors[150:] += 0.8
    vectors[0] += 2.0
    every = poses(vectors, np.ones(301))
    assert 0 not in medoids(every, count=2)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_poses(count: int) -> None:
    every = some(7, count)
    assert 1 <= len(medoids(every)) <= count


def test_place_and_heading_do_not_matter(turned: tuple[Motion, Motion]) -> None:
    one, other = (PoseSet.of(m, Body.of(m)) for m in turned)
    assert np.diag(distances(one, other)).max() < 1e-6


@pytest.fixture
def turned() -> tuple[Motion, Motion]:
    walk = samples.walk(seconds=1.0).motion
    body = Body.of(walk)
    hips = body.roles["hips"]
    yaw = quaternion.exp(1.1 * body.up)
    rotations, translations = np.array(walk.rotations), np.array(walk.translations)
    rotations[:, hips] = quaternion.multiply(yaw, rotations[:, hips])
    translations[:, hips] = quaternion.rotate(yaw, translations[:, hips]) + 3.0 * body.left
    return walk, walk.with_(rotations=rotations, translations=translations)


def test_short_stays_go_to_the_longer_neighbour() -> None:
    assert settled(np.array([0, 0, 1, 2, 2, 2]), 2).tolist() == [0, 0, 2, 2, 2, 2]
    assert settled(np.array([1, 0]), 5).tolist() in ([0, 0], [1, 1])
    assert settled(np.array([3]), 5).tolist() == [3]
