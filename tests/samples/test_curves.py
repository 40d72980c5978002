import numpy as np
import pytest
from scipy.interpolate import BPoly

from mien.samples.curves import cycle, keyed

KEYS = [(0.2, 1.0, 0.5, -2.0), (0.7, -0.3), (1.1, 2.0, 0.0, 3.0), (1.6, 0.5, -1.0)]


def test_keyed_is_the_hermite_polynomial_between_keys() -> None:
    t = np.linspace(0.2, 1.6, 400)
    full = [(*key[1:], 0.0, 0.0)[:3] for key in KEYS]
    oracle = BPoly.from_derivatives([key[0] for key in KEYS], full)
    np.testing.assert_allclose(keyed(t, KEYS), oracle(t), atol=1e-12)


def test_keyed_holds_the_end_values_exactly() -> None:
    assert (keyed(np.array([-1.0, 0.2]), KEYS) == 1.0).all()
    assert (keyed(np.array([1.6, 9.0]), KEYS) == 0.5).all()
    assert keyed(np.array([5.0]), [(1.0, 3.0)]) == 3.0


@pytest.mark.parametrize(("share", "value"), [(0.25, 0.103515625), (0.5, 0.5), (0.75, 0.896484375)])
def test_from_rest_to_rest_it_is_the_minimum_jerk_profile(share: float, value: float) -> None:
    # 10 u^3 - 15 u^4 + 6 u^5 (Flash & Hogan 1985), worked out by hand.
    assert keyed(np.array([2.0 + 3.0 * share]), [(2.0, 10.0), (5.0, 30.0)])[0] == pytest.approx(
        10 + 20 * value
    )


def test_cycle_peaks_where_it_says() -> None:
    phase = np.arange(0.0, 1.0, 0.01)
    curve = cycle(phase, 5.0, (2.0, 0.3))
    assert phase[curve.argmax()] == pytest.approx(0.3)
    assert curve.max() == pytest.approx(7.0)
    np.testing.assert_allclose(
        cycle(phase, 5.0, (2.0, 0.3), (1.0, 0.1)), cycle(phase + 1, 5.0, (2.0, 0.3), (1.0, 0.1))
    )
