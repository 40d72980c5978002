"""The main bone of each joint."""

import numpy as np

from mien.kinematics.body import Body
from mien.kinematics.bones import main_bones
from mien.motion import Skeleton
from mien.samples import SKELETONS, walk


def test_one_child_or_one_end_site():
    bones = main_bones(Skeleton(("a", "b"), [-1, 0], [[9, 9, 9], [0, 2, 0]], [1], [[0, 0, 3]]))
    np.testing.assert_array_equal(bones, [[0, 2, 0], [0, 0, 3]])


def test_nothing_below():
    np.testing.assert_array_equal(main_bones(Skeleton(("a",), [-1], [[1, 2, 3]])), [[0, 0, 0]])


def test_of_several_children_the_one_without_an_equal():
    names = ("hips", "spine", "head", "left", "left foot", "right", "right foot")
    offsets = [[0, 0, 0], [0, 5, 0], [0, 6, 0], [2, -1, 0], [0, -8, 0], [-2, -1, 0], [0, -8, 0]]
    parents = [-1, 0, 1, 0, 3, 0, 5]
    equal = main_bones(Skeleton(names, parents, offsets))
    np.testing.assert_allclose(equal[0], [0, 1, 0])  # all branches alike: the mean
    longer = Skeleton((*names, "eyes"), [*parents, 2], [*offsets, [0, 1, 1]])
    np.testing.assert_allclose(main_bones(longer)[0], [0, 5, 0])


def test_on_every_sample_skeleton_the_hips_look_up_and_left_mirrors_right():
    for name in SKELETONS:
        motion = walk(seconds=0.1, skeleton=name).motion
        body, bones = Body.of(motion), main_bones(motion.skeleton)
        spine = motion.skeleton.offsets[body.spine[0]]
        assert np.allclose(bones[body.roles["hips"]], spine), name
        for limb in ("arm", "leg"):
            left = [np.linalg.norm(bones[j]) for j in body.limbs[f"left_{limb}"]]
            right = [np.linalg.norm(bones[j]) for j in body.limbs[f"right_{limb}"]]
            np.testing.assert_allclose(left, right)
