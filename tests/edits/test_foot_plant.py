"""foot_plant: planted feet stand, nothing else moves, flight falls, steps carry the body."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits.foot_plant import foot_plant
from mien.edits.path_length import path_length
from mien.edits.posture import posture
from mien.errors import MienError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, foot_points, slides, spans
from mien.kinematics.fk import world
from mien.recipe import Step
from mien.rotations import quaternion as quat


def lengths(motion):
    """Bone lengths over time (T, N) of what hangs on the hips (which travel, on some skeletons)."""
    positions, parents = world(motion)[1], motion.skeleton.parents
    hips = Body.of(motion).roles["hips"]
    child = np.array([j for j in motion.skeleton.descendants(hips) if j != hips])
    return np.linalg.norm(positions[:, child] - positions[:, parents[child]], axis=2)


def soles(motion, body):
    return foot_points(motion, body, *world(motion)) @ body.up


@pytest.mark.parametrize("name", ["walk", "turn", "jump", "still"])
def test_an_unedited_clip_comes_back_unchanged(name):
    motion = samples.SAMPLES[name]().motion
    out = foot_plant(motion, original=motion)
    np.testing.assert_allclose(out.rotations, motion.rotations, atol=1e-9)
    np.testing.assert_allclose(out.translations, motion.translations, atol=1e-9)


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("mid", [0.3, 0.7, 1.5])
@pytest.mark.parametrize("name", ["walk", "tired_walk", "turn"])
def test_planted_feet_do_not_slide_nor_sink(name, mid, skeleton):
    sample = samples.SAMPLES[name](skeleton=skeleton, unit="m")
    body = Body.of(sample.motion)
    edited = path_length(sample.motion, mid=mid)
    out = foot_plant(edited, original=sample.motion)
    contacts = detect(sample.motion, body=body)
    before, bare = slides(sample.motion, contacts, body), slides(edited, contacts, body)
    after = slides(out, contacts, body)
    assert bare.max() > before.max() + 0.002, "the edit alone must slide, or this test shows nothing"
    assert (after - before).max() < 1e-4, "a tenth of a millimetre"
    assert soles(out, body).min() > soles(sample.motion, body).min() - 0.002
    np.testing.assert_allclose(lengths(out), lengths(sample.motion), atol=1e-9)


@pytest.mark.parametrize("mid", [0.5, 1.4])
def test_longer_steps_travel_further(mid):
    sample = samples.walk(seconds=4.0, unit="m")
    hips = Body.of(sample.motion).roles["hips"]

    def travel(motion):
        path = world(motion)[1][:, hips]
        return float(np.linalg.norm((path[-1] - path[0])[[0, 2]]))

    edited = path_length(sample.motion, mid=mid)
    moved = travel(foot_plant(edited, original=sample.motion)) / travel(sample.motion)
    assert (moved - 1.0) * (mid - 1.0) > 0.02, "in the direction of the steps"
    kept = travel(foot_plant(edited, original=sample.motion, travel=False)) / travel(sample.motion)
    assert abs(kept - 1.0) < 0.02


def test_flight_goes_on_falling_with_gravity():
    sample = samples.jump(fps=120.0, unit="m")
    motion = sample.motion
    hips = Body.of(motion).roles["hips"]
    out = foot_plant(posture(motion, arms=20.0, legs=5.0, hips_height=-0.05), original=motion)
    start, stop = max(spans(~detect(motion).feet.any(axis=1)), key=lambda s: s[1] - s[0])
    inside = slice(start + 10, stop - 10)

    def fall(m):
        height = world(m)[1][:, hips, 1]
        return np.gradient(np.gradient(height, m.frame_time), m.frame_time)[inside]

    np.testing.assert_allclose(fall(motion), -9.81, atol=0.3)
    np.testing.assert_allclose(fall(out), -9.81, atol=1.0)


def test_a_lower_pelvis_bends_the_knees_and_leaves_the_feet_where_they_are():
    sample = samples.still(unit="m")
    body = Body.of(sample.motion)
    out = foot_plant(posture(sample.motion, hips_height=-0.08), original=sample.motion)
    rise = world(out)[1][:, body.roles["hips"], 1] - world(sample.motion)[1][:, body.roles["hips"], 1]
    np.testing.assert_allclose(rise, -0.08 * body.leg_length, atol=1e-3)
    for role in ("left_ankle", "right_ankle"):
        here, there = (world(m)[1][:, body.roles[role]] for m in (out, sample.motion))
        np.testing.assert_allclose(here, there, atol=1e-5)
    knee = world(out)[1][:, body.roles["left_knee"]] - world(sample.motion)[1][:, body.roles["left_knee"]]
    assert (knee @ body.forward > 0.02).all(), "knees go forwards"


@pytest.mark.parametrize("mid", [0.5, 1.5])
def test_knees_neither_flip_nor_snap(mid):
    motion = samples.walk(fps=60.0).motion
    body = Body.of(motion)
    out = foot_plant(path_length(motion, mid=mid), original=motion)
    for side in ("left", "right"):
        knee = body.roles[f"{side}_knee"]

        def rate(m, knee=knee):
            q = m.rotations[:, knee]
            return np.degrees(2 * np.arccos(np.clip(np.abs((q[1:] * q[:-1]).sum(-1)), 0, 1))).max() * m.fps

        assert rate(out) < 1.6 * max(mid, 1.0) * rate(motion)


def test_edits_of_the_arms_leave_legs_and_hips_to_the_bit():
    motion = samples.walk().motion
    out = mien.apply(motion, [Step("path_length", {"mid": 1.6}, parts=("arms",)), Step("foot_plant")])
    body = Body.of(motion)
    legs = body.joints(("legs",))
    np.testing.assert_array_equal(out.rotations[:, legs], motion.rotations[:, legs])
    np.testing.assert_array_equal(out.translations, motion.translations)
    assert np.abs(out.rotations - motion.rotations).max() > 0.01


def test_a_clip_without_contacts_keeps_its_hips():
    motion = samples.walk(unit="m").motion
    high = np.array(motion.translations)
    hips = Body.of(motion).roles["hips"]
    high[:, hips] += np.cumsum(np.full((len(motion), 3), 0.05), axis=0)
    flying = motion.with_(translations=high)
    assert not detect(flying).points.any()
    out = foot_plant(path_length(flying, mid=0.5), original=flying)
    np.testing.assert_array_equal(out.translations, flying.translations)


def test_different_frames_are_refused():
    motion = samples.walk().motion
    with pytest.raises(MienError, match="both must be the same"):
        foot_plant(motion, original=motion[:10])


@pytest.mark.parametrize("cadence", [0.5, 1.8])
def test_a_walk_on_the_spot_stays_on_the_spot(cadence):
    walk = samples.walk(seconds=6.0, cadence=cadence, step_length=0.3, unit="m").motion
    hips = Body.of(walk).roles["hips"]
    still = np.array(walk.translations)
    still[:, hips] -= walk.times[:, None] * np.polyfit(walk.times, still[:, hips], 1)[0]
    spot = walk.with_(translations=still)
    out = foot_plant(path_length(spot, mid=0.5), original=spot)
    moved = world(out)[1][:, hips] - world(spot)[1][:, hips]
    assert np.abs(moved @ Body.of(spot).forward).max() < 0.02


@pytest.mark.parametrize("name", ["walk", "turn"])
@pytest.mark.parametrize(
    "step",
    [
        Step("path_length", {"mid": 1.4}),
        Step("posture", {"lean": 10}),
        Step("posture", {"hips_height": -0.08, "legs": 3}),
    ],
)
def test_planting_twice_is_planting_once(name, step):
    motion = samples.SAMPLES[name](seconds=3.0).motion
    once = mien.apply(motion, [step, Step("foot_plant")])
    twice = mien.apply(once, [Step("foot_plant")])
    moved = np.linalg.norm(world(twice)[1] - world(once)[1], axis=-1).max() / Body.of(motion).leg_length
    assert moved < 0.01


def test_two_presets_one_after_the_other_travel_as_far_as_planted_once_at_the_end():
    motion = samples.walk(seconds=3.0).motion
    hips = Body.of(motion).roles["hips"]
    steps = [*mien.preset("sad").steps, *mien.preset("tired").steps]
    bare = [step for step in steps if step.edit != "foot_plant"]
    one, other = (mien.apply(motion, some) for some in (steps, [*bare, Step("foot_plant")]))
    distance = [np.linalg.norm(world(m)[1][-1, hips] - world(m)[1][0, hips]) for m in (one, other)]
    assert distance[0] == pytest.approx(distance[1], rel=0.03)
    assert soles(one, Body.of(motion)).min() > soles(motion, Body.of(motion)).min() - 0.2


@pytest.mark.parametrize("degrees", [12.0, -8.0])
@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_feet_stand_turned_out_or_in_by_the_share_that_is_kept(share: float, degrees: float) -> None:
    """Oracle: the yaw of each foot in the world, in the middle of its contacts; and nothing slides."""
    walk = samples.walk(seconds=4.0).motion
    body = Body.of(walk)
    pose = f"left_ankle 0 {degrees} 0; right_ankle 0 {-degrees} 0"
    after = mien.apply(walk, [Step("posture", {"pose": pose}), Step("foot_plant", {"turn": share})])
    contacts = detect(walk, body=body)
    for foot, sign in ((0, 1.0), (1, -1.0)):
        ankle = body.roles[f"{('left', 'right')[foot]}_ankle"]
        for start, stop in contacts.spans(foot):
            here, there = (world(m)[0][start:stop, ankle] for m in (after, walk))
            yaw = quat.log(quat.multiply(here, quat.conjugate(there))) @ body.up
            # A foot that is on its toes turns about its own axis, which is not upright.
            assert np.degrees(yaw).mean() == pytest.approx(sign * share * degrees, rel=0.25, abs=0.1)
            assert np.ptp(np.degrees(yaw)) < 1.0
    assert (slides(after, contacts, body) - slides(walk, contacts, body)).max() < 0.002
