"""Make limbs dwell and rush, or move evenly, along an unchanged path.

To the motion: each limb gets its own map of time. Added acceleration stretches the short pauses where a
movement turns and hurries in between; constant speed does the reverse. To the viewer: rushing looks fast
and powerful, evenness weak and slow (not angry, nor relaxed: Förger 2011, section 5.2).

Speeds are those of hands, feet and head relative to the hips. Nothing is longer or shorter in the end:
segments of about a second keep their length, and borders are shared, so that limbs stay together.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from ..kinematics.body import Body
from ..kinematics.bones import main_bones
from ..kinematics.fk import world
from ..kinematics.heading import heading_free, heading_rotation
from ..kinematics.loops import Boundary, period
from ..motion import Motion
from ..rotations import quaternion
from ..signal import time_map
from ..typing import Array, Integers
from .registry import Param, edit

Limb = Literal["left_arm", "right_arm", "head", "left_leg", "right_leg"]
Mode = Literal["peaks", "grid"]
# Slower than this is rest: leg lengths a second (5 cm/s), and a share of the limb's own fast speed.
REST, REST_SHARE, FAST = 0.0575, 0.1, 95.0
# A limb whose fast speed is below four times rest is idle: its minima are noise.
IDLE = 4.0
SEGMENT_ACCELERATED, SEGMENT_EVEN = 0.9, 1.5
# Steps of 10 ms over which durations are smoothed; more would slow the ends of even movements.
BLUR_ACCELERATED, BLUR_EVEN = 5, 3


@edit(
    kind="pose",
    paper="Förger 2011, section 3.4.3",
    equation="a > 0: d = 1 + 9 a in short pauses; a < 0: d = 1 + |a| (s / mean s - 1) where it moves; "
    "pose at t = original at D^-1(t), D = sum d",
    deviations="a pause must be prominent (0.8 of both neighbours), as rounding makes minima of even motion; "
    "minima are looked for off the grid; no limb runs above `steepest` times its speed; limbs share borders",
)
def timing(
    motion: Motion,
    *,
    acceleration: Annotated[
        float, Param("above 0: dwell and rush; below 0: constant speed", -1.0, 1.0, neutral=0.0)
    ] = 0.0,
    limbs: Annotated[
        tuple[Limb, ...], Param("limbs to retime; feet slide, so that legs are only for clips in place")
    ] = ("left_arm", "right_arm", "head"),
    mode: Annotated[
        Mode, Param("pauses at minima of speed, or in the thesis's fixed sets of 0.15 s")
    ] = "peaks",
    rests: Annotated[
        bool, Param("added acceleration also lengthens long rests, so that single actions rush too")
    ] = False,
    relative: Annotated[
        Literal["position", "heading"],
        Param("speed relative to the place of the hips, or also to the heading"),
    ] = "position",
    segment: Annotated[
        float | None,
        Param("longest stretch that keeps its length; none: 0.9 accelerated, 1.5 even", 0.3, 60.0, unit="s"),
    ] = None,
    steepest: Annotated[float, Param("how many times faster a limb may run", 1.1, 20.0)] = 2.5,
    boundary: Annotated[Boundary, Param("treat the clip as a loop: if it is one, never, always")] = "auto",
) -> Motion:
    """Redistribute the timing of limbs along their paths, each by its own speed.

    Above 0, sets of 0.15 s around a minimum of speed last ``1 + 9 a`` times as long; longer rests are left
    alone unless ``rests``. Continuous movement such as an arm swing takes 0.3 at most before it looks
    jerky. Below 0, durations go over into speeds. Limbs that the skeleton lacks are passed over. Raises
    ``BodyError`` where no body is found.
    """
    if acceleration == 0.0 or len(motion) < 3:
        return motion
    body = Body.of(motion)
    longest = segment or (SEGMENT_ACCELERATED if acceleration > 0.0 else SEGMENT_EVEN)
    rule = _Rule(acceleration, mode, rests, longest, steepest, REST * body.leg_length)
    below = motion.skeleton.descendants(body.roles["hips"])
    round_length = period(heading_free(motion, body)[0][:, below], boundary)
    tips = _tips(motion, body, [name for name in limbs if body.limbs.get(name)], relative == "heading")
    rotations, translations = np.array(motion.rotations), np.array(motion.translations)
    for name, at in _shown_frames(tips, motion, round_length, rule).items():
        joints = body.joints((name,))
        here, after, weight = _between(at, round_length or len(motion), round_length > 0)
        a, b = motion.rotations[:, joints], motion.translations[:, joints]
        rotations[:, joints] = quaternion.slerp(a[here], a[after], weight[:, None])
        translations[:, joints] = b[here] + weight[:, None, None] * (b[after] - b[here])
    return motion.with_(rotations=quaternion.continuous(rotations), translations=translations)


@dataclass(frozen=True)
class _Rule:
    """How durations come from speeds: see the parameters of ``timing``; ``rest`` in units a second."""

    acceleration: float
    mode: Mode
    rests: bool
    longest: float
    steepest: float
    rest: float


def _tips(motion: Motion, body: Body, names: Sequence[str], turn: bool) -> dict[str, Array]:
    """Return where the end of each limb is, relative to the hips (T, 3)."""
    rotations, positions = world(motion)
    bones = main_bones(motion.skeleton)
    back = quaternion.conjugate(heading_rotation(positions, body)) if turn else quaternion.IDENTITY
    out = {}
    for name in names:
        tip = body.limbs[name][-1]
        end = positions[:, tip] + quaternion.rotate(rotations[:, tip], bones[tip])
        out[name] = quaternion.rotate(back, end - positions[:, body.roles["hips"]])
    return out


def _shown_frames(tips: dict[str, Array], motion: Motion, round_length: int, rule: _Rule) -> dict[str, Array]:
    """Return, for each limb that moves, which frame (T,), in fractions, is shown at each frame."""
    wrap = round_length > 0
    curves = [
        time_map.speed_curve(p[: round_length or None], motion.frame_time, wrap=wrap) for p in tips.values()
    ]
    speeds = {name: speed for name, (speed, _) in zip(tips, curves, strict=True)}
    fast = {name: float(np.percentile(speed, FAST)) for name, speed in speeds.items()}
    moving = [name for name in tips if fast[name] > IDLE * rule.rest]
    if not moving:
        return {}
    step = curves[0][1]
    # Rounded, so that in a rest it is not the last bits that say where it is slowest.
    common = np.sum([speeds[name] / fast[name] for name in moving], axis=0).round(3)
    # A loop is cut open where the limbs are slowest, so that its seam is like any other border.
    start = int(np.argmin(common)) if wrap else 0
    borders = time_map.segment_borders(np.roll(common, -start), rule.longest / step)
    at = (motion.times - start * step) % (len(common) * step) if wrap else motion.times
    out = {}
    for name in moving:
        still = max(REST_SHARE * fast[name], rule.rest)
        durations = _durations(np.roll(speeds[name], -start), still, borders, rule, wrap)
        if np.abs(durations - 1.0).max() > 1e-9:
            out[name] = (time_map.source_times(durations, step, at) + start * step) / motion.frame_time
    return out


def _durations(speed: Array, still: float, borders: Integers, rule: _Rule, wrap: bool) -> Array:
    a = rule.acceleration
    if a > 0.0:
        pauses = time_map.short_pauses(speed, still, mode=rule.mode, wrap=wrap)
        pauses = np.maximum(pauses, speed < still) if rule.rests else pauses
        raw, width = 1.0 + (time_map.FACTOR - 1.0) * a * pauses, BLUR_ACCELERATED
    else:
        even = time_map.constant_speed(speed, speed < still, borders)
        raw, width = 1.0 - a * (even - 1.0), BLUR_EVEN
    smooth = time_map.blur(raw, width=width, wrap=wrap)
    return time_map.balance(smooth, borders, steepest=rule.steepest, wrap=wrap)


def _between(at: Array, frames: int, wrap: bool) -> tuple[Integers, Integers, Array]:
    """Return the frames before and after the moments ``at``, and how far they are in between."""
    here = np.floor(at).astype(np.int64)
    weight = at - here
    if wrap:
        return here % frames, (here + 1) % frames, weight
    return np.clip(here, 0, frames - 1), np.clip(here + 1, 0, frames - 1), weight
