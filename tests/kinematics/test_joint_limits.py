"""Joint angles in anatomy's terms, and what is beyond the range of a body."""

from dataclasses import replace

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.joint_angles import joint_angles
from mien.kinematics.joint_limits import JOINTS, JointAngles
from mien.kinematics.mirroring import mirrored
from mien.motion import Motion
from mien.rotations import quaternion as quat
from mien.samples import SKELETONS
from mien.samples.gestures import REST
from mien.samples.pose import build
from mien.samples.sample import Truth, sample


def angles(motion: Motion) -> dict[str, np.ndarray]:
    found = joint_angles(motion, Body.of(motion), world(motion)[0])
    return dict(zip(found.names, np.moveaxis(found.angles, 1, 0), strict=True))


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_knees_and_elbows_of_a_walk(skeleton: str) -> None:
    truth = samples.walk(seconds=2.0, skeleton=skeleton)
    found = angles(truth.motion)
    for role in ("knee", "elbow"):
        for side in ("left", "right"):
            wanted = np.degrees(truth.angles[f"{side}_{role}"])
            np.testing.assert_allclose(found[f"{side}_{role}"][:, 0], wanted, atol=4.0)


def posed(**arm: float) -> Motion:
    """A statue whose left arm has some joint angles, in degrees."""
    from mien.samples.gestures import statue

    pose, contacts = statue(np.arange(3) / 60.0)
    left = replace(REST, abduction=0.0, rotation=0.0, elbow=0.0, flexion=0.0)
    left = replace(left, **{k: np.radians(v) for k, v in arm.items()})
    figure, known = build(replace(pose, arms={"left": left, "right": REST}))
    return sample("posed", figure, Truth(contacts, known)).motion


@pytest.mark.parametrize(
    ("arm", "role", "axis", "wanted"),
    [
        ({"flexion": 60.0}, "left_shoulder", 0, 60.0),
        ({"flexion": -40.0}, "left_shoulder", 0, -40.0),
        ({"abduction": 50.0}, "left_shoulder", 1, 42.0),  # the calm stance has arms 8 degrees out
        ({"elbow": 90.0}, "left_elbow", 0, 90.0),
    ],
)
def test_signs_are_those_of_anatomy(arm: dict[str, float], role: str, axis: int, wanted: float) -> None:
    assert angles(posed(**arm))[role][0, axis] == pytest.approx(wanted, abs=2.5)


def test_a_mirrored_motion_has_its_sides_swapped() -> None:
    motion = samples.wave(seconds=2.0).motion
    rotations, translations = mirrored(motion, Body.of(motion))
    here, there = angles(motion), angles(motion.with_(rotations=rotations, translations=translations))
    for name, found in here.items():
        if name.startswith("left"):
            np.testing.assert_allclose(found, there[name.replace("left", "right")], atol=0.5)
    np.testing.assert_allclose(here["chest"] * [1, -1, -1], there["chest"], atol=0.5)


def test_heading_and_place_do_not_matter() -> None:
    one, other = (samples.walk(seconds=1.0, heading=h).motion for h in (0.0, 2.0))
    for name, found in angles(one).items():
        np.testing.assert_allclose(found, angles(other)[name], atol=1e-6)


def single(name: str, flexion: float, abduction: float = 0.0, rotation: float = 0.0) -> float:
    return float(JointAngles((name,), np.array([[[flexion, abduction, rotation]]])).beyond()[0, 0])


def test_inside_the_range_nothing_is_beyond() -> None:
    for role, (_, able) in JOINTS.items():
        name = role if role in ("chest", "head") else f"left_{role}"
        for value in (*able.flexion, 0.0):
            assert single(name, value) == pytest.approx(0.0, abs=1e-9)
        for value in able.rotation:
            assert single(name, 0.0, 0.0, value) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "angle", "beyond"),
    [
        ("left_knee", (-30.0, 0.0, 0.0), 20.0),
        ("right_knee", (170.0, 0.0, 0.0), 12.0),
        ("left_elbow", (20.0, 45.0, 0.0), 15.0),
        ("head", (90.0, 0.0, 0.0), 30.0),
        ("head", (0.0, 0.0, 100.0), 15.0),
        ("left_hip", (-60.0, 0.0, 0.0), 20.0),
        ("left_shoulder", (-150.0, 0.0, 150.0), 0.0),  # overhead nothing can be said
    ],
)
def test_what_is_beyond(name: str, angle: tuple[float, float, float], beyond: float) -> None:
    assert single(name, *angle) == pytest.approx(beyond, abs=1e-9)


def test_swing_is_bounded_by_an_ellipse() -> None:
    """Half of both limits at once is inside, 0.8 of both is not: hypot(0.8, 0.8) = 1.13."""
    assert single("left_hip", 65.0, 30.0) == 0.0
    wanted = np.hypot(104.0, 48.0) * (1.0 - 1.0 / np.hypot(0.8, 0.8))
    assert single("left_hip", 104.0, 48.0) == pytest.approx(wanted)


def test_a_knee_bent_backwards_is_seen_in_the_motion() -> None:
    motion = samples.walk(seconds=1.0).motion
    body = Body.of(motion)
    knee = body.roles["left_knee"]
    stretch = np.array(motion.rotations)
    bend = angles(motion)["left_knee"][:, 0] + 40.0
    axis = quat.rotate(quat.conjugate(world(motion)[0][:, knee]), np.tile(body.left, (len(motion), 1)))
    turn = quat.exp(-np.radians(bend)[:, None] * axis)
    stretch[:, knee] = quat.multiply(stretch[:, knee], turn)
    wrong = motion.with_(rotations=stretch, reference=motion)
    found = joint_angles(wrong, Body.of(wrong), world(wrong)[0])
    at = found.names.index("left_knee")
    assert found.beyond()[:, at].max() == pytest.approx(30.0, abs=8.0)


def test_captured_walks_are_inside(data) -> None:
    import mien

    for name in ("bandai1/dataset-1_walk_normal_001.bvh", "cmu_daz/02_01.bvh", "xia/neutral_01_000.bvh"):
        motion = mien.load(data / name)[5:]
        body = Body.of(motion)
        assert joint_angles(motion, body, world(motion)[0]).beyond().max() < 5.0, name
