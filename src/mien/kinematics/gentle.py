"""Constraints met by changes that are smooth in time: solve, smooth what was changed, ask again."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ..motion import Motion
from .constraints import Constraint
from .smoothing import calm_change
from .solver import solve

ROUNDS = 12  # as what is smoothed gets smaller, and some is left


def gently(
    motion: Motion,
    ask: Callable[[Motion], Sequence[Constraint]],
    *,
    size: float,
    ease: Mapping[int, float],
    calm: float,
) -> Motion:
    """Return the motion with what ``ask`` asks for, nearly, and no change quicker than ``calm`` seconds.

    ``ask`` gives the constraints that a motion does not meet, none when it is well; ``size`` and ``ease`` are
    as for ``solve``. Joints that need not turn stay as they are.
    """
    out, sigma = motion, calm / motion.frame_time
    for _ in range(ROUNDS):
        constraints = ask(out)
        if not constraints:
            break
        found = solve(out, constraints, size=size, ease=ease).motion
        turned = [j for j in ease if np.abs(found.rotations[:, j] - out.rotations[:, j]).max() > 1e-9]
        rotations = np.array(out.rotations)
        rotations[:, turned] = calm_change(rotations[:, turned], found.rotations[:, turned], sigma=sigma)
        out = out.with_(rotations=rotations)
    return out
