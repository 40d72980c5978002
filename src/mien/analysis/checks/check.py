"""The form of a check: what it measures, and how much is too much."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from ...typing import Array
from .scene import Scene

# Seconds that too much force has to last. Weight goes from foot to foot within a tenth or two, and when
# exactly a foot lets go is not known so well; 25 cm out of balance for 0.1 s is a centimetre of falling.
LASTING_FORCES = 0.2
NEAR = 0.3  # seconds: what a source shows so near in time may move there with a limb's timing


@dataclass(frozen=True, eq=False)
class Measured:
    """``values`` (T, P) of the ``parts`` (P), larger is worse, 0 where there is nothing to measure.

    ``facts`` are numbers that say more of the whole clip.
    """

    values: Array
    parts: tuple[str, ...]
    facts: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Check:
    """One question about a body in motion.

    A capture by itself passes if its values stay below ``limit`` but for a ``share`` of the frames. An edit
    passes if no value is above ``factor`` times its source's, near in time, plus ``tolerance``. Only what
    lasts for ``lasting`` seconds counts. With ``overall`` the values are judged by their mean over the clip
    instead. Checks that ``needs_source`` are left out without one.
    """

    name: str
    label: str
    unit: str
    digits: int
    limit: float
    tolerance: float
    measure: Callable[[Scene], Measured]
    factor: float = 1.0
    share: float = 0.1
    lasting: float = 0.1
    overall: bool = False
    needs_source: bool = False

    def allowed(self, source: Measured | None, scene: Scene) -> Array:
        """Return the most that each value (T, P) may be; one row where it does not depend on the frame."""
        if source is None:
            return np.full((1, 1), self.limit)
        values = source.values
        if self.overall:
            return self.factor * values.mean(axis=0)[None] + self.tolerance
        if scene.source is None:
            return self.factor * values.max(axis=0)[None] + self.tolerance
        return self.factor * _near(values, scene.motion.frame_time) + self.tolerance

    def excess(self, found: Measured, source: Measured | None, scene: Scene) -> Array:
        """Return by how much each value (T, P) is too large, for long enough; below 0 where it is not."""
        allowed = self.allowed(source, scene)
        if self.overall:
            over = found.values.mean(axis=0) - allowed[0]
            return np.broadcast_to(over, found.values.shape)
        return _sustained(found.values - allowed, round(self.lasting / scene.motion.frame_time))

    def lasting_values(self, found: Measured, frame_time: float) -> Array:
        """Return the values (T, P) that are kept up for long enough to count."""
        return _sustained(found.values, round(self.lasting / frame_time))


def _sustained(values: Array, frames: int) -> Array:
    """Return what each column (T, P) keeps up for so many frames: runs that are shorter are cut down."""
    from scipy.ndimage import maximum_filter1d, minimum_filter1d

    width = min(frames, len(values))
    if width < 2:
        return values
    low = minimum_filter1d(values, width, axis=0, mode="nearest")
    return maximum_filter1d(low, width, axis=0, mode="nearest", origin=-1 if width % 2 == 0 else 0)


def _near(values: Array, frame_time: float) -> Array:
    """Return the largest value of each part within ``NEAR`` seconds of each frame."""
    from scipy.ndimage import maximum_filter1d

    return maximum_filter1d(values, 2 * round(NEAR / frame_time) + 1, axis=0, mode="nearest")
