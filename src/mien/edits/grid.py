"""Go to a point of the square between short and long paths, rushing and even speed.

To the motion: nine variants of it, three path lengths by three timings with the feet fixed, are made, and
the point is blended from those around it. To the viewer: path length and timing work as they do alone;
here both are set at once, and what is made once can be gone through without jumps (see ``mien.grid``).
"""

from typing import Annotated

import numpy as np

from ..kinematics.body import Body
from ..kinematics.contacts import detect
from ..kinematics.square import Mode, Square
from ..motion import Motion
from ..recipe import Step
from ..signal.time_map import Rule
from . import pipeline
from .registry import Param, edit


@edit(
    kind="pose",
    paper="Förger 2011, section 3.6, figures 27 and 28",
    equation="i = min(floor p, 1), j = min(floor q, 1), a = p - i, b = q - j; mean of four with the weights "
    "(1-a)(1-b), a(1-b), (1-a)b, ab: of direction vectors (bilinear) or of maps of time (timemap)",
    deviations="mode timemap moves limbs along their paths, where the thesis's mean of poses cuts corners; "
    "between the nine, standing feet are put where the mean of the ankles is; long rests count as pauses, as "
    "a knock has no others",
)
def grid(
    motion: Motion,
    *,
    path: Annotated[float, Param("0 short paths, 1 as it was, 2 long paths", 0.0, 2.0, neutral=1.0)] = 1.0,
    timing: Annotated[
        float, Param("0 added acceleration, 1 as it was, 2 constant speed", 0.0, 2.0, neutral=1.0)
    ] = 1.0,
    short: Annotated[float, Param("gain of path_length at path 0", 0.0, 1.0)] = 0.3,
    long: Annotated[float, Param("gain of path_length at path 2", 1.0, 4.0)] = 1.5,
    acceleration: Annotated[
        float, Param("acceleration of timing at timing 0, and evenness at timing 2", 0.0, 1.0)
    ] = 1.0,
    rests: Annotated[
        bool, Param("added acceleration also lengthens long rests, so that single actions rush too")
    ] = True,
    mode: Annotated[Mode, Param("blend the maps of time, or the four motions as in the thesis")] = "timemap",
) -> Motion:
    """Blend from the nine variants of path length and timing the one at a point of their square.

    The centre is the motion itself and the corners are ``path_length``, ``foot_plant`` and ``timing`` one
    after the other; between them the feet stay where they stand. Raises ``BodyError`` where no body is found.
    """
    if path == timing == 1.0:
        return motion
    # What lies on the other side of the square is not made.
    made = square(
        motion,
        short=short if path < 1.0 else 1.0,
        long=long if path > 1.0 else 1.0,
        acceleration=acceleration if timing != 1.0 else 0.0,
        rests=rests,
        mode=mode,
    )
    at = made.point(path, timing)
    return motion.with_(rotations=at.rotations, translations=at.translations)


def square(
    motion: Motion, *, short: float, long: float, acceleration: float, rests: bool, mode: Mode
) -> Square:
    """Return the square of a motion, whose points are ``grid``; parameters as there."""
    reference = motion.reference or motion
    body = Body.of(reference)
    planted = np.zeros((len(motion), 2), bool) if short == long else detect(reference, body=body).feet
    paths = (_with_paths(motion, short), motion, _with_paths(motion, long))
    retimed = acceleration > 0.0 and len(motion) > 2
    rules = (Rule(acceleration, rests=rests), Rule(-acceleration)) if retimed else ()
    return Square.of(paths, body, rules=rules, planted=planted, mode=mode)


def _with_paths(motion: Motion, gain: float) -> Motion:
    """Return the motion with shorter or longer paths and its feet where they stood."""
    if gain == 1.0:
        return motion
    return pipeline.apply(motion, [Step("path_length", {"mid": gain}), Step("foot_plant")])
