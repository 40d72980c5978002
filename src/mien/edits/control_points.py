"""Move pelvis, head and hands by the rules of emotion control for dance: ten numbers for the whole pose.

To the motion: the pelvis comes down or up, the torso leans further or straightens, each hand comes nearer to
or goes away from head, chest, pelvis and ground; the body follows, and the feet stay where they are. To the
viewer: low, bent and with the hands down and close reads as sad or tired, upright and wide as happy or
excited (Aristidou et al. 2017). ``mien.emotion.synthesis`` finds the numbers for a place on the disc of
emotions.
"""

from typing import Annotated

import numpy as np

from ..kinematics.body import Body
from ..kinematics.contacts import detect
from ..kinematics.control_points import moved
from ..kinematics.control_rules import BOUNDS
from ..motion import Motion
from ..typing import Array
from .registry import Param, edit


def _hand(side: str, place: str) -> Param:
    return Param(
        f"{side} hand further from the {place} (above 1) or nearer to it (below)",
        *BOUNDS["hand"],
        neutral=1.0,
    )


@edit(
    paper="Aristidou et al. 2017, table 2",
    equation="h' = c h (c <= 1), h + (h_T - h)(1 - 1/c); d' = d_T - (d_T - d) / c; "
    "p' = p + 1/4 sum_r (p - r)(c_r - 1)",
    deviations="vectors of the printed table are read the other way round; a pelvis above its calm height "
    "rises by (h - h_T)(c - 1), continuous at 1; upright (d_T) is 10 degrees behind the vertical, as bent "
    "further is to be forwards. Rules and inverse kinematics are done in every frame, not in every fifth; "
    "hands go with the trunk before their own rule",
)
def control_points(
    motion: Motion,
    *,
    pelvis: Annotated[
        float | Array,
        Param(
            "height of the pelvis, times; above 1 up to that of the stance", *BOUNDS["pelvis"], neutral=1.0
        ),
    ] = 1.0,
    torso: Annotated[
        float | Array,
        Param("torso nearer to upright (above 1) or leaning further (below)", *BOUNDS["torso"], neutral=1.0),
    ] = 1.0,
    left_head: Annotated[float | Array, _hand("left", "head")] = 1.0,
    left_chest: Annotated[float | Array, _hand("left", "chest")] = 1.0,
    left_pelvis: Annotated[float | Array, _hand("left", "pelvis")] = 1.0,
    left_ground: Annotated[float | Array, _hand("left", "ground")] = 1.0,
    right_head: Annotated[float | Array, _hand("right", "head")] = 1.0,
    right_chest: Annotated[float | Array, _hand("right", "chest")] = 1.0,
    right_pelvis: Annotated[float | Array, _hand("right", "pelvis")] = 1.0,
    right_ground: Annotated[float | Array, _hand("right", "ground")] = 1.0,
) -> Motion:
    """Move pelvis, torso and hands, and let the body follow with the feet where they are.

    A number may be one for each frame (T,). Bones keep their lengths: a hand out of reach is approached
    softly, and the pelvis comes no higher than planted legs reach. Raises ``BodyError`` where no body is
    found.

    >>> from mien.samples import walk
    >>> control_points(walk(seconds=1.0).motion, pelvis=0.95, left_ground=0.8, right_ground=0.8)
    Motion('walk', 61 frames, 22 joints, 60 fps, 1.00 s, 1 step)
    """
    left = (left_head, left_chest, left_pelvis, left_ground)
    right = (right_head, right_chest, right_pelvis, right_ground)
    values = np.stack(np.broadcast_arrays(pelvis, torso, *left, *right), axis=-1)
    if (values == 1.0).all():
        return motion
    body = Body.of(motion)
    planted = detect(motion, body=body).feet
    return moved(motion, body, values, planted)
