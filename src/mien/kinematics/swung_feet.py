"""Feet that keep to their path when their legs are shown in other time than the hips.

Captured hips tremble and legs take it back, so that the foot goes smoothly. A leg shown at another frame
takes back the wrong tremble, and the foot gets it. So the ankle is put where it was as seen from the hips
without what is fast in them, and the leg bent a little to reach there.
"""

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..signal.time_map import between
from ..typing import Array
from .ankles import Ankles, move_ankles
from .body import SIDES, Body
from .fk import chain
from .limb_timing import LimbMaps

STEADY = 0.03  # seconds: the Gaussian that halves what goes to and fro at 6 Hz
TREMBLE = 0.015  # leg lengths: what is much more is no tremble, and a leg bent for it would snap


def keep_feet(shown: Motion, motion: Motion, body: Body, maps: LimbMaps) -> Motion:
    """Return ``shown``, which is ``motion`` by ``maps``, feet on their path as the steady hips see it.

    Frames that a leg shows at their own time stay as they are, to the last bit.
    """
    legs = [f"{side}_leg" for side in SIDES]
    if not any(leg in maps.frames for leg in legs):
        return shown
    own = np.arange(len(motion), dtype=float)
    at = np.stack([maps.frames.get(leg, own) for leg in legs], axis=1)
    moved = at != own[:, None]
    goal = _on_path(motion, body, at, maps.round_length)
    away = np.linalg.norm(goal.positions - Ankles.of(shown, body).positions, axis=-1)
    share = moved / np.sqrt(1.0 + (away / (TREMBLE * body.leg_length)) ** 2)
    bent = move_ankles(shown, body, goal, share=share)
    rotations = np.array(shown.rotations)
    for foot, leg in enumerate(legs):
        there = np.ix_(np.flatnonzero(moved[:, foot]), np.array(body.joints((leg,))))
        rotations[there] = bent.rotations[there]
    return shown.with_(rotations=quaternion.continuous(rotations))


def _on_path(motion: Motion, body: Body, at: Array, round_length: int) -> Ankles:
    """Return the ankles where the steady hips see them at the frames ``at`` (T, 2)."""
    place, turned = (x[:, None] for x in _steady_hips(motion, body))
    ankles, feet = Ankles.of(motion, body), np.arange(2)
    paths = quaternion.rotate(quaternion.conjugate(turned), ankles.positions - place)
    turns = quaternion.multiply(quaternion.conjugate(turned), ankles.rotations)
    here, after, part = between(at, round_length or len(motion), wrap=round_length > 0)
    path = paths[here, feet] + part[..., None] * (paths[after, feet] - paths[here, feet])
    turn = quaternion.slerp(turns[here, feet], turns[after, feet], part)
    return Ankles(place + quaternion.rotate(turned, path), quaternion.multiply(turned, turn))


def _steady_hips(motion: Motion, body: Body) -> tuple[Array, Array]:
    """Return where the hips are (T, 3) and how they are turned (T, 4), without what is fast in it."""
    hips = body.roles["hips"]
    order, rotations, positions = chain(motion, [hips])
    at, sigma = order.index(hips), STEADY / motion.frame_time
    turned = smooth(quaternion.continuous(rotations[:, at]), sigma=sigma)
    return smooth(positions[:, at], sigma=sigma), quaternion.normalise(turned)
