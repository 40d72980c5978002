"""sway: tilts and turns in closed form; what stays: head, legs, hanging arms, the way, those who stand."""

import numpy as np
import pytest

from mien import samples
from mien.edits.pipeline import apply
from mien.edits.sway import sway
from mien.kinematics.body import SIDES, Body
from mien.kinematics.contacts import detect, slides
from mien.kinematics.fk import world
from mien.kinematics.heading import heading
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion as quat

FPS = 100.0


def rocking(size: float, axis: str, frequency: float = 1.5, frames: int = 800, **form: object) -> Motion:
    """A figure at rest whose hips go to and fro by ``size`` degrees about its front or about up."""
    first = samples.walk(seconds=0.1, **form).motion
    body = Body.of(first)
    angle = np.radians(size) * np.sin(2 * np.pi * frequency * np.arange(frames) / FPS)
    about = {"tilt": body.forward, "turn": body.up}[axis]
    rotations = np.repeat(first.rotations[:1], frames, axis=0)
    root = int(np.flatnonzero(first.skeleton.parents < 0)[0])
    rotations[:, root] = quat.multiply(quat.exp(angle[:, None] * about), rotations[:, root])
    translations = np.repeat(first.translations[:1], frames, axis=0)
    return Motion(first.skeleton, quat.continuous(rotations), translations, 1.0 / FPS)


def line(motion: Motion, role: str, like: Motion) -> tuple[np.ndarray, np.ndarray]:
    """Tilt and turn (T,) in degrees of the line from the right to the left joint of a role."""
    body, positions = Body.of(like), world(motion)[1]
    side = positions[:, body.roles[f"left_{role}"]] - positions[:, body.roles[f"right_{role}"]]
    tilt = np.arctan2(side @ body.up, np.hypot(side @ body.forward, side @ body.left))
    turn = np.arctan2(side @ -body.forward, side @ body.left)
    return np.degrees(tilt), np.degrees(turn)


def turned(before: Motion, after: Motion, role: str) -> float:
    """The largest angle in degrees by which a joint is turned in the world."""
    j = Body.of(before).roles[role]
    change = quat.multiply(world(after)[0][:, j], quat.conjugate(world(before)[0][:, j]))
    return float(np.degrees(np.linalg.norm(quat.log(change), axis=1)).max())


@pytest.mark.parametrize("form", [{}, {"unit": "inch", "up": "z", "skeleton": "capture31"}])
@pytest.mark.parametrize(("axis", "which"), [("tilt", 0), ("turn", 1)])
@pytest.mark.parametrize("gain", [0.0, 2.0])
def test_the_pelvis_goes_so_much_further(gain: float, axis: str, which: int, form: dict[str, object]) -> None:
    """Oracle: what two Gaussians leave of 1.5 Hz, times the gain less one; the shoulders do what they did."""
    clip = rocking(4.0, axis, **form)
    after = sway(clip, **{f"hips_{axis}": gain})
    band = 2.0 ** -((1.5 / 8.0) ** 2) - 2.0 ** -((1.5 / 0.5) ** 2)
    before, found = line(clip, "hip", clip)[which], line(after, "hip", clip)[which]
    middle = slice(200, 600)
    wanted = before + (gain - 1.0) * band * (before - before.mean())
    np.testing.assert_allclose(found[middle], wanted[middle], atol=0.1)
    for other in (0, 1):
        np.testing.assert_allclose(
            line(after, "shoulder", clip)[other], line(clip, "shoulder", clip)[other], atol=0.05
        )


@pytest.mark.parametrize(("axis", "which"), [("tilt", 0), ("turn", 1)])
def test_the_shoulders_go_further_over_hips_that_stay(axis: str, which: int) -> None:
    walk = samples.walk(seconds=6.0).motion
    after = sway(walk, **{f"shoulders_{axis}": 2.0})
    ranges = [np.ptp(line(m, "shoulder", walk)[which] - line(m, "hip", walk)[which]) for m in (walk, after)]
    assert ranges[1] > 1.15 * ranges[0]
    for other in (0, 1):
        np.testing.assert_allclose(line(after, "hip", walk)[other], line(walk, "hip", walk)[other], atol=1e-6)


def test_head_legs_and_hanging_arms_keep_their_directions() -> None:
    walk = samples.walk(seconds=4.0).motion
    after = sway(walk, hips_tilt=3.0, hips_turn=2.0, shoulders_tilt=3.0)
    for role in ("head", *(f"{s}_{r}" for s in SIDES for r in ("hip", "knee", "ankle", "shoulder", "elbow"))):
        assert turned(walk, after, role) < 1e-5, role
    assert turned(walk, after, "hips") > 2.0


def test_nothing_is_added_beyond_sixteen_degrees() -> None:
    clip = rocking(25.0, "tilt")
    more = line(sway(clip, hips_tilt=4.0), "hip", clip)[0] - line(clip, "hip", clip)[0]
    assert 14.0 < np.abs(more).max() <= 16.0 + 1e-6


def test_who_turns_a_corner_turns_as_far_and_who_stands_stays() -> None:
    turn = samples.turn().motion
    ways = [heading(world(m)[1], Body.of(turn)) for m in (turn, sway(turn, hips_turn=2.0))]
    ends = [np.degrees(way[-1] - way[0]) for way in ways]
    assert ends[1] == pytest.approx(ends[0], abs=8.0)
    still = rocking(0.0, "tilt", frames=300)
    same = np.einsum("tji,tji->tj", sway(still, hips_tilt=3.0).rotations, still.rotations)
    np.testing.assert_allclose(np.abs(same), 1.0, atol=1e-12)


def test_weight_goes_from_leg_to_leg_where_no_step_is_near() -> None:
    """The pelvis tilts up towards the side that it moves to, by no more than asked; a walker does nothing."""
    still = rocking(0.0, "tilt", frames=1200)
    after, body = sway(still, shift=5.0), Body.of(still)
    tilt = line(after, "hip", still)[0] - line(still, "hip", still)[0]
    aside = (world(after)[1] - world(still)[1])[:, body.roles["hips"]] @ body.left / body.leg_length
    assert 3.0 < np.abs(tilt).max() < 7.5
    assert np.corrcoef(tilt, aside)[0, 1] > 0.99
    assert 0.02 < np.abs(aside).max() < 0.055
    walk = samples.walk(seconds=3.0).motion
    assert turned(walk, sway(walk, shift=5.0), "hips") < 1e-6


def test_feet_stay_once_they_are_put_back() -> None:
    walk = samples.walk(seconds=4.0).motion
    after = apply(walk, [Step("sway", {"hips_tilt": 2.5, "hips_turn": 2.0}), Step("foot_plant")])
    body = Body.of(walk)
    contacts = detect(walk, body=body)
    assert (slides(after, contacts, body) - slides(walk, contacts, body)).max() < 0.002


def test_another_seed_shifts_the_weight_at_other_times() -> None:
    still = rocking(0.0, "tilt", frames=600)
    one, again, other = (sway(still, shift=5.0, seed=seed).translations for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, again)
    assert np.abs(one - other).max() > 0.01
