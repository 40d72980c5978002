"""tremor: hands and head shake as much as asked, and nothing from the hips down moves."""

import numpy as np
import pytest
from scipy.signal import welch

from mien import samples
from mien.edits.pipeline import apply
from mien.edits.tremor import tremor
from mien.errors import RecipeError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, foot_points, slides
from mien.kinematics.fk import world
from mien.kinematics.posing import add_turns
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion as quat

ENDS = ("left_wrist", "right_wrist", "head")


def shaking(before: Motion, after: Motion, role: str) -> np.ndarray:
    """How a joint is turned in the world against before (T, 3), in degrees."""
    joint = Body.of(before).roles[role]
    was, now = (world(m)[0][:, joint] for m in (before, after))
    return np.degrees(quat.log(quat.multiply(now, quat.conjugate(was))))


def size(turns: np.ndarray) -> float:
    """Root mean square of vectors (T, 3)."""
    return float(np.sqrt((turns**2).sum(axis=1).mean()))


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("amount", [0.5, 3.0])
def test_hands_and_head_shake_as_much_as_asked(skeleton: str, amount: float) -> None:
    """However many joints the chain has. Nine tenths to eleven tenths: half a minute of noise varies."""
    clip = samples.walk(seconds=30.0, skeleton=skeleton).motion
    after = tremor(clip, amount=amount)
    for role in ENDS:
        assert size(shaking(clip, after, role)) == pytest.approx(amount, rel=0.1), role


@pytest.mark.parametrize("lacking", ["left_wrist", "left_collar", "neck", "chest"])
def test_joints_that_are_missing_leave_the_end_as_shaken(
    lacking: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    clip = samples.still(seconds=30.0).motion
    body = Body.of(clip)
    roles = {role: joint for role, joint in body.roles.items() if role != lacking}
    spine, neck = () if lacking == "chest" else body.spine, () if lacking == "neck" else body.neck
    less = type(body)(**{**vars(body), "roles": roles, "spine": spine, "neck": neck})
    monkeypatch.setattr(Body, "of", lambda motion: less)
    after = tremor(clip, amount=2.0)
    monkeypatch.undo()
    for end in ("left_elbow" if lacking == "left_wrist" else "left_wrist", "head"):
        assert size(shaking(clip, after, end)) == pytest.approx(2.0, rel=0.1), end


def test_the_hierarchy_does_not_amplify() -> None:
    """The thesis's trouble: as much noise on every joint shakes the hand more than twice as much.

    Shared out, each joint further out shakes more, and the hand travels less than a stiff arm would.
    """
    clip = samples.still(seconds=30.0).motion
    body = Body.of(clip)
    chain = ("trunk", "left_shoulder", "left_elbow", "left_wrist")
    rng = np.random.default_rng(2)
    naive = {s: 2.0 / np.sqrt(3.0) * rng.normal(size=(len(clip), 3)) for s in chain}
    whole = clip.with_(rotations=add_turns(clip, body, naive, weights={}, method="body_fixed"))
    assert size(shaking(clip, whole, "left_wrist")) > 1.8 * 2.0
    after = tremor(clip, amount=2.0)
    sizes = [size(shaking(clip, after, f"left_{role}")) for role in ("shoulder", "elbow", "wrist")]
    assert sizes == sorted(sizes)
    wrist, shoulder = body.roles["left_wrist"], body.roles["left_shoulder"]
    before, found, plain = (world(m)[1] for m in (clip, after, whole))
    arm = np.linalg.norm(before[0, wrist] - before[0, shoulder])
    moved, amplified = (size(p[:, wrist] - before[:, wrist]) for p in (found, plain))
    assert moved < 0.6 * np.radians(2.0) * arm
    assert amplified > 2.0 * moved


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
def test_hips_and_legs_are_left_alone_so_that_no_foot_slides(skeleton: str) -> None:
    clip = samples.walk(seconds=4.0, skeleton=skeleton).motion
    after = tremor(clip, amount=10.0)
    body = Body.of(clip)
    below = sorted({*body.joints(("legs",)), body.roles["hips"]})
    np.testing.assert_array_equal(after.rotations[:, below], clip.rotations[:, below])
    np.testing.assert_array_equal(after.translations, clip.translations)
    was, now = (foot_points(m, body, *world(m)) for m in (clip, after))
    np.testing.assert_array_equal(now, was)
    contacts = detect(clip)
    np.testing.assert_array_equal(detect(after, body=body).points, contacts.points)
    np.testing.assert_array_equal(slides(after, contacts, body), slides(clip, contacts, body))


def test_it_shakes_in_the_band() -> None:
    """Oracle: SciPy's spectrum of the turns of the hand."""
    clip = samples.still(seconds=30.0, fps=120.0).motion
    for low, high in ((4.0, 10.0), (5.0, 6.0)):
        turns = shaking(clip, tremor(clip, amount=2.0, low=low, high=high), "right_wrist")
        frequency, power = welch(turns, 120.0, nperseg=1024, axis=0)
        inside = (frequency > low - 0.4) & (frequency < high + 0.4)
        assert power[inside].sum() > 0.98 * power.sum()


def test_the_same_moments_shake_the_same_at_any_frame_rate() -> None:
    slow, fast = (tremor(samples.still(seconds=3.0, fps=fps).motion, amount=5.0) for fps in (24.0, 120.0))
    same = np.abs(np.einsum("tji,tji->tj", slow.rotations, fast.rotations[::5]))
    np.testing.assert_allclose(same, 1.0, atol=1e-9)


def test_another_seed_is_another_shaking_and_the_same_seed_the_same() -> None:
    clip = samples.still(seconds=10.0).motion
    one, again, other = (tremor(clip, amount=2.0, seed=seed) for seed in (1, 1, 2))
    assert one.rotations.tobytes() == again.rotations.tobytes()
    first, second = (shaking(clip, m, "left_wrist").ravel() for m in (one, other))
    assert abs(np.corrcoef(first, second)[0, 1]) < 0.2


def test_the_two_hands_shake_apart() -> None:
    clip = samples.still(seconds=30.0).motion
    after = tremor(clip, amount=2.0)
    left, right = (shaking(clip, after, f"{side}_wrist").ravel() for side in ("left", "right"))
    assert abs(np.corrcoef(left, right)[0, 1]) < 0.25  # they share the trunk's


def test_elbows_do_not_bend_sideways() -> None:
    """At rest the forearm hangs down and bends about the left axis: no turn about forward."""
    motion = samples.still(seconds=5.0).motion
    body = Body.of(motion)
    clip = motion.with_(rotations=np.repeat(body.neutral[None], len(motion), axis=0))
    after = tremor(clip, amount=6.0)
    upper, lower = body.roles["left_shoulder"], body.roles["left_elbow"]
    turned = []
    for m in (clip, after):
        rotations = world(m)[0]
        turned.append(quat.multiply(quat.conjugate(rotations[:, upper]), rotations[:, lower]))
    change = quat.log(quat.multiply(quat.conjugate(turned[0]), turned[1]))
    seen = quat.rotate(world(clip)[0][:, lower], change)
    assert np.degrees(np.abs(seen @ body.forward)).max() < 1e-6
    assert np.degrees(np.abs(seen @ body.left)).max() > 2.0


def test_only_some_parts_may_shake() -> None:
    clip = samples.still(seconds=2.0).motion
    after = apply(clip, [Step("tremor", {"amount": 4.0}, parts=("left_arm",))])
    body = Body.of(clip)
    others = [j for j in range(len(clip.skeleton)) if j not in body.joints(("left_arm",))]
    np.testing.assert_array_equal(after.rotations[:, others], clip.rotations[:, others])
    assert size(shaking(clip, after, "left_wrist")) > 2.5


def test_amount_0_is_the_motion_itself() -> None:
    clip = samples.walk(seconds=1.0).motion
    np.testing.assert_array_equal(tremor(clip).rotations, clip.rotations)


def test_a_band_the_wrong_way_round_is_refused() -> None:
    with pytest.raises(RecipeError, match=r"tremor: low \(12 Hz\) must be below high \(10 Hz\)"):
        tremor(samples.walk(seconds=0.5).motion, amount=1.0, low=12.0)
