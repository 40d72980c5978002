"""Blends: exact at the clips, in between where geometry says, on their feet, whatever the clips' form."""

import numpy as np
import pytest

import mien
from mien import MienError, Motion, Step, samples
from mien.errors import BodyError
from mien.kinematics.alignment import align
from mien.kinematics.body import Body
from mien.kinematics.contacts import Contacts, detect, slides
from mien.kinematics.fk import world
from mien.kinematics.heading import heading
from mien.rotations import quaternion
from mien.signal.sampling import spline
from mien.styles.multitarget import blend, mix
from mien.styles.skeletons import on_one_skeleton

POSTURE_OF_SECOND = {"low": [0, 1], "mid": [1, 0], "high": [1, 0]}


def assert_same(one: Motion, other: Motion, *, atol: float = 1e-9) -> None:
    """The same movement; a quaternion and its negative are the same rotation."""
    assert len(one) == len(other)
    along = np.abs(np.einsum("tji,tji->tj", one.rotations, other.rotations))
    np.testing.assert_allclose(along, 1.0, atol=atol)
    unit = Body.of(other).leg_length
    np.testing.assert_allclose(one.translations / unit, other.translations / unit, atol=atol)


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=4.0, fps=30.0).motion


@pytest.fixture(scope="module")
def tired() -> Motion:
    return samples.tired_walk(seconds=5.0, fps=30.0, heading=1.1).motion


@pytest.fixture(scope="module")
def wave() -> Motion:
    return samples.wave(fps=30.0).motion


@pytest.fixture(scope="module")
def knock() -> Motion:
    return samples.knock(fps=30.0).motion


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("pair", [("walk", "tired_walk"), ("wave", "knock")])
def test_all_weight_on_one_clip_gives_that_clip(skeleton, pair):
    clips = [
        samples.SAMPLES[name](fps=30.0, skeleton=skeleton, heading=h).motion
        for name, h in zip(pair, (0, 2), strict=True)
    ]
    for i, weights in enumerate(([1, 0], [0, 1])):
        made = mix(clips, weights)
        first, last = made.frames[i]
        assert_same(made.motion, clips[i][first : last + 1])
    if pair == ("wave", "knock"):
        assert len(blend(clips, [1, 0])) == len(clips[0])


def test_all_weight_on_one_of_three(walk, tired):
    clips = [walk, tired, samples.walk(seconds=3.0, fps=30.0, cadence=2.2, heading=-2.0).motion]
    for i in range(3):
        made = mix(clips, np.eye(3)[i])
        assert_same(made.motion, clips[i][made.frames[i][0] : made.frames[i][1] + 1])


@pytest.mark.parametrize("weights", [[0.3, 0.7], [-1, 2]])
@pytest.mark.parametrize("bands", [None, POSTURE_OF_SECOND])
@pytest.mark.parametrize("name", ["walk", "turn", "wave", "spin", "jump"])
def test_equal_clips_give_the_clip(name, weights, bands):
    motion = samples.SAMPLES[name](fps=30.0).motion
    assert_same(blend([motion, motion], weights, bands=bands), motion)


@pytest.mark.parametrize("bands", [False, True])
def test_the_order_of_the_clips_does_not_matter(walk, tired, bands):
    clips = [walk, tired, samples.walk(seconds=3.0, fps=30.0, step_length=0.5, heading=-0.6).motion]
    own = {"low": [0, 0.5, 0.5], "mid": [0.8, 0, 0.2]} if bands else {}
    swapped = {band: [weights[2], weights[0], weights[1]] for band, weights in own.items()}
    one = blend(clips, [0.2, 0.5, 0.3], bands=own)
    other = blend([clips[2], clips[0], clips[1]], [0.3, 0.2, 0.5], bands=swapped)
    assert_same(one, other)


@pytest.mark.parametrize("w", [-0.4, 0.0, 0.25, 0.5, 1.0, 1.3])
def test_it_lasts_the_weighted_sum(walk, tired, w):
    made = mix([walk, tired], [1 - w, w])
    seconds = (made.frames[:, 1] - made.frames[:, 0]) / 30.0
    want = float(seconds @ [1 - w, w])
    assert want - 1 / 30 - 1e-9 <= made.motion.duration <= want + 1e-9


def test_the_first_clip_gives_rate_and_skeleton(walk):
    other = samples.tired_walk(seconds=4.0, fps=48.0, unit="m").motion
    made = blend([walk, other], [0.5, 0.5])
    assert made.fps == pytest.approx(30.0)
    assert made.skeleton is walk.skeleton
    back = blend([other, walk], [0.5, 0.5])
    assert back.fps == pytest.approx(48.0)
    np.testing.assert_allclose(made.duration, back.duration, atol=0.1)


def test_bones_keep_their_lengths(walk, tired):
    made = blend([walk, tired], [0.4, 0.6])
    fixed = [j for j, name in enumerate(made.skeleton.names) if name != "Hips"]
    np.testing.assert_array_equal(
        made.translations[:, fixed], np.broadcast_to(walk.translations[0, fixed], (len(made), len(fixed), 3))
    )


def test_joints_turn_half_way_between_two_stills():
    """Elbows that differ by 50 degrees are at 25 with equal shares."""
    still = samples.still(seconds=1.0, fps=30.0).motion
    bent = [mien.apply(still, [Step("posture", {"elbows": angle})]) for angle in (0.0, 50.0)]
    elbow = Body.of(still).roles["left_elbow"]
    whole = quaternion.multiply(quaternion.conjugate(bent[0].rotations), bent[1].rotations)[:, elbow]
    full = np.linalg.norm(quaternion.log(whole), axis=1)
    assert full.min() > 0.8
    made = blend([bent[0], bent[1]], [0.5, 0.5])
    way = quaternion.multiply(quaternion.conjugate(bent[0].rotations), made.rotations)[:, elbow]
    np.testing.assert_allclose(np.linalg.norm(quaternion.log(way), axis=1), 0.5 * full, rtol=5e-3)


def test_a_turn_and_a_straight_walk_turn_by_half(walk):
    gait = {"seconds": 4.0, "fps": 30.0}
    straight = samples.turn(rate=0.0, **gait).motion
    left, right = (samples.turn(rate=rate, **gait).motion for rate in (0.4, -0.4))
    body = Body.of(straight)

    def turned(motion: Motion) -> float:
        angles = heading(world(motion)[1], body)
        return float(np.mean(angles[-17:]) - np.mean(angles[:17])) / (motion.duration - 16 / 30)

    assert turned(blend([straight, left], [0.5, 0.5])) == pytest.approx(0.2, abs=0.02)
    assert turned(blend([left, right], [0.5, 0.5])) == pytest.approx(0.0, abs=0.02)
    assert turned(blend([left, right], [1.25, -0.25])) == pytest.approx(0.6, abs=0.04)


@pytest.mark.parametrize("turned", [0.0, 1.2, 3.0, -2.4])
def test_steps_are_as_long_as_the_blend_of_steps(turned):
    """Steps of 0.5 and 0.7 m, wherever the two walkers face, make steps of 0.6 m on a straight line."""
    short = samples.walk(seconds=4.0, fps=30.0, step_length=0.5).motion
    long = samples.walk(seconds=4.0, fps=30.0, step_length=0.7, heading=turned).motion
    made = blend([short, long], [0.5, 0.5])
    hips = world(made)[1][:, Body.of(short).roles["hips"]][:, [0, 2]]
    steps = 1.8 * made.duration
    assert np.linalg.norm(hips[-1] - hips[0]) / 100 / steps == pytest.approx(0.6, abs=0.01)
    way = hips - hips[0]
    along = way[-1] / np.linalg.norm(way[-1])
    sideways = way - np.outer(way @ along, along)
    assert np.linalg.norm(sideways, axis=1).max() < 5.0, "cm: no more than a walker sways"


def test_turning_and_moving_all_clips_turns_and_moves_the_blend(walk, tired):
    one = blend([walk, tired], [0.4, 0.6], bands=POSTURE_OF_SECOND)
    turn, shift = quaternion.exp(np.array([0, 0.9, 0])), np.array([120.0, 0, -40.0])
    moved = []
    for motion in (walk, tired):
        hips = Body.of(motion).roles["hips"]
        rotations, translations = np.array(motion.rotations), np.array(motion.translations)
        rotations[:, hips] = quaternion.multiply(turn, rotations[:, hips])
        translations[:, hips] = quaternion.rotate(turn, translations[:, hips]) + shift
        moved.append(motion.with_(rotations=rotations, translations=translations))
    other = blend(moved, [0.4, 0.6], bands=POSTURE_OF_SECOND)
    want = quaternion.rotate(turn, world(one)[1]) + shift
    np.testing.assert_allclose(world(other)[1], want, atol=1e-6)


@pytest.mark.parametrize("w", [0.25, 0.5, 0.75])
@pytest.mark.parametrize("bands", [None, POSTURE_OF_SECOND])
def test_planted_feet_do_not_slide(walk, tired, w, bands):
    """Oracle: the samples' feet stand exactly, so whatever slides was put there by the blend."""
    made = blend([walk, tired], [1 - w, w], bands=bands)
    body = Body.of(walk)
    contacts = detect(made, body=body)
    assert sum(len(contacts.spans(foot)) for foot in range(2)) > 6
    own = max(slides(m, detect(m), Body.of(m)).max() for m in (walk, tired))
    assert slides(made, contacts, body).max() < own + 0.004 * body.leg_length


def lean(motion: Motion) -> float:
    """How far the head is in front of the hips on average, in leg lengths."""
    body, positions = Body.of(motion), world(motion)[1]
    seen = positions[:, body.roles["head"]] - positions[:, body.roles["hips"]]
    facing = np.stack([np.sin(heading(positions, body)), np.cos(heading(positions, body))], axis=1)
    return float(np.einsum("ti,ti->t", seen[:, [0, 2]], facing).mean() / body.leg_length)


def swing(motion: Motion) -> float:
    """How far the left upper arm turns to and fro, in radians."""
    shoulder = Body.of(motion).roles["left_shoulder"]
    turns = quaternion.log(
        quaternion.multiply(
            quaternion.conjugate(motion.rotations[:1, shoulder]), motion.rotations[:, shoulder]
        )
    )
    return float(np.linalg.norm(turns.std(axis=0)))


def test_posture_of_one_and_movement_of_the_other(walk, tired):
    made = blend([walk, tired], None, bands=POSTURE_OF_SECOND)
    clips = mix([walk, tired], [1, 0])
    assert len(made) == len(clips.motion), "time runs as in the movement"
    assert lean(made) == pytest.approx(lean(tired), abs=0.1 * (lean(tired) - lean(walk)))
    assert swing(made) > 0.7 * swing(walk) > 1.4 * swing(tired)


def test_more_weight_is_more_of_it_also_beyond_one(walk, tired):
    leans = [lean(blend([walk, tired], [1 - w, w])) for w in (-0.3, 0, 0.3, 0.6, 1, 1.3)]
    assert (np.diff(leans) > 0.02).all()


def test_time_never_runs_back():
    """Twice the slow clip minus the four times faster: the sum of their times would go back in places."""
    quick = samples.wave(fps=30.0).motion
    slow = samples.wave(fps=30.0).motion.with_(frame_time=4 / 30)
    made = blend([quick, slow], [2.0, -1.0])
    assert 0.2 * quick.duration < made.duration < quick.duration
    assert np.isfinite(made.rotations).all()


def test_the_frame_rate_hardly_matters():
    made = []
    for fps in (30.0, 60.0):
        clips = [samples.walk(seconds=4.0, fps=fps).motion, samples.tired_walk(fps=fps).motion]
        made.append(blend(clips, [0.5, 0.5]))
    slow, fast = (world(m)[1] for m in made)
    count = min(len(slow), (len(fast) + 1) // 2)
    assert np.abs(slow[:count] - fast[: 2 * count : 2]).max() < 0.03 * Body.of(made[0]).leg_length


@pytest.mark.parametrize("align", ["auto", "dtw", "none"])
@pytest.mark.parametrize("frames", [1, 2, 3, 4])
def test_very_short_clips(walk, tired, frames, align):
    made = blend([walk[:frames], tired[:frames]], [0.5, 0.5], bands={"low": [0, 1]}, align=align)
    assert len(made) == frames
    assert np.isfinite(made.rotations).all()


def test_the_clips_are_left_as_they_are_and_no_history_is_made_up(walk, tired):
    before = [np.array(m.rotations) for m in (walk, tired)]
    made = blend([walk, tired], [0.5, 0.5])
    for motion, rotations in zip((walk, tired), before, strict=True):
        np.testing.assert_array_equal(motion.rotations, rotations)
    assert (made.history, made.reference, made.source) == ((), None, None)
    assert made.name == "walk + tired_walk"
    np.testing.assert_array_equal(blend([walk, tired], [0.5, 0.5]).rotations, made.rotations)


def test_what_was_taken_is_said(walk, tired):
    made = mix([walk, tired], [0.5, 0.5])
    assert made.method == "steps"
    assert made.frames.shape == (2, 2)
    assert "2 clips aligned by steps" in repr(made)


def test_a_t_pose_is_not_blended(walk, tired):
    rotations = np.concatenate([np.tile([0, 0, 0, 1.0], (1, len(walk.skeleton), 1)), walk.rotations])
    posed = walk.with_(
        rotations=rotations, translations=np.concatenate([walk.translations[:1], walk.translations])
    )
    made = mix([posed, tired], [0.5, 0.5])
    assert_same(made.motion, blend([walk, tired], [0.5, 0.5]))
    assert made.frames[0][0] == 1 + mix([walk, tired], [0.5, 0.5]).frames[0][0]


def test_what_does_not_fit_is_said(walk, tired):
    with pytest.raises(MienError, match="sum to 1"):
        blend([walk, tired], [1, 1])
    with pytest.raises(MienError, match="no alignment 'steps '"):
        blend([walk, tired], [1, 0], align="steps ")
    lying = samples.walk(seconds=4.0, fps=30.0, up="z").motion
    with pytest.raises(MienError, match="clip 2"):
        blend([walk, lying], [0.5, 0.5])
    box = mien.Skeleton(("box", "lid"), [-1, 0], [[0, 0, 0], [0, 1.0, 0]])
    still = Motion(box, np.tile([0, 0, 0, 1.0], (4, 2, 1)), np.tile(box.offsets, (4, 1, 1)), 0.1)
    with pytest.raises(BodyError):
        blend([still, still], [0.5, 0.5])


@pytest.mark.parametrize("w", [0.25, 0.5, 0.75])
@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("bandai1/dataset-1_walk_normal_001", "bandai1/dataset-1_walk_sad_001"),
        ("bandai1/dataset-1_walk_normal_001", "bandai1/dataset-1_walk_angry_001"),
        ("bandai1/dataset-1_bow_normal_001", "bandai1/dataset-1_bow_old_001"),
        ("xia/neutral_01_000", "xia/old_13_000"),
        ("cmu_daz/02_01", "cmu_daz/12_01"),
    ],
)
def test_feet_of_real_blends_slide_no_more_than_those_of_the_clips(data, first, second, w):
    """In every contact that the clips have in common, against the clip that slides more in it."""
    clips = on_one_skeleton([mien.load(data / f"{name}.bvh") for name in (first, second)])
    made = blend(clips, [1 - w, w])
    shown = at_the_same_time(clips, [1 - w, w], made)
    bodies = [Body.of(clip) for clip in clips]
    found = [detect(motion, body=body).points for motion, body in zip(shown, bodies, strict=True)]
    both = Contacts(np.all(found, axis=0))
    own = np.max([slides(m, both, body) for m, body in zip(shown, bodies, strict=True)], axis=0)
    assert len(own) > 3
    assert (slides(made, both, bodies[0]) < own + 0.002 * bodies[0].leg_length).all()


def at_the_same_time(clips: list[Motion], weights: list[float], made: Motion) -> list[Motion]:
    """The clips, each as it is at the moments that their blend shows."""
    found = align(clips)
    times = (found.knots * [clip.frame_time for clip in clips]) @ weights
    frames = found.frames(times - times[0], made.times).T
    return [
        Motion(
            clip.skeleton,
            quaternion.normalise(spline(clip.rotations, at)),
            spline(clip.translations, at),
            made.frame_time,
        )
        for clip, at in zip(clips, frames, strict=True)
    ]
