"""Let hips and shoulders swing with the steps, more or less, each in its own way.

To the motion: the pelvis drops and turns further with every step while the spine takes it back, or the
shoulders tilt and twist further over hips that stay. Head, legs and hanging arms keep their directions, so
that it is the trunk alone that sways. To the viewer: hips that sway look feminine (Troje 2002), still hips
and rolling shoulders masculine or swaggering, twisting shoulders angry or eager, a trunk that does not move
sad or stiff.

``path_length`` makes all of a trunk's movement larger at once. Feet move with the hips: let ``foot_plant``
follow.
"""

from typing import Annotated

import numpy as np

from ..kinematics.body import SIDES, Body
from ..kinematics.contacts import detect_points, foot_points
from ..kinematics.fk import world
from ..kinematics.heading import heading_free, heading_rotation, hips_frame
from ..kinematics.loops import period
from ..kinematics.poses import neutral_world
from ..kinematics.standing import standing
from ..motion import Motion
from ..rotations import quaternion
from ..signal.noise import wander
from ..signal.to_and_fro import to_and_fro
from ..signal.waveshaping import smooth_step, soft_limit
from ..typing import Array
from .registry import Param, edit

MOST, FREE = np.radians(16.0), np.radians(8.0)  # added at most, and from where on ever less
SHIFTS = 0.2, 0.6  # Hz
ASIDE = 0.007  # leg lengths that the pelvis goes aside for each degree it tilts as weight is shifted
# How level a line from side to side must be for its tilt and turn to mean anything: who lies has none.
UNCLEAR, CLEAR = 0.5, 0.8


def _gain(doc: str) -> Param:
    return Param(doc, 0.0, 4.0, neutral=1.0)


@edit(
    kind="pose",
    paper="Troje 2002; Bruderlin & Williams 1995",
    equation="W' = exp(x) W; hips x = (g - 1) (tilt, turn), shoulders x = (k - 1) (tilt, turn), each less "
    "its slow mean; spine from the one to the other, neck back to 0, legs 0, arms only the turn",
    deviations="Troje finds hips and shoulders among what tells walkers' sex, and gives no edit; gains, "
    "limits, the shift of weight and what takes the sway back are ours",
)
def sway(
    motion: Motion,
    *,
    hips_tilt: Annotated[float, _gain("how far the pelvis drops from side to side, as a factor")] = 1.0,
    hips_turn: Annotated[float, _gain("how far the pelvis turns to and fro, as a factor")] = 1.0,
    shoulders_tilt: Annotated[float, _gain("how far the shoulders rock, as a factor")] = 1.0,
    shoulders_turn: Annotated[float, _gain("how far the shoulders turn to and fro, as a factor")] = 1.0,
    shift: Annotated[
        float,
        Param("how far the pelvis tilts as a standing body shifts its weight", 0.0, 12.0, "degrees", 0.0),
    ] = 0.0,
    seed: Annotated[int, Param("which shifting of weight: another number, another one", 0)] = 0,
) -> Motion:
    """Make the sway of hips and shoulders larger or smaller than it is.

    Each factor is of what goes to and fro faster than 0.5 Hz; nothing is made up, so who stands still goes on
    standing still, and who turns a corner turns as far. At most 16 degrees are added to any tilt or turn.
    ``shift`` makes something up where no step is near: the weight goes from leg to leg every second or two,
    as ``seed`` says, the pelvis moves there and its other side sinks. Raises ``BodyError`` where no body is
    found.
    """
    if hips_tilt == hips_turn == shoulders_tilt == shoulders_turn == 1.0 and shift == 0.0:
        return motion
    body = Body.of(motion)
    turned, positions = world(motion)
    frames = period(heading_free(motion, body, steady=True)[0], "auto")
    top = body.spine[-1] if body.spine else body.roles["hips"]
    stance = neutral_world(motion, body)[0]

    def added(joint: int, tilt: float, turn: float) -> tuple[Array, Array]:
        """Return the turns (T, 3) about the front and about up that gains on a joint's tilt and turn add."""
        side = quaternion.rotate(quaternion.multiply(turned[:, joint], _back(stance[joint])), body.left)
        return _added(side, body, motion.frame_time, frames, tilt, turn)

    low = added(body.roles["hips"], hips_tilt, hips_turn)
    high = added(top, shoulders_tilt, shoulders_turn) if body.spine else low
    translations = np.array(motion.translations)
    if shift:
        weight = _weight(motion, body, turned, positions, seed)
        facing = heading_rotation(positions, body)
        tilted = np.radians(shift) * weight[:, None] * quaternion.rotate(facing, body.forward)
        low = low[0] + tilted, low[1]
        aside = shift * ASIDE * body.leg_length * weight[:, None] * body.left
        translations[:, body.roles["hips"]] += quaternion.rotate(hips_frame(motion, body), aside)
    rotations = _turned(motion, turned, _shares(body, low, high))
    return motion.with_(rotations=rotations, translations=translations)


def _weight(motion: Motion, body: Body, turned: Array, positions: Array, seed: int) -> Array:
    """Return on which leg (T,) a standing body puts its weight: from -1, the right one, to 1."""
    points = foot_points(motion, body, turned, positions)
    planted = detect_points(points, body, motion.frame_time).feet
    course = wander(motion.times, low=SHIFTS[0], high=SHIFTS[1], seed=seed, stream="sway")
    return course * standing(planted, motion.frame_time)


def _added(
    side: Array, body: Body, frame_time: float, frames: int, tilt: float, turn: float
) -> tuple[Array, Array]:
    """Return the turns (T, 3) in world axes, about the front and about up, that a gain on each adds.

    ``side`` (T, 3) points to the left of the segment.
    """
    height = side @ body.up
    level = side - height[:, None] * body.up
    flat = np.linalg.norm(level, axis=1)
    front = np.cross(level, body.up) / np.maximum(flat, 1e-9)[:, None]
    yaw = np.unwrap(np.arctan2(level @ -body.forward, level @ body.left))
    courses = np.stack([np.arctan2(height, flat), yaw], axis=1)
    swing = to_and_fro(courses, frame_time, frames=frames) * [tilt - 1.0, turn - 1.0]
    swing = np.sign(swing) * soft_limit(np.abs(swing), MOST, MOST - FREE)
    swing *= smooth_step(flat, UNCLEAR, CLEAR)[:, None]
    return swing[:, :1] * front, swing[:, 1:] * body.up


def _shares(body: Body, low: tuple[Array, Array], high: tuple[Array, Array]) -> dict[int, Array]:
    """Return joint -> the turn (T, 3) added to it in world axes; a joint that is not named goes along."""
    hips, chest = sum(low), sum(high)
    shares = {body.roles["hips"]: np.asarray(hips)}
    for joint, part in zip(body.spine, np.linspace(0.0, 1.0, len(body.spine) + 1)[1:], strict=True):
        shares[joint] = (1.0 - part) * hips + part * chest
    above = [*body.neck, *([body.roles["head"]] if "head" in body.roles else [])]
    for joint, part in zip(above, np.linspace(1.0, 0.0, len(above) + 1)[1:], strict=True):
        shares[joint] = part * chest
    for side in SIDES:
        shares[body.roles[f"{side}_hip"]] = np.zeros_like(low[0])
        shares[body.roles[f"{side}_shoulder"]] = high[1]
    return shares


def _turned(motion: Motion, turned: Array, shares: dict[int, Array]) -> Array:
    """Return the local rotations (T, J, 4) with the turns of ``shares`` added in the world."""
    rotations, parents = np.array(motion.rotations), motion.skeleton.parents
    along: dict[int, Array] = {-1: np.zeros((len(motion), 3))}
    for joint in range(len(parents)):
        above = along[int(parents[joint])]
        along[joint] = own = shares.get(joint, above)
        if own is above:
            continue
        change = quaternion.multiply(_back(quaternion.exp(above)), quaternion.exp(own))
        if parents[joint] >= 0:
            seen = turned[:, parents[joint]]
            change = quaternion.multiply(quaternion.multiply(_back(seen), change), seen)
        rotations[:, joint] = quaternion.multiply(change, rotations[:, joint])
    return quaternion.continuous(rotations)


def _back(rotation: Array) -> Array:
    return quaternion.conjugate(rotation)
