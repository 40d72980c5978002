from collections.abc import Callable

import numpy as np
import pytest

from mien.samples import Sample, pendulum, spin

Places = Callable[[Sample], dict[str, np.ndarray]]


def test_the_pendulum_swings_by_its_formula(places: Places) -> None:
    sample = pendulum(amplitude=0.8, frequency=3.125, fps=100.0, seconds=1.0, skeleton="poser43")
    at = places(sample)
    arm = at["right_wrist"] - at["right_shoulder"]
    # The trunk leans back by one degree; the arm hangs from it.
    swing = np.arctan2(arm[:, 2], -arm[:, 1])
    expected = 0.8 * np.sin(2.0 * np.pi * 3.125 * sample.motion.times)
    np.testing.assert_allclose(swing - swing[0], expected, atol=1e-9)
    others = [place for role, place in at.items() if role not in ("right_elbow", "right_wrist")]
    assert all(np.ptp(place, axis=0).max() < 1e-9 for place in others)


@pytest.mark.parametrize("skeleton", ["standard22", "engine23"])
def test_the_spin_turns_twice_at_constant_speed(skeleton: str, places: Places) -> None:
    sample = spin(seconds=2.0, fps=60.0, skeleton=skeleton)
    at = places(sample)
    side = at["left_hip"] - at["right_hip"]
    heading = np.unwrap(np.arctan2(-side[:, 2], side[:, 0]))
    np.testing.assert_allclose(heading - heading[0], 4.0 * np.pi * sample.motion.times / 2.0, atol=1e-9)
    assert sample.angles["heading"][-1] == pytest.approx(4.0 * np.pi)
    for place in at.values():
        np.testing.assert_allclose(place[-1], place[0], atol=1e-9)
