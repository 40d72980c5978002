"""mien.grid: the nine by their letters, any point to the same bytes as its history, posture last."""

import numpy as np
import pytest

import mien
from mien.samples import walk, wave
from mien.styles.grid import NINE

OTHER = [(0.3, 1.0), (1.0, 1.7), (1.4, 0.3), (0.2, 1.6)]


@pytest.fixture(scope="module")
def clip():
    return walk(seconds=2.0, fps=30.0).motion


@pytest.fixture(scope="module", params=["timemap", "bilinear"])
def square(request, clip):
    return mien.grid(clip, mode=request.param)


def test_letters_stand_where_the_thesis_has_them():
    assert {c.letter: (c.path, c.timing) for c in NINE} == {
        "A": (0, 2), "B": (1, 2), "C": (2, 2),
        "D": (0, 1), "E": (1, 1), "F": (2, 1),
        "G": (0, 0), "H": (1, 0), "I": (2, 0),
    }  # fmt: skip
    for corner in NINE:
        words = ("short paths", "", "long paths")[corner.path], (
            "added acceleration", "", "constant speed")[corner.timing]  # fmt: skip
        assert corner.title == (", ".join(w for w in words if w) or "the original")


def test_the_nine_are_the_points_they_stand_on(square, clip):
    nine = square.nine()
    assert list(nine) == list("ABCDEFGHI")
    assert nine["E"] is clip
    for corner in NINE:
        point = square.at(corner.path, corner.timing)
        assert nine[corner.letter].rotations.tobytes() == point.rotations.tobytes()
    swing = {
        k: np.ptp(m.rotations[:, mien.Body.of(clip).roles["left_shoulder"]], axis=0).max()
        for k, m in nine.items()
    }
    assert swing["D"] < swing["E"] < swing["F"]


@pytest.mark.parametrize("at", OTHER + [(0, 2), (2, 0)])
def test_the_history_of_a_point_makes_it_again(square, clip, at):
    point = square.at(*at)
    again = mien.apply(clip, point.history)
    assert again.rotations.tobytes() == point.rotations.tobytes()
    assert again.translations.tobytes() == point.translations.tobytes()
    assert point.reference is clip


def test_the_centre_is_the_motion_itself(square, clip):
    assert square.at(1, 1) is clip
    assert square.at(1.0, 1.0, posture=mien.Step("posture", {"head": 10})).history[0].edit == "posture"


def test_posture_comes_last_and_may_be_a_recipe(square, clip):
    steps = (mien.Step("posture", {"head": 15, "legs": 4}), mien.Step("foot_plant"))
    whole = square.at(0.4, 1.2, posture=mien.Recipe("slumped", steps))
    assert [step.edit for step in whole.history] == ["grid", "posture", "foot_plant"]
    np.testing.assert_array_equal(whole.rotations, mien.apply(square.at(0.4, 1.2), steps).rotations)
    one = square.at(0.4, 1.2, posture=steps[0])
    assert [step.edit for step in one.history] == ["grid", "posture"]
    again = mien.apply(clip, whole.history)
    assert again.rotations.tobytes() == whole.rotations.tobytes()


@pytest.mark.parametrize("at", OTHER + [(1, 1), (0, 0)])
def test_one_frame_is_that_of_the_whole(square, clip, at):
    whole = square.at(*at)
    for index in (0, 30, len(clip) - 1):
        rotations, translations = square.frame(index, *at)
        np.testing.assert_allclose(rotations, whole.rotations[index], atol=1e-12)
        np.testing.assert_allclose(translations, whole.translations[index], atol=1e-12)


@pytest.mark.parametrize("at", OTHER + [(2, 2)])
def test_points_are_sound(square, clip, at):
    point = square.at(*at)
    np.testing.assert_allclose(np.linalg.norm(point.rotations, axis=-1), 1.0, atol=1e-12)
    assert (np.einsum("tji,tji->tj", point.rotations[1:], point.rotations[:-1]) > 0).all()
    hips = mien.Body.of(clip).roles["hips"]
    bones = [j for j in clip.skeleton.descendants(hips) if j != hips]
    np.testing.assert_array_equal(point.translations[:, bones], clip.translations[:, bones])


def test_a_clip_with_a_t_pose_at_its_start(data):
    clip = mien.load(data / "cmu_daz" / "07_01.bvh")
    square = mien.grid(clip)
    assert square.still > 0
    point = square.at(1.4, 0.3)
    np.testing.assert_array_equal(point.rotations[0], clip.rotations[0])
    again = mien.apply(clip, point.history)
    assert again.rotations.tobytes() == point.rotations.tobytes()
    for index in (0, square.still - 1, square.still, 100):
        np.testing.assert_allclose(square.frame(index, 1.4, 0.3)[0], point.rotations[index], atol=1e-12)


def test_a_motion_that_was_edited_before_goes_on_from_there(clip):
    proud = mien.edit(clip, "proud")
    point = mien.grid(proud).at(0.5, 1.5)
    assert point.history[: len(proud.history)] == proud.history
    again = mien.apply(clip, point.history)
    assert again.rotations.tobytes() == point.rotations.tobytes()


@pytest.mark.parametrize("frames", [1, 2, 3, 9])
def test_very_short_motions(frames):
    clip = wave(fps=30.0).motion[:frames]
    for at in [(0, 0), (1.3, 0.4), (0.6, 1.9)]:
        point = mien.grid(clip).at(*at)
        assert np.isfinite(point.rotations).all()
        np.testing.assert_allclose(mien.grid(clip).frame(0, *at)[0], point.rotations[0], atol=1e-12)


def test_what_does_not_fit_is_refused(clip, square):
    for wrong in ((2.5, 1.0), (1.0, -0.1)):
        for ask in (square.at, lambda p, q: square.frame(0, p, q)):
            with pytest.raises(mien.RecipeError, match="must be from 0 to 2, got"):
                ask(*wrong)
    with pytest.raises(mien.MienError, match="frames 0 to 60, not 61"):
        square.frame(61, 1.0, 1.0)
    with pytest.raises(mien.RecipeError, match="grid: short must be from 0 to 1, got 2"):
        mien.grid(clip, short=2.0)
    with pytest.raises(mien.RecipeError, match="bilinear"):
        mien.grid(clip, mode="linear")
    with pytest.raises(mien.MienError, match=r"mien\.load"):
        mien.grid("walk.bvh")


def test_it_says_what_it_is(square):
    assert repr(square).startswith("Grid(Motion(")
    assert "short=0.3, long=1.5, acceleration=1.0" in repr(square)
