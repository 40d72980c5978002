"""Posture: what each parameter does to a body, measured on positions; fade-out; strength."""

import numpy as np
import pytest

from mien import samples
from mien.edits.pipeline import apply
from mien.edits.posture import posture
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.poses import neutral_world
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion as quat


def neutral(skeleton: str = "standard22", **form: object) -> Motion:
    motion = samples.still(seconds=0.5, skeleton=skeleton, **form).motion
    rotations = np.repeat(Body.of(motion).neutral[None], len(motion), axis=0)
    still = np.repeat(motion.translations[:1], len(motion), axis=0)
    return motion.with_(rotations=rotations, translations=still)


def bone(motion: Motion, start: str, end: str) -> np.ndarray:
    """Direction between two roles in the first frame: (left, up, forward), unit."""
    body, positions = Body.of(motion), world(motion)[1][0]
    d = positions[body.roles[end]] - positions[body.roles[start]]
    return np.stack([body.left, body.up, body.forward]) @ (d / np.linalg.norm(d))


def pitch(d: np.ndarray) -> float:
    """How far a direction leans forward of up, in degrees."""
    return float(np.degrees(np.arctan2(d[2], d[1])))


def outward(d: np.ndarray) -> float:
    """How far a hanging direction goes to the left, in degrees."""
    return float(np.degrees(np.arctan2(d[0], -d[1])))


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("form", [{}, {"up": "z", "unit": "inch"}])
class TestEachParameter:
    def test_head(self, skeleton: str, form: dict[str, object]) -> None:
        """The head's own up leans forward by what is asked, on top of the trunk."""
        before = neutral(skeleton, **form)
        after = posture(before, head=25.0)
        body = Body.of(before)
        turned = quat.multiply(world(after)[0][0], quat.conjugate(world(before)[0][0]))[body.roles["head"]]
        np.testing.assert_allclose(quat.log(turned), np.radians(25.0) * body.left, atol=1e-9)

    def test_trunk_bends_and_arms_go_on_hanging(self, skeleton: str, form: dict[str, object]) -> None:
        before = neutral(skeleton, **form)
        after = posture(before, trunk=20.0)
        body = Body.of(before)
        turned = quat.multiply(world(after)[0][0], quat.conjugate(world(before)[0][0]))
        np.testing.assert_allclose(quat.log(turned[body.spine[-1]]), np.radians(20.0) * body.left, atol=1e-9)
        arm = (bone(m, "left_shoulder", "left_elbow") for m in (before, after))
        np.testing.assert_allclose(next(arm), next(arm), atol=1e-9)

    def test_lean_turns_the_whole_body_about_the_ankles(self, skeleton: str, form: dict[str, object]) -> None:
        before = neutral(skeleton, **form)
        after = posture(before, lean=6.0)
        body = Body.of(before)
        for start, end in (("left_ankle", "left_hip"), ("hips", "head")):
            assert pitch(bone(after, start, end)) - pitch(bone(before, start, end)) == pytest.approx(
                6.0, abs=0.1
            )
        feet = [body.roles[f"{s}_{r}"] for s in ("left", "right") for r in ("ankle", "toe")]
        moved = np.abs(world(after)[1] - world(before)[1])[:, feet].max() / body.leg_length
        assert moved < 0.02

    def test_arms_and_legs_go_out(self, skeleton: str, form: dict[str, object]) -> None:
        before = neutral(skeleton, **form)
        after = posture(before, arms=20.0, legs=6.0)
        for start, end, angle in (("shoulder", "elbow", 20.0), ("hip", "knee", 6.0)):
            for side, sign in (("left", 1.0), ("right", -1.0)):
                was, now = (outward(bone(m, f"{side}_{start}", f"{side}_{end}")) for m in (before, after))
                assert sign * (now - was) == pytest.approx(angle, abs=0.1)

    def test_soles_stay_level_when_feet_go_apart(self, skeleton: str, form: dict[str, object]) -> None:
        before = neutral(skeleton, **form)
        after = posture(before, legs=10.0, lean=4.0)
        for side in ("left", "right"):
            foot = Body.of(before).roles[f"{side}_ankle"]
            turned = quat.multiply(world(after)[0][0, foot], quat.conjugate(world(before)[0][0, foot]))
            assert np.linalg.norm(quat.log(turned)) < np.radians(1.0)

    def test_arms_forward(self, skeleton: str, form: dict[str, object]) -> None:
        before = neutral(skeleton, **form)
        after = posture(before, arms_forward=30.0)
        was, now = (-bone(m, "right_shoulder", "right_elbow") for m in (before, after))
        assert pitch(was) - pitch(now) == pytest.approx(30.0, abs=1.0)

    def test_elbows(self, skeleton: str, form: dict[str, object]) -> None:
        before = neutral(skeleton, **form)
        after = posture(before, elbows=40.0)
        for side in ("left", "right"):
            upper, fore = ((f"{side}_shoulder", f"{side}_elbow"), (f"{side}_elbow", f"{side}_wrist"))
            was, now = (np.degrees(np.arccos(bone(m, *upper) @ bone(m, *fore))) for m in (before, after))
            assert now - was == pytest.approx(40.0, abs=0.5)
            assert bone(after, *fore)[2] > bone(before, *fore)[2] + 0.5  # hands come forward

    def test_shoulders_go_up_and_arms_still_hang(self, skeleton: str, form: dict[str, object]) -> None:
        before = neutral(skeleton, **form)
        after = posture(before, shoulders=15.0)
        body = Body.of(before)
        rise = (world(after)[1] - world(before)[1])[0] @ body.up / body.leg_length
        assert rise[body.roles["left_shoulder"]] > 0.02
        assert rise[body.roles["left_shoulder"]] == pytest.approx(
            rise[body.roles["right_shoulder"]], abs=1e-6
        )
        arm = (bone(m, "left_shoulder", "left_elbow") for m in (before, after))
        np.testing.assert_allclose(next(arm), next(arm), atol=1e-9)

    def test_hips_height(self, skeleton: str, form: dict[str, object]) -> None:
        before = neutral(skeleton, **form)
        after = posture(before, hips_height=-0.1)
        body = Body.of(before)
        moved = (world(after)[1] - world(before)[1]) / body.leg_length
        np.testing.assert_allclose(
            moved[:, body.roles["hips"]], np.tile(-0.1 * body.up, (len(before), 1)), atol=1e-9
        )
        np.testing.assert_array_equal(after.rotations, before.rotations)


def test_named_poses_are_their_parameters() -> None:
    walk = samples.walk(seconds=1.0).motion
    one, other = posture(walk, pose="elbows_out"), posture(walk, arms=20.0, elbows=10.0)
    np.testing.assert_array_equal(one.rotations, other.rotations)
    back = posture(walk, pose="elbows_out", amount=-0.5)
    np.testing.assert_array_equal(back.rotations, posture(walk, arms=-10.0, elbows=-5.0).rotations)


def test_a_pose_in_a_line_replays_to_the_same_bytes() -> None:
    walk = samples.walk(seconds=1.0).motion
    after = apply(walk, [Step("posture", {"pose": "head 20 5 0; left_shoulder 0 0 12"}, strength=0.7)])
    again = apply(walk, after.history)
    assert after.rotations.tobytes() == again.rotations.tobytes()
    assert np.abs(after.rotations - walk.rotations).max() > 0.01


@pytest.mark.parametrize("method", ["anatomical", "additive", "body_fixed"])
def test_strength_is_linear_for_little(method: str) -> None:
    walk = samples.walk(seconds=1.0).motion
    full = {"head": 25, "trunk": 10, "arms": 15, "elbows": 20, "legs": 4, "method": method}
    start = world(walk)[1]
    steps = [world(apply(walk, [Step("posture", full, strength=s)]))[1] - start for s in (0.01, 0.02)]
    np.testing.assert_allclose(2 * steps[0], steps[1], atol=0.03 * np.abs(steps[1]).max())


def test_the_change_fades_where_an_arm_reaches_and_stays_where_it_hangs() -> None:
    """While one arm waves up high the other hangs: only the hanging one takes the posture on."""
    motion = samples.wave(seconds=4.0).motion
    body, positions = Body.of(motion), world(motion)[1]
    wrist = body.roles["right_wrist"]
    high = positions[:, wrist] @ body.up
    top = int(np.argmax(high))
    faded, whole = (posture(motion, arms=20.0, fade=f) for f in (True, False))
    shoulder = body.roles["right_shoulder"]

    def turned(after: Motion, joint: int) -> float:
        q = quat.multiply(quat.conjugate(motion.rotations[top, joint]), after.rotations[top, joint])
        return float(np.degrees(np.linalg.norm(quat.log(q))))

    assert turned(faded, shoulder) < 0.5
    assert turned(whole, shoulder) > 5.0
    other = body.roles["left_shoulder"]
    assert turned(faded, other) == pytest.approx(turned(whole, other), abs=1e-6)
    assert turned(faded, other) > 15.0


def test_the_fade_leaves_no_step() -> None:
    """The change of a joint comes and goes within the speed of a 3 Hz low-pass."""
    motion = samples.wave(seconds=4.0, fps=120.0).motion
    after = posture(motion, arms=30.0)
    joint = Body.of(motion).roles["right_shoulder"]
    change = quat.log(quat.multiply(after.rotations[:, joint], quat.conjugate(motion.rotations[:, joint])))
    speed = np.linalg.norm(np.diff(change, axis=0), axis=-1) * 120.0
    assert np.ptp(np.linalg.norm(change, axis=-1)) > np.radians(15.0)
    assert speed.max() < 2.0 * np.pi * 3.0 * np.radians(30.0)


def test_arms_and_feet_are_drawn_in_only_as_far_as_there_is_room() -> None:
    walk = samples.walk(seconds=2.0).motion
    after = posture(walk, arms=-30.0, legs=-15.0)
    body, positions = Body.of(walk), world(after)[1]
    roles = body.roles
    for end, least in (("ankle", 0.0), ("wrist", 0.05)):
        across = (positions[:, roles[f"left_{end}"]] - positions[:, roles[f"right_{end}"]]) @ body.left
        assert np.median(across) > 2 * least * body.leg_length
    was = world(walk)[1]
    assert np.median((positions - was)[:, roles["left_wrist"]] @ body.left) < -0.01 * body.leg_length


def test_joints_above_the_hips_and_fingers_are_left_alone() -> None:
    motion = samples.walk(seconds=1.0, skeleton="engine23").motion
    after = posture(motion, head=20.0, trunk=10.0, arms=10.0, elbows=20.0, lean=3.0, hips_height=-0.05)
    body = Body.of(motion)
    outside = [j for j, part in enumerate(body.parts_of) if not part]
    np.testing.assert_array_equal(after.rotations[:, outside], motion.rotations[:, outside])
    others = [j for j in range(len(body.parts_of)) if j != body.roles["hips"]]
    np.testing.assert_array_equal(after.translations[:, others], motion.translations[:, others])
    hand = samples.walk(seconds=0.5, skeleton="poser43").motion
    bent = posture(hand, elbows=30.0, arms=10.0)
    fingers = [j for j, name in enumerate(hand.skeleton.names) if name[1:] in ("Thumb1", "Index2", "Ring1")]
    assert len(fingers) == 6
    np.testing.assert_array_equal(bent.rotations[:, fingers], hand.rotations[:, fingers])


def test_nothing_asked_is_the_motion_itself() -> None:
    walk = samples.walk(seconds=0.5).motion
    for after in (posture(walk), posture(walk, pose="head_down", amount=0.0)):
        np.testing.assert_array_equal(after.rotations, walk.rotations)
        np.testing.assert_array_equal(after.translations, walk.translations)


def test_the_head_stops_before_the_neck_is_bent_too_far() -> None:
    """Heads down already go down less, and no head beyond 50 degrees against the trunk."""

    def bent(motion: Motion) -> float:
        body = Body.of(motion)
        rotations = world(motion)[0]
        stance = quat.conjugate(neutral_world(motion, body)[0])
        head, chest = (
            quat.multiply(rotations[:, j], stance[j]) for j in (body.roles["head"], body.spine[-1])
        )
        turn = quat.log(quat.multiply(quat.conjugate(chest), head))
        return float(np.degrees(np.median(turn @ body.left)))

    for motion in (samples.walk().motion, samples.tired_walk().motion):
        before = bent(motion)
        for head in (20.0, 40.0, 60.0):
            after = bent(posture(motion, head=head))
            assert before < after < 51.0
    upright, bowed = samples.walk().motion, samples.tired_walk().motion
    rises = [bent(posture(m, head=30.0)) - bent(m) for m in (upright, bowed)]
    assert rises[1] < rises[0] <= 30.0
