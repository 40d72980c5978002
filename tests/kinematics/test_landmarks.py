"""The nineteen places: the same on every skeleton, and found where joints are missing."""

from dataclasses import replace

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.landmarks import LANDMARKS, landmarks


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_places_are_the_joints_of_the_roles(skeleton: str) -> None:
    motion = samples.walk(seconds=0.5, fps=30.0, skeleton=skeleton).motion
    body, positions = Body.of(motion), world(motion)[1]
    marks = landmarks(motion, body)
    assert marks.points.shape == (len(motion), len(LANDMARKS), 3)
    for place, role in (
        ("pelvis", "hips"),
        ("head", "head"),
        ("left_hand", "left_wrist"),
        ("right_foot", "right_ankle"),
        ("left_knee", "left_knee"),
    ):
        np.testing.assert_array_equal(marks[place], positions[:, body.roles[role]])


@pytest.mark.parametrize(
    ("gone", "place", "near"),
    [
        (("left_wrist", "right_wrist"), "left_hand", 0.07),
        (("right_toe",), "right_toe", 0.3),
        (("head", "neck"), "head", 0.07),
        (("neck",), "neck", 0.15),
    ],
)
@pytest.mark.parametrize("name", ["walk", "wave"])
def test_a_missing_joint_is_replaced_by_a_point_nearby(
    name: str, gone: tuple[str, ...], place: str, near: float
) -> None:
    """``near`` in leg lengths; a toe without anything to tell it by is the ankle."""
    motion = samples.SAMPLES[name](seconds=1.0, fps=30.0).motion
    body = Body.of(motion)
    less = replace(body, roles={role: j for role, j in body.roles.items() if role not in gone})
    whole, found = landmarks(motion, body), landmarks(motion, less)
    assert (np.linalg.norm(found[place] - whole[place], axis=1) < near * body.leg_length).all()
    for other in ("pelvis", "left_hip", "right_elbow", "right_foot", "left_shoulder"):
        np.testing.assert_array_equal(found[other], whole[other])


def test_a_hand_without_a_wrist_is_the_tip_of_the_forearm() -> None:
    motion = samples.walk(seconds=0.5, fps=30.0).motion
    body, skeleton = Body.of(motion), motion.skeleton
    elbow, tip = body.roles["left_elbow"], np.array([7.0, 0.0, 0.0])
    made = motion.with_(
        skeleton=replace(
            skeleton,
            end_parents=np.append(skeleton.end_parents, elbow),
            end_offsets=np.concatenate([skeleton.end_offsets, tip[None]]),
            layout=None,
        ),
        source=None,
    )
    less = replace(body, roles={role: j for role, j in body.roles.items() if role != "left_wrist"})
    found = landmarks(made, less)
    away = np.linalg.norm(found["left_hand"] - found["left_elbow"], axis=1)
    np.testing.assert_allclose(away, 7.0)


def test_a_spine_of_one_joint_and_none() -> None:
    motion = samples.walk(seconds=0.5, fps=30.0).motion
    body = Body.of(motion)
    whole = landmarks(motion, body)
    one = landmarks(motion, replace(body, spine=body.spine[-1:]))
    np.testing.assert_array_equal(one["chest"], whole["chest"])
    np.testing.assert_allclose(one["spine"], 0.5 * (whole["pelvis"] + whole["chest"]))
    roles = {role: j for role, j in body.roles.items() if role not in ("spine", "chest")}
    none = landmarks(motion, replace(body, spine=(), roles=roles))
    np.testing.assert_allclose(none["chest"], 0.5 * (whole["left_shoulder"] + whole["right_shoulder"]))
