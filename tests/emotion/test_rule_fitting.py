"""The fit: as good as a grid, blocks by themselves, curves between clusters, a band that is least squares."""

from dataclasses import replace

import numpy as np
import pytest

import mien
from mien import samples
from mien.curve import evaluate
from mien.emotion.circumplex import Point, point
from mien.emotion.control_features import POSE
from mien.emotion.joint_fitting import BEND, SIZE, _banded
from mien.emotion.model import shipped_model
from mien.emotion.pose_clusters import PoseSet
from mien.emotion.rule_curves import SEEN, in_time, through
from mien.emotion.rule_fitting import HIGH, LOW, PLACES, Found, fit, penalty, sequential
from mien.emotion.rule_wish import Wish, at
from mien.emotion.synthesis import synthesise
from mien.emotion.wishes import Wanted, wanted
from mien.kinematics.body import Body

SAD, HAPPY = point("sad"), point("happy")


def wish_of(name: str, place: Point) -> Wish:
    return Wish.of(samples.SAMPLES[name]().motion, wanted(shipped_model(), place))


@pytest.mark.parametrize("place", [SAD, HAPPY])
@pytest.mark.parametrize("name", ["walk", "wave"])
@pytest.mark.parametrize(("rule", "number"), [("pelvis", 4), ("torso", 20)])
def test_a_single_coefficient_is_as_good_as_a_fine_grid(
    name: str, place: Point, rule: str, number: int
) -> None:
    """Cluster by cluster, with the rules before at what was found."""
    wish = wish_of(name, place)
    found = sequential(wish).pose
    where = PLACES[rule][0]
    base = np.ones_like(found)
    base[:, :where] = found[:, :where]
    column = POSE.index(number)

    def cost(values: np.ndarray) -> np.ndarray:
        c = base.copy()
        c[:, where] = values
        rows = wish.misses(wish.ruled(c[None]), near=None)[0, :, column] ** 2
        own = penalty(values, LOW[where], HIGH[where]) ** 2
        return 0.5 * (np.bincount(wish.member, rows, minlength=len(values)) + own)

    grid = np.geomspace(LOW[where], HIGH[where], 400)
    least = np.min([cost(np.full(wish.clusters, value)) for value in grid], axis=0)
    assert (cost(found[:, where]) <= 1.02 * least + 1e-3).all()


def test_blocks_are_fitted_each_for_itself() -> None:
    """A line through points for each block: as by the normal equations, whatever the other block wants."""
    rng = np.random.default_rng(3)
    member = np.repeat([0, 1], 12)
    slope = rng.normal(size=(24, 2, 3))
    truth = np.array([[1.1, 0.9, 1.2], [0.8, 1.3, 1.0]])
    aim = np.einsum("krp,kp->kr", slope, truth[member])

    def misses(trials: np.ndarray) -> np.ndarray:
        return 30.0 * (np.einsum("krp,nkp->nkr", slope, trials[:, member]) - aim)

    low, high = np.full(3, 0.5), np.full(3, 2.0)
    np.testing.assert_allclose(fit(misses, np.ones((2, 3)), low, high, member), truth, atol=0.01)


def test_a_cluster_gets_what_it_wants_and_only_it() -> None:
    """Two clusters, arm up and arm down: one is to have its hands further out, the other nothing."""
    wave = samples.wave(seconds=6.0).motion
    body = Body.of(wave)
    centres = PoseSet.of(at(wave, np.array([0, len(wave) // 2])), body)
    model = shipped_model()
    numbers = np.zeros((2, 30))
    numbers[1, [POSE.index(n) for n in (2, 3)]] = 0.03
    weights = np.tile(model.clusters.weights[0], (2, 1))
    wish = Wish.of(wave, Wanted(centres, numbers, weights))
    assert wish.clusters == 2
    found = sequential(wish)
    np.testing.assert_allclose(found.pose[0], 1.0, atol=1e-3)
    assert np.abs(found.pose[1] - 1.0).max() > 0.05
    assert found.tempo == pytest.approx(1.0, abs=1e-3)


def test_tempo_is_the_analytic_one() -> None:
    """All speeds times r, accelerations r^2, jerk r^3: the tempo is r, but for the little penalty."""
    from mien.emotion.control_features import ORDER, toned
    from mien.emotion.rule_fitting import fitted_tempo

    wish = wish_of("walk", SAD)
    quick = replace(
        wish, pace_aim=toned(wish.pace * 1.25**ORDER).mean(axis=0), pace_weights=np.full(14, 20.0)
    )
    assert fitted_tempo(quick) == pytest.approx(1.25, abs=0.01)


def test_curves_hold_each_cluster_and_go_over_between() -> None:
    pose = np.array([[0.9, 1.0], [0.8, 1.0]])
    curve, steady = in_time([(0.0, 0), (2.0, 1), (5.0, 0)], pose)
    assert steady == 1.0
    values = evaluate(curve, np.array([0.0, 1.5, 2.0, 3.0, 4.5, 6.0]))
    np.testing.assert_allclose(values, [0.9, 0.9, 0.85, 0.8, 0.8, 0.9], atol=1e-9)


def test_few_keys_tell_a_curve() -> None:
    times = np.linspace(0.0, 8.0, 25)
    column = 1.0 + 0.2 * np.sin(times)
    (curve,) = through(times, column[:, None])
    assert len(curve) < 20
    np.testing.assert_allclose(evaluate(curve, times), column, atol=2.0 * SEEN)


def test_the_band_is_the_dense_least_squares() -> None:
    rng = np.random.default_rng(4)
    keys, count = 7, 3
    slopes, away = rng.normal(size=(keys, 5, count)), rng.normal(size=(keys, 5))
    dense = np.zeros((keys * 5, keys * count))
    for k in range(keys):
        dense[5 * k : 5 * k + 5, count * k : count * k + count] = slopes[k]
    bend = np.kron(np.diff(np.eye(keys), n=2, axis=0), np.eye(count))
    rows = np.concatenate([dense, np.sqrt(SIZE) * np.eye(keys * count), np.sqrt(BEND) * bend])
    right = np.concatenate([-away.ravel(), np.zeros(len(rows) - keys * 5)])
    expected = np.linalg.lstsq(rows, right, rcond=None)[0].reshape(keys, count)
    np.testing.assert_allclose(_banded(slopes, away), expected, atol=1e-9)


@pytest.mark.parametrize("method", ["rules", "joint"])
def test_strength_is_monotone_and_nothing_at_0(method: str) -> None:
    """The head comes down further the stronger sad is done, also where numbers change over time."""
    from mien.kinematics.landmarks import landmarks

    wave = samples.wave(seconds=4.0).motion
    recipe = synthesise(wave, SAD, method=method)
    body = Body.of(wave)
    heads = []
    for strength in (0.0, 0.25, 0.5, 0.75, 1.0):
        done = mien.apply(wave, recipe, strength=strength)
        heads.append(float((landmarks(done, body)["head"] @ body.up).mean()))
    assert mien.apply(wave, recipe, strength=0.0) is wave
    assert (np.diff(heads) < 0.0).all()


def test_absolute_asks_the_same_of_a_bowed_clip_and_an_upright_one() -> None:
    """A clip that is bent is straightened where the place is neutral; relative leaves it as it is."""
    walk = samples.walk(seconds=3.0).motion
    bent = mien.apply(walk, [mien.Step("posture", {"trunk": 25.0, "head": 10.0})])
    middle = Point(0.0, 0.0)
    assert synthesise(bent, middle).steps == ()
    straight, kept = (
        float(np.mean(synthesise(m, middle, mode="absolute").steps[0].parameters.get("torso", 1.0)))
        for m in (bent, walk)
    )
    assert straight > kept
    with pytest.raises(mien.MienError, match="mode of synthesis"):
        synthesise(walk, SAD, mode="total")


def test_all_numbers_and_back() -> None:
    found = Found(np.arange(20.0).reshape(2, 10), 1.5)
    again = Found.of(found.vector)
    np.testing.assert_array_equal(again.pose, found.pose)
    assert again.tempo == found.tempo
