"""Products with the Jacobian of points on a tree, against the Jacobian itself by finite differences."""

import numpy as np
import pytest

from mien.kinematics.fk import fk
from mien.kinematics.linkage import Linkage, line, linkage, response, turns
from mien.rotations import quaternion as quat

FRAMES = 3
# Name -> parents, joints that hold the points (one twice, one above another).
TREES = {
    "chain": ([-1, 0, 1, 2, 3], [4, 2, 4]),
    "body": ([-1, 0, 1, 2, 1, 4, 0, 6, 7, 0], [3, 5, 8, 1, 8]),
    "two roots": ([-1, 0, 1, -1, 3, 4, 3], [2, 5, 6, 3]),
    "one joint": ([-1], [0, 0]),
}


class Posed:
    """A tree in some poses, with points fixed to its joints."""

    def __init__(self, name: str, *, far: float = 0.0) -> None:
        rng = np.random.default_rng(3)
        self.parents, self.holders = (np.array(x) for x in TREES[name])
        joints = len(self.parents)
        self.rotations = quat.normalise(rng.normal(size=(FRAMES, joints, 4)))
        self.translations = rng.normal(size=(FRAMES, joints, 3))
        self.translations[:, joints // 2] = 0.0  # a bone without length
        self.translations[:, self.parents < 0] += far
        self.offsets = rng.normal(size=(len(self.holders), 3))
        self.offsets[0] = 0.0
        self.ease = rng.uniform(0.2, 2.0, joints)
        self.ease[joints // 3] = 0.0
        self.travel = np.where(self.parents < 0, 0.7, 0.0)

    def points(self, turn: np.ndarray, shift: np.ndarray) -> np.ndarray:
        """Places of the points (T, K, 3) when joints turn and move by vectors (J, 3) in world axes."""
        world, _ = fk(self.rotations, self.translations, self.parents)
        rotations, translations = self.rotations.copy(), self.translations.copy()
        for j, p in enumerate(self.parents):
            around = quat.IDENTITY if p < 0 else world[:, p]
            back = quat.conjugate(around)
            rotations[:, j] = quat.multiply(quat.exp(quat.rotate(back, turn[j])), rotations[:, j])
            translations[:, j] += quat.rotate(back, shift[j])
        world, at = fk(rotations, translations, self.parents)
        return at[:, self.holders] + quat.rotate(world[:, self.holders], self.offsets)

    def jacobian(self) -> np.ndarray:
        """How the points change with all turns and moves (T, 3 K, 6 J)."""
        joints, step, columns = len(self.parents), 1e-5, []
        for part in range(2):
            for unit in np.eye(3 * joints).reshape(-1, joints, 3) * step:
                moves = [np.zeros((joints, 3)), np.zeros((joints, 3))]
                moves[part] = unit
                change = self.points(*moves) - self.points(-moves[0], -moves[1])
                columns.append(change.reshape(FRAMES, -1) / (2.0 * step))
        return np.stack(columns, axis=-1)

    def rows(self) -> tuple[Linkage, np.ndarray, np.ndarray]:
        link = linkage(self.parents, self.holders.tolist(), self.ease, self.travel)
        at = np.moveaxis(fk(self.rotations, self.translations, self.parents)[1], 0, -1)[link.joints]
        still = np.zeros((len(self.parents), 3))
        return link, np.moveaxis(self.points(still, still), 0, -1), at


@pytest.mark.parametrize("name", TREES)
def test_response_is_the_jacobian_with_its_transpose(name: str) -> None:
    posed = Posed(name)
    jacobian = posed.jacobian()
    weights = np.concatenate([np.repeat(posed.ease, 3), np.repeat(posed.travel, 3)])
    expected = (jacobian * weights) @ np.swapaxes(jacobian, 1, 2)
    np.testing.assert_allclose(response(*posed.rows()), expected, atol=1e-7)


@pytest.mark.parametrize("name", TREES)
def test_turns_are_what_forces_do_through_the_jacobian(name: str) -> None:
    posed = Posed(name)
    link, points, at = posed.rows()
    forces = np.random.default_rng(5).normal(size=points.shape)
    turn, shift = turns(link, points, at, forces)
    found = np.swapaxes(posed.jacobian(), 1, 2) @ np.moveaxis(forces, -1, 0).reshape(FRAMES, -1, 1)
    found = found.reshape(FRAMES, 2, -1, 3)[:, :, link.joints]
    ease, travel = posed.ease[link.joints, None], posed.travel[link.joints, None]
    np.testing.assert_allclose(np.moveaxis(turn, -1, 0), ease * found[:, 0], atol=1e-8)
    np.testing.assert_allclose(np.moveaxis(shift, -1, 0), travel * found[:, 1], atol=1e-8)


def test_far_from_the_origin_nothing_is_lost() -> None:
    """A body 10,000 of its sizes away: sums of squares about the origin would keep 8 digits of 16."""
    near, far = Posed("body"), Posed("body", far=1e4)
    np.testing.assert_allclose(response(*far.rows()), response(*near.rows()), atol=1e-9)


def test_ease_may_change_from_frame_to_frame() -> None:
    posed = Posed("body")
    link, points, at = posed.rows()
    one = response(link, points, at)
    loose = np.repeat(link.ease, FRAMES, axis=1)
    loose[:, 1] *= 2.0
    both = response(
        Linkage(link.joints, link.above, link.holders, loose, 0.0 * link.travel, link.pairs, link.shared),
        points,
        at,
    )
    stiff = response(
        Linkage(link.joints, link.above, link.holders, link.ease, 0.0 * link.travel, link.pairs, link.shared),
        points,
        at,
    )
    np.testing.assert_allclose(both[0], stiff[0], atol=1e-12)
    np.testing.assert_allclose(both[1], 2.0 * stiff[1], atol=1e-12)
    assert np.abs(one - stiff).max() > 0.5  # what travel adds


def test_only_joints_above_a_point_are_in_it() -> None:
    parents = np.array([-1, 0, 1, 0, 3, 4])
    link = linkage(parents, [4, 3], np.arange(6.0), np.zeros(6))
    assert link.joints.tolist() == [0, 3, 4]
    assert link.above.tolist() == [-1, 0, 1]
    assert link.ease.ravel().tolist() == [0.0, 3.0, 4.0]
    assert line(parents, 5) == [0, 3, 4, 5]
