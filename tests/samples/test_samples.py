"""Laws of every sample: whatever the skeleton, unit, up axis, heading and frame rate, the same motion."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mien.errors import MienError
from mien.formats import load, save
from mien.kinematics.fk import end_positions, world
from mien.samples import SAMPLES, SKELETONS, Sample, walk

Places = Callable[[Sample], dict[str, np.ndarray]]
every_sample = pytest.mark.parametrize("name", SAMPLES)
every_skeleton = pytest.mark.parametrize("skeleton", SKELETONS)
# From the y-up axes (x left, z forward) to the z-up ones (x left, -y forward).
TO_Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
# The widest ranges of healthy adults, degrees (AAOS, rounded up); elevation of the arm to the vertical.
RANGES = {"knee": (0, 150), "hip": (-30, 125), "ankle": (-55, 45), "elbow": (0, 150), "shoulder": (-60, 180)}


@every_sample
@every_skeleton
def test_the_joints_of_a_role_are_at_the_same_place_on_every_skeleton(
    name: str, skeleton: str, places: Places
) -> None:
    expected, sample = places(SAMPLES[name](unit="m")), SAMPLES[name](unit="m", skeleton=skeleton)
    found = places(sample)
    assert found.keys() == expected.keys()
    for role, place in expected.items():
        np.testing.assert_allclose(found[role], place, atol=1e-9 * sample.leg_length, err_msg=role)


@every_skeleton
@pytest.mark.parametrize(
    ("unit", "metres"), [("cm", 0.01), ("mm", 0.001), ("inch", 0.0254), ("foot", 0.3048)]
)
def test_the_unit_scales_and_nothing_else(skeleton: str, unit: str, metres: float, places: Places) -> None:
    a, b = walk(seconds=0.3, unit="m", skeleton=skeleton), walk(seconds=0.3, unit=unit, skeleton=skeleton)
    assert b.metres_per_unit == metres
    assert b.leg_length * metres == pytest.approx(a.leg_length)
    assert b.facts["step_length"] * metres == pytest.approx(0.7)
    assert b.facts["cadence"] == a.facts["cadence"] == 1.8
    np.testing.assert_allclose(b.motion.rotations, a.motion.rotations, atol=1e-12)
    for role, place in places(b).items():
        np.testing.assert_allclose(place * metres, places(a)[role], atol=1e-9)


@every_skeleton
def test_z_up_is_the_same_motion_in_other_axes(skeleton: str, places: Places) -> None:
    y, z = walk(seconds=0.5, skeleton=skeleton), walk(seconds=0.5, skeleton=skeleton, up="z")
    for role, place in places(y).items():
        np.testing.assert_allclose(places(z)[role], place @ TO_Z_UP.T, atol=1e-9 * y.leg_length)
    np.testing.assert_allclose(z.up, TO_Z_UP @ y.up)
    np.testing.assert_allclose(z.forward, TO_Z_UP @ y.forward, atol=1e-15)


@every_sample
@pytest.mark.parametrize("up", ["y", "z"])
def test_heading_turns_the_whole_motion_about_up(name: str, up: str, places: Places) -> None:
    straight, turned = SAMPLES[name](up=up), SAMPLES[name](up=up, heading=2.3, skeleton="engine23")
    about = Rotation.from_rotvec(2.3 * straight.up)
    np.testing.assert_allclose(turned.forward, about.apply(straight.forward), atol=1e-12)
    for role, place in places(straight).items():
        np.testing.assert_allclose(places(turned)[role], about.apply(place), atol=1e-9 * straight.leg_length)


@every_sample
@pytest.mark.parametrize("fps", [24.0, 30.0, 120.0, 240.0])
def test_the_frame_rate_only_samples(name: str, fps: float, places: Places) -> None:
    # 6 frames a second divide all these rates, so those moments are common to both clips.
    a, b = SAMPLES[name](fps=6.0, seconds=2.0), SAMPLES[name](fps=fps, seconds=2.0)
    step = int(fps / 6)
    assert len(b.motion) == 2 * fps + 1
    for role, place in places(a).items():
        np.testing.assert_allclose(places(b)[role][::step], place, atol=1e-9 * a.leg_length)
    for angle, values in a.angles.items():
        np.testing.assert_allclose(b.angles[angle][::step], values, atol=1e-9)
    np.testing.assert_array_equal(b.contacts[::step], a.contacts)
    assert a.events == b.events


@every_sample
@every_skeleton
def test_bones_keep_their_length_and_rotations_do_not_jump(name: str, skeleton: str) -> None:
    motion = SAMPLES[name](skeleton=skeleton).motion
    moving = (motion.translations != motion.skeleton.offsets).any(axis=(0, 2))
    assert moving.sum() == 1
    turned = np.einsum("tji,tji->tj", motion.rotations[1:], motion.rotations[:-1])
    assert turned.min() > 0.9  # less than 52 degrees a frame, on the same side of the sphere


@every_sample
@pytest.mark.parametrize("seconds", [0.0, 0.017, 0.034])
def test_one_two_and_three_frames(name: str, seconds: float) -> None:
    sample = SAMPLES[name](seconds=seconds)
    frames = len(sample.motion)
    assert frames == round(seconds * 60) + 1
    assert sample.contacts.shape == (frames, 2, 2)
    assert np.isfinite(sample.motion.rotations).all()
    assert all(values.shape == (frames,) and np.isfinite(values).all() for values in sample.angles.values())


@every_sample
def test_joint_angles_are_those_of_a_human(name: str) -> None:
    angles = SAMPLES[name](fps=240.0).angles
    for side in ("left", "right"):
        for joint, (low, high) in RANGES.items():
            degrees = np.degrees(angles[f"{side}_{joint}"])
            assert low <= degrees.min(), (side, joint)
            assert degrees.max() <= high, (side, joint)
    assert np.degrees(min(angles["left_knee"].min(), angles["right_knee"].min())) > 2.0  # never locked


@every_sample
def test_knee_and_elbow_angles_are_those_between_the_bones(name: str, places: Places) -> None:
    sample = SAMPLES[name]()
    at = places(sample)
    for side in ("left", "right"):
        for joint, above, below in (("knee", "hip", "ankle"), ("elbow", "shoulder", "wrist")):
            a = at[f"{side}_{joint}"] - at[f"{side}_{above}"]
            b = at[f"{side}_{below}"] - at[f"{side}_{joint}"]
            between = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ti,ti->t", a, b))
            np.testing.assert_allclose(sample.angles[f"{side}_{joint}"], between, atol=1e-7)


@every_sample
def test_knees_bend_forwards(name: str, places: Places) -> None:
    at, up = places(SAMPLES[name]()), np.array([0.0, 1.0, 0.0])
    facing = np.cross(at["left_hip"] - at["right_hip"], up)
    for side in ("left", "right"):
        halfway = 0.5 * (at[f"{side}_hip"] + at[f"{side}_ankle"])
        assert (np.einsum("ti,ti->t", at[f"{side}_knee"] - halfway, facing) > 0).all()


@every_sample
def test_nothing_is_below_the_floor(name: str) -> None:
    sample = SAMPLES[name](fps=240.0, unit="m")
    rotations, positions = world(sample.motion)
    ends = end_positions(sample.motion, rotations, positions)
    assert min(positions[..., 1].min(), ends[..., 1].min()) > 0.0


@every_sample
def test_what_stands_does_not_move(name: str, places: Places) -> None:
    """Flat, the ankle stays where it is; on the toes, the toe joint."""
    sample = SAMPLES[name](fps=120.0)
    at, tolerance = places(sample), 1e-9 * sample.leg_length
    for i, side in enumerate(("left", "right")):
        heel, toe = sample.contacts[:, i].T
        for stands, role in ((heel & toe, "ankle"), (toe, "toe")):
            both = stands[1:] & stands[:-1]
            steps = np.linalg.norm(np.diff(at[f"{side}_{role}"], axis=0), axis=1)
            assert both.any() or name == "spin" or not stands.any()
            assert (steps[both] <= tolerance).all(), (side, role)


@every_sample
def test_what_is_said_to_be_off_the_floor_is_higher_or_turned(name: str, places: Places) -> None:
    sample = SAMPLES[name](fps=120.0, unit="m")
    if name == "spin":
        pytest.skip("nothing is planted on a turning plate")
    at = places(sample)
    for i, side in enumerate(("left", "right")):
        heel, toe = sample.contacts[:, i].T
        flat_ankle, flat_toe = 0.039 * 1.75, 0.011 * 1.75  # the figure's heights over the sole
        ankle, tip = at[f"{side}_ankle"][:, 1], at[f"{side}_toe"][:, 1]
        np.testing.assert_allclose(ankle[heel & toe], flat_ankle, atol=1e-9)
        np.testing.assert_allclose(tip[toe], flat_toe, atol=1e-9)
        assert (tip[~toe] > flat_toe + 1e-9).all()
        assert (ankle[~heel] > flat_ankle - 1e-9).all()


@every_skeleton
@pytest.mark.parametrize("up", ["y", "z"])
def test_a_saved_file_holds_the_same_motion(skeleton: str, up: str, tmp_path: object, places: Places) -> None:
    sample = walk(seconds=0.5, skeleton=skeleton, up=up, heading=1.0)
    save(sample.motion, f"{tmp_path}/walk.bvh")
    again = load(f"{tmp_path}/walk.bvh")
    assert again.skeleton.names == sample.motion.skeleton.names
    np.testing.assert_allclose(world(again)[1], world(sample.motion)[1], atol=1e-5 * sample.leg_length)


def test_wrong_forms_are_refused_with_what_would_fit() -> None:
    for wrong, message in (
        ({"unit": "metre"}, "unit"),
        ({"up": "x"}, "up axis"),
        ({"skeleton": "standrd22"}, "did you mean 'standard22'"),
        ({"fps": 0.0}, "fps"),
        ({"fps": float("nan")}, "fps"),
        ({"seconds": -1.0}, "seconds"),
        ({"heading": float("inf")}, "heading"),
    ):
        with pytest.raises(MienError, match=message):
            walk(**wrong)
    with pytest.raises(TypeError):
        walk(speed=3)
