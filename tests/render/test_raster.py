"""The renderer against areas known in closed form and against a slow twin that sweeps many spheres."""

import numpy as np
import pytest

from mien.render.raster import _cone, draw, paste
from mien.render.solids import Camera, Solids

PALETTE = np.array([[200.0, 40.0, 40.0], [40.0, 40.0, 200.0]])
SIZE = (160, 120)
CAMERA = Camera(np.eye(3), np.zeros(3), 80.0, 60.0, 1.0)


def cones(*parts, colours=None):
    a, b, ra, rb = (np.array(x, float) for x in zip(*parts, strict=True))
    colours = np.arange(len(parts)) if colours is None else np.array(colours)
    return Solids(a[None], b[None], ra, rb, np.zeros((1, 0, 3)), np.zeros((1, 0, 3, 3)), colours)


def ellipsoid(axes, centre=(0.0, 0.0, 0.0)):
    none = np.zeros((1, 0, 3))
    return Solids(
        none,
        none,
        np.zeros(0),
        np.zeros(0),
        np.array([[centre]]),
        np.array(axes)[None, None],
        np.zeros(1, np.int64),
    )


def full(layer):
    cover = np.zeros((SIZE[1], SIZE[0]))
    height, width = layer.cover.shape
    cover[layer.y : layer.y + height, layer.x : layer.x + width] = layer.cover
    return cover


def swept(a, b, ra, rb, camera=CAMERA, steps=4000):
    """Slow twin: cover and depth of a round cone as the union of many spheres, four samples a pixel."""
    a, b = camera.project(np.array(a, float)), camera.project(np.array(b, float))
    x, y = np.meshgrid((np.arange(2 * SIZE[0]) + 0.5) / 2, (np.arange(2 * SIZE[1]) + 0.5) / 2)
    depth = np.full(x.shape, -np.inf)
    for t in np.linspace(0, 1, steps):
        c, r = a + t * (b - a), (ra + t * (rb - ra)) * camera.scale
        rest = r * r - (x - c[0]) ** 2 - (y - c[1]) ** 2
        depth = np.where(rest >= 0, np.maximum(depth, c[2] + np.sqrt(np.maximum(rest, 0))), depth)
    hit = np.isfinite(depth)
    return hit.reshape(SIZE[1], 2, SIZE[0], 2).mean(axis=(1, 3))


def test_a_sphere_covers_a_disc():
    cover = full(draw(cones(((0, 0, 0), (0, 0, 0), 40, 40)), 0, CAMERA, SIZE, PALETTE))
    assert cover.sum() == pytest.approx(np.pi * 40**2, rel=2e-3)


@pytest.mark.parametrize("seed", range(4))
def test_an_ellipsoid_covers_the_ellipse_of_its_projection(seed):
    axes = np.random.default_rng(seed).normal(size=(3, 3)) * 14
    cover = full(draw(ellipsoid(axes), 0, CAMERA, SIZE, PALETTE))
    # The outline of {A u: |u| = 1} along z is the ellipse with matrix (A A^T) cut to x and y.
    area = np.pi * np.sqrt(np.linalg.det((axes @ axes.T)[:2, :2]))
    assert cover.sum() == pytest.approx(area, rel=5e-3)


@pytest.mark.parametrize(
    ("a", "b", "ra", "rb"),
    [
        ((-40, -10, 0), (35, 20, 0), 18, 7),
        ((-40, -10, -50), (35, 20, 30), 9, 22),
        ((-3, 2, -30), (4, -2, 40), 30, 6),  # points at the viewer: the tip lies inside the outline
        ((-3, 2, 40), (4, -2, -30), 30, 6),
        ((0, 0, 0), (5, 0, 0), 30, 10),  # one sphere holds the other
        ((10, 0, 0), (10, 0, 60), 12, 12),  # seen end-on
    ],
)
def test_a_round_cone_covers_what_many_spheres_cover(a, b, ra, rb):
    cover = full(draw(cones((a, b, ra, rb)), 0, CAMERA, SIZE, PALETTE))
    expected = swept(a, b, ra, rb, steps=400)
    assert np.abs(cover - expected).sum() < 0.004 * expected.sum()


@pytest.mark.parametrize("tip", [60.0, 30.0, -30.0])
def test_a_round_cone_has_the_depth_and_normal_of_many_spheres(tip):
    a, b, ra, rb = np.array([-3.0, 2.0, 10.0]), np.array([14.0, -2.0, tip]), 28.0, 8.0
    x, y = np.arange(-35.0, 30.0, 1.7)[None], np.arange(-30.0, 34.0, 1.7)[:, None]
    with np.errstate(invalid="ignore"):
        z, nx, ny = _cone(x, y, a, b, ra, rb)
    best, normal = np.full(z.shape, -np.inf), np.zeros((*z.shape, 3))
    for t in np.linspace(0, 1, 4001):
        centre, radius = a + t * (b - a), ra + t * (rb - ra)
        rest = radius**2 - (x - centre[0]) ** 2 - (y - centre[1]) ** 2
        depth = np.where(rest > 0, centre[2] + np.sqrt(np.maximum(rest, 0)), -np.inf)
        nearer = depth > best
        best[nearer] = depth[nearer]
        points = np.stack(np.broadcast_arrays(x, y, depth), axis=-1)[nearer]
        normal[nearer] = (points - centre) / radius
    steep = (normal[..., 2] < 0.1) & np.isfinite(best)  # there the sampling of the twin is coarse
    np.testing.assert_array_equal(np.isfinite(z)[~steep], np.isfinite(best)[~steep])
    clear = np.isfinite(best) & ~steep
    assert clear.sum() > 600
    np.testing.assert_allclose(z[clear], best[clear], atol=0.02)
    np.testing.assert_allclose(np.stack([nx, ny], axis=-1)[clear], normal[clear][:, :2], atol=0.01)


def test_the_nearer_sphere_hides_the_farther_one_in_either_order():
    near, far = ((0, 0, 30), (0, 0, 30), 20, 20), ((0, 0, -30), (0, 0, -30), 30, 30)
    for parts, colours in (((near, far), [0, 1]), ((far, near), [1, 0])):
        canvas = np.zeros((SIZE[1], SIZE[0], 3))
        paste(canvas, draw(cones(*parts, colours=colours), 0, CAMERA, SIZE, PALETTE))
        assert canvas[60, 80, 0] > canvas[60, 80, 2]
        assert canvas[60, 105, 2] > canvas[60, 105, 0]


def test_light_comes_from_above():
    canvas = np.zeros((SIZE[1], SIZE[0], 3))
    paste(canvas, draw(cones(((0, 0, 0), (0, 0, 0), 40, 40)), 0, CAMERA, SIZE, PALETTE))
    assert canvas[30, 80, 0] > 1.2 * canvas[90, 80, 0]


def test_solids_outside_or_across_the_edge_of_the_canvas():
    assert draw(cones(((500, 0, 0), (500, 0, 0), 20, 20)), 0, CAMERA, SIZE, PALETTE) is None
    cover = full(draw(cones(((80, 0, 0), (80, 0, 0), 20, 20)), 0, CAMERA, SIZE, PALETTE))
    assert cover.sum() == pytest.approx(np.pi * 20**2 / 2, rel=2e-2)


def test_opacity_mixes_with_the_canvas():
    canvas, half = np.full((SIZE[1], SIZE[0], 3), 100.0), np.full((SIZE[1], SIZE[0], 3), 100.0)
    layer = draw(cones(((0, 0, 0), (0, 0, 0), 40, 40)), 0, CAMERA, SIZE, PALETTE)
    paste(canvas, layer)
    paste(half, layer, opacity=0.5)
    np.testing.assert_allclose(half, 0.5 * (canvas + 100.0), atol=1e-3)
