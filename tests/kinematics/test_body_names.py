"""Naming schemes of many programs, and names that say nothing or the wrong thing."""

from dataclasses import replace

import numpy as np
import pytest

from mien.kinematics import names
from mien.kinematics.body import Body
from mien.samples import walk

# The order of the 22 joints of the sample, spelt by role; "*" stands for the joint between spine and chest.
TRUNK = ("hips", "spine", "chest", "neck", "head")
SIDE = ("collar", "shoulder", "elbow", "wrist", "hip", "knee", "ankle", "toe")

# Scheme -> trunk names, left names, and how right is made of left.
SCHEMES = {
    "HumanIK": (
        "Hips Spine Spine1 Neck Head",
        "LeftShoulder LeftArm LeftForeArm LeftHand LeftUpLeg LeftLeg LeftFoot LeftToeBase",
        ("Left", "Right"),
    ),
    "Mixamo": (
        "mixamorig:Hips mixamorig:Spine mixamorig:Spine1 mixamorig:Neck mixamorig:Head",
        "mixamorig:LeftShoulder mixamorig:LeftArm mixamorig:LeftForeArm mixamorig:LeftHand "
        "mixamorig:LeftUpLeg mixamorig:LeftLeg mixamorig:LeftFoot mixamorig:LeftToeBase",
        ("Left", "Right"),
    ),
    "3ds Max Biped": (
        "Bip01 Bip01_Spine Bip01_Spine1 Bip01_Neck Bip01_Head",
        "Bip01_L_Clavicle Bip01_L_UpperArm Bip01_L_Forearm Bip01_L_Hand "
        "Bip01_L_Thigh Bip01_L_Calf Bip01_L_Foot Bip01_L_Toe0",
        ("_L_", "_R_"),
    ),
    "Unreal": (
        "pelvis spine_01 spine_02 neck_01 head",
        "clavicle_l upperarm_l lowerarm_l hand_l thigh_l calf_l foot_l ball_l",
        ("_l", "_r"),
    ),
    "SMPL": (
        "Pelvis Spine1 Spine3 Neck Head",
        "L_Collar L_Shoulder L_Elbow L_Wrist L_Hip L_Knee L_Ankle L_Foot",
        ("L_", "R_"),
    ),
    "VRM": (
        "hips spine chest neck head",
        "leftShoulder leftUpperArm leftLowerArm leftHand leftUpperLeg leftLowerLeg leftFoot leftToes",
        ("left", "right"),
    ),
    "Rigify": (
        "spine spine.001 spine.003 spine.004 spine.006",
        "shoulder.L upper_arm.L forearm.L hand.L thigh.L shin.L foot.L toe.L",
        (".L", ".R"),
    ),
    "Acclaim": (
        "root lowerback thorax lowerneck head",
        "lclavicle lhumerus lradius lwrist lfemur ltibia lfoot ltoes",
        None,
    ),
    "OptiTrack": (
        "Hip Ab Chest Neck Head",
        "LShoulder LUArm LFArm LHand LThigh LShin LFoot LToe",
        None,
    ),
    "Xsens": (
        "Pelvis L5 T8 Neck Head",
        "LeftShoulder LeftUpperArm LeftForeArm LeftHand LeftUpperLeg LeftLowerLeg LeftFoot LeftToe",
        ("Left", "Right"),
    ),
    "BVH habit": (
        "Hips Chest Chest4 Neck Head",
        "LeftCollar LeftShoulder LeftElbow LeftWrist LeftHip LeftKnee LeftAnkle LeftToe",
        ("Left", "Right"),
    ),
    "Japanese": (
        "センター 上半身 上半身2 首 頭",
        "左肩 左腕 左ひじ 左手首 左足 左ひざ 左足首 左つま先",
        ("左", "右"),
    ),
    "unknown language": ("a b c d e", "s1 s2 s3 s4 s5 s6 s7 s8", ("s", "d")),
    "all the same": ("x x x x x", "x x x x x x x x", ("x", "x")),
}


def right_of(left: str, swap: tuple[str, str] | None) -> str:
    if swap is not None:
        return left.replace(*swap)
    return ("r" if left[0] == "l" else "R") + left[1:]


@pytest.mark.parametrize("scheme", SCHEMES)
def test_every_scheme_gives_the_same_body(scheme: str) -> None:
    trunk, left, swap = SCHEMES[scheme]
    truth = walk(skeleton="standard22")
    new = dict(zip(TRUNK, trunk.split(), strict=True))
    for role, name in zip(SIDE, left.split(), strict=True):
        new |= {f"left_{role}": name, f"right_{role}": right_of(name, swap)}
    called = {joint: new[role] for role, joint in truth.roles.items()}
    skeleton = truth.motion.skeleton
    other = replace(skeleton, names=tuple(called.get(n, n + "_x") for n in skeleton.names))
    found, expected = Body.of(truth.motion.with_(skeleton=other)), Body.of(truth.motion)
    assert found.roles == expected.roles
    assert found.parts_of == expected.parts_of
    np.testing.assert_allclose(found.neutral, expected.neutral, atol=1e-12)


@pytest.mark.parametrize(
    ("name", "side", "roles"),
    [
        ("LeftUpLeg", "left", {"hip"}),
        ("mixamorig:RightForeArm", "right", {"elbow"}),
        ("CC_Base_L_Thigh", "left", {"hip"}),
        ("Bip001 R Calf", "right", {"knee"}),
        ("upper_arm.L", "left", {"shoulder"}),
        ("lShldr", "left", {"collar", "shoulder"}),
        ("rfemur", "right", {"hip"}),
        ("L_foot_jnt", "left", {"ankle", "toe"}),
        ("spine05", "", {"spine", "chest"}),
        ("右ひじ", "right", {"elbow"}),
        ("CC_Base_L_ThighTwist01", "left", set()),
        ("LeftHandIndex1", "left", set()),
        ("rButtock", "right", set()),
        ("HeadTop_End", "", set()),
        ("joint_17", "", set()),
        ("lumbar", "", {"spine"}),  # no left umbar
        ("rib", "", set()),  # no right ib
    ],
)
def test_what_a_name_says(name: str, side: str, roles: set[str]) -> None:
    assert names.side_of(name) == side
    assert names.roles_of(name) == roles


def test_names_that_lie_about_a_limb_are_outvoted_by_the_rest() -> None:
    """A file that calls the collar bone an elbow: the shape and the other names decide."""
    truth = walk(skeleton="standard22")
    skeleton = truth.motion.skeleton
    wrong = {"LeftShoulder": "LeftElbow", "RightShoulder": "RightElbow"}
    other = replace(skeleton, names=tuple(wrong.get(n, n) for n in skeleton.names))
    assert Body.of(truth.motion.with_(skeleton=other)).roles == Body.of(truth.motion).roles
