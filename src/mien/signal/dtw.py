"""Dynamic time warping: which frame of one sequence belongs to which of another.

Sakoe & Chiba 1978; for motion Bruderlin & Williams 1995. Of all monotone paths through the table of
distances the one with the least sum is taken. The table is worked off along its anti-diagonals, all cells
of one at a time; only a band around the line from start to end is looked at, and of that only the choices
are kept, one byte a cell. The path is a staircase; ``knots`` makes a smooth map of it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import MienError, unknown
from ..typing import Array, Integers
from .bridging import smooth

Steps = Literal["limited", "free"]
Choices = NDArray[np.int8]  # which of the steps led to a cell
# How far a step goes in each sequence. The straight step stands first: of equal sums it is taken.
STEPS: dict[str, tuple[tuple[int, int], ...]] = {
    "limited": ((1, 1), (1, 2), (2, 1)),
    "free": ((1, 1), (1, 0), (0, 1)),
}
MARGIN = 2  # rows beside an anti-diagonal that a step may come from
NARROWEST = 2.0  # frames beside the line that any band lets in
LEAST = 0.25  # the least slope of a smooth map, seen from either sequence


@dataclass(frozen=True, eq=False)
class Path:
    """Frames that belong together, ``pairs`` (P, 2), and the mean distance ``cost`` along the path."""

    pairs: Integers
    cost: float


def path(a: Array, b: Array, *, steps: Steps = "limited", band: float = 0.2, slack: float = 0.0) -> Path:
    """Return the cheapest path between two sequences (T1, D) and (T2, D).

    ``g(i, j) = min over steps (p, q) of g(i - p, j - q) + (p + q) |a_i - b_j|``: so weighted no way is
    shorter than another, and swapping the sequences swaps the path. ``limited`` steps (1,1), (1,2), (2,1)
    keep the slope between one half and two; ``free`` steps (1,1), (1,0), (0,1) let one sequence wait.
    ``band`` is how far from the straight line the path may lie, as a share of the length. It runs from the
    first pair to the last; with ``slack`` it may leave out so great a share of either sequence at each end
    if that lowers the mean distance. Time O(T band D), memory O(T band). Raises ``MienError`` where no
    such path joins the ends.
    """
    a, b = _checked(a, b, steps, band, slack)
    table = _Table(a, b, STEPS[steps], slack)
    low, high = _band(len(a), len(b), band + 2.0 * slack)
    choice = np.full((len(low), int((high - low).max()) + 1), -1, np.int8)
    for k, (first, last) in enumerate(zip(low.tolist(), high.tolist(), strict=True)):
        choice[k, : last - first + 1] = table.advance(k, np.arange(first, last + 1))
    if not table.ends:
        raise MienError(
            f"no path with {steps} steps joins the ends of sequences of {len(a)} and {len(b)} frames; "
            "resample them to like lengths, or take free steps"
        )
    cost, i, j = min(table.ends)
    return Path(_trace(choice, low, STEPS[steps], i, j), cost)


def knots(path: Path, *, sigma: float, spacing: float) -> Array:
    """Return pairs of moments (K, 2), in frames, of a smooth map through a path, from its first to its last.

    With ``u`` and ``v`` the shares of both sequences that are done, ``d = u - v`` is averaged over
    ``sigma`` frames along the path and then kept so even that neither slope falls below 0.25. A knot
    stands about every ``spacing`` frames.
    """
    first, last = path.pairs[0].astype(float), path.pairs[-1].astype(float)
    length = last - first
    if not (length > 0.0).all():
        return np.stack([first, last])[: 1 if (length == 0.0).all() else 2]
    share = (path.pairs - first) / length
    count = int(max(np.ceil(length.max()), 1.0)) + 1
    grid = np.linspace(0.0, 1.0, count)
    apart = np.interp(grid, share.mean(axis=1), 0.5 * (share[:, 0] - share[:, 1]))
    apart = _no_steeper(smooth(apart, sigma=sigma), grid, (1.0 - LEAST) / (1.0 + LEAST))
    kept = np.linspace(0.0, 1.0, max(round((count - 1) / spacing), 1) + 1)
    apart = np.interp(kept, grid, apart)
    return first + length * np.stack([kept + apart, kept - apart], axis=1)


def _no_steeper(y: Array, x: Array, slope: float) -> Array:
    """Return a curve near ``y`` (N,) over ``x`` that is nowhere steeper, and zero at both ends."""
    room = slope * np.minimum(x - x[0], x[-1] - x)
    y = np.clip(y, -room, room)

    def lowest(y: Array) -> Array:  # the highest curve below y that is no steeper
        after = np.minimum.accumulate((y + slope * x)[::-1])[::-1] - slope * x
        return np.minimum(after, np.minimum.accumulate(y - slope * x) + slope * x)

    return 0.5 * (lowest(y) - lowest(-y))


def _checked(a: Array, b: Array, steps: str, band: float, slack: float) -> tuple[Array, Array]:
    a, b = np.asarray(a, float), np.asarray(b, float)
    if steps not in STEPS:
        raise MienError(unknown("kind of steps", steps, STEPS))
    if a.ndim != 2 or b.ndim != 2 or a.shape[1] != b.shape[1] or not (len(a) and len(b)):
        raise MienError(f"sequences must have shapes (T1, D) and (T2, D), got {a.shape} and {b.shape}")
    if not (band > 0.0 and 0.0 <= slack < 0.5):
        raise MienError(f"band must be above 0 and slack from 0 to below 0.5, got {band:g} and {slack:g}")
    return a, b


def _band(n: int, m: int, band: float) -> tuple[Integers, Integers]:
    """Return the first and last row of each anti-diagonal ``i + j = k`` that lies in the band.

    In it is ``|i (m - 1) - j (n - 1)| <= band (n - 1) (m - 1)``, which does not change with a swap.
    """
    k = np.arange(n + m - 1)
    low, high = np.maximum(0, k - m + 1), np.minimum(k, n - 1)
    across = max(n + m - 2, 1)
    width = max(band * (n - 1) * (m - 1), NARROWEST * across)
    low = np.maximum(low, np.ceil((k * (n - 1) - width) / across - 1e-9).astype(np.int64))
    high = np.minimum(high, np.floor((k * (n - 1) + width) / across + 1e-9).astype(np.int64))
    return low, high


class _Table:
    """The last few anti-diagonals of the sums, by row, and the ends that paths have reached.

    The weight of each path so far is carried along, as with slack the mean depends on where it began.
    """

    def __init__(self, a: Array, b: Array, steps: Sequence[tuple[int, int]], slack: float) -> None:
        self.a, self.b, self.steps = a, b, steps
        self.free = slack * (len(a) - 1), slack * (len(b) - 1)
        self.kept = max(p + q for p, q in steps) + 1
        self.sums = np.full((self.kept, len(a) + 2 * MARGIN), np.inf)
        self.weights = np.ones_like(self.sums)
        self.ends: list[tuple[float, int, int]] = []

    def advance(self, k: int, i: Integers) -> Choices:
        """Work off the cells ``(i, k - i)`` of one anti-diagonal; return the step that led to each, or -1."""
        j = k - i
        here = self.a[i[0] : i[-1] + 1] - self.b[j]
        distance = np.sqrt(np.einsum("td,td->t", here, here))
        starts = ((j == 0) & (i <= self.free[0])) | ((i == 0) & (j <= self.free[1]))
        total, weight = np.where(starts, 2.0 * distance, np.inf), np.full(len(i), 2.0)
        taken = np.full(len(i), -1, np.int8)
        for number, (p, q) in enumerate(self.steps):
            before = (k - p - q) % self.kept, slice(i[0] - p + MARGIN, i[-1] - p + MARGIN + 1)
            new, heavier = self.sums[before] + (p + q) * distance, self.weights[before] + (p + q)
            better = new * weight < total * heavier if any(self.free) else new < total
            total, weight = np.where(better, new, total), np.where(better, heavier, weight)
            taken[better] = number
        now = k % self.kept, slice(i[0] + MARGIN, i[-1] + MARGIN + 1)
        self.sums[now[0]] = np.inf
        self.sums[now], self.weights[now] = total, weight
        self._note_ends(i, j, total / weight)
        return taken

    def _note_ends(self, i: Integers, j: Integers, mean: Array) -> None:
        last_i, last_j = len(self.a) - 1, len(self.b) - 1
        if i[-1] < last_i and j[0] < last_j:
            return
        there = ((j == last_j) & (i >= last_i - self.free[0])) | (
            (i == last_i) & (j >= last_j - self.free[1])
        )
        for e in np.flatnonzero(there & np.isfinite(mean)):
            self.ends.append((float(mean[e]), int(i[e]), int(j[e])))


def _trace(choice: Choices, low: Integers, steps: Sequence[tuple[int, int]], i: int, j: int) -> Integers:
    """Return the cells (P, 2) from the start of the path to its end ``(i, j)``."""
    cells = [(i, j)]
    while (step := int(choice[i + j, i - low[i + j]])) >= 0:
        i, j = i - steps[step][0], j - steps[step][1]
        cells.append((i, j))
    return np.array(cells[::-1], np.int64)
