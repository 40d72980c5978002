"""timing: on an arm whose movement is known."""

import numpy as np
import pytest

from mien import Step, apply, load
from mien.analysis.checks.report import check
from mien.edits.timing import timing
from mien.kinematics.body import Body
from mien.kinematics.bones import main_bones
from mien.kinematics.contacts import detect, foot_points, slides
from mien.kinematics.fk import world
from mien.kinematics.limb_timing import loop
from mien.motion import Motion
from mien.rotations import directions, quaternion
from mien.samples import walk


def arm_clip(angle, fps, roles=("right_shoulder",)):
    """The sample figure in its first pose, with joints turning by ``angle (T,)`` across their bones."""
    first = walk(seconds=0.1).motion
    rotations = np.repeat(first.rotations[:1], len(angle), axis=0)
    body = Body.of(first)
    _, across = directions.axes(main_bones(first.skeleton))
    for role in roles:
        joint = body.roles[role]
        turned = quaternion.exp(angle[:, None] * across[joint])
        rotations[:, joint] = quaternion.multiply(rotations[:, joint], turned)
    return Motion(first.skeleton, rotations, np.repeat(first.translations[:1], len(angle), axis=0), 1.0 / fps)


def shown_angle(motion, role="right_shoulder"):
    """The angle of a joint of ``arm_clip`` at every frame, without jumps."""
    first = walk(seconds=0.1).motion
    joint = Body.of(first).roles[role]
    _, across = directions.axes(main_bones(first.skeleton))
    rest = quaternion.conjugate(first.rotations[0, joint])
    turned = quaternion.multiply(rest, motion.rotations[:, joint])
    return np.unwrap(2.0 * np.arctan2(turned[:, :3] @ across[joint], turned[:, 3]))


def knocks(fps, move=0.4, pause=0.1, count=3):
    """An angle that goes there and back in smooth moves with pauses in between."""
    t = np.arange(round((count * 2 * (move + pause) + 0.6) * fps) + 1) / fps
    angle = np.zeros(len(t))
    for i in range(2 * count):
        u = np.clip((t - 0.3 - i * (move + pause)) / move, 0.0, 1.0)
        angle += (-1) ** i * 0.5 * (1.0 - np.cos(np.pi * u))
    return angle


def even(fps=100.0, seconds=4.0):
    return 2.3 * np.arange(int(seconds * fps) + 1) / fps


def speeds(motion, role="right_wrist"):
    body = Body.of(motion)
    _, positions = world(motion)
    relative = positions[:, body.roles[role]] - positions[:, body.roles["hips"]]
    return np.linalg.norm(np.diff(relative, axis=0), axis=1) * motion.fps


@pytest.mark.parametrize("amount", [-1.0, -0.3, 0.3, 1.0])
@pytest.mark.parametrize("mode", ["peaks", "grid"])
@pytest.mark.parametrize("fps", [30.0, 100.0])
def test_a_hand_going_round_evenly_is_left_alone(amount, mode, fps):
    clip = arm_clip(even(fps), fps)
    out = timing(clip, acceleration=amount, mode=mode)
    np.testing.assert_allclose(shown_angle(out), shown_angle(clip), atol=1e-9)


def test_amount_0_is_the_clip():
    clip = arm_clip(knocks(60.0), 60.0)
    np.testing.assert_array_equal(timing(clip).rotations, clip.rotations)


def test_nothing_moves():
    clip = arm_clip(np.zeros(100), 50.0)
    for amount in (-1.0, 1.0):
        np.testing.assert_array_equal(timing(clip, acceleration=amount).rotations, clip.rotations)


def test_a_trembling_limb_is_not_a_moving_one():
    t = np.arange(300) / 100.0
    clip = arm_clip(0.004 * np.sin(2 * np.pi * 2.0 * t), 100.0)
    for amount in (-1.0, 1.0):
        np.testing.assert_array_equal(timing(clip, acceleration=amount).rotations, clip.rotations)


@pytest.mark.parametrize("mode", ["peaks", "grid"])
@pytest.mark.parametrize("fps", [30.0, 60.0, 120.0])
def test_added_acceleration_dwells_and_rushes(mode, fps):
    clip = arm_clip(knocks(fps), fps)
    out = timing(clip, acceleration=0.5, mode=mode)
    before, after = speeds(clip), speeds(out)
    assert after.max() > 1.3 * before.max()
    assert (after < 0.2 * after.max()).mean() > (before < 0.2 * before.max()).mean() + 0.1


def test_constant_speed_evens_what_moves_and_keeps_the_pauses():
    clip = arm_clip(knocks(100.0, pause=0.3), 100.0)
    out = timing(clip, acceleration=-1.0)
    before, after = speeds(clip), speeds(out)
    moving, moving_after = before > 0.2 * before.max(), after > 0.2 * before.max()
    assert before[moving].std() / before[moving].mean() > 0.25
    assert after[moving_after].std() / after[moving_after].mean() < 0.12
    assert after.max() < 0.75 * before.max()
    assert (after < 0.05 * before.max()).sum() > 0.8 * (before < 0.05 * before.max()).sum()


def test_more_is_more():
    clip = arm_clip(knocks(100.0), 100.0)
    amounts = (-1.0, -0.5, 0.0, 0.2, 0.5, 1.0)
    fastest = [speeds(timing(clip, acceleration=a, steepest=20.0)).max() for a in amounts]
    assert (np.diff(fastest) > 0).all()


@pytest.mark.parametrize("steepest", [1.5, 2.5])
def test_no_limb_runs_faster_than_allowed(steepest):
    t = np.arange(600) / 100.0
    clip = arm_clip(0.5 * np.sin(2 * np.pi * t), 100.0)
    out = timing(clip, acceleration=1.0, steepest=steepest, boundary="hold")
    assert speeds(out).max() == pytest.approx(steepest * speeds(clip).max(), rel=0.02)


@pytest.mark.parametrize("amount", [-1.0, 0.4, 1.0])
def test_time_never_runs_back_and_the_ends_are_fixed(amount):
    clip = arm_clip(even() + 0.3 * np.sin(7.0 * np.arange(401) / 100.0), 100.0)
    out = timing(clip, acceleration=amount, boundary="hold")
    assert len(out) == len(clip)
    assert (np.diff(shown_angle(out)) > 0).all()
    np.testing.assert_allclose(shown_angle(out)[[0, -1]], shown_angle(clip)[[0, -1]], atol=1e-9)


@pytest.mark.parametrize("amount", [-0.8, 0.8])
def test_the_path_stays_where_it_was(amount):
    clip = walk(seconds=3.0, fps=30.0).motion
    out = timing(clip, acceleration=amount, boundary="hold")
    joint = Body.of(clip).roles["left_shoulder"]
    assert np.abs(out.rotations[:, joint] - clip.rotations[:, joint]).max() > 0.01
    u, v = directions.axes(main_bones(clip.skeleton)[joint])
    path, shown = (directions.encode(m.rotations[:, joint], u, v) for m in (clip, out))
    start, step = path[:-1], np.diff(path, axis=0)
    along = np.einsum("tsi,si->ts", shown[:, None] - start, step) / (step**2).sum(-1)
    nearest = start + np.clip(along, 0.0, 1.0)[..., None] * step
    distance = np.linalg.norm(shown[:, None] - nearest, axis=-1).min(axis=1)
    turns = np.linalg.norm(step[:, :3], axis=-1).max()
    assert distance.max() < 2.0 * turns**2 / 8.0  # both vectors at most the sagitta of one step away


def test_all_joints_of_a_limb_share_one_map_of_time():
    angle = knocks(100.0)
    clip = arm_clip(angle, 100.0, ("right_shoulder", "right_elbow"))
    out = timing(clip, acceleration=0.4)
    np.testing.assert_allclose(shown_angle(out), shown_angle(out, "right_elbow"), atol=1e-9)


@pytest.mark.parametrize("amount", [-0.8, 0.4])
def test_the_frame_rate_does_not_matter(amount):
    shown = []
    for fps in (30.0, 60.0, 120.0):
        out = timing(arm_clip(knocks(fps), fps), acceleration=amount)
        shown.append(shown_angle(out)[:: int(fps / 30.0)])
    # Pauses lie on steps of 10 ms, so that a limb may be early or late by about as much.
    fastest = np.abs(np.diff(shown[2])).max() * 30.0
    assert np.abs(shown[0] - shown[2]).max() < 0.016 * fastest
    assert np.abs(shown[1] - shown[2]).max() < 0.012 * fastest


def test_only_the_named_limbs_change():
    clip = walk(seconds=3.0).motion
    body = Body.of(clip)
    out = timing(clip, acceleration=-0.5, limbs=("left_arm", "right_leg"))
    np.testing.assert_array_equal(out.translations, clip.translations)
    chosen = body.joints(("left_arm", "right_leg"))
    others = [j for j in range(len(clip.skeleton)) if j not in chosen]
    np.testing.assert_array_equal(out.rotations[:, others], clip.rotations[:, others])
    for role in ("left_shoulder", "right_hip"):
        assert np.abs(out.rotations[:, body.roles[role]] - clip.rotations[:, body.roles[role]]).max() > 0.01


def test_legs_are_left_alone_unless_named():
    clip = walk(seconds=3.0).motion
    out = timing(clip, acceleration=0.5)
    legs = Body.of(clip).joints(("legs", "torso"))
    np.testing.assert_array_equal(out.rotations[:, legs], clip.rotations[:, legs])


@pytest.mark.parametrize("amount", [-0.8, 0.5])
def test_a_loop_stays_a_loop_wherever_it_is_cut(amount):
    t = np.arange(120) / 50.0  # two and a half seconds: one round
    angle = 0.6 * np.sin(2 * np.pi * t / 2.4) + 0.3 * np.sin(2 * np.pi * 2 * t / 2.4 + 1.0)
    clip = arm_clip(angle, 50.0)
    out = timing(clip, acceleration=amount)
    rolled = timing(clip.with_(rotations=np.roll(clip.rotations, 31, axis=0)), acceleration=amount)
    assert np.abs(shown_angle(out) - shown_angle(clip)).max() > 0.02
    np.testing.assert_allclose(shown_angle(rolled), np.roll(shown_angle(out), 31), atol=1e-9)
    closed = clip.with_(
        rotations=np.concatenate([clip.rotations, clip.rotations[:1]]),
        translations=np.concatenate([clip.translations, clip.translations[:1]]),
    )
    again = shown_angle(timing(closed, acceleration=amount))
    np.testing.assert_allclose(again, [*shown_angle(out), shown_angle(out)[0]], atol=1e-9)


def test_long_rests_take_time_up_only_when_asked():
    clip = arm_clip(knocks(100.0, move=0.25, pause=0.5), 100.0)
    usual, rests = (timing(clip, acceleration=0.4, rests=r) for r in (False, True))
    np.testing.assert_allclose(shown_angle(usual), shown_angle(clip), atol=1e-9)
    assert speeds(rests).max() > 1.3 * speeds(clip).max()


def test_relative_to_the_heading_a_turning_body_moves_no_limb():
    clip = arm_clip(np.zeros(300), 100.0)
    body = Body.of(clip)
    hips = body.roles["hips"]
    t = np.arange(300) / 100.0
    yaw = quaternion.exp((t + 0.4 * np.sin(5.0 * t))[:, None] * body.up)
    rotations = np.array(clip.rotations)
    rotations[:, hips] = quaternion.multiply(yaw, rotations[:, hips])
    turning = clip.with_(rotations=rotations)
    out = timing(turning, acceleration=-1.0, relative="heading")
    np.testing.assert_array_equal(out.rotations, quaternion.continuous(rotations))


@pytest.mark.parametrize("frames", [1, 2, 3, 20])
def test_shorter_than_a_set(frames):
    clip = arm_clip(knocks(60.0)[:frames], 60.0)
    out = timing(clip, acceleration=1.0)
    np.testing.assert_allclose(shown_angle(out), shown_angle(clip), atol=1e-9)


IMPACTS = {"where": "impacts"}


def strike(fps, start=1.0, move=0.25):
    """An angle that rests, goes by a radian in ``move`` seconds with least jerk, and stays."""
    t = np.arange(round(3.5 * fps) + 1) / fps
    u = np.clip((t - start) / move, 0.0, 1.0)
    return u**3 * (10.0 - 15.0 * u + 6.0 * u * u)


def hardest_stop(angle, fps):
    return -np.diff(angle, n=2).min() * fps * fps


@pytest.mark.parametrize("amount", [-1.0, -0.5, 0.5, 1.0])
def test_at_impacts_the_stop_gets_harder_by_two_to_the_amount(amount):
    fps = 240.0
    clip = arm_clip(strike(fps), fps)
    out = timing(clip, acceleration=amount, **IMPACTS)
    gain = hardest_stop(shown_angle(out), fps) / hardest_stop(shown_angle(clip), fps)
    # As much where time runs fastest; that is not quite where the stop is hardest.
    assert min(1.0, 2.0**amount) < gain < 1.3 * max(1.0, 2.0**amount)
    assert (gain > 1.15) == (amount > 0.0)
    assert (gain < 0.87) == (amount < 0.0)


@pytest.mark.parametrize("amount", [-1.0, 0.5, 1.0])
@pytest.mark.parametrize("fps", [30.0, 60.0, 120.0])
def test_at_impacts_all_but_the_stroke_and_its_wind_up_is_the_very_motion(amount, fps):
    clip = arm_clip(strike(fps) + strike(fps, start=2.0, move=0.8), fps)
    out = timing(clip, acceleration=amount, **IMPACTS)
    assert len(out) == len(clip)
    at = np.arange(len(clip)) / fps
    same = (out.rotations == clip.rotations).all(axis=(1, 2))
    assert same[(at < 1.25 - 0.9) | (at > 1.25 + 1.0 / fps)].all()  # also in the slow move that follows
    moved = shown_angle(out) - shown_angle(clip)
    assert np.abs(moved[(at > 1.0) & (at < 1.25)]).max() > 0.03
    assert (np.diff(shown_angle(out)) >= -1e-9).all()


@pytest.mark.parametrize("amount", [-1.0, 1.0])
@pytest.mark.parametrize("steepest", [1.1, 2.5])
def test_at_impacts_no_limb_runs_faster_than_allowed(amount, steepest):
    fps = 240.0
    ramp = arm_clip(strike(fps), fps)
    fast = speeds(timing(ramp, acceleration=amount, steepest=steepest, **IMPACTS)).max() / speeds(ramp).max()
    assert 1.0 / min(steepest, 2.0**0.5) - 0.01 < fast < min(steepest, 2.0**0.5) + 0.01


def test_at_impacts_the_arms_of_a_walk_and_its_standing_feet_are_left_alone():
    clip = walk(seconds=4.0).motion
    body = Body.of(clip)
    planted = detect(clip, body=body)
    for amount in (-1.0, 0.5, 1.0):
        out = timing(clip, acceleration=amount, **IMPACTS)
        others = [j for j in range(len(clip.skeleton)) if j not in body.joints(("legs",))]
        np.testing.assert_array_equal(out.rotations[:, others], clip.rotations[:, others])
        np.testing.assert_array_equal(out.translations, clip.translations)
        for foot, leg in enumerate(("left_leg", "right_leg")):
            stands, joints = planted.feet[:, foot], body.joints((leg,))
            np.testing.assert_array_equal(out.rotations[stands][:, joints], clip.rotations[stands][:, joints])
            moved = np.abs(out.rotations[~stands] - clip.rotations[~stands])[:, joints]
            assert moved.max() > 0.02
        np.testing.assert_array_equal(slides(out, planted, body), slides(clip, planted, body))


def test_at_impacts_feet_stop_harder_or_softer():
    clip = walk(seconds=4.0, fps=120.0).motion
    body = Body.of(clip)
    strikes = [f for f in np.diff(detect(clip, body=body).feet[:, 0].astype(int)).nonzero()[0] if f > 30][
        1::2
    ]

    def stop(amount):
        out = timing(clip, acceleration=amount, **IMPACTS)
        heel = foot_points(out, body, *world(out))[:, 0, 0]
        speed = np.linalg.norm(np.diff(heel, axis=0), axis=1)
        return np.mean([-np.diff(speed[f - 18 : f + 1]).min() for f in strikes])

    assert len(strikes) >= 2
    assert stop(1.0) > 1.3 * stop(0.0)
    assert stop(0.5) > 1.1 * stop(0.0)
    assert stop(-1.0) < 0.85 * stop(0.0)


def test_at_impacts_feet_that_an_edit_made_slide_hurry_where_they_were_in_the_air():
    clip = walk(seconds=4.0).motion
    body, planted = Body.of(clip), detect(clip)
    longer = apply(clip, [Step("path_length", {"mid": 1.5})])
    assert (detect(longer, body=body).feet != planted.feet).any()
    out = apply(longer, [Step("timing", {"acceleration": 1.0, **IMPACTS})])
    for foot, leg in enumerate(("left_leg", "right_leg")):
        joints = body.joints((leg,))
        changed = (out.rotations != longer.rotations)[:, joints].any(axis=(1, 2))
        assert not (changed & planted.feet[:, foot]).any()
        assert changed.mean() > 0.15


def test_at_impacts_only_the_named_limbs_change():
    clip = walk(seconds=3.0).motion
    body = Body.of(clip)
    out = timing(clip, acceleration=0.8, limbs=("left_leg", "head"), **IMPACTS)
    changed = np.abs(out.rotations - clip.rotations).max(axis=(0, 2)) > 0
    assert set(np.flatnonzero(changed)) <= set(body.joints(("left_leg",)))
    assert changed[body.roles["left_knee"]]


@pytest.mark.parametrize("amount", [-1.0, 1.0])
def test_at_impacts_a_loop_stays_a_loop_wherever_it_is_cut(amount):
    t = np.arange(120) / 50.0
    u = np.clip((t - 0.8) / 0.25, 0.0, 1.0) - np.clip((t - 1.5) / 0.7, 0.0, 1.0)
    clip = arm_clip(0.5 * (1.0 - np.cos(np.pi * u)), 50.0)
    out = timing(clip, acceleration=amount, **IMPACTS)
    assert np.abs(shown_angle(out) - shown_angle(clip)).max() > 0.03
    for shift in (31, 71, 83):  # in the rest, in the wind-up, in the stroke
        turned = clip.with_(rotations=np.roll(clip.rotations, -shift, axis=0))
        rolled = timing(turned, acceleration=amount, boundary="wrap", **IMPACTS)
        whole = timing(clip, acceleration=amount, boundary="wrap", **IMPACTS)
        np.testing.assert_allclose(shown_angle(rolled), np.roll(shown_angle(whole), -shift), atol=2e-3)


@pytest.mark.parametrize("first", [60, 77, 98, 111])
def test_at_impacts_a_looping_walk_still_loops(first):
    stride = walk(seconds=4.0, cadence=1.6, fps=60.0).motion[first : first + 75]  # two steps
    body = Body.of(stride)
    out = timing(stride, acceleration=1.0, **IMPACTS)
    assert loop(stride, body) == loop(out, body) == 75
    knees = [body.roles["left_knee"], body.roles["right_knee"]]
    assert (np.abs(out.rotations - stride.rotations)[:, knees].max(axis=(0, 2)) > 0.02).all()
    planted = detect(stride, body=body)
    np.testing.assert_array_equal(slides(out, planted, body), slides(stride, planted, body))


def test_at_impacts_the_frame_rate_does_not_matter():
    shown = []
    for fps in (30.0, 60.0, 120.0):
        out = timing(arm_clip(knocks(fps, move=0.25, pause=0.5), fps), acceleration=1.0, **IMPACTS)
        shown.append(shown_angle(out)[:: int(fps / 30.0)])
    fastest = np.abs(np.diff(shown[2])).max() * 30.0
    assert np.abs(shown[0] - shown[2]).max() < 0.016 * fastest
    assert np.abs(shown[1] - shown[2]).max() < 0.006 * fastest


@pytest.mark.parametrize("frames", [1, 2, 3, 20])
def test_at_impacts_short_clips_are_the_very_motion(frames):
    clip = arm_clip(knocks(60.0)[:frames], 60.0)
    np.testing.assert_array_equal(timing(clip, acceleration=1.0, **IMPACTS).rotations, clip.rotations)


CAPTURES = (
    "bandai1/dataset-1_walk_angry_001.bvh",
    "bandai1/dataset-1_run_normal_001.bvh",
    "bandai2/dataset-2_walk_normal_024.bvh",
    "cmu_daz/07_01.bvh",
    "cmu_mb_misc/02_01.bvh",
    "xia/neutral_01_000.bvh",
    "reactidle/000_genuine.bvh",
    "exporters/walk01.bvh",
)


@pytest.mark.parametrize("name", CAPTURES)
def test_at_impacts_captured_feet_neither_slide_nor_tremble_and_arms_are_left_alone(data, name):
    if not (data / name).exists():
        pytest.skip(f"no {name}")
    clip = load(data / name)[:1000]
    body = Body.of(clip)
    planted = detect(clip, body=body)
    out = apply(clip, [Step("timing", {"acceleration": 0.5, **IMPACTS})])
    assert np.abs(out.rotations - clip.rotations).max() > 0.01
    np.testing.assert_array_equal(slides(out, planted, body), slides(clip, planted, body))
    report = check(out, against=clip, only=("foot_slide", "floor", "jitter", "popping"))
    assert report.failed == ()
    if "idle" not in name:
        arms = body.joints(("arms",))
        np.testing.assert_allclose(out.rotations[:, arms], clip.rotations[:, arms], atol=1e-15)
