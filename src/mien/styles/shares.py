"""How much of each clip goes into a blend: for time and path, and for each band of frequencies."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from numbers import Real

import numpy as np

from ..errors import MienError, unknown
from ..signal.multiresolution import REFERENCE_SUPPORT, reference_response, regain, three_bands
from ..typing import Array

BANDS = ("low", "mid", "high")
LEAST, MOST = -1.0, 2.0
# A sum that is this near to 1, such as 0.33 + 0.33 + 0.33, is meant to be 1.
ROUNDING = 0.011


@dataclass(frozen=True, eq=False)
class Shares:
    """Weights (N,) of the clips, each set with the sum 1: for time, and for three bands of frequencies."""

    time: Array
    low: Array
    mid: Array
    high: Array

    @property
    def heaviest(self) -> int:
        """The clip that has the largest part in the movement."""
        return int(np.argmax(self.mid))

    def of(self, clip: int) -> tuple[float, ...]:
        """Return the weights of one clip: for time, and for the bands low, mid and high."""
        return tuple(float(weights[clip]) for weights in (self.time, self.low, self.mid, self.high))

    def mixed(self, values: Sequence[Array], fps: float) -> Array:
        """Return the blend (T, ...) of signals, one for each clip, on common frames.

        ``x = sum_i (w_low,i G_6 + w_mid,i (G_2 - G_6) + w_high,i (1 - G_2)) x_i``, the bands of
        ``multiresolution.reference_response``: nominally below 1, 1 to 12.5 and above 12.5 Hz.
        """
        total = np.zeros(values[0].shape)
        for i, x in enumerate(values):
            gains = float(self.low[i]), float(self.mid[i]), float(self.high[i])
            total += _weighted(x, gains, fps)
        return total


def _weighted(x: Array, gains: tuple[float, float, float], fps: float) -> Array:
    if gains[0] == gains[1] == gains[2]:
        return gains[0] * x
    levels = three_bands(*gains)
    return regain(x, fps, lambda hertz: reference_response(hertz, levels), support=REFERENCE_SUPPORT)


def shares(
    count: int, weights: Sequence[float] | None, bands: Mapping[str, Sequence[float]] | None
) -> Shares:
    """Return the shares of ``count`` clips.

    A band without weights of its own takes ``weights``; these, where they are not given, are those of mid,
    else equal. Weights lie between -1 and 2 and sum to 1; what is off by rounding is made to. Raises
    ``MienError`` for anything else.
    """
    given = {name: checked(f"weights of {name}", count, own) for name, own in _known(bands).items()}
    if weights is not None:
        common = checked("weights", count, weights)
    else:
        common = given.get("mid", np.full(count, 1.0 / count))
    return Shares(common, *(given.get(name, common) for name in BANDS))


def _known(bands: Mapping[str, Sequence[float]] | None) -> Mapping[str, Sequence[float]]:
    for name in bands or ():
        if name not in BANDS:
            raise MienError(unknown("band", name, BANDS))
    return bands or {}


def checked(what: str, count: int, weights: Sequence[float]) -> Array:
    """Return ``weights`` as an array with the sum 1; raise ``MienError`` naming ``what`` does not fit."""
    if isinstance(weights, str) or not isinstance(weights, Sequence | np.ndarray):
        raise MienError(f"{what} must be a list of numbers, got {weights!r:.60}")
    if len(weights) != count:
        raise MienError(f"{what}: {len(weights)} for {count} clips; give one for each clip")
    for weight in weights:
        if isinstance(weight, bool) or not isinstance(weight, Real) or not isfinite(weight):
            raise MienError(f"{what} must be numbers, got {weight!r:.60}")
        if not LEAST <= weight <= MOST:
            raise MienError(f"{what} must be from {LEAST:g} to {MOST:g}, got {weight:g}")
    values = np.array(weights, float)
    total = float(values.sum())
    if abs(total - 1.0) > ROUNDING:
        hint = f"; in the same proportion: {_listed(values / total)}" if total > ROUNDING else ""
        raise MienError(f"{what} must sum to 1, but {_listed(values)} sum to {total:g}{hint}")
    return values / total


def _listed(values: Array) -> str:
    return ",".join(f"{value:.4g}" for value in values)
