"""bounce: a rise and fall in closed form, flights that fall, bows and those who stand, feet that stay."""

import numpy as np
import pytest

from mien import samples
from mien.edits.bounce import bounce
from mien.edits.pipeline import apply
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, slides
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.recipe import Step

FPS = 100.0


def raised(course: np.ndarray, **form: object) -> Motion:
    """A figure at rest that goes up and down by ``course`` (T,), in leg lengths."""
    first = samples.walk(seconds=0.1, **form).motion
    body = Body.of(first)
    translations = np.repeat(first.translations[:1], len(course), axis=0)
    root = int(np.flatnonzero(first.skeleton.parents < 0)[0])
    translations[:, root] += course[:, None] * body.leg_length * body.up
    return Motion(
        first.skeleton, np.repeat(first.rotations[:1], len(course), axis=0), translations, 1.0 / FPS
    )


def height(motion: Motion, like: Motion) -> np.ndarray:
    """Height of the hips (T,) in leg lengths."""
    body = Body.of(like)
    return world(motion)[1][:, body.roles["hips"]] @ body.up / body.leg_length


def wave(size: float, frequency: float, frames: int = 800) -> np.ndarray:
    return size * np.sin(2 * np.pi * frequency * np.arange(frames) / FPS)


@pytest.mark.parametrize("form", [{}, {"unit": "inch", "up": "z", "skeleton": "capture31"}])
@pytest.mark.parametrize("gain", [0.0, 0.5, 1.5, 2.5])
def test_a_sine_gets_the_gain_and_its_top_stays(gain: float, form: dict[str, object]) -> None:
    """Oracle: what two Gaussians leave of 2 Hz; lowered by its own height, as tops stay where they are."""
    size, f = 0.02, 2.0
    clip = raised(wave(size, f), **form)
    before, after = height(clip, clip), height(bounce(clip, gain=gain), clip)
    band = 2.0 ** -((f / 8.0) ** 2) - 2.0 ** -((f / 0.5) ** 2)
    change = (gain - 1.0) * band * (before - before.mean())
    middle = slice(200, 600)
    found = (after - before)[middle]
    np.testing.assert_allclose(found - found.mean(), change[middle], atol=0.02 * size)
    assert found.mean() == pytest.approx(-abs(gain - 1.0) * band * size, rel=0.05)
    assert (after - before).max() < 1e-9, "nobody is lifted"


def test_what_is_slow_and_who_stands_still_stay() -> None:
    slow = raised(wave(0.2, 0.1, frames=2000))
    assert np.abs(height(bounce(slow, gain=3.0), slow) - height(slow, slow)).max() < 0.02
    still = raised(np.zeros(300))
    np.testing.assert_allclose(bounce(still, gain=3.0).translations, still.translations, atol=1e-9)


def test_it_goes_down_a_fifth_of_a_leg_at_most() -> None:
    clip = raised(wave(0.3, 1.5))
    down = height(clip, clip) - height(bounce(clip, gain=4.0), clip)
    assert 0.15 < down.max() <= 0.2 + 1e-9


def test_a_standing_body_bounces_to_its_beat() -> None:
    """Oracle: the strongest frequency of the hips is the one asked for, the dips are about as deep."""
    still = raised(np.zeros(1000))
    down = -height(bounce(still, beat=0.02, rate=1.5), still)
    down -= down.min()
    spectrum = np.abs(np.fft.rfft(down - down.mean()))
    assert np.fft.rfftfreq(1000, 1.0 / FPS)[spectrum.argmax()] == pytest.approx(1.5, abs=0.11)
    assert 0.02 < down.max() < 0.02 * 4.0 / 3.0 + 1e-9


def test_a_walker_has_no_beat_of_his_own() -> None:
    walk = samples.walk(seconds=4.0).motion
    assert np.abs(bounce(walk, beat=0.05).translations - walk.translations).max() < 1e-9


def test_a_jump_falls_as_it_did() -> None:
    """Oracle: gravity. In the middle of the flight the acceleration is the original's."""
    jump = samples.jump(fps=120.0).motion
    body = Body.of(jump)
    feet = np.stack([world(jump)[1][:, body.roles[f"{s}_ankle"]] @ body.up for s in ("left", "right")])
    clear = np.flatnonzero(feet.min(axis=0) > np.median(feet) + 0.1 * body.leg_length)
    middle = clear[len(clear) // 3 : -(len(clear) // 3)]
    before, after = (height(m, jump) for m in (jump, bounce(jump, gain=2.5)))
    there, here = (np.diff(h, n=2)[middle - 1] * 120.0**2 for h in (before, after))
    assert np.abs(here - there).max() < 0.02 * np.abs(there).mean()
    assert after.max() <= before.max() + 1e-9


def test_feet_stay_once_they_are_put_back_and_knees_bend() -> None:
    walk = samples.walk(seconds=4.0).motion
    after = apply(walk, [Step("bounce", {"gain": 2.0}), Step("foot_plant")])
    body = Body.of(walk)
    contacts = detect(walk, body=body)
    assert (slides(after, contacts, body) - slides(walk, contacts, body)).max() < 0.002
    assert np.ptp(height(after, walk)) > 1.5 * np.ptp(height(walk, walk))


def test_another_seed_is_another_unevenness() -> None:
    still = raised(np.zeros(600))
    one, again, other = (bounce(still, beat=0.03, seed=seed).translations for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, again)
    assert np.abs(one - other).max() > 1e-3
