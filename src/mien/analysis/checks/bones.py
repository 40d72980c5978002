"""Whether bones change their length.

Against the source's usual length of each bone below the hips. An edit never may; captures and exporters that
move joints by position channels do so a little.
"""

import numpy as np

from .check import Check, Measured
from .scene import Scene


def measure(scene: Scene) -> Measured:
    """Return how much longer or shorter than usual each bone is (T, B), in percent of it."""
    skeleton, hips = scene.motion.skeleton, scene.body.roles["hips"]
    bones = [j for j in skeleton.descendants(hips) if j != hips]
    usual = np.median(_lengths((scene.source or scene).motion.translations[:, bones]), axis=0)
    slack = 1e-3 * scene.body.leg_length  # joints that sit on their parents have no length to change
    change = np.abs(_lengths(scene.motion.translations[:, bones]) - usual)
    return Measured(100.0 * change / np.maximum(usual, slack), tuple(skeleton.names[j] for j in bones))


def _lengths(translations: np.ndarray) -> np.ndarray:
    return np.sqrt(np.einsum("tji,tji->tj", translations, translations))


CHECK = Check("bones", "bones change length", "%", 2, limit=5.0, tolerance=0.05, measure=measure)
