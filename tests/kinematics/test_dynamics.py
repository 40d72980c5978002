"""Forces: cases that mechanics knows in closed form."""

import numpy as np
import pytest

from mien import samples
from mien.edits.pipeline import apply
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect_points, foot_points
from mien.kinematics.dynamics import STRENGTH, Dynamics, dynamics
from mien.kinematics.fk import world
from mien.kinematics.mass import GRAVITY, mass_model
from mien.motion import Motion
from mien.recipe import Step
from mien.samples import SKELETONS


def forces(motion: Motion) -> Dynamics:
    body = Body.of(motion)
    rotations, positions = world(motion)
    feet = foot_points(motion, body, rotations, positions)
    planted = detect_points(feet, body, motion.frame_time).feet
    return dynamics(motion, body, rotations, positions, feet.mean(axis=2), planted)


def along(motion: Motion, vector: np.ndarray) -> np.ndarray:
    body = Body.of(motion)
    return np.stack([vector @ body.forward, vector @ body.left, vector @ body.up], axis=-1)


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_a_statue_weighs_what_it_weighs_above_its_centre(skeleton: str) -> None:
    motion = samples.still(seconds=1.0, sway=0.0, skeleton=skeleton).motion
    found = forces(motion)
    np.testing.assert_allclose(along(motion, found.force), [[0.0, 0.0, GRAVITY]] * len(motion), atol=1e-6)
    under = along(motion, found.zero_moment - found.centre)
    np.testing.assert_allclose(under[:, :2], 0.0, atol=1e-6)


def test_a_body_in_flight_takes_no_force() -> None:
    """The jump sample flies by g; away from take-off and landing, where positions are smoothed over both."""
    truth = samples.jump(fps=120.0)
    found = forces(truth.motion)
    air = np.flatnonzero(~truth.contacts.any(axis=(1, 2)))
    middle = air[len(air) // 3 : -len(air) // 3]
    assert np.linalg.norm(found.force[middle], axis=1).max() < 0.25 * GRAVITY


def test_the_torque_of_a_held_arm_is_its_weight_times_its_lever() -> None:
    """A straight arm held still, level to the front: sum of m g r about the shoulder."""
    swing = samples.pendulum(seconds=0.5, amplitude=np.pi / 2, frequency=0.5, fps=60.0).motion
    level = swing[30:31]
    still = swing.with_(
        rotations=np.repeat(level.rotations, 20, axis=0),
        translations=np.repeat(level.translations, 20, axis=0),
    )
    body = Body.of(swing)
    rotations, positions = world(still)
    model = mass_model(swing, body)
    arm = [i for i, n in enumerate(model.names) if n in ("right_upper_arm", "right_forearm", "right_hand")]
    lever = model.centres(rotations, positions)[0, arm] - positions[0, body.roles["right_shoulder"]]
    lever = (lever @ body.forward) * body.metres_per_unit
    wanted = GRAVITY * float(model.shares[arm] @ lever)
    feet = foot_points(still, body, rotations, positions)
    planted = np.ones((len(still), 2), bool)
    found = dynamics(still, body, rotations, positions, feet.mean(axis=2), planted)
    torque = found.torques[10, found.joints.index("right_shoulder")]
    assert np.linalg.norm(torque) == pytest.approx(wanted, rel=1e-4)
    assert 0.1 < wanted < 0.2  # a twentieth of the mass, 0.3 m out


def test_time_run_faster_takes_the_square_in_acceleration() -> None:
    slow = samples.wave(seconds=4.0, sway=0.0, fps=60.0).motion
    fast = slow.with_(frame_time=slow.frame_time / 2.0)
    pushes = [found.force - found.force.mean(axis=0) for found in (forces(slow), forces(fast))]
    # Smoothing takes some off the faster one.
    ratio = np.abs(pushes[1]).max() / np.abs(pushes[0]).max()
    assert 3.0 < ratio < 4.01


def test_bent_knees_carry_half_the_body_each() -> None:
    """Crouching still: at each knee the ground's half of the weight, less the shank's and foot's own."""
    low = [Step("posture", {"hips_height": -0.3}), Step("foot_plant")]
    motion = apply(samples.still(seconds=0.5, sway=0.0).motion, low)
    body = Body.of(motion)
    rotations, positions = world(motion)
    found, model = forces(motion), mass_model(motion, body)
    centres = model.centres(rotations, positions)[10] * body.metres_per_unit
    feet = foot_points(motion, body, rotations, positions)[10].mean(axis=1) * body.metres_per_unit
    for foot, side in enumerate(("left", "right")):
        knee = positions[10, body.roles[f"{side}_knee"]] * body.metres_per_unit
        wanted = -0.5 * GRAVITY * float((feet[foot] - knee) @ body.forward)
        for segment in ("shank", "foot"):
            at = model.names.index(f"{side}_{segment}")
            wanted += GRAVITY * float(model.shares[at] * ((centres[at] - knee) @ body.forward))
        torque = found.torques[10, found.joints.index(f"{side}_knee")] @ body.left
        # up x forward = left, so a weight in front turns about -left.
        assert torque == pytest.approx(-wanted, rel=0.02)
        assert abs(torque) > 0.5


def test_strengths_are_those_of_the_tables_for_a_man() -> None:
    """75 kg and 1.75 m: hip 207, knee 210, ankle 122, shoulder 127, elbow 101 Nm."""
    one = 75.0 * GRAVITY * 1.75
    for joint, torque in (("hip", 207), ("knee", 210), ("ankle", 122), ("shoulder", 127), ("elbow", 101)):
        assert STRENGTH[joint] * one == pytest.approx(torque, rel=0.01)


def test_very_short_clips() -> None:
    for frames in (1, 2, 3):
        found = forces(samples.walk(seconds=1.0).motion[:frames])
        assert np.isfinite(found.force).all()
        assert np.isfinite(found.torques).all()
