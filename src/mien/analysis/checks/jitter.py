"""Whether the movement trembles.

The jerk (third derivative of place) of head, hands, feet and hips below 20 Hz, root mean square over a third
of a second; hands, feet and head as seen from the hips. Beside it the share of their movement above 12.5 Hz,
where bodies hardly move (Förger 2011, section 3.4.1).
"""

import numpy as np

from ...signal.bridging import smooth
from ...signal.multiresolution import HALF
from ...typing import Array
from .check import Check, Measured
from .scene import Scene

WINDOW = 0.33  # seconds
SMOOTHING = 0.0094  # seconds: half amplitude at 20 Hz, as files with few digits shake faster than that
HIGH = 12.5  # Hz


def measure(scene: Scene) -> Measured:
    """Return the jerk of each point (T, P), in m/s3."""
    names, places = scene.tips
    places = places * scene.body.metres_per_unit
    seen = np.concatenate([places[:, :1], places[:, 1:] - places[:, :1]], axis=1)
    return Measured(
        _jerk(seen, scene.motion.frame_time), names, {"share above 12.5 Hz": high_share(seen, scene)}
    )


def _jerk(places: Array, dt: float) -> Array:
    from scipy.ndimage import uniform_filter1d

    if len(places) < 4:
        return np.zeros(places.shape[:2])
    jerk = np.diff(smooth(places, sigma=SMOOTHING / dt), n=3, axis=0) / dt**3
    square = np.pad(np.einsum("tpi,tpi->tp", jerk, jerk), ((1, 2), (0, 0)), mode="edge")
    mean = uniform_filter1d(square, max(1, round(WINDOW / dt)), axis=0, mode="nearest")
    return np.sqrt(np.maximum(mean, 0.0))  # its running sum may round to below zero


def high_share(places: Array, scene: Scene) -> float:
    """Return how much of the points' velocity power is above 12.5 Hz, 0 to 1."""
    if len(places) < 8:
        return 0.0
    speed = np.diff(places, axis=0)
    speed = speed - speed.mean(axis=0)
    power = np.abs(np.fft.rfft(speed * np.hanning(len(speed))[:, None, None], axis=0)) ** 2
    power = power.sum(axis=(1, 2))
    frequency = np.fft.rfftfreq(len(speed), scene.motion.frame_time)
    above = 1.0 - np.sinc(HALF * frequency / HIGH) ** 4  # half at 12.5 Hz, as the bands of path_length
    return float((power * above).sum() / max(power.sum(), 1e-300))


CHECK = Check(
    "jitter", "jerk", "m/s3", 0, limit=7000.0, tolerance=10.0, factor=2.0, overall=True, measure=measure
)
