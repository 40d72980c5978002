"""What can be seen of a change: nothing of nothing, and what was done by as much as it was done."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.visible import VISIBLE, Look, visible_change
from mien.motion import Motion
from mien.recipe import Step

NAMES = list(VISIBLE)


def changed(motion: Motion, **values: float) -> dict[str, float]:
    body = mien.Body.of(motion)
    after = mien.apply(motion, [Step("posture", {**values, "fade": False})])
    found = visible_change(Look.of(motion, body=body), Look.of(after, body=body))
    return dict(zip(NAMES, found.tolist(), strict=True))


@pytest.fixture(scope="module", params=samples.SKELETONS)
def walk(request: pytest.FixtureRequest) -> Motion:
    return samples.walk(seconds=3.0, fps=30.0, skeleton=request.param).motion


def test_of_nothing_it_is_nothing(walk: Motion) -> None:
    assert not visible_change(Look.of(walk), Look.of(walk)).any()


@pytest.mark.parametrize(
    ("name", "value"),
    [("head", 15.0), ("trunk", 12.0), ("arms", 10.0), ("arms_forward", 15.0), ("hips_height", -0.06)],
)
def test_what_was_done_is_seen_by_as_much_on_every_skeleton(walk: Motion, name: str, value: float) -> None:
    found = changed(walk, **{name: value})
    assert found[name] * VISIBLE[name] == pytest.approx(value, rel=0.15)


def test_arms_that_go_on_hanging_are_seen_to_hang(walk: Motion) -> None:
    """A bent trunk takes its arms along in their joints, not in the world."""
    found = changed(walk, trunk=20.0)
    assert abs(found["arms_forward"]) < 0.3
    assert abs(found["elbows"]) < 0.1


def test_tempo_is_seen_as_quickness() -> None:
    walk = samples.walk(seconds=6.0).motion
    fast = mien.apply(walk, [Step("tempo", {"rate": 1.3})])
    body = mien.Body.of(walk)
    found = visible_change(Look.of(walk, body=body), Look.of(fast, body=body))
    assert found[NAMES.index("rate")] * VISIBLE["rate"] == pytest.approx(np.log(1.3), abs=0.08)
