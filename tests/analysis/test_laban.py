"""Laban features: known truth, slow twins, and what must not matter."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull, QhullError

from mien import apply, features, samples
from mien.analysis.laban import MOVING, VOLUMES
from mien.analysis.laban_table import DERIVED, FEATURES, SELECTED
from mien.analysis.windows import WINDOW
from mien.errors import MienError
from mien.kinematics.body import Body
from mien.kinematics.landmarks import LANDMARKS, landmarks
from mien.recipe import Step
from mien.rotations import quaternion

NAMES = [f.name for f in FEATURES]
CLIPS = ("walk", "tired_walk", "knock", "wave", "punch", "jump", "turn", "pendulum")
UP, AHEAD, LEFT = np.eye(3)[[1, 2, 0]]


def column(found, name):
    return found.frames[:, NAMES.index(name)]


def test_a_body_at_rest(made) -> None:
    motion, body = made.pose(90)
    found = features(motion, body=body)
    for f in FEATURES:
        if f.number in (*range(15, 27), 35, 36):
            assert np.abs(column(found, f.name)).max() < 1e-6, f.name
    for d in DERIVED:
        if d.statistic == "std":
            assert abs(found[d.name]) < 1e-9, d.name
    assert found["hip_ground_minus_feet_hip_mean"] == pytest.approx(0.03, abs=0.02), "about an ankle's height"
    assert found["hands_level_below_chest"] == 1.0
    assert found["total_volume"] == pytest.approx(found["volume_of_all_joints_mean"], rel=1e-6)


def test_constant_speed(made) -> None:
    motion, body = made.pose(120)
    speed = 0.7 * body.height  # a second
    found = features(made.carried(motion, body, speed * motion.times[:, None] * AHEAD), body=body)
    for name in MOVING:
        assert found[f"{name}_speed_mean"] == pytest.approx(0.7)
        assert found[f"{name}_speed_std"] == pytest.approx(0.0, abs=1e-9)
        assert found[f"{name}_acceleration_max"] == pytest.approx(0.0, abs=1e-7)
    assert found["pelvis_jerk_max"] == pytest.approx(0.0, abs=1e-5)
    assert found["total_distance"] == pytest.approx(0.7 * WINDOW)
    assert found["area_per_second_mean"] == pytest.approx(0.0, abs=1e-9)
    assert found["deceleration_peaks"] == 0.0


def test_up_and_down_is_no_way_over_the_ground(made) -> None:
    motion, body = made.pose(120)
    bob = 0.05 * body.height * np.sin(2.0 * np.pi * motion.times)
    found = features(made.carried(motion, body, bob[:, None] * UP), body=body)
    assert found["total_distance"] == pytest.approx(0.0, abs=1e-9)
    assert found["pelvis_speed_max"] == pytest.approx(0.1 * np.pi, rel=0.03)
    assert found["pelvis_acceleration_max"] == pytest.approx(0.2 * np.pi**2, rel=0.03)
    assert found["hip_ground_distance_max"] - found["hip_ground_distance_min"] == pytest.approx(0.1, rel=0.02)


def test_a_circle_over_the_ground(made) -> None:
    """One round in one window: the area of the disc, and its rim."""
    motion, body = made.pose(241, fps=60.0)
    angle = 2.0 * np.pi * motion.times / WINDOW
    circle = 0.3 * body.height * (np.cos(angle)[:, None] * LEFT + np.sin(angle)[:, None] * AHEAD)
    found = features(made.carried(motion, body, circle), body=body)
    middle = slice(60, -60)
    kept = 0.5 ** ((1.0 / WINDOW / 6.0) ** 2)  # what the low-pass leaves of the radius
    area = np.pi * (0.3 * kept) ** 2 / WINDOW
    np.testing.assert_allclose(column(found, "area_per_second")[middle], area, rtol=0.02)
    np.testing.assert_allclose(column(found, "total_distance")[middle], 2 * np.pi * 0.3 * kept, rtol=0.01)
    np.testing.assert_allclose(
        column(found, "pelvis_acceleration")[middle], 0.3 * kept * (2 * np.pi / WINDOW) ** 2, rtol=0.01
    )


@pytest.mark.parametrize("fps", [30.0, 120.0])
def test_deceleration_peaks_are_counted(made, fps: float) -> None:
    """A pelvis that brakes twice a second, between 0.7 and 1.3 heights a second."""
    motion, body = made.pose(round(6 * fps) + 1, fps=fps)
    t = motion.times
    way = t + 0.3 / (4 * np.pi) * (1.0 - np.cos(4.0 * np.pi * t))
    found = features(made.carried(motion, body, body.height * way[:, None] * AHEAD), body=body)
    assert found["deceleration_peaks"] == pytest.approx(2.0 * WINDOW, rel=0.1)
    gentle = t + 0.03 / (4 * np.pi) * (1.0 - np.cos(4.0 * np.pi * t))
    calm = features(made.carried(motion, body, body.height * gentle[:, None] * AHEAD), body=body)
    assert calm["deceleration_peaks"] == 0.0, "0.38 heights a second squared is below the limit"


def test_unit_cube(made) -> None:
    """Limbs in the corners of a cube as tall as the body, trunk inside."""
    motion, body = made.pose(3)
    size = body.height
    floor = body.floor * UP
    corners = [size * np.array([x, y, z]) + floor for x, y, z in product((0.0, 1.0), repeat=3)]
    ends = ("hand", "foot", "shoulder", "hip", "elbow", "knee", "toe")
    places = {
        f"{side}_{end}": corners[i % 8] for i, (side, end) in enumerate(product(("left", "right"), ends))
    }
    places |= {
        place: 0.5 * size * np.ones(3) + floor for place in ("pelvis", "spine", "chest", "neck", "head")
    }
    found = features(made.placed(motion, body, places), body=body)
    assert found["volume_of_all_joints_mean"] == pytest.approx(1.0, rel=1e-6)
    assert found["total_volume"] == pytest.approx(1.0, rel=1e-6)


def test_hands_above_the_head_at_the_chest_and_below(made) -> None:
    """One hand is up for a third of the time; the other rises to the chin in the last third."""
    motion, body = made.pose(30)
    marks = landmarks(motion, body)
    head, chest, thigh = (marks[name] for name in ("head", "chest", "left_hip"))
    frames = np.arange(30)[:, None]
    left = np.where(frames < 10, head + 0.1 * body.height * UP, thigh)
    right = np.where(frames >= 20, 0.5 * (head + chest), thigh)
    found = features(made.placed(motion, body, {"left_hand": left, "right_hand": right}), body=body)
    assert found["hands_level_above_head"] == pytest.approx(1.0 / 6.0)
    assert found["hands_level_head_to_chest"] == pytest.approx(1.0 / 6.0)
    assert found["hands_level_below_chest"] == pytest.approx(2.0 / 3.0)
    np.testing.assert_allclose(column(found, "hands_level"), np.repeat([0.5, 0.0, 0.25], 10))


def test_distances_between_places(made) -> None:
    """Each distance by itself: only what it names makes it longer."""
    motion, body = made.pose(2)
    marks, height = landmarks(motion, body), body.height
    found = features(motion, body=body)
    pairs = {
        "left_foot_hip_distance": ("left_foot", "pelvis"),
        "right_hand_shoulder_distance": ("right_hand", "right_shoulder"),
        "hands_distance": ("left_hand", "right_hand"),
        "left_hand_head_distance": ("left_hand", "head"),
        "right_hand_hip_distance": ("right_hand", "pelvis"),
        "feet_distance": ("left_foot", "right_foot"),
        "right_hand_chest_distance": ("right_hand", "chest"),
        "torso_height": ("head", "pelvis"),
    }
    for name, (a, b) in pairs.items():
        expected = np.linalg.norm(marks[a] - marks[b], axis=1) / height
        np.testing.assert_allclose(column(found, name), expected, rtol=1e-12)
    assert column(found, "hip_ground_distance")[0] == pytest.approx(
        (marks["pelvis"][0, 1] - body.floor) / height
    )


def slow_frames(motion) -> np.ndarray:
    """The features of the pose, frame by frame."""
    body = Body.of(motion)
    marks = landmarks(motion, body)
    out = np.zeros((len(motion), 6))
    for t in range(len(motion)):
        p = {name: marks[name][t] / body.height for name in LANDMARKS}
        for g, group in enumerate(VOLUMES):
            try:
                out[t, g] = ConvexHull(np.array([p[name] for name in group])).volume
            except QhullError:
                out[t, g] = 0.0
    return out


@pytest.mark.parametrize("name", ["walk", "wave", "jump"])
def test_volumes_against_qhull_frame_by_frame(name: str) -> None:
    motion = samples.SAMPLES[name](seconds=1.0, fps=30.0).motion
    found = features(motion).frames[:, [26, 27, 30, 31, 32, 33]]
    np.testing.assert_allclose(found, slow_frames(motion), rtol=1e-5, atol=1e-8)


def test_windows_against_loops() -> None:
    motion = samples.walk(seconds=2.5, fps=30.0).motion
    found = features(motion)
    frames, windows, times = found.frames, found.windows(stride=0.2), found.window_times(stride=0.2)
    assert windows.shape == (len(times), 121)
    for row, time in zip(windows, times, strict=True):
        start = round(time * 30.0 - 17.0)
        part, hands = frames[start : start + 35], found.zones[start : start + 35]
        for d, value in zip(DERIVED, row, strict=True):
            x = part[:, d.feature.number - 1]
            expected = {
                "max": max(x),
                "min": min(x),
                "mean": sum(x) / 35.0,
                "std": np.sqrt(sum((x - sum(x) / 35.0) ** 2) / 35.0),
                "window": x[17],
                "above_head": sum(hands[:, 0]) / 35.0,
                "head_to_chest": sum(hands[:, 1]) / 35.0,
                "below_chest": sum(hands[:, 2]) / 35.0,
            }[d.statistic]
            peak = d.feature.component == "Effort" and d.statistic == "max"  # told between frames
            assert value == pytest.approx(expected, rel=0.1 if peak else 1e-9, abs=1e-9), d.name
            assert not peak or value >= expected


def test_the_space_of_a_window_against_qhull() -> None:
    """f35 to f37 of each window on the grid, from the points themselves."""
    motion = samples.turn(seconds=3.0, fps=30.0).motion
    body, found = Body.of(motion), features(motion)
    points = landmarks(motion, body).points / body.height
    for time in found.window_times():
        start = round(time * 30.0 - 17.0)
        cloud = points[start : start + 35]
        middle = start + 17
        assert column(found, "total_volume")[middle] == pytest.approx(ConvexHull(cloud.reshape(-1, 3)).volume)
        ground = cloud[:, 0] - np.outer(cloud[:, 0] @ body.up, body.up)
        way = np.linalg.norm(np.diff(ground, axis=0), axis=1).sum() * 35.0 / 34.0
        assert column(found, "total_distance")[middle] == pytest.approx(way, rel=0.05, abs=0.005)


def test_a_peak_between_two_frames_is_as_high_as_it_is(made) -> None:
    """A pelvis that goes to and fro three times a second, at its quickest between frames."""
    motion, body = made.pose(91)
    sway = 0.05 * body.height * np.sin(2.0 * np.pi * 3.0 * (motion.times + 1.0 / 60.0))
    found = features(made.carried(motion, body, sway[:, None] * LEFT), body=body)
    kept = 0.5 ** ((3.0 / 6.0) ** 2)
    assert found["pelvis_speed_max"] == pytest.approx(0.05 * kept * 6.0 * np.pi, rel=0.02)
    assert column(found, "pelvis_speed")[20:70].max() < 0.96 * 0.05 * kept * 6.0 * np.pi


def close(one, other, share: float) -> None:
    """Assert that two lists of features agree to a share of what the basic feature reaches."""
    reach = {f.number: np.abs(one.frames[:, f.number - 1]).max() for f in FEATURES}
    for d in DERIVED:
        allowed = share * max(reach[d.feature.number], 1e-6)
        assert one[d.name] == pytest.approx(other[d.name], abs=allowed), d.name


@pytest.mark.parametrize(
    "form",
    [
        {"unit": "m"},
        {"unit": "inch"},
        {"up": "z"},
        {"heading": 2.1},
        {"skeleton": "capture31"},
        {"skeleton": samples.SKELETONS[2]},
        {"skeleton": samples.SKELETONS[3]},
    ],
    ids=str,
)
def test_unit_axes_heading_and_skeleton_do_not_matter(form) -> None:
    one, other = (features(samples.walk(seconds=2.0, fps=30.0, **f).motion) for f in ({}, form))
    close(one, other, 1e-5 if "skeleton" not in form else 0.02)


@settings(max_examples=20)
@given(st.integers(0, 10_000), st.floats(-3.0, 3.0), st.floats(0.01, 100.0), st.integers(1, 80))
def test_any_movement_turned_and_scaled(seed: int, yaw: float, scale: float, frames: int) -> None:
    """Limbs flung about at random: numbers stay in range, and heading and size change none of them."""
    rng = np.random.default_rng(seed)
    still = samples.still(seconds=0.0, fps=30.0).motion
    body, joints = Body.of(still), len(still.skeleton)
    t = np.arange(frames)[:, None, None] / 30.0
    swing = rng.normal(0.0, 0.4, (joints, 3)) * np.sin(
        2.0 * np.pi * rng.uniform(0.0, 3.0, (joints, 1)) * t + rng.uniform(0.0, 6.0, (joints, 1))
    )
    rotations = quaternion.multiply(
        np.broadcast_to(still.rotations[0], (frames, joints, 4)), quaternion.exp(swing)
    )
    moved = np.repeat(still.translations[:1], frames, axis=0)
    one = still.with_(rotations=rotations, translations=moved, source=None)
    turn, root = quaternion.exp(yaw * body.up), body.roles["hips"]
    turned = rotations.copy()
    turned[:, root] = quaternion.multiply(turn, turned[:, root])
    way = scale * moved
    way[:, root] = quaternion.rotate(turn, way[:, root])
    skeleton = replace(
        still.skeleton,
        offsets=scale * still.skeleton.offsets,
        end_offsets=scale * still.skeleton.end_offsets,
        layout=None,
    )
    other = still.with_(skeleton=skeleton, rotations=turned, translations=way, source=None)
    larger = replace(
        body, height=scale * body.height, leg_length=scale * body.leg_length, floor=scale * body.floor
    )
    here, there = features(one, body=body), features(other, body=larger)
    assert np.isfinite(here.windows()).all()
    assert (here.frames[:, [i for i in range(37) if i not in (9, 10)]] >= 0.0).all()  # heights may be below 0
    close(here, there, 1e-5)


def test_the_place_does_not_matter(made) -> None:
    motion = samples.knock(seconds=2.0, fps=30.0).motion
    body = Body.of(motion)
    close(features(motion), features(made.carried(motion, body, 500.0 * (AHEAD - LEFT))), 1e-6)


@pytest.mark.parametrize("name", CLIPS)
def test_the_frame_rate_does_not_matter(name: str) -> None:
    one, other = (features(samples.SAMPLES[name](seconds=4.0, fps=fps).motion) for fps in (30.0, 120.0))
    close(one, other, 0.03)


def test_a_mirrored_clip_swaps_left_and_right() -> None:
    motion = samples.knock(seconds=2.0, fps=30.0).motion
    one, other = features(motion), features(apply(motion, [Step("mirror")]))

    def swapped(name: str) -> str:
        return name.translate({}).replace("left", "*").replace("right", "left").replace("*", "right")

    for d in DERIVED:
        assert other[swapped(d.name)] == pytest.approx(one[d.name], rel=1e-5, abs=1e-7), d.name


@pytest.mark.parametrize("frames", [1, 2, 3, 5])
@pytest.mark.parametrize("name", ["walk", "jump"])
def test_few_frames(name: str, frames: int) -> None:
    motion = samples.SAMPLES[name](seconds=1.0, fps=30.0).motion[:frames]
    found = features(motion)
    assert found.frames.shape == (frames, 37)
    assert found.windows().shape == (1, 121)
    assert np.isfinite(found.frames).all()
    assert np.isfinite(found.clip).all()


def test_shares_and_volumes_stay_in_range() -> None:
    for name in CLIPS:
        found = features(samples.SAMPLES[name](seconds=2.0, fps=30.0).motion)
        assert (found.frames[:, [*range(10), *range(11, 37)]] >= 0.0).all()
        np.testing.assert_allclose(found.zones.sum(axis=1), 1.0)
        whole = column(found, "volume_of_all_joints")
        for part in ("upper_body", "lower_body", "right_side", "left_side", "five_joints"):
            assert (column(found, f"volume_of_{part}") <= whole * (1 + 1e-9)).all()
        assert (column(found, "total_volume") >= whole.min()).all()


def test_a_pose_before_the_motion_is_left_out(made) -> None:
    motion = samples.walk(seconds=2.0, fps=30.0).motion
    arms = np.array(motion.rotations)
    arms[0] = 0.0
    arms[0, :, 3] = 1.0
    with_pose = features(motion.with_(rotations=arms, source=None), body=Body.of(motion))
    assert with_pose.times[0] == pytest.approx(1.0 / 30.0)
    assert len(with_pose.frames) == len(motion) - 1
    close(features(motion[1:], body=Body.of(motion)), with_pose, 1e-9)


def test_the_table_of_a_clip() -> None:
    found = features(samples.walk(seconds=2.0, fps=30.0).motion)
    rows = found.table()
    assert [row.feature for row in rows] == list(DERIVED)
    assert {row.feature.name: row.value for row in rows} == {name: found[name] for name in found.names}
    np.testing.assert_allclose(found.clip, found.windows().mean(axis=0))
    assert found.selected.tolist() == [found[d.name] for d in SELECTED]
    with pytest.raises(MienError, match=r"mien\.load"):
        features("walk.bvh")
    with pytest.raises(MienError, match="hands_distance_mean"):
        found["hands_distance_men"]
    with pytest.raises(MienError, match="stride"):
        found.windows(stride=0.0)
    with pytest.raises(ValueError, match="read-only"):
        found.frames[0, 0] = 1.0


def test_what_an_emotion_changes() -> None:
    """A tired walk is slower, smaller and more bent than a walk."""
    walk, tired = (features(f(seconds=4.0, fps=30.0).motion) for f in (samples.walk, samples.tired_walk))
    for name in ("pelvis_speed_mean", "left_hand_speed_mean", "total_distance", "pelvis_acceleration_max"):
        assert tired[name] < 0.8 * walk[name]
    assert tired["torso_height_mean"] < walk["torso_height_mean"]
