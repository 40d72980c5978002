"""Strips: what is on the picture, where, and the same for every unit and axis."""

import numpy as np
import pytest

import mien
from mien import Body, samples
from mien.errors import MienError
from mien.kinematics.fk import world
from mien.render import compare, strip
from mien.render.figure import Figure
from mien.render.strip import _called, pose_frames


def pixels(image):
    return np.asarray(image).astype(int)


def blue(image):
    return (pixels(image)[..., 2] - pixels(image)[..., 0]) > 60


def orange(image):
    return (pixels(image)[..., 0] - pixels(image)[..., 2]) > 80


def ghostly(image):
    """Pixels of the ghost's pale violet: a little more blue than red, least green, bright."""
    p = pixels(image)
    tint = p[..., 2] - p[..., 0]
    return (tint > 12) & (tint < 45) & (p[..., 1] < p[..., 2] - 15) & (p.min(axis=2) > 150)


@pytest.fixture(scope="module")
def walk():
    return samples.walk(seconds=2.0).motion


def test_width_is_as_asked_and_views_are_rows(walk):
    one, two = strip(walk, views=("side",), width=800), strip(walk, width=800)
    assert one.width == two.width == 800
    assert two.height > 1.6 * one.height


def test_the_side_view_shows_the_right_limbs_in_front_and_the_left_view_the_left(walk):
    right, left = strip(walk, views=("side",)), strip(walk, views=("left",))
    assert orange(right).sum() > 1.15 * blue(right).sum()
    assert blue(left).sum() > 1.15 * orange(left).sum()


def test_the_feet_stand_on_the_floor_line(walk):
    image = strip(walk, views=("side",), poses=6, width=1200, title="")
    column = pixels(image)[:, 1].sum(axis=1)  # nothing but paper, line and floor at the edge
    line = int(np.argmin(column))
    limbs = np.nonzero((blue(image) | orange(image)).any(axis=1))[0]
    assert abs(limbs.max() - line) <= 0.03 * (limbs.max() - limbs.min())


def test_each_pose_has_its_own_panel_without_travel(walk):
    image = strip(walk, views=("side",), poses=4, width=1200)
    for part in np.array_split(orange(image), 4, axis=1):
        assert part.sum() > 0.15 * orange(image).sum()


def test_travel_leaves_the_poses_where_they_are():
    """The heads of the first and the last pose are as far apart as the walk went between them."""
    sample = samples.walk(seconds=3.0)
    motion, body = sample.motion, Body.of(sample.motion)
    frames = pose_frames(len(motion), 2)
    image = strip(motion, views=("side",), poses=2, width=1400, travel=True, title="")
    drawn = pixels(image).min(axis=2) < 200
    drawn[:, 1200:] &= ~(np.arange(len(drawn)) < 30)[:, None]  # without the scale bar
    line = int(np.argmin(pixels(image)[:, 1].sum(axis=1)))
    top = int(np.nonzero(drawn[25:line].any(axis=1))[0].min()) + 25
    heads = np.nonzero(drawn[top : top + (line - top) // 12].any(axis=0))[0]
    apart = heads.max() - heads.min() - np.argmax(np.diff(heads) > 20)
    hips = world(motion)[1][frames, body.roles["hips"]]
    went = abs(float((hips[1] - hips[0]) @ sample.forward))
    assert apart / (line - top) == pytest.approx(went / body.height, rel=0.08)


def test_a_ghost_shows_where_the_original_differs():
    still, wave = samples.still(seconds=1.0).motion, samples.wave(seconds=1.0).motion
    with_ghost = strip(still, against=wave, views=("front",), poses=3)
    assert ghostly(with_ghost).sum() > 800
    assert ghostly(strip(still, views=("front",), poses=3)).sum() < 40


def test_a_ghost_of_the_same_motion_is_hidden_even_when_it_stood_elsewhere(walk):
    moved = walk.translations.copy()
    moved[:, 0] += [300.0, 0.0, -120.0]
    image = strip(walk, against=walk.with_(translations=moved), poses=4, title="")
    assert ghostly(image)[40:].sum() < 300


def test_a_ghost_of_another_length_is_taken_at_the_same_share(walk):
    """Twice as many frames of the same movement show the same ghost, half of the movement another."""
    wave = samples.wave(seconds=2.0, fps=60.0).motion
    one, twice, half = (
        strip(wave[:31], against=ghost.with_(name="ghost"), poses=3, width=600, views=("front",), title="")
        for ghost in (wave[::2], samples.wave(seconds=2.0, fps=120.0).motion, wave[:61])
    )
    differ = [(np.abs(pixels(one) - pixels(other)).max(axis=2) > 24).mean() for other in (twice, half)]
    assert differ[0] < 0.002 < differ[1]


def test_the_same_motion_gives_the_same_bytes(walk):
    assert (
        strip(walk, against=walk[::2], width=500).tobytes()
        == strip(walk, against=walk[::2], width=500).tobytes()
    )


@pytest.mark.parametrize("form", [{"up": "z"}, {"unit": "m"}, {"unit": "inch", "up": "z"}, {"heading": 2.0}])
def test_unit_axis_and_heading_do_not_change_the_picture(form):
    a, b = (strip(samples.walk(seconds=1.0, **f).motion, poses=4, width=900, title="") for f in ({}, form))
    assert a.size == b.size
    differ = np.abs(pixels(a) - pixels(b)).max(axis=2) > 24
    assert differ.mean() < 0.002


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_very_short_clips(walk, frames):
    image = strip(walk[:frames], width=300)
    assert (blue(image) | orange(image)).sum() > 100


def test_pose_frames_are_the_middles_of_equal_parts():
    assert pose_frames(100, 4).tolist() == [12, 37, 62, 87] or pose_frames(100, 4).tolist() == [
        12,
        38,
        62,
        88,
    ]
    assert pose_frames(3, 8).tolist() == [0, 1, 2]
    assert pose_frames(1, 5).tolist() == [0]


def test_compare_has_a_row_for_each_motion(walk):
    one = compare({"walk": walk}, poses=3, width=900)
    three = compare(
        {"walk": walk, "tired": samples.tired_walk(seconds=1.0).motion, "turn": walk}, poses=3, width=900
    )
    assert three.width == 900
    assert three.height > 2.5 * one.height


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"poses": 0}, "at least one pose"),
        ({"views": ()}, "at least one view"),
        ({"views": ("sdie",)}, "did you mean 'side'"),
        ({"width": 10}, "at least 64 pixels"),
    ],
)
def test_what_cannot_be_drawn_is_refused(walk, options, message):
    with pytest.raises(MienError, match=message):
        strip(walk, **options)


def test_comparing_nothing_is_refused():
    with pytest.raises(MienError, match="at least one"):
        compare({})


def shifted(motion, by):
    moved = motion.translations.copy()
    moved[:, 0] += by
    return motion.with_(translations=moved)


@pytest.mark.parametrize("form", [{}, {"unit": "m"}])
def test_travel_draws_both_clips_in_one_room(form):
    """A clip whose poses stand where the other's do hides its ghost; moved aside by a metre it does not."""
    walk, same = samples.walk(seconds=2.0).motion, samples.walk(seconds=2.0, **form).motion
    metre = {"m": 1.0}.get(form.get("unit"), 100.0)
    half = same[: len(same) // 2]
    hidden = strip(walk, against=same, views=("side",), poses=3, travel=True, title="")
    aside = shifted(same, [0.0, 0.0, metre])
    beside = strip(walk, against=aside, views=("side",), poses=3, travel=True, title="")
    assert ghostly(hidden)[40:].sum() < 300
    assert ghostly(beside)[40:].sum() > 3000
    begins = strip(walk[:1], against=half[:1], views=("side",), poses=1, travel=True, title="")
    assert ghostly(begins)[40:].sum() < 300, "two clips that start at the same place are drawn so"


def test_a_ghost_that_faces_another_way_is_turned():
    walk, other = samples.walk(seconds=1.0).motion, samples.walk(seconds=1.0, heading=2.0).motion
    turned = strip(walk, against=other.with_(name="other"), views=("side",), poses=4, title="")
    assert ghostly(turned)[40:].sum() < 300


def test_an_original_is_seen_by_the_same_camera():
    """An edit that turns the body is seen to turn it."""
    still = samples.still(seconds=0.5).motion
    turned = samples.still(seconds=0.5, heading=1.5).motion
    assert turned.name == still.name
    assert ghostly(strip(turned, against=still, views=("side",), poses=2, title=""))[40:].sum() > 800


@pytest.mark.parametrize(("name", "label"), [("walk", "original"), ("other", "other"), ("", "another clip")])
def test_the_ghost_is_called_what_it_is(walk, name, label):
    motion, ghost = (Figure.of(m) for m in (walk, walk.with_(name=name)))
    assert _called(ghost, [motion]) == label


def test_the_motion_before_an_edit_is_its_original(walk):
    edited = mien.apply(walk, mien.Step("posture", {"head": 10.0})).with_(name="walk_bowed")
    assert _called(Figure.of(walk), [Figure.of(edited)]) == "original"
    assert _called(Figure.of(edited), [Figure.of(walk)]) == "walk_bowed"


def test_what_is_no_motion_is_told_so():
    with pytest.raises(MienError, match=r"mien\.load\('walk\.bvh'\)"):
        strip("walk.bvh")
