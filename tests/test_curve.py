"""Numbers that change over time: how they are read, and that they neither jump nor overshoot."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.curve import evaluate, multiply, read_varying, shown, values
from mien.errors import RecipeError

keys = st.lists(st.tuples(st.floats(0, 9), st.floats(-3, 3)), min_size=1, max_size=6).map(
    lambda pairs: tuple(sorted({round(t, 2): v for t, v in pairs}.items()))
)


@pytest.mark.parametrize(
    ("given", "read"),
    [
        (0.5, 0.5),
        ("0.5", 0.5),
        ("0:0,1.5:1", ((0.0, 0.0), (1.5, 1.0))),
        ([[0, 0], [1.5, 1]], ((0.0, 0.0), (1.5, 1.0))),
        (((2, 3),), ((2.0, 3.0),)),
    ],
)
def test_forms(given: object, read: object) -> None:
    assert read_varying("x", given) == read


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("fast", "x must be a number, or times with their values such as 0:0,1.5:1, got 'fast'"),
        ("0:1:2", "x must be a number"),
        ("0:0,1", "x must be a number"),
        ([], "x must be a number"),
        (None, "x must be a number"),
        (True, "x must be a number"),
        ([[0, True]], "x must be a number"),
        ([[0, float("nan")]], "x must be a number"),
        ([[0, 1, 2]], "x must be a number"),
        ([[0, 1], 2], "x must be a number"),
        ([[1, 0], [1, 1]], "x: the times of its keys must go up, got 1 s after 1 s"),
    ],
)
def test_what_is_none(given: object, message: str) -> None:
    with pytest.raises(RecipeError, match=r".") as caught:
        read_varying("x", given)
    assert message in str(caught.value)


def test_two_keys_are_a_smoothstep() -> None:
    """Level at both ends, so ``v0 + (v1 - v0) (3 u^2 - 2 u^3)``: the one cubic that fits."""
    at = np.linspace(-1.0, 4.0, 501)
    u = np.clip((at - 0.5) / 1.5, 0.0, 1.0)
    np.testing.assert_allclose(
        evaluate(((0.5, 2.0), (2.0, 1.0)), at), 2.0 - (3 * u**2 - 2 * u**3), atol=1e-12
    )


@given(keys)
def test_a_curve_meets_its_keys_and_stays_between_them(curve: tuple[tuple[float, float], ...]) -> None:
    times, amounts = np.array(curve).T
    np.testing.assert_allclose(evaluate(curve, times), amounts, atol=1e-12)
    fine = np.linspace(-1.0, 10.0, 1201)
    found = evaluate(curve, fine)
    after = np.clip(np.searchsorted(times, fine), 1, max(len(times) - 1, 1)) if len(times) > 1 else 0
    low = np.minimum(amounts[after - 1], amounts[after]) if len(times) > 1 else amounts[0]
    high = np.maximum(amounts[after - 1], amounts[after]) if len(times) > 1 else amounts[0]
    assert (found >= low - 1e-12).all()
    assert (found <= high + 1e-12).all()


def test_speed_does_not_jump() -> None:
    curve = ((0.2, 0.0), (1.0, 1.0), (1.6, 0.3), (3.0, 0.5))
    at = np.linspace(0.0, 3.5, 35_001)
    speed = np.diff(evaluate(curve, at)) / np.diff(at)
    assert np.abs(np.diff(speed)).max() < 2e-3  # a jump would be as large as the speeds themselves, about 1
    assert abs(speed[0]) < 1e-9
    assert abs(speed[-1]) < 1e-9


def test_products() -> None:
    curve = ((0.0, 0.0), (2.0, 1.5))
    assert multiply(0.5, 3.0, most=2.0) == 1.5
    assert multiply(1.0, 3.0, most=2.0) == 2.0
    assert multiply(curve, 2.0, most=2.0) == ((0.0, 0.0), (2.0, 2.0))
    both = multiply(curve, ((1.0, 1.0), (3.0, 0.0)), most=2.0)
    assert [time for time, _ in both] == [0.0, 1.0, 2.0, 3.0]
    np.testing.assert_allclose(values(both), [0.0, 0.75, 0.75, 0.0], atol=1e-12)


def test_a_person_reads_what_a_person_wrote() -> None:
    for text in ("0.8", "0:0,1.5:1", "0:0.25,2:1.125"):
        assert shown(read_varying("x", text)) == text
