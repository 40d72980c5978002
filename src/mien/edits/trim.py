"""Keep a stretch of time: the frames from ``start`` to ``end``, both included.

To the motion: frames before and after go; the numbers of those kept are not touched, and time starts
at 0 again. To the viewer: the T-pose before a take or the walk-off after it is gone.
"""

from math import ceil, floor
from typing import Annotated

from ..errors import MienError
from ..motion import Motion
from .registry import Param, edit


@edit(kind="time", paper="", equation="frames i with start <= i frame_time <= end")
def trim(
    motion: Motion,
    *,
    start: Annotated[float, Param("first moment kept", 0.0, 1e6, "seconds")] = 0.0,
    end: Annotated[
        float | None, Param("last moment kept; none is the end of the clip", 0.0, 1e6, "seconds")
    ] = None,
) -> Motion:
    """Keep the frames from ``start`` to ``end`` (seconds, both included); the rest is dropped.

    Raises ``MienError`` where no frame lies between them. An ``end`` after the last frame is that frame.
    """
    slack = 1e-6  # of a frame, so that a time written with few decimals still names its frame
    first = ceil(start * motion.fps - slack)
    last = len(motion) - 1 if end is None else min(floor(end * motion.fps + slack), len(motion) - 1)
    if first > last:
        raise MienError(
            f"trim: no frame from {start:g} s to {'the end' if end is None else f'{end:g} s'}: "
            f"the clip lasts {motion.duration:g} s"
        )
    return motion if (first, last) == (0, len(motion) - 1) else motion[first : last + 1]
