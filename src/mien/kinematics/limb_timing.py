"""Limbs in their own time: which frame each limb shows at each frame, and a motion shown so.

A map of time says for every frame which frame, in fractions, of the same motion a limb shows there. Its
joints share it, so the limb stays on its path. Maps come from the speed of the limb's end relative to the
hips (Förger 2011, section 3.4.3), from the moments at which hands and feet meet something (section 5.2), or
from anywhere else: ``show`` takes them all.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal import time_map
from ..signal.accents import accented
from ..typing import Array
from .body import Body
from .bones import main_bones
from .fk import world
from .heading import heading_free, heading_rotation
from .impacts import LONGEST, impacts
from .loops import Boundary, period

Limb = Literal["left_arm", "right_arm", "head", "left_leg", "right_leg"]
Relative = Literal["position", "heading"]
# The legs are left out: a foot that hurries or dwells slides.
USUAL: tuple[Limb, ...] = ("left_arm", "right_arm", "head")
# Heads meet nothing. Feet do, and in the air between they may hurry without sliding.
MEETING: tuple[Limb, ...] = ("left_arm", "right_arm", "left_leg", "right_leg")
# Seconds before an impact that are played faster: a foot has met the floor some hundredths of a second
# before it stands.
STRIKE = {"arm": 0.15, "leg": 0.2}
# Slower than this is rest: leg lengths a second (5 cm/s), and a share of the limb's own fast speed.
REST, REST_SHARE, FAST = 0.0575, 0.1, 95.0
# A limb whose fast speed is below four times rest is idle: its minima are noise.
IDLE = 4.0


@dataclass(frozen=True, eq=False)
class LimbMaps:
    """Which frame each limb shows at each frame.

    ``frames`` limb -> (T,) frames in fractions; a limb that it does not name keeps its time. In a loop
    ``round_length`` is how many frames make one round: frames beyond it start over. Else it is 0, and
    frames beyond the ends show the ends.
    """

    frames: Mapping[str, Array]
    round_length: int = 0


def limb_maps(
    motion: Motion,
    body: Body,
    rule: time_map.Rule,
    *,
    limbs: Sequence[str] = USUAL,
    relative: Relative = "position",
    round_length: int = 0,
) -> LimbMaps:
    """Return the maps of time of those ``limbs`` that move, by a rule on the speed of their ends.

    Limbs that the skeleton lacks, and those that hardly move, are left out. Segments keep their length,
    and all limbs share their borders, so that they stay together. ``round_length`` as from ``loop``.
    """
    paths = tip_paths(motion, body, limbs=limbs, relative=relative)
    return LimbMaps(_shown_frames(paths, motion, round_length, rule, REST * body.leg_length), round_length)


def impact_maps(
    motion: Motion,
    body: Body,
    pace: float,
    *,
    limbs: Sequence[str] = MEETING,
    original: Motion | None = None,
    longest: float | None = None,
    round_length: int = 0,
) -> LimbMaps:
    """Return the maps of time of those ``limbs`` that meet something: they change nowhere else.

    The last 0.15 s before each impact (0.2 s of feet) run up to ``pace`` times as fast, so that the stop is
    up to ``pace^2`` times as hard; below 1 it is softer. What that gains or takes comes from the wind-up,
    which lasts ``longest`` seconds at most (None: 0.9). Feet keep their contacts, which are those of the
    ``original`` (None: the motion).
    """
    found = impacts(
        motion,
        body,
        limbs=limbs,
        original=original,
        round_length=round_length,
        longest=longest or LONGEST,
    )
    own = np.arange(len(motion), dtype=float)
    out = {}
    for limb, at in found.items():
        # What a loop winds up for before it begins, it winds up for at its end.
        every = np.concatenate([at + round_length, at]) if round_length else at
        length = STRIKE[limb.partition("_")[2]] / motion.frame_time
        out[limb] = accented(own, every, pace=pace, length=length)
    return LimbMaps(out, round_length)


def loop(motion: Motion, body: Body, *, boundary: Boundary = "auto") -> int:
    """Return the frames of one round of a motion, as its body turns but for the heading; 0 for no loop."""
    below = motion.skeleton.descendants(body.roles["hips"])
    return period(heading_free(motion, body)[0][:, below], boundary)


def tip_paths(
    motion: Motion, body: Body, *, limbs: Sequence[str] = USUAL, relative: Relative = "position"
) -> dict[str, Array]:
    """Return where the end of each limb is, relative to the hips (T, 3); of limbs that are there.

    With ``relative="heading"`` as seen by somebody who turns with the body.
    """
    rotations, positions = world(motion)
    bones = main_bones(motion.skeleton)
    turn = relative == "heading"
    back = quaternion.conjugate(heading_rotation(positions, body)) if turn else quaternion.IDENTITY
    out = {}
    for name in (limb for limb in limbs if body.limbs.get(limb)):
        tip = body.limbs[name][-1]
        end = positions[:, tip] + quaternion.rotate(rotations[:, tip], bones[tip])
        out[name] = quaternion.rotate(back, end - positions[:, body.roles["hips"]])
    return out


def show(motion: Motion, body: Body, maps: LimbMaps) -> Motion:
    """Return the motion with every limb at the frames that its map says, in between by slerp.

    Where a map says the frame itself nothing changes, to the last bit.
    """
    rotations, translations = np.array(motion.rotations), np.array(motion.translations)
    frames, wrap = maps.round_length or len(motion), maps.round_length > 0
    for name, at in maps.frames.items():
        joints, moved = body.joints((name,)), np.flatnonzero(at != np.arange(len(motion)))
        here, after, weight = time_map.between(at[moved], frames, wrap=wrap)
        a, b = motion.rotations[:, joints], motion.translations[:, joints]
        shown = np.ix_(moved, np.array(joints))
        rotations[shown] = quaternion.slerp(a[here], a[after], weight[:, None])
        translations[shown] = b[here] + weight[:, None, None] * (b[after] - b[here])
    return motion.with_(rotations=quaternion.continuous(rotations), translations=translations)


def _shown_frames(
    paths: Mapping[str, Array], motion: Motion, round_length: int, rule: time_map.Rule, rest: float
) -> dict[str, Array]:
    """Return the map of each limb that moves and does not keep its time; ``rest`` in units a second."""
    wrap = round_length > 0
    curves = [
        time_map.speed_curve(p[: round_length or None], motion.frame_time, wrap=wrap) for p in paths.values()
    ]
    speeds = {name: speed for name, (speed, _) in zip(paths, curves, strict=True)}
    fast = {name: float(np.percentile(speed, FAST)) for name, speed in speeds.items()}
    moving = [name for name in paths if fast[name] > IDLE * rest]
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
        still = max(REST_SHARE * fast[name], rest)
        lasting = time_map.durations(np.roll(speeds[name], -start), still, borders, rule, wrap=wrap)
        if np.abs(lasting - 1.0).max() > 1e-9:
            out[name] = (time_map.source_times(lasting, step, at) + start * step) / motion.frame_time
    return out
