"""Resample: exact where frames coincide, near the true movement elsewhere."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, RotationSpline

from mien import samples
from mien.edits.resample import resample
from mien.kinematics.body import Body
from mien.kinematics.fk import world


def test_up_and_down_gives_the_clip_again() -> None:
    walk = samples.walk(seconds=1.5, fps=30.0).motion
    for fps in (60.0, 120.0, 90.0):
        back = resample(resample(walk, fps=fps), fps=30.0)
        assert len(back) == len(walk)
        np.testing.assert_allclose(back.rotations, walk.rotations, atol=1e-9)
        np.testing.assert_allclose(back.translations, walk.translations, atol=1e-9)


def test_coinciding_frames_are_the_frames() -> None:
    walk = samples.walk(seconds=1.5, fps=24.0).motion
    up = resample(walk, fps=60.0)
    np.testing.assert_allclose(up.rotations[::5], walk.rotations[::2][: len(up.rotations[::5])], atol=1e-9)


@pytest.mark.parametrize(("low", "high", "error"), [(30.0, 120.0, 0.004), (60.0, 50.0, 0.0015)])
def test_frames_between_are_near_the_true_movement(low: float, high: float, error: float) -> None:
    """Oracle: the sample's own curves at the other rate."""
    made = resample(samples.punch(fps=low).motion, fps=high)
    true = samples.punch(fps=high).motion
    unit = Body.of(true).leg_length
    count = min(len(made), len(true))
    assert abs(len(made) - len(true)) <= 1
    assert np.abs(world(made)[1][:count] - world(true)[1][:count]).max() < error * unit


def test_rotations_follow_scipys_spline() -> None:
    """Away from the ends, where conditions differ, SciPy's own spline lies within a twentieth of a degree."""
    walk = samples.walk(seconds=1.0, fps=30.0).motion
    up = resample(walk, fps=120.0)
    joint = Body.of(walk).roles["left_knee"]
    spline = RotationSpline(walk.times, Rotation.from_quat(walk.rotations[:, joint]))
    apart = spline(up.times).inv() * Rotation.from_quat(up.rotations[:, joint])
    assert np.degrees(apart.magnitude())[20:-20].max() < 0.05


def test_a_translation_that_does_not_move_keeps_its_number() -> None:
    walk = samples.walk(seconds=1.0, fps=30.0).motion
    up = resample(walk, fps=77.0)
    hips = Body.of(walk).roles["hips"]
    fixed = [j for j in range(len(walk.skeleton)) if j != hips]
    np.testing.assert_array_equal(
        up.translations[:, fixed],
        np.broadcast_to(walk.translations[0, fixed], up.translations[:, fixed].shape),
    )


def test_signs_of_quaternions_do_not_matter() -> None:
    walk = samples.walk(seconds=1.0, fps=30.0).motion
    flipped = np.array(walk.rotations)
    flipped[::2] *= -1.0
    one, other = resample(walk, fps=70.0), resample(walk.with_(rotations=flipped), fps=70.0)
    np.testing.assert_allclose(np.abs(np.sum(one.rotations * other.rotations, axis=-1)), 1.0, atol=1e-12)


def test_length_is_kept_to_the_last_frame_that_fits() -> None:
    walk = samples.walk(seconds=1.0, fps=30.0).motion
    for fps in (24.0, 29.97, 60.0, 100.0):
        new = resample(walk, fps=fps)
        assert new.fps == pytest.approx(fps)
        assert 0.0 <= walk.duration - new.duration < new.frame_time
    np.testing.assert_array_equal(resample(walk, fps=30.0).rotations, walk.rotations)
    np.testing.assert_array_equal(resample(walk).rotations, walk.rotations)


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_very_short_clips(frames: int) -> None:
    short = samples.walk(seconds=1.0, fps=30.0).motion[:frames]
    assert len(resample(short, fps=60.0)) == 2 * frames - 1
    np.testing.assert_allclose(resample(short, fps=60.0).rotations[::2], short.rotations, atol=1e-12)


def test_no_curve_over_the_jump_from_a_t_pose() -> None:
    walk = samples.walk(seconds=1.0, fps=60.0).motion
    first = np.zeros_like(walk.rotations[:1])
    first[..., 3] = 1.0
    posed = walk.with_(
        rotations=np.concatenate([first, walk.rotations]),
        translations=np.concatenate([walk.translations[:1], walk.translations]),
    )
    fine, alone = resample(posed, fps=240.0), resample(walk, fps=240.0)
    same = np.abs(np.einsum("tji,tji->tj", fine.rotations[4:], alone.rotations))
    np.testing.assert_allclose(same, 1.0, atol=1e-12)
    np.testing.assert_array_equal(fine.rotations[0], first[0])
