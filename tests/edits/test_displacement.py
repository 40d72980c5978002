"""displacement: each key is met, nothing happens elsewhere, and what is fine stays as it is."""

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

import mien
from mien import samples
from mien.edits.displacement import displacement
from mien.edits.pipeline import apply
from mien.edits.posture import posture
from mien.errors import RecipeError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, slides
from mien.kinematics.fk import world
from mien.kinematics.keyed_poses import format_keys, keys_between
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion as quat

RAISED = "left_shoulder -40 10 35; left_elbow -60 0 0"
KEYS = f"0.5 none | 1.1 {RAISED} | 1.8 {RAISED}; head 15 -30 0 | 2.4 none"


def apart(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Angles in degrees."""
    return np.degrees(np.linalg.norm(quat.log(quat.multiply(quat.conjugate(a), b)), axis=-1))


def frozen(motion: Motion) -> Motion:
    """The first pose, held."""
    return motion.with_(
        rotations=np.repeat(motion.rotations[:1], len(motion), axis=0),
        translations=np.repeat(motion.translations[:1], len(motion), axis=0),
    )


@pytest.mark.parametrize("method", ["anatomical", "additive", "body_fixed"])
@pytest.mark.parametrize("skeleton", ["standard22", "capture31"])
def test_at_a_key_a_body_at_rest_is_held_exactly_so(skeleton: str, method: str) -> None:
    clip = frozen(samples.walk(seconds=3.0, skeleton=skeleton).motion)
    after = displacement(clip, keys=KEYS, method=method)
    for time, pose in ((1.1, RAISED), (1.8, f"{RAISED}; head 15 -30 0")):
        held = posture(clip, pose=pose, method=method, fade=False)
        frame = round(time * clip.fps)
        assert apart(after.rotations[frame], held.rotations[frame]).max() < 1e-6
    for frame in (0, 30, 144, 180):
        assert apart(after.rotations[frame], clip.rotations[frame]).max() < 1e-9


def test_at_a_key_a_moving_body_is_held_so_but_for_its_finest_movement() -> None:
    clip = samples.walk(seconds=3.0, fps=120.0).motion
    after, held = displacement(clip, keys=KEYS), posture(clip, pose=RAISED, fade=False)
    frame = round(1.1 * clip.fps)
    assert apart(after.rotations[frame], held.rotations[frame]).max() < 0.2
    assert apart(clip.rotations[frame], held.rotations[frame]).max() > 30.0


def test_beyond_the_ends_the_change_fades_or_is_held() -> None:
    clip = frozen(samples.walk(seconds=4.0).motion)
    head = Body.of(clip).roles["head"]
    keys = "1 head 0 20 0 | 2 head 0 40 0"

    def turn(**options: object) -> np.ndarray:
        return apart(displacement(clip, keys=keys, **options).rotations, clip.rotations)[:, head]

    faded, quick, held = turn(fade=0.5), turn(fade=0.25), turn(ends="hold")
    for found in (faded, quick, held):
        np.testing.assert_allclose(found[[60, 120]], [20.0, 40.0], atol=1e-6)
    assert faded[:31].max() < 1e-6
    assert faded[40] > 1.0
    assert faded[150:].max() < 1e-6
    assert quick[:46].max() < 1e-6
    assert quick[135:].max() < 1e-6
    np.testing.assert_allclose(held[:60], 20.0, atol=1e-6)
    np.testing.assert_allclose(held[120:], 40.0, atol=1e-6)


def test_where_two_keys_are_alike_the_body_stays_and_never_goes_beyond() -> None:
    """A cubic with continuous acceleration would turn the head by 40 degrees and more."""
    clip = frozen(samples.still(seconds=5.0).motion)
    head = Body.of(clip).roles["head"]
    keys = "0.5 none | 1 head 30 0 0 | 3 head 30 0 0 | 3.5 none"
    turn = apart(displacement(clip, keys=keys).rotations, clip.rotations)[:, head]
    np.testing.assert_allclose(turn[60:181], 30.0, atol=1e-6)
    assert turn.max() < 30.0 + 1e-6
    speed = np.diff(turn) * clip.fps
    assert np.abs(np.diff(speed)).max() * clip.fps < 1.1 * 6.0 * 30.0 / 0.5**2  # that of a smooth step


def test_joints_and_frames_without_a_key_are_left_as_they_are() -> None:
    clip = samples.walk(seconds=3.0).motion
    after = displacement(clip, keys=KEYS)
    body = Body.of(clip)
    touched = [body.roles["left_shoulder"], body.roles["left_elbow"], body.roles["head"]]
    others = [j for j in range(len(clip.skeleton)) if j not in touched]
    np.testing.assert_array_equal(after.rotations[:, others], clip.rotations[:, others])
    np.testing.assert_array_equal(after.rotations[:31], clip.rotations[:31])
    np.testing.assert_array_equal(after.rotations[144:], clip.rotations[144:])
    np.testing.assert_array_equal(after.translations, clip.translations)
    assert apart(after.rotations, clip.rotations)[:, touched].max(axis=0).min() > 20.0


def fine_energy(motion: Motion, joints: list[int]) -> np.ndarray:
    """Energy of each joint (J,) above 12.5 Hz, by SciPy; of quaternions, as a turned bone keeps it there."""
    high = butter(6, 12.5, "high", fs=motion.fps, output="sos")
    away = round(0.3 * motion.fps)
    filtered = sosfiltfilt(high, quat.continuous(motion.rotations[:, joints]), axis=0)[away:-away]
    return (filtered**2).sum(axis=(0, 2))


@pytest.mark.parametrize("method", ["anatomical", "additive", "body_fixed"])
def test_fine_movement_keeps_its_energy(method: str) -> None:
    """Witkin & Popovic's promise: with keys half a second apart and more, within one in a hundred."""
    clip = samples.walk(seconds=3.0, fps=120.0).motion
    noise = quat.exp(np.radians(0.4) * np.random.default_rng(1).normal(size=(*clip.rotations.shape[:2], 3)))
    rough = clip.with_(rotations=quat.multiply(clip.rotations, noise))
    body = Body.of(clip)
    joints = [body.roles[role] for role in ("left_shoulder", "left_elbow", "head")]
    after = displacement(rough, keys=KEYS, method=method)
    assert apart(after.rotations, rough.rotations)[:, joints].max(axis=0).min() > 20.0
    np.testing.assert_allclose(fine_energy(after, joints), fine_energy(rough, joints), rtol=0.01)


def test_fine_movement_of_a_capture_keeps_its_energy(data: Path) -> None:
    clip = mien.load(data / "cmu_mb_misc" / "02_01.bvh")
    joints = [Body.of(clip).roles[role] for role in ("left_shoulder", "left_elbow", "head")]
    was, now = (fine_energy(m, joints).sum() for m in (clip, displacement(clip, keys=KEYS)))
    assert now == pytest.approx(was, rel=0.01)


def test_amount_scales_and_reverses() -> None:
    clip = frozen(samples.still(seconds=3.0).motion)
    half, back = (displacement(clip, keys=KEYS, amount=a, method="body_fixed") for a in (0.5, -1.0))
    frame = round(1.8 * clip.fps)
    head = Body.of(clip).roles["head"]
    for after, pose in ((half, "head 7.5 -15 0"), (back, "head -15 30 0")):
        held = posture(clip, pose=pose, method="body_fixed", fade=False)
        assert apart(after.rotations[frame, head], held.rotations[frame, head]) < 1e-6


def test_stills_of_an_actor_become_keys_of_another() -> None:
    """A nod captured on one skeleton, put on another at 1 s: the head is down, and up again at 2 s."""
    calm = samples.still(seconds=0.2, skeleton="capture31", unit="inch", up="z").motion
    keys = keys_between(calm, {1.0: posture(calm, head=25.0), 2.0: calm})
    clip = samples.walk(seconds=3.0).motion
    after = apply(clip, [Step("displacement", {"keys": format_keys(keys)})])
    body = Body.of(clip)
    down = [
        np.degrees(quat.log(quat.multiply(b, quat.conjugate(a))) @ body.left)
        for a, b in zip(world(clip)[0], world(after)[0], strict=True)
    ]
    head = np.array(down)[:, body.roles["head"]]
    assert head[60] == pytest.approx(25.0, abs=1.0)
    assert abs(head[120]) < 0.5


def test_history_holds_the_keys_and_replays() -> None:
    clip = samples.walk(seconds=3.0).motion
    after = apply(clip, [Step("displacement", {"keys": KEYS}, strength=0.7), Step("foot_plant")])
    assert after.history[0].parameters["keys"] == KEYS
    assert apply(clip, after.history).rotations.tobytes() == after.rotations.tobytes()


def test_feet_stay_where_they_stand_with_foot_plant() -> None:
    clip = samples.walk(seconds=3.0).motion
    keys = "0.7 hips 8 0 0; trunk 10 0 0; left_knee 12 0 0; left_hip -6 0 4 | 1.6 none"
    after = apply(clip, [Step("displacement", {"keys": keys}), Step("foot_plant")])
    body, contacts = Body.of(clip), detect(clip)
    was, now = (slides(m, contacts, body).max() / body.leg_length for m in (clip, after))
    assert now < was + 0.002


def test_no_keys_or_no_turns_are_the_motion_itself() -> None:
    clip = samples.walk(seconds=1.0).motion
    for options in ({}, {"keys": "0.2 none | 0.5 head 0 0 0"}, {"keys": KEYS, "amount": 0.0}):
        np.testing.assert_array_equal(displacement(clip, **options).rotations, clip.rotations)


def test_keys_that_cannot_be_read_are_refused() -> None:
    with pytest.raises(RecipeError, match="keys: at 25 s: there is no pose 'degrees'"):
        displacement(samples.walk(seconds=0.5).motion, keys="0.5 none | 25 degrees")
