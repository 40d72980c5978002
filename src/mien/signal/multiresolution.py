"""Split signals into bands an octave wide and put them together with other gains, without phase shift.

Bruderlin & Williams 1995, as used by Förger 2011, equations (1) to (3): ``G_0 = x``,
``G_{k+1} = G_k * w_{k+1}``, bands ``L_k = G_k - G_{k+1}``, result ``sum g_k L_k + g_rest G_n``, where
``w_k`` is the kernel ``[1 4 6 4 1] / 16`` with ``2^(k-1) - 1`` zeros between its numbers. Which Hz a band
holds depends on the frame rate; ``reference_response`` evaluates the bands of a 100 Hz clip at any
frequency, so that the result does not.

Frames are on axis 0. The first and last frames are held beyond the ends; with ``wrap`` the signal is one
period of a loop.
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from ..typing import Array

REFERENCE_FPS = 100.0
# Bands L_0 and L_1 of a 100 Hz clip lie above 12.5 Hz, L_2 to L_5 between 1 and 12.5 Hz, the rest below.
REFERENCE_HIGH, REFERENCE_MID = 2, 4
REFERENCE_SUPPORT = 1.26
# sinc^4(HALF) = 1/2: the limit of the half-amplitude point of G_k, in units of fps / 2^k.
HALF = 0.31891669868522327


def band_count(frames: int) -> int:
    """Return how many bands a signal has: ``floor(log2 m)``."""
    return max(frames, 1).bit_length() - 1


def bands(x: Array, *, wrap: bool = False) -> list[Array]:
    """Return ``L_0`` to ``L_{n-1}`` and what is left, ``G_n``; their sum is ``x``."""
    cascade = list(_cascade(x, band_count(len(x)), wrap))
    return [fine - coarse for fine, coarse in pairwise(cascade)] + cascade[-1:]


def smooth(x: Array, level: int, *, wrap: bool = False) -> Array:
    """Return ``G_level`` of ``x``: low-passed to about ``0.32 fps / 2^level`` Hz."""
    *_, last = _cascade(x, level, wrap)
    return last


def band_levels(fps: float, *, edges: tuple[float, float] = (1.0, 12.5)) -> tuple[int, int]:
    """Return ``(h, m)``: bands below ``h`` lie above the upper edge, ``h`` to ``m - 1`` between the edges.

    A band counts by the geometric centre of its octave, ``fps / 2^(k + 1.5)``.
    """
    centres = fps / 2.0 ** (np.arange(32) + 1.5)
    return int((centres > edges[1]).sum()), int((centres > edges[0]).sum())


def regain_bands(x: Array, fps: float, gains: tuple[float, float, float], *, wrap: bool = False) -> Array:
    """Return ``x`` with ``gains`` (low, mid, high) on the whole bands of its own frame rate.

    Low is below 1 Hz, high above 12.5 Hz, by ``band_levels``; a short clip has fewer bands.
    """
    low, mid, high = gains
    levels = [min(level, band_count(len(x))) for level in band_levels(fps)]
    cascade = list(_cascade(x, levels[1], wrap))
    above, below = cascade[levels[0]], cascade[levels[1]]
    return high * x + (mid - high) * above + (low - mid) * below


def reference_response(frequency: Array, gains: Sequence[float]) -> Array:
    """Return the gain at each frequency in Hz of the bands of a 100 Hz clip.

    ``gains`` holds one for each band, the fastest first, and one for the rest:
    ``H = sum g_k (G_k - G_{k+1}) + g_n G_n`` with
    ``G_k(f) = [sin(2^(k-1) W) / (2^k sin(W/2))]^4``, ``W = 2 pi f / 100`` below 50 Hz and 0 above.
    """
    out = np.full(np.shape(frequency), float(gains[0]))
    for k, (before, gain) in enumerate(pairwise(gains), start=1):
        if gain != before:
            out += (gain - before) * _reference_low_pass(frequency, k)
    return out


def three_bands(low: float, mid: float, high: float) -> tuple[float, ...]:
    """Return the gains of ``reference_response`` for below 1, 1 to 12.5 and above 12.5 Hz (nominal)."""
    return (high,) * REFERENCE_HIGH + (mid,) * REFERENCE_MID + (low,)


def edge_response(frequency: Array, gains: tuple[float, float, float], edges: tuple[float, float]) -> Array:
    """Return the gain at each frequency of three bands (low, mid, high) with ``edges`` in Hz.

    ``H = g_low S(f1) + g_mid (S(f2) - S(f1)) + g_high (1 - S(f2))``, where
    ``S(fc) = sinc^4(0.3189 f / fc)`` is one half at ``fc``.
    """
    low, mid, high = gains
    lower, upper = (np.sinc(HALF * frequency / edge) ** 4 for edge in edges)
    return high + (mid - high) * upper + (low - mid) * lower


def regain(
    x: Array, fps: float, response: Callable[[Array], Array], *, support: float, wrap: bool = False
) -> Array:
    """Return ``x`` with every frequency multiplied by ``response(Hz)``, without phase shift.

    ``support`` is how many seconds away a frame may still be felt: so long the ends are held before a
    straight line leads from the last value to the first, which makes the Fourier transform's circle.
    """
    padded, start = (x, 0) if wrap else _circle(x, int(np.ceil(support * fps)) + 1)
    spectrum = np.fft.rfft(padded, axis=0)
    gain = response(np.fft.rfftfreq(len(padded), 1.0 / fps))
    spectrum *= gain.reshape(-1, *[1] * (x.ndim - 1))
    return np.fft.irfft(spectrum, len(padded), axis=0)[start : start + len(x)]


def _circle(x: Array, pad: int) -> tuple[Array, int]:
    """Return ``x`` held ``pad`` frames at both ends and closed by a line, and where it starts."""
    held = len(x) + 2 * pad
    # At most a sixteenth longer than needed, but a length that the fast Fourier transform likes.
    unit = 1 << max((held + pad).bit_length() - 4, 0)
    length = -(-(held + pad) // unit) * unit
    out = np.empty((length, *x.shape[1:]))
    out[:pad], out[pad : pad + len(x)], out[pad + len(x) : held] = x[0], x, x[-1]
    weight = (np.arange(1, length - held + 1) / (length - held + 1)).reshape(-1, *[1] * (x.ndim - 1))
    out[held:] = x[-1] + weight * (x[0] - x[-1])
    return out, pad


def _reference_low_pass(frequency: Array, level: int) -> Array:
    half = np.pi * np.asarray(frequency) / REFERENCE_FPS
    still = half < 1e-9
    ratio = np.sin(2.0**level * half) / (2.0**level * np.sin(np.where(still, 1.0, half)))
    return np.where(still, 1.0, np.where(half < 0.5 * np.pi, ratio**4, 0.0))


def _cascade(x: Array, levels: int, wrap: bool) -> Iterator[Array]:
    """Yield ``G_0`` to ``G_levels``."""
    yield x
    # Held this far, the ends are constant as far as the widest kernel reaches: holding them again at
    # every stage is then the same as holding them for ever.
    pad = 0 if wrap else 2 ** (levels + 1)
    g = np.pad(x, _around(x, pad), mode="edge")
    for level in range(1, levels + 1):
        g = _widen(g, 2 ** (level - 1), wrap)
        yield g[pad : pad + len(x)]


def _widen(g: Array, step: int, wrap: bool) -> Array:
    """Convolve with ``[1 4 6 4 1] / 16``, the numbers ``step`` frames apart."""
    wide = np.pad(g, _around(g, 2 * step), mode="wrap" if wrap else "edge")
    far, near, here, after, beyond = (wide[i * step : i * step + len(g)] for i in range(5))
    return 0.375 * here + 0.25 * (near + after) + 0.0625 * (far + beyond)


def _around(x: Array, width: int) -> list[tuple[int, int]]:
    return [(width, width)] + [(0, 0)] * (x.ndim - 1)
