"""Dynamic time warping against a slow twin, a known warp, and what must hold of every path."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import CubicSpline

from mien.errors import MienError
from mien.signal.dtw import knots, path

KINDS = {"limited": [(1, 1), (1, 2), (2, 1)], "free": [(1, 1), (1, 0), (0, 1)]}
elements = st.floats(-5, 5, allow_subnormal=False)
short = st.integers(2, 12).flatmap(lambda n: arrays(float, (n, 2), elements=elements))


def cheapest(a: np.ndarray, b: np.ndarray, steps: list[tuple[int, int]]) -> float:
    """The slow twin: the whole table, cell by cell, without a band."""
    table = np.full((len(a), len(b)), np.inf)
    for i in range(len(a)):
        for j in range(len(b)):
            distance = float(np.sqrt(((a[i] - b[j]) ** 2).sum()))
            if i == j == 0:
                table[i, j] = 2 * distance
            for p, q in steps:
                if i >= p and j >= q:
                    table[i, j] = min(table[i, j], table[i - p, j - q] + (p + q) * distance)
    return table[-1, -1] / (len(a) + len(b))


def swing(t: np.ndarray) -> np.ndarray:
    """A movement without symmetry, at shares ``t`` of its length."""
    return np.stack([np.sin(9 * t + k * t * t) + 0.3 * k * t for k in range(5)], axis=1)


@pytest.mark.parametrize("kind", KINDS)
@given(a=short, b=short)
def test_cost_is_that_of_the_slow_twin(kind, a, b):
    want = cheapest(a, b, KINDS[kind])
    if np.isfinite(want):
        assert path(a, b, steps=kind, band=2.0).cost == pytest.approx(want, abs=1e-12)
    else:
        with pytest.raises(MienError, match="joins the ends"):
            path(a, b, steps=kind, band=2.0)


@pytest.mark.parametrize("kind", KINDS)
@given(a=short, b=short)
def test_the_path_is_a_path_and_costs_what_it_says(kind, a, b):
    if not np.isfinite(cheapest(a, b, KINDS[kind])):
        return
    found = path(a, b, steps=kind, band=2.0)
    assert found.pairs[0].tolist() == [0, 0]
    assert found.pairs[-1].tolist() == [len(a) - 1, len(b) - 1]
    moves = np.diff(found.pairs, axis=0)
    assert {tuple(move) for move in moves.tolist()} <= set(KINDS[kind])
    distance = np.linalg.norm(a[found.pairs[:, 0]] - b[found.pairs[:, 1]], axis=1)
    total = 2 * distance[0] + (moves.sum(axis=1) * distance[1:]).sum()
    assert total / (len(a) + len(b)) == pytest.approx(found.cost, abs=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_with_itself_it_is_the_diagonal_at_no_cost(kind):
    a = swing(np.linspace(0, 1, 90))
    found = path(a, a, steps=kind)
    assert found.cost == 0.0
    np.testing.assert_array_equal(found.pairs, np.stack([np.arange(90)] * 2, axis=1))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("exponent", [1.2, 1 / 1.2])
def test_a_known_warp_is_found_within_a_frame(kind, exponent):
    t = np.linspace(0, 1, 240)
    found = knots(path(swing(t), swing(t**exponent), steps=kind), sigma=4, spacing=8)
    np.testing.assert_allclose(found[:, 0], 239 * (found[:, 1] / 239) ** exponent, atol=1.0)


@pytest.mark.parametrize("kind", KINDS)
def test_swapping_the_sequences_swaps_the_path(kind):
    random = np.random.default_rng(3)
    a, b = random.normal(size=(60, 3)).cumsum(axis=0), random.normal(size=(75, 3)).cumsum(axis=0)
    one, other = path(a, b, steps=kind), path(b, a, steps=kind)
    assert one.cost == pytest.approx(other.cost, abs=1e-12)
    np.testing.assert_array_equal(one.pairs, other.pairs[:, ::-1])


def test_the_path_stays_in_the_band():
    a, b = np.zeros((101, 1)), np.zeros((101, 1))
    a[20:], b[80:] = 1.0, 1.0  # the step would be matched 60 frames off the diagonal
    for band in (0.1, 0.3):
        pairs = path(a, b, steps="free", band=band).pairs
        off = np.abs(pairs[:, 0] - pairs[:, 1]).max()
        assert off == pytest.approx(100 * band, abs=1)
        assert path(a, b, steps="free", band=band).cost > 0
    assert path(a, b, steps="free", band=0.7).cost == 0


def test_with_slack_a_piece_is_found_in_the_whole():
    t = np.linspace(0, 1, 201)
    whole, piece = swing(t), swing(t[30:180])
    found = path(whole, piece, slack=0.2)
    assert found.cost < 1e-12
    np.testing.assert_array_equal(found.pairs[[0, -1]], [[30, 0], [179, 149]])
    assert path(whole, piece).pairs[0].tolist() == [0, 0]


def test_memory_is_that_of_the_band():
    a = swing(np.linspace(0, 1, 3000))
    tracemalloc.start()
    path(a, a, band=0.02)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 3e6, "a whole table of sums would take 72 MB, one of bytes 9"


@pytest.mark.parametrize("lengths", [(1, 1), (1, 4), (4, 1), (2, 3), (3, 3)])
def test_very_short_sequences(lengths):
    a, b = (swing(np.linspace(0, 1, n)) for n in lengths)
    pairs = path(a, b, steps="free").pairs
    assert pairs[0].tolist() == [0, 0]
    assert pairs[-1].tolist() == [n - 1 for n in lengths]
    found = knots(path(a, b, steps="free"), sigma=2, spacing=1)
    assert np.isfinite(found).all()
    np.testing.assert_array_equal(found[-1], [n - 1 for n in lengths])


@given(arrays(float, (40, 2), elements=elements), arrays(float, (50, 2), elements=elements))
def test_knots_rise_by_a_quarter_of_the_mean_at_least_and_keep_the_ends(a, b):
    found = knots(path(a, b, steps="free"), sigma=1.0, spacing=3.0)
    np.testing.assert_allclose(found[[0, -1]], [[0, 0], [39, 49]], atol=1e-12)
    slope = np.diff(found, axis=0) / [39, 49]
    assert (slope[:, 0] >= 0.25 * slope[:, 1] - 1e-12).all()
    assert (slope[:, 1] >= 0.25 * slope[:, 0] - 1e-12).all()


def test_knots_of_an_even_path_are_even():
    a = swing(np.linspace(0, 1, 61))
    b = CubicSpline(np.linspace(0, 1, 61), a)(np.linspace(0, 1, 91))
    found = knots(path(a, b), sigma=5, spacing=10)
    np.testing.assert_allclose(found[:, 1], 1.5 * found[:, 0], atol=1.0)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"steps": "limitd"}, "did you mean 'limited'"),
        ({"band": 0.0}, "band must be above 0"),
        ({"slack": 0.5}, "below 0.5"),
    ],
)
def test_what_does_not_fit_is_said(arguments, words):
    with pytest.raises(MienError, match=words):
        path(np.zeros((5, 2)), np.zeros((5, 2)), **arguments)


@pytest.mark.parametrize(("a", "b"), [((5, 2), (5, 3)), ((0, 2), (5, 2)), ((5,), (5,))])
def test_shapes_must_fit(a, b):
    with pytest.raises(MienError, match="shapes"):
        path(np.zeros(a), np.zeros(b))


def test_ends_too_far_apart_are_said():
    with pytest.raises(MienError, match="resample them"):
        path(np.zeros((10, 1)), np.zeros((30, 1)))
