"""Where a hand or a foot meets something, and what it does to get there.

The thesis saw its angry actress stop hard where the feet touched the ground and the hand the door, and
proposed to accelerate there and nowhere else (Förger 2011, section 5.2). A foot meets the floor where a
contact begins (``contacts``); a hand meets whatever stops it (``strokes``).
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..motion import Motion
from ..typing import Array, Mask
from .body import SIDES, Body
from .contacts import HEIGHT, detect_points, foot_points, spans, standing_level
from .fk import world
from .strokes import Hand, strokes

LONGEST = 0.9  # seconds before an impact that belong to it
SHORTEST = 0.1  # seconds: a shorter stretch is none, and a foot that lands so near the end may not stand


def impacts(
    motion: Motion,
    body: Body,
    *,
    limbs: Sequence[str],
    original: Motion | None = None,
    round_length: int = 0,
    longest: float = LONGEST,
) -> dict[str, Array]:
    """Return limb -> (N, 2): where each of its impacts is wound up for, and where it is, in frames.

    ``limbs`` are arms and legs; others, and those without impacts, are left out. An impact of an arm is the
    end of a stroke, in fractions of frames, wound up for since the rest or the reversal before; of a leg the
    first frame of a contact, wound up for since the foot left the floor; neither for more than ``longest``
    seconds. Stretches do not overlap. Contacts are those of the ``original``, as edited feet may slide and
    float until they are put back. In a loop ``round_length`` is how many frames make one round, and what is
    wound up for before the first frame has a start below 0.
    """
    rotations, positions = world(motion)
    found = {}
    for side in (side for side in SIDES if f"{side}_arm" in limbs):
        hand = Hand.of(body, motion, side, rotations, positions)
        found[f"{side}_arm"] = _blows(hand, motion.frame_time, round_length)
    seen = original or motion
    feet = foot_points(seen, body, *world(seen))
    planted = detect_points(feet, body, motion.frame_time).feet
    height = feet @ body.up
    raised = (height - standing_level(height, body.leg_length)).max(axis=2) > HEIGHT * body.leg_length
    shortest, most = SHORTEST / motion.frame_time, longest / motion.frame_time
    for foot, side in enumerate(SIDES):
        if f"{side}_leg" in limbs:
            found[f"{side}_leg"] = landings(planted[:, foot], raised[:, foot], shortest, round_length)
    shown = {limb: _apart(at, shortest, most, round_length) for limb, at in found.items()}
    return {limb: at for limb, at in shown.items() if len(at)}


def landings(planted: Mask, raised: Mask, shortest: float, round_length: int) -> Array:
    """Return the frames in which a foot leaves the floor and comes down again (N, 2).

    ``planted`` (T,) says when it stands and ``raised`` (T,) when some of it is up in the air: otherwise it
    has only slid. From the last frame in which it stands, or the first of the clip, to the first in which it
    stands again, at least ``shortest`` frames before the end. In a loop (``round_length`` above 0) those that
    end within one round.
    """
    count = 3 if round_length else 1
    stands, up = (np.concatenate([x[: round_length or None]] * count) for x in (planted, raised))
    runs = pairwise([(0, 1), *spans(stands)])
    found = [(leave - 1, land) for (_, leave), (land, _) in runs if leave < land <= len(stands) - shortest]
    high = np.array([(a, b) for a, b in found if up[a:b].any()], float).reshape(-1, 2)
    return _one_round(high - round_length, round_length)


def _blows(hand: Hand, frame_time: float, round_length: int) -> Array:
    """Return the strokes of a hand in frames (N, 2); in a loop those that end within one round."""
    path = hand.rounds(round_length, 3) if round_length else hand
    return _one_round(strokes(path, frame_time) / frame_time - round_length, round_length)


def _one_round(found: Array, round_length: int) -> Array:
    """Return what ends within one round of a loop, or all where there is none."""
    ends = found[:, 1]
    return found[(ends >= 0) & (ends < round_length)] if round_length else found


def _apart(found: Array, shortest: float, longest: float, round_length: int) -> Array:
    """Return the stretches (N, 2) that are long enough, in order, none too long or begun within another."""
    starts, ends = found[np.argsort(found[:, 1])].T
    if len(ends):
        before = np.concatenate([ends[-1:] - round_length if round_length else [-np.inf], ends[:-1]])
        starts = np.max([starts, ends - longest, before], axis=0)
    return np.column_stack([starts, ends])[ends - starts >= shortest]
