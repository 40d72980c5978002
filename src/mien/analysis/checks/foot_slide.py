"""Whether planted feet slide.

For every contact of the source: how far the planted heel or toe is from where it stands on average, in
centimetres. Beside it, for the whole clip, the two ratios that other work prints: frames that skate (the
definition used with SMooDi: lower than 5 cm twice running, faster than 0.5 m/s now and on a mean of five
frames at 20 a second) and the slide of low toes over the way of the hips (that used with CAMDM: toes below
1 cm). Both use their own idea of a contact, so they also count what ours would miss.
"""

from itertools import product

import numpy as np

from ...kinematics.contacts import spans
from ...typing import Array
from .check import Check, Measured
from .scene import Scene

LOW, FAST, MEAN = 0.05, 0.5, 0.25  # metres, metres a second, seconds
GROUNDED = 0.01  # metres
PARTS = ("left_heel", "left_toe", "right_heel", "right_toe")


def measure(scene: Scene) -> Measured:
    """Return how far each planted point is from where it stands (T, 4), in centimetres."""
    flat = scene.feet - (scene.feet @ scene.body.up)[..., None] * scene.body.up
    values = np.zeros((len(flat), 4))
    for column, (foot, point) in enumerate(product(range(2), range(2))):
        for start, stop in spans(scene.contacts.points[:, foot, point]):
            run = flat[start:stop, foot, point]
            values[start:stop, column] = np.linalg.norm(run - run.mean(axis=0), axis=1)
    facts = {"skating frames": skating(scene), "toe slide over way": toe_slide(scene)}
    return Measured(values * scene.centimetres, PARTS, facts)


def skating(scene: Scene) -> float:
    """Return the share of frames in which a foot is low and fast."""
    height, speed = _height_and_speed(scene)
    if not len(speed):
        return 0.0
    from scipy.ndimage import uniform_filter1d

    mean = uniform_filter1d(speed, max(1, round(MEAN * scene.motion.fps)), axis=0, mode="nearest")
    low = (height[1:] < LOW) & (height[:-1] < LOW)
    return float((low & (speed > FAST) & (mean > FAST)).any(axis=(1, 2)).mean())


def toe_slide(scene: Scene) -> float:
    """Return the mean slide of toes that are on the ground, over the mean way of the hips; 0 in place."""
    height, speed = _height_and_speed(scene)
    hips = scene.positions[:, scene.body.roles["hips"]] * scene.body.metres_per_unit
    ground = np.diff(hips - (hips @ scene.body.up)[:, None] * scene.body.up, axis=0)
    way = float(np.linalg.norm(ground, axis=1).mean()) * scene.motion.fps if len(ground) else 0.0
    down = height[1:, :, 1] < GROUNDED
    if not down.any() or way < 0.05:
        return 0.0
    return float(speed[:, :, 1][down].mean() / way)


def _height_and_speed(scene: Scene) -> tuple[Array, Array]:
    """Return heights (T, 2, 2) above each point's lowest and speeds over the ground (T - 1, 2, 2), metres."""
    points = scene.feet * scene.body.metres_per_unit
    height = points @ scene.body.up
    flat = points - height[..., None] * scene.body.up
    speed = np.linalg.norm(np.diff(flat, axis=0), axis=-1) * scene.motion.fps
    return height - np.percentile(height, 2, axis=0), speed


CHECK = Check("foot_slide", "planted feet slide", "cm", 2, limit=6.0, tolerance=0.3, measure=measure)
