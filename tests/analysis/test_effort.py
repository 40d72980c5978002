"""Effort factors: known truth, a slow twin, and what must not matter."""

import numpy as np
import pytest

from mien import apply, samples
from mien.analysis.effort import EFFORT, effort
from mien.errors import MienError
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.mass import mass_model
from mien.recipe import Step
from mien.signal.derivatives import derivatives

WEIGHT, TIME, SPACE, FLOW = range(4)
AHEAD = np.array([0.0, 0.0, 1.0])


def test_a_body_at_rest(made) -> None:
    motion, body = made.pose(60)
    found = effort(motion, body=body)
    np.testing.assert_allclose(found.frames[:, [WEIGHT, TIME, FLOW]], 0.0, atol=1e-6)
    np.testing.assert_allclose(found.frames[:, SPACE], 1.0)


def test_constant_speed_is_energy_and_straight(made) -> None:
    motion, body = made.pose(90)
    moved = made.carried(motion, body, 0.8 * body.height * motion.times[:, None] * AHEAD)
    found = effort(moved, body=body)
    np.testing.assert_allclose(found.frames[:, WEIGHT], 0.5 * 0.8**2, rtol=1e-9)
    np.testing.assert_allclose(found.frames[:, SPACE], 1.0, rtol=1e-9)
    np.testing.assert_allclose(found.frames[:, [TIME, FLOW]], 0.0, atol=1e-5)


def test_a_circle_is_told_by_its_radius_and_period(made) -> None:
    """Two seconds a round: half the way in 1.13 s (34 steps of the window), the chord against the arc."""
    motion, body = made.pose(241)
    angle = np.pi * motion.times
    radius = 0.4 * 0.5 ** ((0.5 / 6.0) ** 2)
    circle = np.stack([np.cos(angle), np.zeros(241), np.sin(angle)], axis=1)
    found = effort(made.carried(motion, body, 0.4 * body.height * circle), body=body).frames[60:-60]
    np.testing.assert_allclose(found[:, WEIGHT], 0.5 * (radius * np.pi) ** 2, rtol=0.01)
    np.testing.assert_allclose(found[:, TIME], radius * np.pi**2, rtol=0.01)
    np.testing.assert_allclose(found[:, FLOW], radius * np.pi**3, rtol=0.01)
    turned = np.pi * 34.0 / 30.0
    np.testing.assert_allclose(found[:, SPACE], 2.0 * np.sin(0.5 * turned) / turned, rtol=0.01)


def test_against_a_loop_over_segments() -> None:
    motion = samples.punch(seconds=2.0, fps=30.0).motion
    body, found = Body.of(motion), effort(motion)
    model = mass_model(motion, body)
    centres = model.centres(*world(motion)) / body.height
    expected = np.zeros((len(motion), 3))
    for i, share in enumerate(model.shares):
        velocity, acceleration, jerk = derivatives(centres[:, i], motion.frame_time)
        for t in range(len(motion)):
            expected[t] += share * np.array(
                [0.5 * velocity[t] @ velocity[t], np.linalg.norm(acceleration[t]), np.linalg.norm(jerk[t])]
            )
    np.testing.assert_allclose(found.frames[:, [WEIGHT, TIME, FLOW]], expected, rtol=1e-9)
    windows = found.windows(stride=0.1)
    assert windows[:, WEIGHT].max() == pytest.approx(expected[:, 0].max(), rel=1e-6)
    np.testing.assert_allclose(found.clip, found.windows().mean(axis=0))


@pytest.mark.parametrize("form", [{"unit": "m"}, {"up": "z"}, {"heading": 1.0}, {"fps": 120.0}], ids=str)
@pytest.mark.parametrize("name", ["walk", "knock"])
def test_unit_axes_heading_and_frame_rate_do_not_matter(name: str, form) -> None:
    sample = samples.SAMPLES[name]
    one, other = (effort(sample(seconds=3.0, **{"fps": 30.0, **f}).motion).clip for f in ({}, form))
    np.testing.assert_allclose(other, one, rtol=0.03 if "fps" in form else 1e-6, atol=1e-6)


def test_a_mirrored_clip_has_the_same() -> None:
    motion = samples.wave(seconds=2.0, fps=30.0).motion
    np.testing.assert_allclose(
        effort(apply(motion, [Step("mirror")])).clip, effort(motion).clip, rtol=1e-4, atol=1e-6
    )


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_few_frames(frames: int) -> None:
    found = effort(samples.walk(seconds=1.0).motion[:frames])
    assert found.frames.shape == (frames, 4)
    assert np.isfinite(found.frames).all()
    assert np.isfinite(found.windows()).all()
    assert found.names == tuple(EFFORT)
    with pytest.raises(MienError, match="stride"):
        found.windows(stride=-1.0)
