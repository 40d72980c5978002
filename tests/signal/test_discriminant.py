"""Linear discriminants beside scikit-learn's, and where the answer is known."""

import numpy as np
import pytest

from mien.errors import MienError
from mien.signal.discriminant import discriminate


@pytest.fixture
def cloud() -> tuple[np.ndarray, list[str]]:
    rng = np.random.default_rng(3)
    centres = {"a": [0, 0, 0], "b": [3, 0, 1], "c": [0, 3, -1]}
    groups = [name for name in centres for _ in range(12)]
    return np.array([centres[g] for g in groups]) + rng.normal(size=(36, 3)) * [1.0, 2.0, 0.5], groups


def test_it_agrees_with_scikit_learn(cloud: tuple[np.ndarray, list[str]]) -> None:
    analysis = pytest.importorskip("sklearn.discriminant_analysis")
    points, groups = cloud
    theirs = analysis.LinearDiscriminantAnalysis(solver="lsqr", shrinkage=0.4, priors=[1 / 3] * 3)
    theirs.fit(points, groups)
    mine = discriminate(points, groups, shrinkage=0.4)
    asked = np.random.default_rng(4).normal(scale=3.0, size=(50, 3))
    expected = theirs.predict_proba(asked)
    # scikit-learn shrinks each group's covariance after scaling it; the planes are near, not the same.
    assert (mine.log_probabilities(asked).argmax(axis=1) == expected.argmax(axis=1)).mean() > 0.94
    np.testing.assert_allclose(np.exp(mine.log_probabilities(asked)).sum(axis=1), 1.0)


def test_two_round_groups_are_parted_halfway() -> None:
    rng = np.random.default_rng(0)
    noise = rng.normal(size=(4000, 2))
    points = np.concatenate([noise, noise + [4.0, 0.0]])
    found = discriminate(points, ["left"] * 4000 + ["right"] * 4000, shrinkage=0.0)
    middle = np.exp(found.log_probabilities(np.array([2.0, 0.0]) + noise.mean(axis=0)))
    assert middle == pytest.approx([0.5, 0.5], abs=0.02)
    # Of two unit normals 4 apart, the log of the odds falls by 4 for each step of 1.
    odds = np.diff(found.log_probabilities(np.array([[1.0, 0.0], [3.0, 0.0]])), axis=1)[:, 0]
    assert odds[1] - odds[0] == pytest.approx(8.0, rel=0.05)


def test_what_speaks_for_a_group_is_where_it_lies(cloud: tuple[np.ndarray, list[str]]) -> None:
    points, groups = cloud
    pulls = discriminate(points, groups).pulls(np.array([3.0, 0.0, 0.0]), "b")
    assert pulls.argmax() == 0
    assert pulls[0] > 0


@pytest.mark.parametrize(
    ("points", "groups", "message"),
    [([[1.0], [2.0]], ["a", "a"], "two or more"), ([[1.0], [2.0]], ["a", "b"], "more than one")],
)
def test_what_cannot_be_told_apart(points: list[list[float]], groups: list[str], message: str) -> None:
    with pytest.raises(MienError, match=message):
        discriminate(np.array(points), groups)
