"""Learning: known edits as styles on samples, contents that nobody has seen, and noise that says nothing."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.laban_table import DERIVED
from mien.analysis.manner import Manner
from mien.analysis.manner_features import FEATURES
from mien.emotion import learning
from mien.emotion.circumplex import Point, point
from mien.emotion.cluster_tables import Seen
from mien.emotion.control_features import NUMBERS
from mien.emotion.learning import Take, common_changes, learn, measure_takes, scores, without_common
from mien.emotion.model import NEUTRAL, EmotionModel, format_model, load_model
from mien.emotion.pose_clusters import PoseSet
from mien.errors import MienError
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion

STYLES = {
    NEUTRAL: [],
    "sad": [Step("posture", {"head": 20.0, "trunk": 12.0}), Step("path_length", {"mid": 0.7})],
    "excited": [Step("posture", {"arms": 15.0, "elbows": 20.0}), Step("path_length", {"mid": 1.4})],
    "tired": [Step("posture", {"hips_height": -0.06, "head": 12.0}), Step("tempo", {"rate": 0.75})],
}
CONTENTS: dict[str, Callable[[], Motion]] = {
    "walk": lambda: samples.walk(seconds=3.0, fps=30.0).motion,
    "stroll": lambda: samples.walk(seconds=3.0, fps=30.0, cadence=1.4).motion,
    "wave": lambda: samples.wave(seconds=3.0, fps=30.0).motion,
    "knock": lambda: samples.knock(seconds=3.0, fps=30.0).motion,
}
PLACES = {label: point(label) for label in STYLES if label != NEUTRAL}
Clips = list[tuple[Motion, str, str, str]]


@pytest.fixture(scope="module")
def clips() -> Clips:
    return [
        (mien.apply(make(), steps), label, content, "ann")
        for content, make in CONTENTS.items()
        for label, steps in STYLES.items()
    ]


@pytest.fixture(scope="module")
def takes(clips: Clips) -> list[Take]:
    return measure_takes(clips)


def test_styles_are_read_on_contents_that_were_not_learned(clips: Clips, takes: list[Take]) -> None:
    model = learn([take for take in takes if take.content != "stroll"], PLACES, card={})
    walk = next(motion for motion, label, content, _ in clips if (label, content) == (NEUTRAL, "stroll"))
    for motion, label, content, _ in clips:
        if content == "stroll" and label != NEUTRAL:
            found = mien.read(motion, neutral=walk, model=model)
            assert next(iter(found.labels)) == label
            assert np.hypot(*np.subtract(found.place, PLACES[label])) < 0.5


def test_scores_of_what_is_clear_are_high(takes: list[Take]) -> None:
    found = scores(takes, PLACES)
    assert found["takes"] == len(takes) == 16
    assert found["chance"] == 0.25
    assert found["change top-1"] > 0.85
    assert found["change distance"] < 0.3
    assert set(found) == {
        *("takes", "chance", "change top-1", "change top-1, acted", "alone top-1", "alone top-1, acted"),
        *(
            f"{reading} {what}"
            for reading in ("change", "alone", "laban")
            for what in ("quadrant", "distance")
        ),
    }


def test_a_model_goes_through_its_file(takes: list[Take], tmp_path: Any) -> None:
    model = learn(takes, PLACES, card={"source": "samples"})
    (tmp_path / "own.json").write_text(format_model(model), encoding="utf-8")
    again = load_model(tmp_path / "own.json")
    assert again.card == {"source": "samples"}
    assert again.places == model.places
    for take in takes:
        before, after = model.change.probabilities(take.change), again.change.probabilities(take.change)
        assert after == pytest.approx(before, abs=1e-3)


def test_the_content_left_out_is_never_seen(takes: list[Take], monkeypatch: pytest.MonkeyPatch) -> None:
    """Every model that scores is learned from all contents but one, and so is what is common."""
    seen: dict[str, list[set[str]]] = {"learn": [], "common_changes": []}

    def spy(name: str) -> Callable[..., Any]:
        real = getattr(learning, name)

        def watched(some: Sequence[Take], *rest: Any, **options: Any) -> Any:
            seen[name].append({take.content for take in some})
            return real(some, *rest, **options)

        return watched

    for name in seen:
        monkeypatch.setattr(learning, name, spy(name))
    scores(takes, PLACES)
    left_out = [set(CONTENTS) - contents for contents in seen["learn"]]
    assert sorted(map(tuple, left_out)) == sorted((content,) for content in CONTENTS)
    assert all(len(contents) == len(CONTENTS) - 1 for contents in seen["common_changes"])


def test_a_label_that_only_one_content_has_is_never_read(takes: list[Take]) -> None:
    """If anything of a content left out leaked, its own label would be known."""
    some = [replace(t, label="rare") if (t.content, t.label) == ("wave", "sad") else t for t in takes]
    acted = [t for t in some if t.label != NEUTRAL]
    found, all_known = scores(some, PLACES), scores(takes, PLACES)
    assert found["change top-1, acted"] <= 1.0 - 1.0 / len(acted)
    assert found["change top-1, acted"] <= all_known["change top-1, acted"]


def noisy(rng: np.random.Generator) -> Seen:
    turns = {"trunk": quaternion.exp(rng.normal(scale=0.2, size=(4, 3)))}
    return Seen(PoseSet(rng.normal(size=4), turns), rng.normal(size=(4, len(NUMBERS))))


def noise(rng: np.random.Generator) -> Iterator[Take]:
    rest = Manner.of(samples.walk(seconds=1.0).motion)
    for content in range(12):
        neutral = noisy(rng)
        for label in (NEUTRAL, *PLACES):
            for performer in ("ann", "ben", "cid"):
                turns = {s: quaternion.exp(rng.normal(scale=0.2, size=3)) for s in rest.pose}
                pose = {s: quaternion.multiply(q, turns[s]) for s, q in rest.pose.items()}
                change = np.zeros(len(FEATURES)) if label == NEUTRAL else rng.normal(size=len(FEATURES))
                yield Take(
                    *(label, f"content {content}", performer, change, replace(rest, pose=pose)),
                    *(rng.normal(size=len(DERIVED)), noisy(rng), neutral),
                )


def test_noise_scores_no_better_than_chance() -> None:
    """108 acted takes of three labels: by guessing a third, and 0.14 more once in a thousand times."""
    found = scores(list(noise(np.random.default_rng(11))), PLACES)
    assert found["change top-1, acted"] < 0.33 + 0.14
    assert found["alone top-1, acted"] < 0.33 + 0.14
    for reading in ("change", "alone", "laban"):
        assert found[f"{reading} quadrant"] < 0.33 + 0.14
        assert found[f"{reading} distance"] > 0.5


def made_up(label: str, change: np.ndarray, performer: str = "ann") -> Take:
    rest = Manner.of(samples.still(seconds=0.5).motion)
    nothing = noisy(np.random.default_rng(0))
    return Take(label, "walk", performer, change, rest, np.zeros(len(DERIVED)), nothing, nothing)


def test_what_all_acted_takes_share_is_taken_away() -> None:
    """Another day: the same offset on every acted take of one performer."""
    rng = np.random.default_rng(2)
    own = rng.normal(size=(6, len(FEATURES)))
    own -= own.mean(axis=0)
    offset = rng.normal(size=len(FEATURES))
    some = [made_up(f"label {i % 3}", own[i] + offset) for i in range(6)]
    some += [made_up(NEUTRAL, np.zeros(len(FEATURES)))]
    some += [made_up("label 0", own[0], "ben"), made_up("label 1", own[1], "ben")]
    common = common_changes(some)
    assert set(common) == {"ann"}, "two labels of ben say nothing of what they share"
    np.testing.assert_allclose(common["ann"], offset, atol=1e-12)
    left = without_common(some, common)
    np.testing.assert_allclose(left[:6], own, atol=1e-12)
    np.testing.assert_array_equal(left[6], 0.0)
    np.testing.assert_array_equal(left[7:], own[:2])


def test_takes_are_measured_against_their_neutral_take(takes: list[Take]) -> None:
    assert {(take.content, take.label) for take in takes} == {(c, s) for c in CONTENTS for s in STYLES}
    names = [f.name for f in FEATURES]
    for take in takes:
        neck = 10.0 * take.change[[names.index("neck_pitch"), names.index("head_pitch")]].sum()
        bent = {"sad": 20.0, "tired": 12.0}.get(take.label, 0.0)
        assert neck == pytest.approx(bent, abs=2.5)
        if take.label == NEUTRAL:
            np.testing.assert_allclose(take.change, 0.0, atol=1e-5)
            assert take.seen is take.seen_neutral


def test_takes_without_a_neutral_one_are_left_out(clips: Clips) -> None:
    lone = [(motion, label, "alone", "ben") for motion, label, _, _ in clips[1:2]]
    assert {take.content for take in measure_takes([*clips[:4], *lone])} == {"walk"}


@pytest.mark.parametrize("some", [slice(0, 0), slice(0, 2), slice(1, 4)])
def test_too_little_to_learn_from(clips: Clips, some: slice) -> None:
    with pytest.raises(MienError, match="two or more labels besides the neutral one"):
        measure_takes(clips[some])


def test_one_content_cannot_be_scored(takes: list[Take]) -> None:
    with pytest.raises(MienError, match="two or more contents"):
        scores([take for take in takes if take.content == "walk"], PLACES)


def test_labels_without_a_place_say_nothing_about_it(takes: list[Take]) -> None:
    places: dict[str, Point] = {label: PLACES[label] for label in ("sad", "excited")}
    model: EmotionModel = learn(takes, places, card={})
    assert set(model.places) == {NEUTRAL, "sad", "excited"}
    assert set(model.change.planes.names) == set(STYLES)
    sure = dict.fromkeys(STYLES, 0.0) | {"tired": 0.9, "sad": 0.1}
    assert model.place(sure) == pytest.approx(PLACES["sad"])
