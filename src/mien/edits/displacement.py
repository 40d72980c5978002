"""Hold the body differently at given times, and go smoothly from one to the next.

To the motion: at each key a pose is added, as ``posture`` does; a smooth curve leads from key to key, and
the movement goes on, down to its finest detail. To the viewer: a glance down, a shrug, a bow of the head
as the hand comes up: something the actor did not do, in the middle of what the actor did.

Feet move with legs and hips: let ``foot_plant`` follow.
"""

from typing import Annotated, Literal

import numpy as np

from ..kinematics.body import Body
from ..kinematics.keyed_poses import Keys, parse_keys, turns_at
from ..kinematics.poses import Pose
from ..kinematics.posing import Method, add_turns
from ..kinematics.smoothing import without_fine
from ..motion import Motion
from ..rotations import quaternion
from .registry import Param, edit

Ends = Literal["fade", "hold"]


@edit(
    kind="pose",
    paper="Bruderlin & Williams 1995; Witkin & Popović 1995",
    equation="R'(t) = P(S(t), b(t)) S(t)^-1 R(t),  b(t_i) = turns of key i,  S = R below 12.5 Hz,  "
    "P(S, b) = S with a pose added",
    deviations="the spline is a monotone cubic: of a rise, a hold and a way back, all equally long, one with "
    "continuous acceleration makes a quarter more than was asked. It goes through turns of body segments, "
    "not through Euler angles",
)
def displacement(
    motion: Motion,
    *,
    keys: Annotated[
        str,
        Param(
            "seconds with poses, such as '1 head 25 0 0; trunk 10 0 0 | 2.5 none | 4 head_down'; on the "
            "command line also a .toml file of them"
        ),
    ] = "none",
    amount: Annotated[float, Param("how much of the poses; -1 is their reverse", -2, 2, neutral=0.0)] = 1.0,
    ends: Annotated[
        Ends, Param("before the first key and after the last: go back to no change, or hold")
    ] = "fade",
    fade: Annotated[float, Param("how long it takes to go back", 0.05, 60.0, unit="s")] = 0.5,
    method: Annotated[Method, Param("how the change is added to each joint")] = "anatomical",
) -> Motion:
    """Add a pose at each key, and go smoothly from one to the next.

    ``keys`` is what ``kinematics.keyed_poses.format_keys`` writes. Times are those of the clip as the step
    gets it. What is faster than 12.5 Hz is turned with its bone, and otherwise left as it is; so with keys
    more than half a second apart the fine movement keeps its energy. Raises ``RecipeError`` for keys that
    cannot be read.
    """
    poses = parse_keys(keys)
    if amount == 0.0 or not any(map(any, (t for _, pose in poses for t in pose.turns.values()))):
        return motion
    body = Body.of(motion)
    turns = turns_at(_faded(poses, fade) if ends == "fade" else poses, motion.times)
    slow = without_fine(quaternion.continuous(motion.rotations), motion.fps)
    scaled = {segment: amount * turn for segment, turn in turns.items()}
    held = add_turns(motion.with_(rotations=slow), body, scaled, weights={}, method=method)
    change = quaternion.multiply(held, quaternion.conjugate(slow))
    turned = np.any([turn.any(axis=1) for turn in turns.values()], axis=0)
    moved = turned[:, None] & (held != slow).any(axis=(0, 2))
    rotations = np.where(moved[..., None], quaternion.multiply(change, motion.rotations), motion.rotations)
    return motion.with_(rotations=quaternion.continuous(rotations))


def _faded(keys: Keys, seconds: float) -> Keys:
    """Return the keys with one of no change before the first and after the last."""
    return ((keys[0][0] - seconds, Pose()), *keys, (keys[-1][0] + seconds, Pose()))
