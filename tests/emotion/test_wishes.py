"""What a place asks for: the learned changes at their places, nothing where the motion is already."""

from dataclasses import replace

import numpy as np
import pytest

import mien
from mien.analysis.laban_table import SELECTED
from mien.emotion.circumplex import Point
from mien.emotion.model import EmotionModel, shipped_model
from mien.emotion.wishes import FLOOR, scales, surfaces, wanted

CHOSEN = [d.number - 1 for d in SELECTED]


@pytest.fixture(scope="module")
def model() -> EmotionModel:
    return shipped_model()


def test_at_a_learned_place_it_is_the_learned_change(model: EmotionModel) -> None:
    assert not model.changes["neutral"].any()
    for label in ("sad", "happy", "angry"):
        learned = model.changes[label][CHOSEN]
        np.testing.assert_allclose(wanted(model, model.places[label]), learned, atol=1e-9)


def test_it_is_relative(model: EmotionModel) -> None:
    sad, happy = model.places["sad"], model.places["happy"]
    assert not wanted(model, sad, start=sad).any()
    there = wanted(model, happy, start=sad)
    np.testing.assert_allclose(there, -wanted(model, sad, start=happy))
    np.testing.assert_allclose(there, wanted(model, happy) - wanted(model, sad))


def test_a_place_outside_the_disc_is_drawn_in(model: EmotionModel) -> None:
    np.testing.assert_allclose(wanted(model, Point(3.0, 4.0)), wanted(model, Point(0.6, 0.8)))


def test_linear_changes_are_repeated_everywhere(model: EmotionModel) -> None:
    slope = np.random.default_rng(1).normal(size=(2, 121))
    linear = replace(model, changes={k: np.array(p) @ slope for k, p in model.places.items()})
    found = wanted(linear, Point(0.3, -0.4))
    np.testing.assert_allclose(found, (np.array([0.3, -0.4]) @ slope)[CHOSEN], atol=1e-9)


@pytest.mark.parametrize("labels", [("neutral", "sad", "happy"), ("neutral",), ()])
def test_too_few_places_are_refused(model: EmotionModel, labels: tuple[str, ...]) -> None:
    few = replace(model, places={k: model.places[k] for k in labels})
    with pytest.raises(mien.MienError, match="takes 4 or more"):
        surfaces(few)


def test_places_on_one_line_are_refused(model: EmotionModel) -> None:
    line = {k: Point(0.1 * i, 0.2 * i) for i, k in enumerate(model.places)}
    with pytest.raises(mien.MienError, match="do not determine a function"):
        surfaces(replace(model, places=line))


def test_scales_are_usual_changes_but_never_nothing(model: EmotionModel) -> None:
    found = scales(model)
    usual = np.sqrt(np.mean([model.changes[k][CHOSEN] ** 2 for k in model.places if k != "neutral"], axis=0))
    floor = np.array([FLOOR[d.feature.unit] for d in SELECTED])
    np.testing.assert_allclose(found, np.maximum(usual, floor))
    still = replace(model, changes={k: np.zeros(121) for k in model.places})
    np.testing.assert_allclose(scales(still), floor)
