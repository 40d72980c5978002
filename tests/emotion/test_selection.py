"""The rule that selects features, on tables whose standard deviations are known."""

import numpy as np
import pytest

from mien.emotion.selection import consistent, effective, select


def swinging(count: int, by: float) -> np.ndarray:
    """Values about 0.5 whose standard deviation is ``by`` (an even count, half above and half below)."""
    return 0.5 + by * np.where(np.arange(count) % 2, 1.0, -1.0)


@pytest.mark.parametrize(
    ("performers", "by", "passes"),
    [(9, 0.211, True), (7, 0.211, True), (6, 0.211, False), (9, 0.209, False)],
)
def test_a_feature_tells_emotions_apart_for_seven_of_nine(performers: int, by: float, passes: bool) -> None:
    means = np.full((9, 12, 1), 0.5)
    means[:performers, :, 0] = swinging(12, by)
    assert effective(means).tolist() == [passes]


@pytest.mark.parametrize(
    ("emotions", "by", "passes"),
    [(12, 0.199, True), (0, 0.201, False), (10, 0.201, True), (9, 0.201, False)],
)
def test_a_feature_is_alike_for_ten_of_twelve(emotions: int, by: float, passes: bool) -> None:
    """``emotions`` in which all performers are the same; in the others they differ by ``by``."""
    means = np.full((10, 12, 1), 0.5)
    means[:, emotions if emotions < 12 else 0 :, 0] = swinging(10, by)[:, None]
    assert consistent(means).tolist() == [passes]


def test_selected_is_what_is_both() -> None:
    rng = np.random.default_rng(1)
    means = np.full((9, 12, 4), 0.5)
    means[:, :, 1] = swinging(12, 0.3)  # the same for all performers, different emotions
    means[:, :, 2] = swinging(12, 0.3) * np.where(np.arange(9) % 2, 1.0, -1.0)[:, None]  # turned round
    means[:, :, 3] = rng.uniform(0.0, 1.0, (9, 1))  # different people, no emotion
    assert select(means).tolist() == [1]
    assert select(means[:, :, [0, 2, 3]]).tolist() == []
