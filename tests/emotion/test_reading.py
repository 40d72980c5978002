"""Reading: edits are read as what they are meant to be, and what does not matter does not."""

import doctest
import json
from dataclasses import replace

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.manner import change_between
from mien.analysis.manner_features import FEATURES, manner_features
from mien.emotion import circumplex, reading
from mien.emotion.model import shipped_model
from mien.errors import MienError
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=6.0).motion


@pytest.fixture(scope="module")
def sad(walk: Motion) -> Motion:
    return mien.edit(walk, "sad")


def test_a_sad_walk(walk: Motion, sad: Motion) -> None:
    found = mien.read(sad, neutral=walk)
    assert found.quadrant == "mild and unpleasant"
    assert next(iter(found.labels)) == "sad"
    assert "sad" in found.words
    assert {"head bent forward", "trunk bent forward"} & {reason.what for reason in found.why}
    bent = next(reason for reason in found.why if reason.what in ("head bent forward", "trunk bent forward"))
    assert bent.how_much.endswith("degrees")
    assert [r.pull for r in found.why] == sorted((r.pull for r in found.why), reverse=True)


def test_reasons_have_the_words_of_their_direction(walk: Motion) -> None:
    """What an edit does is said as it looks, and nothing that cannot be seen."""
    edits = {
        "shoulders raised": {"shoulders": 15},
        "shoulders lowered": {"shoulders": -15},
        "upper arms away from the body": {"arms": 20},
        "elbows more bent": {"elbows": 30},
        "thighs apart": {"legs": 8},
        "head bent back": {"head": -20},
    }
    for what, changed in edits.items():
        numbers = manner_features(change_between(walk, mien.apply(walk, [Step("posture", changed)])))
        assert what in {f.said(float(n))[0] for f, n in zip(FEATURES, numbers, strict=True) if abs(n) > 0.3}
    slight = mien.read(mien.apply(walk, [Step("posture", {"shoulders": 2})]), neutral=walk)
    assert slight.why == ()


def test_a_place_by_a_small_share_is_told(walk: Motion) -> None:
    """A clip that is like a label without a place may stand anywhere: that is said."""
    model = shipped_model()
    found = mien.read(walk, model=model)
    assert found.placed == pytest.approx(sum(found.labels[label] for label in model.places))
    only = replace(model, places={"tired": model.places["tired"]})
    unsure = mien.read(walk, model=only)
    assert unsure.placed == pytest.approx(unsure.labels["tired"])
    assert unsure.hardly_placed
    assert "has no place on the disc" in unsure.lines()[0]
    assert "has no place" in unsure._repr_html_()
    assert "no place" not in str(mien.read(walk, neutral=walk))


def test_in_words(sad: Motion) -> None:
    lines = str(mien.read(sad)).splitlines()
    assert [line.split(" ")[0] for line in lines] == ["valence", "nearest", "acted", "because:"]


def test_a_model_by_its_path_is_refused_in_words(walk: Motion) -> None:
    with pytest.raises(MienError, match="load_model reads one"):
        mien.read(walk, model="mine.json")  # type: ignore[arg-type]


def test_nothing_against_itself(walk: Motion) -> None:
    found = mien.read(walk, neutral=walk)
    assert (found.quadrant, next(iter(found.labels)), found.against) == ("neutral", "neutral", "neutral")
    assert found.why == ()
    np.testing.assert_allclose(found.manner, 0.0, atol=1e-5)


def test_an_edited_motion_knows_what_it_was_made_from(walk: Motion, sad: Motion) -> None:
    """But not at which tempo: that went through the same steps."""
    by_itself, told = mien.read(sad), mien.read(sad, neutral=walk)
    assert by_itself.against == told.against == "neutral"
    rest = [i for i, f in enumerate(FEATURES) if f.name not in ("rate", "sharpness")]
    np.testing.assert_allclose(by_itself.manner[rest], told.manner[rest], atol=0.1)
    rate = [f.name for f in FEATURES].index("rate")
    assert told.manner[rate] < by_itself.manner[rate] - 0.1
    assert mien.read(walk).against == "usual"


def test_the_stronger_the_further(walk: Motion) -> None:
    """Half an edit is read as less of it: nearer to the centre."""
    places = [mien.read(mien.edit(walk, "sad", strength=s), neutral=walk).place for s in (0.1, 0.5, 1.0)]
    away = [np.hypot(*place) for place in places]
    assert away[0] < away[1] < away[2] + 0.05
    assert away[0] < 0.3


def larger(motion: Motion, by: float) -> Motion:
    skeleton = replace(motion.skeleton, offsets=by * motion.skeleton.offsets)
    return Motion(skeleton, motion.rotations, by * motion.translations, motion.frame_time)


def turned(motion: Motion, angle: float) -> Motion:
    turn = quaternion.exp(np.array([0.0, angle, 0.0]))
    rotations, translations = np.array(motion.rotations), np.array(motion.translations)
    rotations[:, 0] = quaternion.multiply(turn, rotations[:, 0])
    translations[:, 0] = quaternion.rotate(turn, translations[:, 0])
    return Motion(motion.skeleton, rotations, translations, motion.frame_time)


@pytest.mark.parametrize("with_neutral", [True, False])
def test_unit_heading_and_frame_rate_do_not_matter(walk: Motion, sad: Motion, with_neutral: bool) -> None:
    plain = Motion(sad.skeleton, sad.rotations, sad.translations, sad.frame_time)
    neutral = walk if with_neutral else None
    expected = mien.read(plain, neutral=neutral)
    coarse = mien.apply(plain, [Step("resample", {"fps": 30.0})])
    coarse = Motion(coarse.skeleton, coarse.rotations, coarse.translations, coarse.frame_time)
    for other in (larger(plain, 39.37), turned(plain, 1.1), coarse):
        found = mien.read(other, neutral=neutral)
        assert found.labels == pytest.approx(dict(expected.labels), abs=0.06)
        assert found.place == pytest.approx(expected.place, abs=0.06)
        np.testing.assert_allclose(found.manner, expected.manner, atol=0.15)


def test_a_neutral_clip_of_another_skeleton(sad: Motion) -> None:
    other = samples.walk(seconds=6.0, skeleton=samples.SKELETONS[1]).motion
    found = mien.read(sad, neutral=other)
    assert found.against == "neutral"
    assert found.place.valence < 0.0 or found.place.arousal < 0.0


def test_plain_data(sad: Motion) -> None:
    found = mien.read(sad)
    data = json.loads(json.dumps(found.as_data(), allow_nan=False))
    assert list(data) == ["valence", "arousal", "quadrant", "words", "labels", "placed", "against", "why"]
    assert data["valence"] == pytest.approx(found.place.valence, abs=1e-3)
    assert sum(data["labels"].values()) == pytest.approx(1.0, abs=0.01)
    assert data["why"][0]["what"] in {word for f in FEATURES for word in (f.label, f.opposite)}
    assert len(data["words"]) == 3


def test_manner_is_in_units_of_what_is_usual(walk: Motion) -> None:
    bent = mien.apply(walk, [Step("posture", {"head": 15.0})])
    found = mien.read(bent, neutral=walk)
    names = [f.name for f in FEATURES]
    scale = shipped_model().change.scale
    degrees = 10.0 * (found.manner * scale)[[names.index("neck_pitch"), names.index("head_pitch")]].sum()
    assert degrees == pytest.approx(15.0, abs=1.5)


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_the_shortest_clips(walk: Motion, frames: int) -> None:
    for neutral in (None, walk):
        found = mien.read(walk[:frames], neutral=neutral)
        assert np.isfinite([*found.place, *found.labels.values()]).all()


def test_what_is_no_motion_is_told(walk: Motion) -> None:
    with pytest.raises(MienError, match=r"mien\.load"):
        mien.read("walk.bvh", neutral=walk)
    with pytest.raises(MienError, match=r"mien\.load"):
        mien.read(walk, neutral="walk.bvh")


@pytest.mark.parametrize("module", [circumplex, reading], ids=lambda m: m.__name__)
def test_examples(module) -> None:
    found = doctest.testmod(module, extraglobs={"mien": mien})
    assert found.attempted > 0
    assert found.failed == 0
