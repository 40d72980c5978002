"""The disc of emotion words: both tables, distances, quadrants."""

import pytest

from mien.emotion.circumplex import QUADRANTS, TABLES, clamp, nearest, point, quadrant, source, words
from mien.errors import RecipeError

# The twelve emotions of Aristidou et al. 2017, three a quadrant, as far as the text names them.
TWELVE = (
    *("afraid", "angry", "annoyed"),
    *("excited", "happy", "pleased"),
    *("satisfied", "relaxed", "tired"),
    *("bored", "sad", "miserable"),
)


@pytest.mark.parametrize("table", TABLES)
def test_every_word_is_on_the_disc_and_has_a_source(table: str) -> None:
    assert len(words(table=table)) > 18
    assert all(p.valence**2 + p.arousal**2 <= 1.0 + 1e-12 for p in words(table=table).values())
    assert "Russell 1980" in source(table=table)
    assert words(table=table)["neutral"] == (0.0, 0.0)


def test_three_emotions_of_the_twelve_are_in_each_quadrant() -> None:
    found = [quadrant(*point(word)) for word in TWELVE]
    assert found == ["Q1"] * 3 + ["Q2"] * 3 + ["Q3"] * 3 + ["Q4"] * 3
    assert QUADRANTS["Q1"] == "intense and unpleasant"


def test_the_tables_disagree_where_their_authors_do() -> None:
    assert point("angry").valence < -0.5 < point("angry", table="circle").valence
    assert point("pleased").arousal > 0 > point("pleased", table="circle").arousal


def test_each_word_is_nearest_to_its_own_place() -> None:
    for word, place in words().items():
        assert nearest(*place)[0] == (word, 0.0)
    assert [word for word, _ in nearest(-0.5, 0.6)][:2] == ["angry", "afraid"]


def test_what_is_outside_comes_to_the_rim() -> None:
    assert clamp(3.0, 4.0) == pytest.approx((0.6, 0.8))
    assert clamp(0.3, -0.4) == (0.3, -0.4)


def test_slips_are_answered_with_the_nearest_word() -> None:
    assert point("  At  Ease ") == point("at ease")
    with pytest.raises(RecipeError, match="'happy'"):
        point("hapy")
    with pytest.raises(RecipeError, match="table"):
        words(table="rating")
