"""What a place asks for: the learned changes at their places, nothing where the motion is already."""

from dataclasses import replace

import numpy as np
import pytest

import mien
from mien.emotion.circumplex import Point
from mien.emotion.model import EmotionModel, shipped_model
from mien.emotion.wishes import EMPHASIS, surfaces, wanted


@pytest.fixture(scope="module")
def model() -> EmotionModel:
    return shipped_model()


def with_changes(model: EmotionModel, changes: dict[str, np.ndarray]) -> EmotionModel:
    return replace(model, clusters=replace(model.clusters, changes=changes))


def test_at_a_learned_place_it_is_the_learned_change(model: EmotionModel) -> None:
    assert not model.clusters.changes["neutral"].any()
    for label in ("sad", "happy", "angry"):
        learned = EMPHASIS * model.clusters.changes[label]
        np.testing.assert_allclose(wanted(model, model.places[label]).numbers, learned, atol=1e-9)


def test_it_is_relative(model: EmotionModel) -> None:
    sad, happy = model.places["sad"], model.places["happy"]
    assert not wanted(model, sad, start=sad).numbers.any()
    there = wanted(model, happy, start=sad).numbers
    np.testing.assert_allclose(there, -wanted(model, sad, start=happy).numbers)
    np.testing.assert_allclose(there, wanted(model, happy).numbers - wanted(model, sad).numbers)


def test_absolute_is_what_emotions_there_have(model: EmotionModel) -> None:
    tables = model.clusters
    for label in ("sad", "neutral"):
        found = wanted(model, model.places[label], mode="absolute")
        assert found.absolute
        np.testing.assert_allclose(found.numbers, tables.rest + tables.changes[label], atol=1e-9)


def test_a_place_outside_the_disc_is_drawn_in(model: EmotionModel) -> None:
    far, near = wanted(model, Point(3.0, 4.0)), wanted(model, Point(0.6, 0.8))
    np.testing.assert_allclose(far.numbers, near.numbers)


def test_linear_changes_are_repeated_everywhere(model: EmotionModel) -> None:
    shape = model.clusters.rest.shape
    slope = np.random.default_rng(1).normal(size=(2, *shape))
    linear = with_changes(model, {k: np.tensordot(p, slope, 1) for k, p in model.places.items()})
    found = wanted(linear, Point(0.3, -0.4)).numbers
    np.testing.assert_allclose(found, EMPHASIS * np.tensordot([0.3, -0.4], slope, 1), atol=1e-9)


@pytest.mark.parametrize("labels", [("neutral", "sad", "happy"), ("neutral",), ()])
def test_too_few_places_are_refused(model: EmotionModel, labels: tuple[str, ...]) -> None:
    few = replace(model, places={k: model.places[k] for k in labels})
    with pytest.raises(mien.MienError, match="takes 4 or more"):
        surfaces(few)


def test_places_on_one_line_are_refused(model: EmotionModel) -> None:
    line = {k: Point(0.1 * i, 0.2 * i) for i, k in enumerate(model.places)}
    with pytest.raises(mien.MienError, match="do not determine a function"):
        surfaces(replace(model, places=line))
