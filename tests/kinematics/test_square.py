"""The square's weights, its order, its corners, one frame alone; loops."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.edits.grid import square
from mien.edits.path_length import path_length
from mien.edits.timing import timing
from mien.kinematics.body import Body
from mien.kinematics.bones import main_bones
from mien.kinematics.square import corners
from mien.motion import Motion
from mien.rotations import directions, quaternion
from mien.samples import walk, wave

MODES = ("timemap", "bilinear")
inside = st.floats(0.0, 2.0)


def made(motion, mode="timemap", **changes):
    options = {"short": 0.3, "long": 1.5, "acceleration": 0.8, "rests": True, "mode": mode} | changes
    return square(motion, **options)


@pytest.fixture(scope="module")
def clip():
    return walk(seconds=2.0, fps=30.0).motion


@pytest.fixture(scope="module", params=MODES)
def found(request, clip):
    return made(clip, request.param)


@given(inside, inside)
def test_weights_are_those_of_the_thesis(p, q):
    """Add up to 1, meet at the point, and are what two interpolations in either order make."""
    parts = list(corners(p, q))
    assert sum(w for w, _, _ in parts) == pytest.approx(1.0, abs=1e-15)
    assert sum(w * i for w, i, _ in parts) == pytest.approx(p, abs=1e-12)
    assert sum(w * j for w, _, j in parts) == pytest.approx(q, abs=1e-12)
    assert all(0.0 < w <= 1.0 and i in (0, 1, 2) and j in (0, 1, 2) for w, i, j in parts)
    values = np.random.default_rng(7).normal(size=(3, 3))
    once = sum(w * values[i, j] for w, i, j in parts)
    grid = np.arange(3.0)
    path_first = np.interp(q, grid, [np.interp(p, grid, values[:, j]) for j in range(3)])
    timing_first = np.interp(p, grid, [np.interp(q, grid, values[i]) for i in range(3)])
    assert once == pytest.approx(path_first, abs=1e-12)
    assert once == pytest.approx(timing_first, abs=1e-12)


def test_j_is_made_from_b_c_e_and_f():
    """The thesis's example: B (1, 2), C (2, 2), E (1, 1), F (2, 1)."""
    assert {(i, j) for _, i, j in corners(1.4, 1.7)} == {(1, 2), (2, 2), (1, 1), (2, 1)}
    assert [(w, i, j) for w, i, j in corners(2.0, 0.0)] == [(1.0, 2, 0)]


def test_the_centre_is_the_very_motion(found, clip):
    assert found.point(1.0, 1.0) is clip


def test_a_corner_is_its_own_point_to_the_last_bit(found):
    for path in range(3):
        for by in range(3):
            corner, point = found.corner(path, by), found.point(float(path), float(by))
            assert corner.rotations.tobytes() == point.rotations.tobytes()
            assert corner.translations.tobytes() == point.translations.tobytes()


@pytest.mark.parametrize("path", [0.0, 1e-7, 0.4, 1.0, 1.6, 2.0])
@pytest.mark.parametrize("by", [0.0, 1e-7, 0.4, 1.0, 1.6, 2.0])
def test_one_frame_alone_is_that_of_the_whole(found, clip, path, by):
    whole = found.point(path, by)
    for index in (0, 1, len(clip) // 2, len(clip) - 1):
        rotations, translations = found.frame(index, path, by)
        np.testing.assert_allclose(rotations, whole.rotations[index], atol=1e-12)
        np.testing.assert_allclose(translations, whole.translations[index], atol=1e-12)


def test_the_mean_of_four_against_matrices(clip):
    """A slow twin: columns of matrices averaged, made orthogonal by QR. On joints that are not mended."""
    found, (p, q) = made(clip, "bilinear"), (1.4, 1.7)
    body = Body.of(clip)
    joint_u, joint_v = directions.axes(main_bones(clip.skeleton))
    chosen = {(1, 2): 0.6 * 0.7, (2, 2): 0.4 * 0.7, (1, 1): 0.6 * 0.3, (2, 1): 0.4 * 0.3}
    nine = {place: found.corner(*place) for place in chosen}
    point = found.point(p, q)
    joints = [*body.spine, *body.limbs["left_arm"], *body.limbs["head"], body.roles["hips"]]
    for frame in range(0, len(clip), 7):
        for joint in joints:
            mean = np.zeros((3, 2))
            for place, weight in chosen.items():
                matrix = quaternion.to_matrix(nine[place].rotations[frame, joint])
                mean += weight * matrix @ np.stack([joint_u[joint], joint_v[joint]], axis=1)
            columns, upper = np.linalg.qr(mean)
            columns = columns * np.sign(np.diag(upper))
            rest = np.stack([joint_u[joint], joint_v[joint]], axis=1)
            shown = quaternion.to_matrix(point.rotations[frame, joint]) @ rest
            np.testing.assert_allclose(shown, columns, atol=1e-9)
        roots = sum(weight * nine[place].translations[frame] for place, weight in chosen.items())
        np.testing.assert_allclose(point.translations[frame], roots, atol=1e-9)


def test_maps_of_time_are_the_mean_of_those_around(clip):
    """Halfway to constant speed the right arm shows the frame halfway between, on the same path."""
    found = made(clip)
    point, joint = found.point(1.0, 1.5), Body.of(clip).roles["right_shoulder"]
    own = np.arange(len(clip))
    at = own + 0.5 * found.shifts["right_arm"][1, 2]
    assert np.abs(at - own).max() > 0.3
    here = np.clip(np.floor(at).astype(int), 0, len(clip) - 2)
    for frame in own[::5]:
        a, b = clip.rotations[[here[frame], here[frame] + 1], joint]
        expected = quaternion.slerp(a, b, at[frame] - here[frame])
        np.testing.assert_allclose(point.rotations[frame, joint], expected, atol=1e-12)


def test_limbs_stay_on_their_paths_where_the_mean_of_four_cuts_corners():
    clip = wave(fps=60.0).motion
    body = Body.of(clip)
    joints = list(body.limbs["right_arm"])
    u, v = (axis[joints] for axis in directions.axes(main_bones(clip.skeleton)))

    def code(motion):
        return directions.encode(motion.rotations[:, joints], u, v).reshape(len(motion), -1)

    path, far = code(clip), {}
    start, step = path[:-1], np.diff(path, axis=0)
    for mode in MODES:
        shown = code(made(clip, mode).point(1.0, 1.5))
        along = np.einsum("tsi,si->ts", shown[:, None] - start, step) / np.maximum((step**2).sum(-1), 1e-30)
        nearest = start + np.clip(along, 0.0, 1.0)[..., None] * step
        far[mode] = np.linalg.norm(shown[:, None] - nearest, axis=-1).min(axis=1).max()
    assert far["timemap"] < 0.003  # the sagitta of one frame's turn
    assert far["bilinear"] > 10 * far["timemap"]


def round_of_arms(frames=120, fps=50.0):
    """A body that stands and swings its arms; the last frame goes on to the first."""
    first = walk(seconds=0.1).motion
    phase = 2 * np.pi * np.arange(frames) / frames
    rotations = np.repeat(first.rotations[:1], frames, axis=0)
    _, across = directions.axes(main_bones(first.skeleton))
    for side, sign in (("left", 1.0), ("right", -1.0)):
        joint = Body.of(first).roles[f"{side}_shoulder"]
        angle = sign * (0.6 * np.sin(phase) + 0.3 * np.sin(2 * phase + 1.0))
        turned = quaternion.exp(angle[:, None] * across[joint])
        rotations[:, joint] = quaternion.multiply(rotations[:, joint], turned)
    return Motion(first.skeleton, rotations, np.repeat(first.translations[:1], frames, axis=0), 1.0 / fps)


@pytest.mark.parametrize("mode", MODES)
def test_a_loop_stays_a_loop_wherever_it_is_cut(mode):
    clip = round_of_arms()
    rolled = clip.with_(rotations=np.roll(clip.rotations, 31, axis=0))
    one, other = made(clip, mode), made(rolled, mode)
    assert one.round_length == other.round_length == len(clip)
    for at in ((1.0, 0.0), (1.0, 0.5), (0.4, 1.5), (1.7, 0.3)):
        here, there = (found.point(*at).rotations for found in (one, other))
        assert np.abs(here - clip.rotations).max() > 0.01
        same = np.abs(np.einsum("tji,tji->tj", np.roll(here, 31, axis=0), there))
        np.testing.assert_allclose(same, 1.0, atol=1e-9)


def test_the_corners_are_the_edits_one_after_the_other(clip):
    found = made(clip, rests=False)
    shorter = path_length(clip, mid=0.3)
    assert (
        np.abs(found.corner(0, 1).rotations - shorter.rotations)[:, Body.of(clip).joints(("arms",))].max()
        == 0
    )
    for by, acceleration in ((0, 0.8), (2, -0.8)):
        expected = timing(found.corner(0, 1), acceleration=acceleration)
        np.testing.assert_allclose(found.corner(0, by).rotations, expected.rotations, atol=1e-9)
