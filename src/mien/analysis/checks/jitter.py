"""Whether the movement trembles.

How far head, hands, feet and hips go to and fro faster than 8 Hz, root mean square over a third of a second;
hands, feet and head as seen from the hips. Long and quick movement has little of it, shaking is all of it,
and millimetres are what an eye sees. Beside it the jerk (third derivative of place), which grows with the
cube of the pace, and the share of movement above 12.5 Hz, where bodies hardly move (Förger 2011, section
3.4.1).
"""

import numpy as np

from ...signal.bridging import smooth
from ...signal.multiresolution import HALF
from ...typing import Array
from .check import Check, Measured
from .scene import Scene

WINDOW = 0.33  # seconds
TREMBLE = 0.0234  # seconds: a Gaussian of half amplitude at 8 Hz
SMOOTHING = 0.0094  # seconds: half amplitude at 20 Hz, as files with few digits shake faster than that
HIGH = 12.5  # Hz


def measure(scene: Scene) -> Measured:
    """Return how far each point trembles (T, P), in millimetres."""
    names, places = scene.tips
    places = places * scene.body.metres_per_unit
    seen = np.concatenate([places[:, :1], places[:, 1:] - places[:, :1]], axis=1)
    dt = scene.motion.frame_time
    fast = seen - smooth(seen, sigma=TREMBLE / dt)
    facts = {"jerk, mean m/s3": float(_jerk(seen, dt).mean()), "share above 12.5 Hz": high_share(seen, scene)}
    return Measured(1000.0 * _running(fast, dt), names, facts)


def _jerk(places: Array, dt: float) -> Array:
    """Return the jerk of each point (T, P), root mean square over ``WINDOW``."""
    if len(places) < 4:
        return np.zeros(places.shape[:2])
    jerk = np.diff(smooth(places, sigma=SMOOTHING / dt), n=3, axis=0) / dt**3
    return _running(np.pad(jerk, ((1, 2), (0, 0), (0, 0)), mode="edge"), dt)


def _running(vectors: Array, dt: float) -> Array:
    """Return the length of vectors (T, P, 3), root mean square over ``WINDOW`` (T, P)."""
    from scipy.ndimage import uniform_filter1d

    square = np.einsum("tpi,tpi->tp", vectors, vectors)
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
    "jitter",
    "trembling above 8 Hz",
    "mm",
    1,
    limit=20.0,
    tolerance=1.0,
    factor=2.0,
    overall=True,
    measure=measure,
)
