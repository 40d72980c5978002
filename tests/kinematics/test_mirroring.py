"""Partners by role, name and place; mirrors on skeletons with any local axes."""

import numpy as np
import pytest

from mien import samples
from mien.edits.mirror import mirror
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.mirroring import _mirrored_names, partners
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion as quat


@pytest.mark.parametrize(
    ("name", "other"),
    [
        ("LeftHandThumb1", "RightHandThumb1"),
        ("lThumb2", "rThumb2"),
        ("hand.L", "hand.R"),
        ("Index1_R", "Index1_L"),
        ("CC_Base_L_Mid3", "CC_Base_R_Mid3"),
        ("RThumb", "LThumb"),
        ("mixamorig:RightHandRing2", "mixamorig:LeftHandRing2"),
        ("upperarm_twist_01_l", "upperarm_twist_01_r"),
        ("左ひじ", "右ひじ"),
    ],
)
def test_a_name_gives_its_other_side(name: str, other: str) -> None:
    assert other in _mirrored_names(name)


@pytest.mark.parametrize("name", ["Spine", "Head", "neck_01", "pelvis", "Root", "LowerBack", "Roll"])
def test_a_name_without_a_side_has_no_other(name: str) -> None:
    assert _mirrored_names(name) == []


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_partners_are_mutual_and_follow_the_names(skeleton: str) -> None:
    sample = samples.still(seconds=0.2, skeleton=skeleton)
    motion, body = sample.motion, Body.of(sample.motion)
    partner = partners(motion.skeleton, body)
    assert (partner >= 0).all()
    np.testing.assert_array_equal(partner[partner], np.arange(len(partner)))
    for role, joint in body.roles.items():
        side, _, rest = role.partition("_")
        other = {"left": f"right_{rest}", "right": f"left_{rest}"}.get(side, role)
        assert partner[joint] == body.roles[other]
    for joint, other in enumerate(partner):
        middle = body.parts_of[joint] in ("", "torso", "head") and "Eye" not in motion.skeleton.names[joint]
        assert (joint == other) == middle


def test_fingers_without_a_side_in_their_names_pair_by_place() -> None:
    sample = samples.still(seconds=0.2, skeleton="poser43")
    motion, body = sample.motion, Body.of(sample.motion)
    known = partners(motion.skeleton, body)
    roles = set(body.roles.values())
    names = [name if j in roles else f"joint {j}" for j, name in enumerate(motion.skeleton.names)]
    plain = Skeleton(tuple(names), motion.skeleton.parents, motion.skeleton.offsets)
    found = partners(plain, body)
    below = [j for j, part in enumerate(body.parts_of) if part.endswith("arm") and j not in roles]
    assert below
    np.testing.assert_array_equal(found[below], known[below])


def rerigged(motion: Motion, seed: int) -> Motion:
    """The same movement on a skeleton whose every joint has other, unrelated axes of its own."""
    rng = np.random.default_rng(seed)
    joints, parents = len(motion.skeleton), motion.skeleton.parents
    turn = quat.normalise(rng.normal(size=(joints, 4)))
    above = np.where((parents >= 0)[:, None], turn[parents], quat.IDENTITY)
    rotations = quat.multiply(quat.multiply(quat.conjugate(above), motion.rotations), turn)
    translations = quat.rotate(quat.conjugate(above), motion.translations)
    skeleton = Skeleton(
        motion.skeleton.names, parents, quat.rotate(quat.conjugate(above), motion.skeleton.offsets)
    )
    return Motion(skeleton, quat.continuous(rotations), translations, motion.frame_time)


@pytest.mark.parametrize("clip", ["wave", "turn"])
def test_own_axes_of_the_joints_do_not_matter(clip: str) -> None:
    """A skeleton whose left and right axes have nothing to do with each other mirrors to the same picture."""
    plain = getattr(samples, clip)(seconds=2.0).motion
    odd = rerigged(plain, seed=3)
    unit = Body.of(plain).leg_length
    np.testing.assert_allclose(world(odd)[1], world(plain)[1], atol=1e-9 * unit)
    np.testing.assert_allclose(world(mirror(odd))[1], world(mirror(plain))[1], atol=0.01 * unit)


def test_what_slides_on_one_side_slides_on_the_other() -> None:
    """A bone that grows at the left elbow grows by the same at the right one after the mirror."""
    motion = samples.still(seconds=1.0, skeleton="engine23").motion
    body = Body.of(motion)
    left, right = body.roles["left_wrist"], body.roles["right_wrist"]
    translations = np.array(motion.translations)
    grow = 1.0 + 0.1 * np.sin(np.linspace(0, 6, len(motion)))[:, None]
    translations[:, left] *= grow
    after = mirror(motion.with_(translations=translations))
    found = np.linalg.norm(after.translations[:, right], axis=-1)
    expected = np.linalg.norm(translations[:, left], axis=-1)
    np.testing.assert_allclose(found - found.mean(), expected - expected.mean(), atol=1e-9 * body.leg_length)
    assert np.ptp(np.linalg.norm(after.translations[:, left], axis=-1)) < 1e-9
