"""The four skeletons differ in everything but the body they carry."""

import numpy as np
import pytest

from mien.kinematics.fk import fk
from mien.samples import SKELETONS, still
from mien.samples.figure import STANCE, STATURE
from mien.samples.skeletons import rig


@pytest.mark.parametrize(
    ("skeleton", "joints"), [("standard22", 22), ("capture31", 31), ("poser43", 43), ("engine23", 23)]
)
def test_number_of_joints(skeleton: str, joints: int) -> None:
    skeleton_ = still(seconds=0.0, skeleton=skeleton).motion.skeleton
    assert len(skeleton_) == len(set(skeleton_.names)) == joints
    assert np.isfinite(skeleton_.offsets).all()
    childless = set(range(joints)) - set(skeleton_.parents.tolist())
    assert childless <= set(skeleton_.end_parents.tolist()), "every last joint has an end site"


def test_names_and_channels_differ() -> None:
    layouts = {s: still(seconds=0.0, skeleton=s).motion.skeleton.layout for s in SKELETONS}
    assert len({(layout.channels[0], layout.channels[1]) for layout in layouts.values()}) == len(SKELETONS)
    assert all(len(c) == 6 for c in layouts["engine23"].channels)
    assert [len(c) for c in layouts["capture31"].channels] == [6] + [3] * 30
    names = [set(still(seconds=0.0, skeleton=s).roles.values()) for s in SKELETONS]
    assert not names[0] & names[2]
    assert names[2] & names[3] == {"head"}
    assert names[0] != names[1]


@pytest.mark.parametrize(
    ("skeleton", "degrees"), [("standard22", 90.0), ("capture31", 45.0), ("poser43", 0.0)]
)
@pytest.mark.parametrize("up", ["y", "z"])
def test_arms_in_the_rest_pose(skeleton: str, degrees: float, up: str) -> None:
    """At zero rotation the arms make the rest pose's angle with the trunk, and the head is up."""
    sample = still(seconds=0.0, skeleton=skeleton, up=up)
    bones = sample.motion.skeleton
    rest = np.tile([0.0, 0.0, 0.0, 1.0], (1, len(bones), 1))
    _, at = fk(rest, bones.offsets[None], bones.parents)
    place = {role: at[0, bones.names.index(name)] for role, name in sample.roles.items()}
    for side, sign in (("left", 1.0), ("right", -1.0)):
        upper = place[f"{side}_elbow"] - place[f"{side}_shoulder"]
        assert np.degrees(np.arctan2(sign * upper[0], -upper @ sample.up)) == pytest.approx(degrees)
    trunk = place["head"] - place["hips"]
    assert trunk @ sample.up == pytest.approx(np.linalg.norm(trunk), rel=1e-3)


@pytest.mark.parametrize("up", ["y", "z"])
def test_every_bone_of_the_engine_skeleton_lies_on_its_own_x_axis(up: str) -> None:
    bones = still(seconds=0.0, skeleton="engine23", up=up).motion.skeleton
    single = [j for j in range(2, len(bones)) if len(bones.children(int(bones.parents[j]))) == 1]
    assert len(single) >= 12
    for j in single:
        along = np.abs(bones.offsets[j]) / np.linalg.norm(bones.offsets[j])
        np.testing.assert_allclose(along, [1.0, 0.0, 0.0], atol=1e-9)


def test_proportions_are_drillis_and_contini() -> None:
    # Fractions of stature in Winter, Biomechanics and Motor Control of Human Movement, fig. 4.1.
    def length(a: str, b: str) -> float:
        return float(np.linalg.norm(STANCE[a] - STANCE[b])) / STATURE

    assert length("left_shoulder", "left_elbow") == pytest.approx(0.186)
    assert length("left_elbow", "left_wrist") == pytest.approx(0.146)
    assert length("left_wrist", "left_hand_tip") == pytest.approx(0.108)
    assert length("left_hip", "left_knee") == pytest.approx(0.245)
    assert length("left_knee", "left_ankle") == pytest.approx(0.246)
    assert STANCE["left_ankle"][1] / STATURE == pytest.approx(0.039)
    assert STANCE["head_tip"][1] == pytest.approx(STATURE)


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_left_and_right_mirror_each_other(skeleton: str) -> None:
    chosen = rig(skeleton)
    for role, name in chosen.roles.items():
        if role.startswith("left_"):
            other = chosen.names.index(chosen.roles[role.replace("left_", "right_")])
            a, b = chosen.points[chosen.names.index(name)], chosen.points[other]
            np.testing.assert_allclose(a * [-1.0, 1.0, 1.0], b)
