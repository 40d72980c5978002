"""Recipes for every place of the disc: the presets at their words, nothing at the centre, calm between."""

import numpy as np
import pytest

from mien.edits.registry import EDITS
from mien.emotion.circumplex import Point, point
from mien.emotion.palette import ANCHORS, KNOBS, as_steps, recipe_at, settings, settings_at
from mien.emotion.presets import preset


@pytest.mark.parametrize("word", ANCHORS)
def test_at_its_word_it_is_the_preset(word: str) -> None:
    numbers = settings(preset(word).steps)
    np.testing.assert_allclose(settings_at(*point(word)), numbers, atol=1e-9)
    made = recipe_at(*point(word))
    np.testing.assert_allclose(settings(made.steps), numbers, atol=1e-2)
    assert made.steps[-1].edit == "foot_plant"
    assert made.safe


def test_from_a_point_to_itself_is_nothing() -> None:
    assert recipe_at(0.0, 0.0).steps == ()
    assert recipe_at(0.3, -0.2, start=Point(0.3, -0.2)).steps == ()


def test_there_and_back_cancel() -> None:
    there = settings(recipe_at(*point("sad"), start=point("happy")).steps)
    back = settings(recipe_at(*point("happy"), start=point("sad")).steps)
    about = [EDITS[knob.edit].parameters[knob.parameter].about for knob in KNOBS]
    both_ways = np.array([a.low < a.neutral < a.high for a in about])  # a beat can be made, not taken out
    # Factors are written with two digits, so their logarithms are a hundredth or two off.
    np.testing.assert_allclose(there[both_ways], -back[both_ways], atol=2e-2)
    assert (there[~both_ways] * back[~both_ways] == 0.0).all()
    assert both_ways.sum() > 15


def test_it_is_continuous_and_within_what_the_presets_have() -> None:
    away = np.array([np.hypot(*point(word)) for word in ANCHORS])
    corners = np.array([settings(preset(word).steps) for word in ANCHORS]) / away[:, None]
    scale = np.array([knob.scale for knob in KNOBS])
    turn = np.linspace(0.0, 2.0 * np.pi, 721)
    for radius in (0.2, 0.6, 1.0):
        around = np.array([settings_at(radius * np.cos(a), radius * np.sin(a)) for a in turn])
        assert (np.abs(np.diff(around, axis=0)) / scale).max() < 0.2
        assert (around >= radius * corners.min(axis=0) - 1e-9).all()
        assert (around <= radius * corners.max(axis=0) + 1e-9).all()
        np.testing.assert_allclose(around[0], around[-1], atol=1e-9)


def test_further_is_more_in_every_direction() -> None:
    for angle in np.linspace(0.0, 2.0 * np.pi, 50):
        way = np.array([settings_at(r * np.cos(angle), r * np.sin(angle)) for r in np.linspace(0, 1, 11)])
        np.testing.assert_allclose(way, way[-1] * np.linspace(0, 1, 11)[:, None], atol=1e-12)


def test_arousal_quickens_and_displeasure_bends() -> None:
    head, rate = (next(i for i, k in enumerate(KNOBS) if k.parameter == p) for p in ("head", "rate"))
    assert settings_at(0.0, 0.7)[rate] > 0.05 > -0.05 > settings_at(0.0, -0.7)[rate]
    assert settings_at(-0.7, -0.2)[head] > 5.0 > -5.0 > settings_at(0.7, 0.4)[head]


def test_steps_and_numbers_are_each_others_reverse() -> None:
    numbers = np.array([round(knob.scale, 2) for knob in KNOBS])
    np.testing.assert_allclose(settings(as_steps(numbers)), numbers, atol=1e-2)
