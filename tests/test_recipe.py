"""Steps are short to read, take what a person types, and refuse what no step is."""

from typing import Any

import pytest

from mien.errors import RecipeError
from mien.recipe import Recipe, Step


def test_a_step_shows_the_call_that_makes_it() -> None:
    assert repr(Step("mirror")) == "Step('mirror')"
    step = Step("posture", {"head": 20.0}, strength=0.5, parts=("head",), span=(0.5, 2.0), ease=0.1)
    assert repr(step) == (
        "Step('posture', {'head': 20.0}, strength=0.5, parts=('head',), span=(0.5, 2.0), ease=0.1)"
    )
    assert eval(repr(step), {"Step": Step}) == step
    assert "Step('mirror')" in repr(Recipe("mine", (Step("mirror"),)))


def test_parts_and_span_may_be_text() -> None:
    assert Step("posture", parts="head, arms", span="0.5,2") == Step(
        "posture", parts=("head", "arms"), span=(0.5, 2.0)
    )
    assert Step("posture", parts=["head"], span=[1, 2]) == Step("posture", parts=("head",), span=(1, 2))
    assert Step("posture", parts=None).parts == ()


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"edit": 3}, "name of an edit.* got 3"),
        ({"parameters": 20}, "posture: parameters must be a mapping .* got 20"),
        ({"parameters": [("head", 20)]}, "must be a mapping"),
        ({"strength": "much"}, "posture: strength must be a number, or times .* got 'much'"),
        ({"strength": [(0, 1), (0, 2)]}, "posture: strength: the times of its keys must go up"),
        ({"strength": [(0, "x")]}, "posture: strength must be a number, or times"),
        ({"strength": []}, "posture: strength must be a number, or times"),
        ({"ease": None}, "posture: ease must be a number"),
        ({"parts": 3}, "parts must be names"),
        ({"span": 1.0}, "two times in seconds"),
        ({"span": (1.0, None)}, "two times in seconds"),
    ],
)
def test_what_no_step_is(fields: dict[str, Any], message: str) -> None:
    with pytest.raises(RecipeError, match=message):
        Step(**{"edit": "posture", **fields})
