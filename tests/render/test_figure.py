"""The mannequin against the joints it hangs on, in pictures of single poses."""

from dataclasses import replace

import numpy as np
import pytest

from mien import Body, Motion, Skeleton, samples
from mien.errors import MienError
from mien.render.figure import Figure
from mien.render.mannequin import DARK
from mien.render.raster import draw, paste
from mien.render.solids import Camera, view_axes
from mien.rotations import quaternion

SIZE = 400


def picture(figure, view="front", frame=0, facing=None):
    """One pose on white, with the camera; ``facing`` fixes where the camera looks from."""
    facing = figure.facing[frame] if facing is None else facing
    axes = view_axes(view, figure.up, facing)
    middle = figure.ground[frame] + figure.size * figure.up
    camera = Camera(axes, middle, SIZE / 2, SIZE / 2, 0.36 * SIZE / figure.size)
    canvas = np.full((SIZE, SIZE, 3), 255.0, np.float32)
    paste(canvas, draw(figure.solids(np.array([frame])), 0, camera, (SIZE, SIZE), figure.palette))
    return canvas, camera


def colour_at(canvas, camera, point):
    x, y = camera.project(point)[:2].astype(int)
    return canvas[y, x]


def middle_of(mask):
    rows, columns = np.nonzero(mask)
    return columns.mean(), rows.mean()


def eyes(figure, view, facing=None):
    """The pixels of the eye band, told apart by a palette in which only it has a colour."""
    palette = np.full(figure.palette.shape, 200.0)
    palette[DARK] = [0.0, 255.0, 0.0]
    canvas, camera = picture(replace(figure, palette=palette), view, facing=facing)
    return canvas[..., 1] - canvas[..., 0] > 60, camera


@pytest.fixture(scope="module")
def walk():
    return Figure.of(samples.walk(seconds=1.0).motion)


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize("up", ["y", "z"])
def test_left_limbs_are_blue_and_right_limbs_orange_where_their_joints_are(skeleton, up):
    figure = Figure.of(samples.walk(seconds=0.5, skeleton=skeleton, up=up).motion)
    canvas, camera = picture(figure)
    for side, sign in (("left", 1), ("right", -1)):
        for a, b in (("shoulder", "elbow"), ("elbow", "wrist"), ("hip", "knee"), ("knee", "ankle")):
            ends = [figure.positions[0, figure.body.roles[f"{side}_{role}"]] for role in (a, b)]
            red, _, blue = colour_at(canvas, camera, 0.4 * ends[0] + 0.6 * ends[1])
            assert sign * (blue - red) > 25, (side, a)


def test_every_joint_of_the_limbs_is_covered(walk):
    canvas, camera = picture(walk, "three-quarter")
    for role, joint in walk.body.roles.items():
        assert colour_at(canvas, camera, walk.positions[0, joint]).min() < 250, role


def test_the_soles_touch_the_floor_and_do_not_sink():
    figure = Figure.of(samples.still(seconds=1.0).motion)
    low, _ = figure.solids(np.array([0])).bounds(0, figure.up[None])
    assert abs(low[0] - figure.floor) < 0.015 * figure.size


def test_the_face_is_in_front_and_the_hair_behind(walk):
    facing = walk.facing[0]
    front, back = (eyes(walk, "front", facing=f)[0].sum() for f in (facing, -facing))
    assert front > 40
    assert back == 0


def test_the_face_changes_sides_when_the_body_is_turned_round():
    sides = []
    for heading in (0.0, np.pi):
        figure = Figure.of(samples.still(seconds=0.2, heading=heading).motion)
        seen, camera = eyes(figure, "side", facing=samples.still(seconds=0.2).forward)
        head = camera.project(figure.positions[0, figure.body.roles["head"]])[0]
        sides.append(middle_of(seen)[0] - head)
    assert sides[0] > 3
    assert sides[1] < -3


@pytest.mark.parametrize("degrees", [-25, 25])
def test_a_head_bowed_through_the_whole_clip_is_drawn_bowed(degrees):
    still = samples.still(seconds=0.5)
    bowed = nod(still, degrees)
    heights = []
    for motion in (still.motion, bowed):
        figure = Figure.of(motion)
        seen, camera = eyes(figure, "side")
        head = camera.project(figure.positions[0, figure.body.roles["head"]])
        heights.append(middle_of(seen)[1] - head[1])
    assert np.sign(heights[1] - heights[0]) == np.sign(degrees)  # pixels count downwards
    assert abs(heights[1] - heights[0]) > 2


def nod(sample, degrees):
    """The clip with the head turned down by an angle in every frame, about the axis to the left."""
    motion = sample.motion
    body = Body.of(motion)
    head = body.roles["head"]
    world = Figure.of(motion).rotations[:, head]
    axis = quaternion.rotate(quaternion.conjugate(world), body.left)
    rotations = motion.rotations.copy()
    rotations[:, head] = quaternion.multiply(rotations[:, head], quaternion.exp(np.radians(degrees) * axis))
    return motion.with_(rotations=rotations)


def test_one_colour_has_no_sides():
    canvas, _ = picture(Figure.of(samples.still(seconds=0.2).motion, colour="#20a040"))
    drawn = canvas[canvas.min(axis=2) < 200]
    assert (drawn[:, 1] > drawn[:, 0]).all()
    assert (drawn[:, 1] > drawn[:, 2]).all()


def test_a_colour_that_is_none_is_refused():
    with pytest.raises(MienError, match="not a colour"):
        Figure.of(samples.still(seconds=0.2).motion, colour="bluish")


def test_facing_follows_a_turn():
    turn = samples.turn(seconds=4.0)
    facing = Figure.of(turn.motion).facing
    angle = np.arctan2(np.cross(facing[0], facing[-1]) @ turn.up, facing[0] @ facing[-1])
    swept = np.degrees(np.sum(np.arctan2(np.cross(facing[:-1], facing[1:]) @ turn.up, 1.0)))
    assert abs(swept) > 30
    assert np.cos(np.radians(swept) - angle) > 0.95


def test_an_edit_keeps_the_floor_and_the_feet_of_the_original():
    still = samples.still(seconds=0.5).motion
    before = Figure.of(still)
    moved = still.translations.copy()
    moved[:, 0] -= 0.05 * before.size * before.up
    after = Figure.of(still.with_(translations=moved), like=before)
    low, _ = after.solids(np.array([0])).bounds(0, after.up[None])
    assert low[0] < after.floor - 0.035 * after.size


def chain(joints, frames=3):
    """A snake: a tree of joints that is no human body."""
    parents = np.arange(-1, joints - 1)
    offsets = np.tile([0.0, 0.4, 0.3], (joints, 1))
    skeleton = Skeleton(tuple(f"j{i}" for i in range(joints)), parents, offsets, [joints - 1], [[0, 1, 0]])
    rotations = np.zeros((frames, joints, 4))
    rotations[..., 3] = 1
    return Motion(skeleton, rotations, np.broadcast_to(offsets, (frames, joints, 3)), 0.1)


@pytest.mark.parametrize("joints", [1, 2, 200])
def test_what_is_no_body_is_drawn_as_sticks(joints):
    figure = Figure.of(chain(joints))
    assert figure.body is None
    canvas, camera = picture(figure, "side")
    for point in figure.positions[0]:
        x, y = camera.project(point)[:2]
        if 0 <= x < SIZE and 0 <= y < SIZE:
            assert colour_at(canvas, camera, point).min() < 250


def below_a_root(snake, way):
    """The snake hung below a root at the world's origin, ``way`` (T, 3) from it."""
    tree = snake.skeleton
    skeleton = Skeleton(
        ("world", *tree.names),
        [-1, *(tree.parents + 1)],
        np.concatenate([np.zeros((1, 3)), tree.offsets]),
        tree.end_parents + 1,
        tree.end_offsets,
    )
    rotations = np.concatenate([snake.rotations[:, :1], snake.rotations], axis=1)
    translations = np.concatenate([np.zeros((len(snake), 1, 3)), snake.translations], axis=1)
    translations[:, 1] = way
    return Motion(skeleton, rotations, translations, 0.1)


@pytest.mark.parametrize("way", [[[900.0, 0, 0]] * 3, [[0.0, 0, 0], [0, 0, 0.5], [0, 0, 1.0]]])
def test_a_root_left_at_the_origin_is_not_drawn(way):
    snake = chain(6)
    alone, hung = Figure.of(snake), Figure.of(below_a_root(snake, way))
    assert hung.drawn.tolist() == [1, 2, 3, 4, 5, 6]
    assert hung.size == pytest.approx(alone.size)
    canvas, camera = picture(hung, "side")
    for point in hung.positions[0, 1:]:
        assert colour_at(canvas, camera, point).min() < 250
    frames = np.array([0])
    bare = replace(hung, positions=hung.positions - hung.positions[:, 1:2])
    wanted = replace(alone, positions=alone.positions - alone.positions[:, :1])
    for solids in ("starts", "ends"):
        np.testing.assert_allclose(
            getattr(bare.solids(frames), solids), getattr(wanted.solids(frames), solids), atol=1e-12
        )


def test_a_root_that_is_part_of_the_figure_is_drawn():
    snake = chain(6)
    still = Figure.of(below_a_root(snake, [0.0, 0.4, 0.3]))
    assert len(still.drawn) == 7
    moving = snake.translations.copy()
    moving[:, 0] = [[0, 0, 1.0], [0, 0, 2.0], [0, 0, 3.0]]
    assert len(Figure.of(snake.with_(translations=moving)).drawn) == 6


def test_a_lying_body_is_drawn_lying():
    still = samples.still(seconds=0.3)
    roll = quaternion.exp(-0.5 * np.pi * np.cross(still.up, still.forward))
    rotations, translations = still.motion.rotations.copy(), still.motion.translations.copy()
    rotations[:, 0] = quaternion.multiply(roll, rotations[:, 0])
    translations[:, 0] = 0.15 * still.leg_length * still.up
    body = Body.of(still.motion)
    figure = Figure.of(still.motion.with_(rotations=rotations, translations=translations), body=body)
    axes = view_axes("side", figure.up, still.forward)
    low, high = figure.solids(np.array([0])).bounds(0, axes)
    assert high[0] - low[0] > 1.7 * figure.size
    assert high[1] - low[1] < 0.7 * figure.size
