"""Finding clips: distances worked out by hand, and clips that are like another."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.manner_features import FEATURES
from mien.emotion.circumplex import Point
from mien.emotion.library import by_example, by_place, by_word
from mien.emotion.model import shipped_model
from mien.emotion.reading import Reading
from mien.errors import MienError
from mien.recipe import Step

MODEL = shipped_model()


def reading(place: tuple[float, float], labels: Mapping[str, float], *, manner: float = 0.0) -> Reading:
    known = dict.fromkeys(MODEL.change.planes.names, 0.0) | labels
    return Reading(Point(*place), known, (), "neutral", np.full(len(FEATURES), manner))


LIBRARY = {
    "b": reading((0.043, -0.628), {"tired": 0.5, "old": 0.5}, manner=1.0),
    "a": reading((0.343, -0.228), {"tired": 0.9, "happy": 0.1}, manner=-0.5),
    "c": reading((-0.6, 0.3), {"angry": 1.0}, manner=0.25),
}


def test_by_a_place() -> None:
    found = by_place(LIBRARY, Point(0.043, -0.228))
    assert [match.name for match in found] == ["a", "b", "c"]
    assert [match.distance for match in found[:2]] == pytest.approx([0.3, 0.4])


def test_by_a_word_that_is_a_label() -> None:
    """The distance on the disc, and what the probability lacks to 1."""
    found = {match.name: match.distance for match in by_word(LIBRARY, " Tired ", model=MODEL)}
    assert list(found) == ["b", "a", "c"]
    assert found["b"] == pytest.approx(0.0 + 0.5)
    assert found["a"] == pytest.approx(0.5 + 0.1)


def test_by_a_label_without_a_place_and_a_word_without_a_label() -> None:
    old = by_word(LIBRARY, "old", model=MODEL)
    assert [(match.name, match.distance) for match in old] == [("b", 0.5), ("a", 1.0), ("c", 1.0)]
    bored = by_word(LIBRARY, "bored", model=MODEL)
    assert bored[0].distance == pytest.approx(np.hypot(0.043 + 0.664, -0.628 + 0.635))
    assert by_word({}, "bored", model=MODEL) == ()


def test_by_an_unknown_word() -> None:
    with pytest.raises(MienError, match="did you mean 'tired'"):
        by_word(LIBRARY, "tierd", model=MODEL)


def test_by_an_example() -> None:
    found = by_example(LIBRARY, LIBRARY["c"])
    assert [(m.name, m.distance) for m in found] == [("c", 0.0), ("b", 0.5), ("a", 0.75)]


def test_what_is_like_it_but_more_is_nearer_than_what_is_like_nothing() -> None:
    """Twice the manner is its like; a clip with nothing unusual is not, though its numbers are as near."""
    example, more, plain = (reading((0.0, 0.0), {}, manner=m) for m in (1.0, 2.0, 0.0))
    assert [m.name for m in by_example({"plain": plain, "more": more}, example)] == ["more", "plain"]
    assert [m.name for m in by_example({"more": more, "example": example}, plain)] == ["example", "more"]


def test_guesses_are_not_mixed_with_what_is_sure() -> None:
    guess = Reading(Point(0, 0), {"sad": 1.0}, (), "usual", np.zeros(len(FEATURES)))
    with pytest.raises(MienError, match="all against a neutral clip, or none"):
        by_example(LIBRARY, guess)


def test_plain_data() -> None:
    data = by_example(LIBRARY, LIBRARY["c"])[1].as_data()
    assert (data["file"], data["distance"], data["valence"]) == ("b", 0.5, 0.043)
    assert "why" not in data


def test_edits_find_their_like() -> None:
    """Two clips that were bent forward are nearer to each other than to two with larger movement."""
    walk, stroll = (samples.walk(seconds=3.0, cadence=c).motion for c in (1.8, 1.7))
    bent, large = [Step("posture", {"head": 25.0, "trunk": 15.0})], [Step("path_length", {"mid": 1.5})]
    clips = {
        f"{name} {how}": mien.apply(motion, steps)
        for name, motion in (("walk", walk), ("stroll", stroll))
        for how, steps in (("bent", bent), ("large", large), ("plain", []))
    }
    library = {name: mien.read(motion, neutral=walk) for name, motion in clips.items()}
    for how in ("bent", "large"):
        others = {name: found for name, found in library.items() if name != f"walk {how}"}
        assert by_example(others, library[f"walk {how}"])[0].name == f"stroll {how}"


def test_what_has_no_place_is_not_near_to_one() -> None:
    """A clip that is like a label nowhere on the disc is no find, wherever the rest of it stands."""
    sure = reading((0.1, -0.6), {"tired": 1.0})
    nowhere = replace(reading((0.0, -0.6), {"old": 0.99}), placed=0.01)
    library = {"nowhere": nowhere, "sure": sure}
    assert [m.name for m in by_place(library, Point(0.0, -0.6))] == ["sure", "nowhere"]
    found = by_word(library, "sleepy", model=MODEL)
    assert [m.name for m in found] == ["sure", "nowhere"]
