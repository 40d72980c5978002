"""Every skeleton among the real clips, and what must be found in it. Skipped where the clips are absent."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from mien import formats
from mien.errors import BodyError
from mien.kinematics.body import Body
from mien.kinematics.fk import fk
from mien.kinematics.heading import heading
from mien.motion import Motion

SIDE = ("collar", "shoulder", "elbow", "wrist", "hip", "knee", "ankle", "toe")
Y, Z, BACK = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)


@dataclass(frozen=True)
class Expected:
    """Names of hips, spine, chest, neck, head, then of the left limbs in the order of SIDE ("-": none).

    ``swap`` makes a left name a right one. ``legs`` are the shortest and longest leg in metres over the
    clips, with the unit estimated from one clip alone.
    """

    trunk: str
    left: str
    swap: tuple[str, str]
    legs: tuple[float, float]
    up: tuple[float, float, float] = Y
    forward: tuple[float, float, float] = Z
    unit: float = 0.01

    @property
    def roles(self) -> dict[str, str]:
        trunk = zip(("hips", "spine", "chest", "neck", "head"), self.trunk.split(), strict=True)
        left = list(zip(SIDE, self.left.split(), strict=True))
        out = dict(trunk) | {f"left_{r}": n for r, n in left}
        out |= {f"right_{r}": n.replace(*self.swap, 1) for r, n in left}
        return {role: name for role, name in out.items() if name != "-"}


WORDS, TAIL, HEAD = ("Left", "Right"), ("_L", "_R"), ("L_", "R_")
CAPTURE = Expected(
    "Hips LowerBack Spine1 Neck Head",
    "LeftShoulder LeftArm LeftForeArm LeftHand LeftUpLeg LeftLeg LeftFoot LeftToeBase",
    WORDS,
    (0.74, 0.84),
    unit=0.0254 / 0.45,
)
BANDAI = Expected(
    "Hips Spine Chest Neck Head",
    "Shoulder_L UpperArm_L LowerArm_L Hand_L UpperLeg_L LowerLeg_L Foot_L Toes_L",
    TAIL,
    (0.80, 0.81),
)
DAZ = Expected(
    "hip abdomen chest neck head",
    "lCollar lShldr lForeArm lHand lThigh lShin lFoot -",
    ("l", "r"),
    (0.82, 0.83),
)
ICLONE = Expected(
    "CC_Base_Hip CC_Base_Waist CC_Base_Spine02 CC_Base_NeckTwist01 CC_Base_Head",
    "CC_Base_L_Clavicle CC_Base_L_Upperarm CC_Base_L_Forearm CC_Base_L_Hand "
    "CC_Base_L_Thigh CC_Base_L_Calf CC_Base_L_Foot CC_Base_L_ToeBase",
    HEAD,
    (0.97, 0.98),
)
REACTIDLE = Expected(
    "pelvis spine spine.001 neck face",
    "shoulder.L upper_arm.L forearm.L - thigh.L shin.L foot.L -",
    (".L", ".R"),
    (0.61, 0.83),
    unit=1.0,
)
POSED = Expected(
    "Root Spine1 Spine3 Neck Head",
    "Clavicle_L UpArm_L LoArm_L Hand_L UpLeg_L LoLeg_L Foot_L Toe_L",
    TAIL,
    (0.78, 0.83),
    Z,
    BACK,
    0.1,
)
OLD = Expected(
    "Hips - Chest Neck Head",
    "LeftCollar LeftUpArm LeftLowArm LeftHand LeftUpLeg LeftLowLeg LeftFoot -",
    WORDS,
    (0.89, 0.91),
    unit=0.0254,
)
HABIT = Expected(  # the habit of many exporters: Spine, Spine1, ... and toes
    "Hips Spine Spine3 Neck Head",
    "LeftShoulder LeftArm LeftForeArm LeftHand LeftUpLeg LeftLeg LeftFoot LeftToeBase",
    WORDS,
    (0.76, 0.88),
)
COLLARS = Expected(
    "Hips Chest Chest4 Neck Head",
    "LeftCollar LeftShoulder LeftElbow LeftWrist LeftHip LeftKnee LeftAnkle LeftToe",
    WORDS,
    (0.74, 0.75),
)
NO_TOES = " ".join(COLLARS.left.split()[:-1]) + " -"

FOLDERS: Mapping[str, Expected] = {
    "bandai1": BANDAI,
    "bandai2": BANDAI,
    "cmu_daz": DAZ,
    "cmu_60fps_badheader": DAZ,
    "cmu_iclone100j": ICLONE,
    "cmu_mb_misc": CAPTURE,
    "reactidle": REACTIDLE,
    "stylized_outputs": CAPTURE,
    "xia": CAPTURE,
}
FILES: Mapping[str, Expected] = {
    "exporters/10_02": replace(
        COLLARS, trunk="Hips Chest CS_BVH Neck Head", left=NO_TOES, legs=(0.92, 0.93), unit=0.0254
    ),
    "exporters/Geno_bind": HABIT,
    "exporters/bvh_example": replace(HABIT, up=Z, forward=(0.0, 1.0, 0.0), unit=0.0254),
    "exporters/bvh_test3": replace(
        HABIT, left=HABIT.left.replace("ToeBase", "ForeFoot"), up=Z, forward=BACK, unit=0.0254
    ),
    "exporters/custom_skeleton_walk_example": Expected(
        "FK_back1_jnt FK_back2_jnt FK_back3_jnt FK_back4_jnt head_jnt",
        "L_shoulder_jnt L_upArm_jnt L_lowArm_jnt L_hand_jnt L_upLeg_jnt L_lowLeg_jnt L_foot_jnt L_toe_jnt",
        HEAD,
        (0.83, 0.84),
    ),
    "exporters/dab": replace(HABIT, up=Z, forward=BACK, unit=0.87 / 21.676),
    "exporters/dance1": POSED,
    "exporters/example": CAPTURE,
    "exporters/jesse_dance": replace(HABIT, trunk="Hips Spine Spine2 Neck Head"),
    "exporters/jumping": replace(HABIT, up=Z, forward=BACK, unit=0.87 / 21.676),
    "exporters/louise": replace(COLLARS, trunk="Hips - Chest Neck Head", left=NO_TOES, legs=(0.88, 0.89)),
    "exporters/makehuman_tpose": Expected(
        "root spine05 spine01 neck01 head",
        "clavicle.L upperarm01.L lowerarm01.L wrist.L upperleg01.L lowerleg01.L foot.L metatarsal1.L",
        (".L", ".R"),
        (0.81, 0.82),
        Z,
        BACK,
        0.1,
    ),
    "exporters/milad": replace(HABIT, left=HABIT.left.replace("LeftToeBase", "-")),
    "exporters/sample": COLLARS,
    "exporters/simple": replace(OLD, forward=(0.0, 0.0, -1.0), unit=0.0254 / 0.45),
    "exporters/standard_skeleton": replace(HABIT, up=Z, forward=(0.0, 1.0, 0.0), unit=0.0254),
    "exporters/test-bvh-files_example": OLD,
    "exporters/test_freebvh": Expected(
        " ".join(f"mixamorig:{n}" for n in ["Hips", "Spine", "Spine2", "Neck", "Head"]),
        " ".join(f"mixamorig:{n}" for n in HABIT.left.split()),
        WORDS,
        (0.82, 0.83),
    ),
    "exporters/test_mocapbank": replace(
        COLLARS, trunk="Hips Chest Chest2 Neck Head", left=NO_TOES, legs=(0.87, 0.88)
    ),
    "exporters/walk01": replace(
        HABIT,
        trunk="Hips Spine Spine1 Neck Head",
        left=HABIT.left.replace("LeftToeBase", "-"),
        legs=(0.92, 0.93),
    ),
    "exporters/walk1": POSED,
    "exporters/zombieWalk1": POSED,
    "malformed/Boxing_Toes": replace(
        COLLARS, trunk="Hips Ab Chest Neck Head", left=COLLARS.left + "s", legs=(0.85, 0.86)
    ),
}
# Not a humanoid: which needed roles the error must ask for.
NO_BODY = {
    "cmu_mb_misc/oneFrame": {"right_hip", "left_ankle", "left_shoulder", "right_elbow"},
    "exporters/full_precision_frame_time": {"left_hip", "right_knee", "left_shoulder", "right_elbow"},
    "exporters/rotation_first_root": {"right_hip", "left_ankle", "left_shoulder", "right_elbow"},
}
# What names alone can tell. Anonymous, these clips give another answer in the roles named here.
NAMES_NEEDED = {
    "cmu_mb_misc/05_01": ("wrist",),  # forearms half as long as upper arms
    "cmu_mb_misc/05_06": ("wrist",),
    "cmu_mb_misc/backflip": ("wrist",),
    "exporters/bvh_test3": ("ankle", "toe"),  # the toe joint is in the heel
    "exporters/dance1": ("collar",),  # two collar bones in a row, neither moves
    "exporters/walk1": ("collar",),
    "exporters/zombieWalk1": ("collar",),
    # straight feet, so no front; arms longer than legs
    "exporters/simple": ("collar", "shoulder", "elbow", "wrist", "hip", "knee", "ankle"),
}


def clip(data: Path, name: str) -> Motion:
    return formats.load(data / f"{name}.bvh", salvage=name.startswith(("malformed", "cmu_60fps")))


def names_of(data: Path, folder: str) -> list[str]:
    found = sorted((data / folder).glob("*.bvh"))
    return [f"{folder}/{p.stem}" for p in found if f"{folder}/{p.stem}" not in NO_BODY]


def assert_found(name: str, motion: Motion, expected: Expected) -> Body:
    body = Body.of(motion)
    assert {r: motion.skeleton.names[j] for r, j in body.roles.items()} == expected.roles, name
    np.testing.assert_array_equal(body.up, expected.up, err_msg=name)
    np.testing.assert_allclose(body.forward, expected.forward, atol=1e-9, err_msg=name)
    assert expected.legs[0] <= body.leg_length * body.metres_per_unit <= expected.legs[1], name
    assert body.metres_per_unit == pytest.approx(expected.unit, rel=1e-3), name
    if name != "exporters/simple":  # a drawing, not a person
        assert 1.65 < body.height / body.leg_length < 2.45, name
    assert_neutral(name, motion, body)
    assert_anonymous(name, motion, body)
    return body


def assert_neutral(name: str, motion: Motion, body: Body) -> None:
    """The neutral stance stands upright and faces forward, whatever the clip does."""
    if name == "exporters/makehuman_tpose":
        return  # its position channels fold the whole body into one point
    offsets = np.median(motion.translations, axis=0)
    points = fk(body.neutral[None], offsets[None], motion.skeleton.parents)[1]
    assert abs(heading(points, body)[0]) < 0.01, name
    place = {role: points[0, joint] for role, joint in body.roles.items()}
    for side, sign in (("left", 1.0), ("right", -1.0)):
        shank = place[f"{side}_knee"] - place[f"{side}_ankle"]
        assert shank @ body.up > 0.999 * np.linalg.norm(shank), name
        arm = place[f"{side}_shoulder"] - place[f"{side}_elbow"]
        assert arm @ body.up > 0.98 * np.linalg.norm(arm), name
        assert (place[f"{side}_shoulder"] - place["hips"]) @ (sign * body.left) > 0, name
    assert (place["head"] - place["hips"]) @ body.up > 0.5 * body.leg_length, name


def assert_anonymous(name: str, motion: Motion, body: Body) -> None:
    """The same answer when no joint has a name that says anything."""
    plain = tuple(f"joint_{i}" for i in range(len(motion.skeleton)))
    other = Body.of(motion.with_(skeleton=replace(motion.skeleton, names=plain)))
    differ = {r for r in body.roles.keys() | other.roles.keys() if body.roles.get(r) != other.roles.get(r)}
    assert {r.split("_")[1] for r in differ} <= set(NAMES_NEEDED.get(name, ())), name


@pytest.mark.parametrize("name", FILES)
def test_clips_of_many_exporters(data: Path, name: str) -> None:
    assert_found(name, clip(data, name), FILES[name])


@pytest.mark.parametrize("folder", FOLDERS)
def test_every_clip_of_a_folder(data: Path, folder: str) -> None:
    clips = names_of(data, folder)
    assert clips
    floors = []
    for name in clips:
        body = assert_found(name, clip(data, name), FOLDERS[folder])
        floors.append(body.floor / body.leg_length)
    # Captures are levelled: the floor is near zero except where the clip has no root of its own to stand on.
    if folder not in ("reactidle", "cmu_iclone100j"):
        assert np.abs(np.median(floors)) < 0.1, floors


def test_the_table_names_every_skeleton(data: Path) -> None:
    found = {f"{p.parent.name}/{p.stem}" for p in data.glob("*/*.bvh")}
    listed = set(FILES) | set(NO_BODY) | {n for folder in FOLDERS for n in names_of(data, folder)}
    assert found - listed == {"malformed/kick_1row_of_61"}  # its header is broken


@pytest.mark.parametrize("name", NO_BODY)
def test_what_is_no_humanoid_is_refused_with_the_lines_to_add(data: Path, name: str) -> None:
    motion = clip(data, name)
    with pytest.raises(BodyError) as error:
        Body.of(motion)
    lines = str(error.value).split("[roles]\n")[1]
    assert all(f'{role} = "..."' in lines for role in NO_BODY[name])
    assert all(joint in str(error.value) for joint in motion.skeleton.names)
