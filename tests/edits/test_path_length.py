"""path_length: a hinge in closed form, frame rates, loops, the hips, and gains that change nothing."""

import numpy as np
import pytest

from mien.edits import path_length as module
from mien.edits.path_length import path_length
from mien.errors import BodyError, RecipeError
from mien.kinematics.body import Body
from mien.kinematics.bones import main_bones
from mien.kinematics.fk import world
from mien.kinematics.heading import heading
from mien.motion import Motion, Skeleton
from mien.rotations import directions, quaternion
from mien.samples import turn, walk

HINGE = 3.125  # Hz: 32 frames at 100 frames a second


def apart(a, b):
    """The angle between rotations, whatever their signs."""
    v = quaternion.multiply(quaternion.conjugate(a), b)[..., :3]
    return 2.0 * np.arcsin(np.clip(np.linalg.norm(v, axis=-1), 0.0, 1.0))


def still(frames, fps):
    """The sample figure in its first pose."""
    first = walk(seconds=0.1).motion
    return Motion(
        first.skeleton,
        np.repeat(first.rotations[:1], frames, axis=0),
        np.repeat(first.translations[:1], frames, axis=0),
        1.0 / fps,
    )


def hinge(angle, fps, role="right_elbow"):
    """A still figure with one joint turning by ``angle (T,)`` across its bone; the joint and its axis."""
    motion = still(len(angle), fps)
    joint = Body.of(motion).roles[role]
    _, across = directions.axes(main_bones(motion.skeleton))
    rotations = np.array(motion.rotations)
    turned = quaternion.exp(angle[:, None] * across[joint])
    rotations[:, joint] = quaternion.multiply(rotations[:, joint], turned)
    return motion.with_(rotations=rotations), joint, across[joint]


def angles(motion, joint, axis):
    """The angle of a hinge relative to the figure's first pose."""
    rest = still(1, 1.0).rotations[0, joint]
    return quaternion.log(quaternion.multiply(quaternion.conjugate(rest), motion.rotations[:, joint])) @ axis


def fitted(values, frequency, fps):
    """The amplitude of the sinusoid in ``values``, away from the ends."""
    t = np.arange(len(values)) / fps
    inside = (t > 3.0) & (t < t[-1] - 3.0)
    parts = np.stack([np.sin(2 * np.pi * frequency * t), np.cos(2 * np.pi * frequency * t)], -1)
    return np.hypot(*np.linalg.lstsq(parts[inside], values[inside], rcond=None)[0])


@pytest.mark.parametrize(
    ("amplitude", "wanted"),
    [
        (0.1, {0.5: 0.0547, 1.5: 0.1450, 2: 0.1894, 3: 0.2762}),
        (0.5, {0.5: 0.2823, 1.5: 0.6837, 2: 0.8314, 3: 1.0401}),
        (1.0, {0.5: 0.6298, 1.5: 1.2114, 2: 1.3374, 3: 1.4746}),
        (1.5, {0.5: 1.1591, 1.5: 1.6272, 2: 1.6915, 3: 1.7555}),
    ],
)
@pytest.mark.parametrize("mode", ["hz", "bands"])
def test_a_swinging_hinge_saturates_as_computed(amplitude, wanted, mode):
    t = np.arange(32 * 12) / 100.0
    clip, joint, axis = hinge(amplitude * np.sin(2 * np.pi * HINGE * t), 100.0)
    for gain, value in wanted.items():
        out = path_length(clip, mid=gain, mode=mode, boundary="wrap")
        assert angles(out, joint, axis).max() == pytest.approx(value, abs=1e-3)


@pytest.mark.parametrize("frequency", [0.5, 2.0, 6.0])
def test_the_frame_rate_does_not_matter(frequency):
    found = []
    for fps in (24.0, 30.0, 60.0, 100.0, 120.0):
        t = np.arange(int(12 * fps) + 1) / fps
        clip, joint, axis = hinge(0.1 * np.sin(2 * np.pi * frequency * t), fps)
        out = path_length(clip, mid=1.5, high=0.5)
        found.append(fitted(angles(out, joint, axis), frequency, fps))
    np.testing.assert_allclose(found, found[-1], rtol=1e-3)


def test_at_100_frames_a_second_whole_bands_are_the_same():
    clip = walk(seconds=3.0, fps=100.0).motion
    gains = {"mid": 1.7, "low": 0.8, "high": 0.3, "boundary": "hold"}
    a, b = path_length(clip, mode="hz", **gains), path_length(clip, mode="bands", **gains)
    assert apart(a.rotations, b.rotations).max() < 1e-12


def test_the_slow_twin():
    """Every joint by itself, with matrices and band by band: the thesis's order of work."""
    clip = walk(seconds=2.0, fps=100.0).motion
    body = Body.of(clip)
    out = path_length(clip, mid=1.6, high=0.5, boundary="hold")
    bones = main_bones(clip.skeleton)
    for joint in (body.roles["left_knee"], body.roles["right_shoulder"], body.roles["head"]):
        u, v = directions.axes(bones[joint])
        matrix = quaternion.to_matrix(clip.rotations[:, joint])
        codes = np.concatenate([matrix @ u, matrix @ v], axis=-1)
        filtered = np.empty_like(codes)
        for channel in range(6):
            pad = 600
            g = np.pad(codes[:, channel], pad, mode="edge")
            total = np.zeros_like(g)
            for k in range(6):
                kernel = np.zeros(4 * 2**k + 1)
                kernel[:: 2**k] = np.array([1, 4, 6, 4, 1]) / 16
                smoother = np.convolve(g, kernel, mode="same")
                total += (0.5 if k < 2 else 1.6) * (g - smoother)
                g = smoother
            filtered[:, channel] = (total + g)[pad:-pad]
        d, n = filtered[:, :3], filtered[:, 3:]
        d = d / np.linalg.norm(d, axis=1, keepdims=True)
        n = n - (n * d).sum(1, keepdims=True) * d
        n = n / np.linalg.norm(n, axis=1, keepdims=True)
        rest = np.stack([u, v, np.cross(u, v)], axis=1)
        wanted = np.stack([d, n, np.cross(d, n)], axis=-1) @ rest.T
        np.testing.assert_allclose(quaternion.to_matrix(out.rotations[:, joint]), wanted, atol=1e-10)


@pytest.mark.parametrize("gain", [0.25, 1.0, 2.0])
def test_equal_gains_change_nothing(gain):
    clip = walk(seconds=1.0).motion
    out = path_length(clip, low=gain, mid=gain, high=gain)
    np.testing.assert_array_equal(out.rotations, clip.rotations)


@pytest.mark.parametrize("mode", ["hz", "bands", "edges"])
@pytest.mark.parametrize("orthogonalise", ["gram-schmidt", "svd"])
def test_nearly_neutral_gains_change_nearly_nothing(mode, orthogonalise):
    clip = walk(seconds=2.0, fps=50.0).motion
    out = path_length(clip, mid=1.0 + 1e-12, mode=mode, orthogonalise=orthogonalise)
    assert apart(out.rotations, clip.rotations).max() < 1e-9


def test_a_still_pose_stays():
    clip = still(40, 30.0)
    out = path_length(clip, mid=3.0, low=0.5, high=0.0)
    assert apart(out.rotations, clip.rotations).max() < 1e-12


@pytest.mark.parametrize("frames", [1, 2, 3, 7])
def test_a_few_frames(frames):
    out = path_length(walk(seconds=1.0).motion[:frames], mid=2.0, high=0.5)
    assert len(out) == frames
    assert np.isfinite(out.rotations).all()


def test_longer_paths_are_longer_and_shorter_ones_shorter():
    clip = walk(seconds=4.0).motion
    wrist = Body.of(clip).roles["left_wrist"]
    chest = Body.of(clip).spine[-1]

    def travelled(motion):
        _, positions = world(motion)
        return np.linalg.norm(np.diff(positions[:, wrist] - positions[:, chest], axis=0), axis=1).sum()

    lengths = [travelled(path_length(clip, mid=mid)) for mid in (0.0, 0.5, 1.0, 1.5, 2.0)]
    assert (np.diff(lengths) > 0).all()
    assert lengths[0] < 0.4 * lengths[2]


def test_the_hips_neither_travel_nor_turn_otherwise():
    clip = turn(seconds=3.0).motion
    body = Body.of(clip)
    out = path_length(clip, mid=2.0, low=1.0, high=0.5)
    np.testing.assert_array_equal(out.translations, clip.translations)
    before, after = heading(world(clip)[1], body), heading(world(out)[1], body)
    assert np.ptp(before) > 0.9
    np.testing.assert_allclose(after, before, atol=np.radians(1.0))


def test_a_turning_root_above_the_hips_makes_no_difference():
    clip = walk(seconds=1.5).motion
    bones = clip.skeleton
    yaw = quaternion.exp(np.linspace(0.0, 4.0, len(clip))[:, None] * Body.of(clip).up)
    rotations = np.concatenate([yaw[:, None], clip.rotations], axis=1)
    rotations[:, 1] = quaternion.multiply(quaternion.conjugate(yaw), clip.rotations[:, 0])
    translations = np.concatenate([np.zeros((len(clip), 1, 3)), clip.translations], axis=1)
    translations[:, 1] = quaternion.rotate(quaternion.conjugate(yaw), clip.translations[:, 0])
    carried = Motion(
        Skeleton(
            ("Reference", *bones.names),
            np.concatenate([[-1], bones.parents + 1]),
            np.concatenate([np.zeros((1, 3)), bones.offsets]),
            bones.end_parents + 1,
            bones.end_offsets,
        ),
        rotations,
        translations,
        clip.frame_time,
    )
    assert bones.parents[0] == -1
    assert apart(world(carried)[0][:, 1:], world(clip)[0]).max() < 1e-12
    a = path_length(clip, mid=1.8, high=0.5)
    b = path_length(carried, mid=1.8, high=0.5)
    np.testing.assert_array_equal(b.rotations[:, 0], carried.rotations[:, 0])
    assert apart(world(b)[0][:, 1:], world(a)[0]).max() < 1e-9


def looping(frames, fps, joints=("right_elbow", "left_knee", "head")):
    """A figure whose joints turn with whole periods in ``frames``."""
    t = np.arange(frames) / frames
    motion = still(frames, fps)
    rotations = np.array(motion.rotations)
    for i, name in enumerate(joints):
        joint = Body.of(motion).roles[name]
        angle = 0.5 * np.sin(2 * np.pi * (i + 1) * t + i) + 0.2 * np.cos(2 * np.pi * 3 * t)
        turned = quaternion.exp(angle[:, None] * np.array([0.6, 0.0, 0.8]))
        rotations[:, joint] = quaternion.multiply(rotations[:, joint], turned)
    return motion.with_(rotations=rotations)


@pytest.mark.parametrize("mode", ["hz", "bands", "edges"])
def test_a_loop_stays_a_loop_wherever_it_is_cut(mode):
    clip = looping(45, 30.0)
    out = path_length(clip, mid=1.8, high=0.5, mode=mode)
    rolled = clip.with_(rotations=np.roll(clip.rotations, 13, axis=0))
    again = path_length(rolled, mid=1.8, high=0.5, mode=mode)
    assert apart(again.rotations, np.roll(out.rotations, 13, axis=0)).max() < 1e-9
    assert apart(out.rotations, clip.rotations).max() > 0.05


def test_a_loop_that_ends_on_its_first_frame_still_does():
    clip = looping(45, 30.0)
    closed = clip.with_(
        rotations=np.concatenate([clip.rotations, clip.rotations[:1]]),
        translations=np.concatenate([clip.translations, clip.translations[:1]]),
    )
    out, open_out = (path_length(m, mid=1.8, high=0.5) for m in (closed, clip))
    assert apart(out.rotations[0], out.rotations[-1]).max() < 1e-12
    assert apart(out.rotations[:-1], open_out.rotations).max() < 1e-12


def test_hold_does_not_look_at_the_other_end():
    clip = looping(90, 30.0)
    held = path_length(clip, mid=1.8, boundary="hold")
    assert apart(held.rotations[0], path_length(clip, mid=1.8).rotations[0]).max() > 0.01


def test_working_in_chunks_changes_nothing(monkeypatch):
    clip = walk(seconds=2.0).motion
    whole = path_length(clip, mid=1.5, high=0.5)
    monkeypatch.setattr(module, "CHUNK", 1)
    one_by_one = path_length(clip, mid=1.5, high=0.5)
    assert apart(one_by_one.rotations, whole.rotations).max() < 1e-14


def test_edges_in_the_wrong_order_are_refused():
    with pytest.raises(RecipeError, match="edge_low"):
        path_length(walk(seconds=0.5).motion, mid=2.0, edge_low=13.0)


def test_no_body_is_an_error():
    arm = Skeleton(("a", "b", "c"), np.array([-1, 0, 1]), np.eye(3))
    motion = Motion(arm, np.tile(quaternion.IDENTITY, (5, 3, 1)), np.tile(np.eye(3), (5, 1, 1)), 0.02)
    with pytest.raises(BodyError):
        path_length(motion, mid=2.0)
