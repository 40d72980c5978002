"""An edit that cannot break a body: what passes is left alone, what breaks is mended or taken back."""

import re

import numpy as np
import pytest

import mien
from mien import samples
from mien.emotion.resolve import done
from mien.emotion.safe import _when, limbs_of, mended, safe
from mien.kinematics.body import Body
from mien.motion import Motion
from mien.recipe import Recipe, Step


def same(one: Motion, other: Motion) -> bool:
    return one.rotations.tobytes() == other.rotations.tobytes() and (
        one.translations.tobytes() == other.translations.tobytes()
    )


def test_what_passes_comes_back_as_it_is() -> None:
    walk = samples.walk(seconds=3.0).motion
    edited = mien.edit(walk, "sad", safe=False)
    assert mien.check(edited).passed, "or this test shows nothing"
    assert safe(edited) is edited
    assert mended(edited) == ()
    assert safe(walk) is walk


@pytest.mark.parametrize("name", ["afraid", "angry", "feminine", "nervous", "weak", "s0/angry", "s0/excited"])
@pytest.mark.parametrize("sample", ["walk", "punch", "wave", "jump"])
def test_no_check_fails_afterwards(sample: str, name: str) -> None:
    source = samples.SAMPLES[sample]().motion
    made = mien.edit(source, name)
    assert mien.check(made).failed == ()
    assert made.fps == source.fps


def test_some_of_those_fail_without_it() -> None:
    for sample, name, check in (("walk", "weak", "collision"), ("walk", "s0/angry", "jitter")):
        source = samples.SAMPLES[sample]().motion
        assert check in mien.check(mien.edit(source, name, safe=False)).failed


@pytest.mark.parametrize("name", ["weak", "s0/angry"])
def test_its_history_replays_to_the_same_bytes(name: str) -> None:
    walk = samples.walk(seconds=3.0).motion
    made = mien.edit(walk, name)
    assert {"repair", "restore"} & {step.edit for step in made.history}
    assert same(mien.apply(walk, made.history), made)


def test_it_tells_what_it_does_and_does_the_same() -> None:
    walk = samples.walk(seconds=3.0).motion
    told: list[tuple[str, float | None]] = []
    made = done(walk, mien.preset("weak"), progress=lambda what, share: told.append((what, share)))
    assert same(made, mien.edit(walk, "weak"))
    steps = [step.edit for step in mien.preset("weak").steps]
    rounds = [f"mending, round {turn + 1}" for turn in range(len(told) - len(steps) - 3)]
    assert rounds
    assert [what for what, _ in told] == [*steps, "checking the original", "checking", "mending", *rounds]
    shares = [share for _, share in told if share is not None]
    assert (shares[0], sorted(shares), shares[len(steps)]) == (0.0, shares, 0.5)
    assert told[-1][1] is None, "nobody knows how many rounds there will be"


def broken_for_a_while(source: Motion) -> Motion:
    """The left forearm goes into the belly for half a second in the middle."""
    pose = "left_elbow -90 0 0; left_shoulder 0 -60 0"
    keys = f"1.3 none | 1.8 {pose} | 2.2 {pose} | 2.7 none"
    return mien.apply(source, [Step("displacement", {"keys": keys})])


def test_only_the_limb_and_the_time_are_touched() -> None:
    still = samples.still(seconds=4.0).motion
    broken = broken_for_a_while(still)
    assert mien.check(broken).failed
    made = safe(broken)
    assert mien.check(made).failed == ()
    arm = set(Body.of(still).joints(("left_arm",)))
    others = [j for j in range(len(still.skeleton)) if j not in arm]
    np.testing.assert_allclose(made.rotations[:, others], broken.rotations[:, others], atol=1e-12)
    np.testing.assert_array_equal(made.rotations[:20], broken.rotations[:20])
    np.testing.assert_array_equal(made.rotations[-20:], broken.rotations[-20:])


def test_it_says_what_was_taken_back() -> None:
    made = mien.edit(samples.walk(seconds=3.0).motion, "s0/angry")
    said = " and ".join(mended(made))
    assert "left arm" in said
    assert re.search(r"% of the original at \d\.\d to \d\.\d", said)
    assert "jitter" in said


def test_a_recipe_asks_for_it_and_who_calls_may_refuse() -> None:
    walk = samples.walk(seconds=3.0).motion
    steps = mien.preset("weak").steps
    bare = mien.apply(walk, steps)
    assert same(mien.edit(walk, Recipe("mine", steps)), bare)
    assert same(mien.edit(walk, "weak", safe=False), bare)
    made = mien.edit(walk, Recipe("mine", steps, safe=True))
    assert same(made, mien.edit(walk, "weak"))
    assert same(made, mien.edit(walk, list(steps), safe=True))
    assert not same(made, bare)


def test_without_feet_put_back_they_may_slide() -> None:
    """Who does not want the feet put back gets no foot_plant, and no edit taken back because of them."""
    walk = samples.walk(seconds=3.0).motion
    made = mien.edit(walk, [Step("path_length", {"mid": 0.5})], safe=True)
    assert "foot_plant" not in {step.edit for step in made.history}
    assert "foot_slide" in mien.check(made).failed


@pytest.mark.parametrize(
    ("part", "limbs"),
    [
        ("left_hand", {"left_arm"}),
        ("right_forearm-left_chest", {"right_arm"}),
        ("left_hand-right_hand", {"left_arm", "right_arm"}),
        ("left_foot-right_shank", {"torso", "left_leg", "right_leg"}),
        ("head", {"head"}),
        ("right_knee", {"torso", "left_leg", "right_leg"}),
        ("whole_body", {"torso", "left_leg", "right_leg"}),
        ("place", {"head", "torso", "left_arm", "right_arm", "left_leg", "right_leg"}),
    ],
)
def test_parts_of_checks_belong_to_limbs(part: str, limbs: set[str]) -> None:
    assert set(limbs_of(part)) == limbs


def test_the_last_resort_is_the_original_as_a_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    """With no search at all: an edit that nothing but the original mends comes back as that, and says so."""
    monkeypatch.setattr("mien.emotion.safe.ROUNDS", 0)
    still = samples.still(seconds=4.0).motion
    keys = "0 none | 1 left_elbow 150 0 0; right_elbow 150 0 0; head 150 0 0 | 2 none"
    broken = mien.apply(still, [Step("displacement", {"keys": keys})])
    assert mien.check(broken).failed
    made = safe(broken)
    assert mien.check(made).failed == ()
    assert made.history[-1].parameters["why"] == "last resort"
    assert "all along" in mended(made)[0]
    if made.history[-1].parameters["amount"] == 1.0:
        np.testing.assert_allclose(made.rotations, still.rotations, atol=1e-12)


def test_stretches_that_were_taken_back_are_told_one_by_one() -> None:
    curve = [(0.0, 0.0), (1.0, 0.0), (1.3, 1.0), (1.6, 0.0), (5.0, 0.0), (5.5, 0.3), (6.0, 0.0)]
    assert _when(curve) == "at 1.0 to 1.6, 5.0 to 6.0 s"
    many = [(float(t), float(t % 2)) for t in range(12)]
    assert _when(many) == "at 0.0 to 2.0, 2.0 to 4.0, 4.0 to 6.0 s and 3 more times"
