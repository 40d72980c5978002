"""repair: mends what is broken, there and then, and nothing else."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits.repair import repair
from mien.errors import MienError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, slides
from mien.kinematics.fk import world
from mien.kinematics.legs import Placed, over_feet, shifted
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion

STEP = Step("repair")


def failing(motion: Motion, source: Motion) -> set[str]:
    return set(mien.check(motion, against=source).failed)


def turned(
    motion: Motion, role: str, degrees: float, *, start: int = 30, stop: int = 90, about: str = "left"
) -> Motion:
    """Turn a joint about an axis of the body for some frames, softly in and out."""
    body = Body.of(motion)
    joint, length = body.roles[role], stop - start
    share = np.zeros(len(motion))
    share[start:stop] = np.minimum(1.0, 1.5 * np.sin(np.pi * np.arange(length) / length) ** 2)
    rotations = np.array(motion.rotations)
    outer = world(motion)[0][:, joint]
    axis = quaternion.rotate(quaternion.conjugate(outer), getattr(body, about))
    turn = quaternion.exp(np.radians(degrees) * share[:, None] * axis)
    rotations[:, joint] = quaternion.multiply(rotations[:, joint], turn)
    return motion.with_(rotations=rotations)


def into_the_belly(motion: Motion) -> Motion:
    """Put the left forearm into the belly for three seconds."""
    motion = turned(motion, "left_elbow", -75.0, start=30, stop=210)
    return turned(motion, "left_shoulder", -55.0, start=30, stop=210, about="up")


@pytest.mark.parametrize("name", ["walk", "turn", "jump", "still", "wave", "punch"])
def test_an_unedited_clip_comes_back_unchanged(name: str) -> None:
    motion = samples.SAMPLES[name]().motion
    np.testing.assert_array_equal(repair(motion, original=motion).rotations, motion.rotations)


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_arms_are_pushed_out_of_the_body(skeleton: str) -> None:
    still = samples.still(seconds=4.0, skeleton=skeleton).motion
    broken = into_the_belly(still)
    assert failing(broken, still) == {"collision"}
    mended = repair(broken, original=still)
    assert failing(mended, still) == set()
    body = Body.of(still)
    arms = set(body.joints(("left_arm",)))
    others = [j for j in range(len(still.skeleton)) if j not in arms]
    np.testing.assert_allclose(mended.rotations[:, others], broken.rotations[:, others], atol=1e-12)
    np.testing.assert_array_equal(mended.translations, broken.translations)
    moved = np.linalg.norm(world(mended)[1] - world(broken)[1], axis=-1).max() / body.leg_length
    assert moved < 0.2, "pushed out, not thrown out"


@pytest.mark.parametrize(("role", "degrees"), [("left_elbow", 45.0), ("right_knee", -40.0), ("head", 95.0)])
def test_a_joint_beyond_its_limits_is_turned_back_there_and_then(role: str, degrees: float) -> None:
    still = samples.still(seconds=3.0).motion
    broken = turned(still, role, degrees, start=60, stop=120)
    assert "limits" in failing(broken, still)
    mended = repair(broken, original=still, what=("limits",))
    assert "limits" not in failing(mended, still)
    assert "popping" not in failing(mended, still)
    joint = Body.of(still).roles[role]
    others = [j for j in range(len(still.skeleton)) if j != joint]
    np.testing.assert_array_equal(mended.rotations[:, others], broken.rotations[:, others])
    np.testing.assert_array_equal(mended.rotations[:50], broken.rotations[:50])
    # It stays turned as far as it may be: the edit is not taken back.
    assert np.abs(mended.rotations - still.rotations).max() > 0.05


def test_hands_are_lifted_off_the_floor() -> None:
    """Bent over from the hips, and lowered, so that the hanging hands are in the floor for a while."""
    still = samples.still(seconds=4.0).motion
    body = Body.of(still)
    broken = still
    for role, degrees in (("hips", 100.0), ("left_shoulder", -95.0), ("right_shoulder", -95.0)):
        broken = turned(broken, role, degrees, start=40, stop=200)
    pose = Placed.of(broken, body)
    share = np.clip(np.sin(np.pi * (np.arange(len(still)) - 40) / 160), 0.0, None)
    broken = shifted(pose, -0.5 * body.leg_length * share[:, None] * body.up, body).motion
    below = [j for s in ("left", "right") for j in still.skeleton.descendants(body.roles[f"{s}_elbow"])]

    def lowest(motion: Motion) -> float:
        return float((world(motion)[1][:, below] @ body.up).min() - body.floor) * body.metres_per_unit

    assert lowest(broken) < -0.05
    mended = repair(broken, original=still, what=("floor",))
    assert lowest(mended) > -0.008
    np.testing.assert_array_equal(mended.rotations[:30], broken.rotations[:30])
    jumps = [mien.check(m, against=still)["popping"].value for m in (broken, mended)]
    assert jumps[1] < jumps[0] + 0.5


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_who_would_fall_is_put_over_the_feet(skeleton: str) -> None:
    still = samples.still(seconds=4.0, skeleton=skeleton, unit="m").motion
    body = Body.of(still)
    contacts = detect(still, body=body)
    share = np.sin(np.pi * np.arange(len(still)) / len(still)) ** 2
    away = 0.43 * body.leg_length * share[:, None] * body.forward
    broken = over_feet(Placed.of(still, body), away, contacts.feet, body)
    assert "balance" in failing(broken, still)
    mended = repair(broken, original=still)
    assert "balance" not in failing(mended, still)
    assert slides(mended, contacts, body).max() < slides(still, contacts, body).max() + 0.001


@pytest.mark.parametrize("name", ["afraid", "feminine", "angry", "s0/excited"])
def test_what_is_mended_is_never_worse(name: str) -> None:
    for sample in (samples.walk, samples.punch, samples.tired_walk):
        source = sample(seconds=3.0).motion
        broken = mien.edit(source, name, safe=False)
        before, after = mien.check(broken), mien.check(mien.apply(broken, [STEP]))
        for check in ("collision", "limits", "floor", "balance"):
            worse = np.maximum(after[check].over, 0).sum() - np.maximum(before[check].over, 0).sum()
            assert worse <= 1e-9, check


def test_a_clip_by_itself_is_judged_by_what_bodies_do() -> None:
    broken = turned(
        into_the_belly(samples.still(seconds=4.0).motion), "left_shoulder", 20.0, start=30, stop=210
    )
    assert mien.check(broken)["collision"].value > 8.0
    mended = repair(broken).with_(history=(), reference=None)
    assert mien.check(mended)["collision"].value < 4.5
    alone = mien.apply(broken, [STEP])
    np.testing.assert_array_equal(alone.rotations, mended.rotations)


def test_only_what_is_asked_for_is_mended() -> None:
    still = samples.still(seconds=4.0).motion
    broken = into_the_belly(still)
    same = repair(broken, original=still, what=("limits", "floor", "balance"))
    np.testing.assert_array_equal(same.rotations, broken.rotations)


def test_another_number_of_frames_is_refused() -> None:
    walk = samples.walk(seconds=2.0).motion
    with pytest.raises(MienError, match="frames"):
        repair(walk, original=walk[:20])
