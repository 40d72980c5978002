"""The steps of a walk or run, and which steps of several walks belong together.

A step is where a foot is furthest ahead of the hips, about when it comes down (Zeni, Richards & Higginson
2008). That is sharper than any likeness of poses, finer than a frame, and is there on a treadmill, in a
sliding capture and in a run as well. Matching the steps keeps feet planted when walks are blended.
"""

from collections.abc import Sequence

import numpy as np

from ..motion import Motion
from ..rotations import quaternion
from ..signal.bridging import smooth
from ..typing import Array
from .body import SIDES, Body
from .fk import world
from .heading import heading_rotation

AHEAD = 0.15  # leg lengths: a foot swings by more than that
QUICKEST, UNEVEN = 0.15, 3.0  # seconds between steps; the longest step over the shortest
FEWEST = 2  # steps that walks must have in common
KEPT_END = 0.25  # steps by which the ends of clips may be apart and still be taken for the same moment
ANOTHER = 1.5  # steps: who has more than that before the first or after the last step does something else


def steps(motion: Motion, *, body: Body | None = None) -> Array:
    """Return when a foot is furthest forward, in fractions of frames, and which (0 left, 1 right): (S, 2)."""
    from scipy.signal import find_peaks

    body = body or Body.of(motion)
    positions = world(motion)[1]
    back = quaternion.conjugate(heading_rotation(positions, body))
    found = []
    for foot, side in enumerate(SIDES):
        reach = positions[:, body.roles[f"{side}_ankle"]] - positions[:, body.roles["hips"]]
        ahead: Array = quaternion.rotate(back, reach) @ body.forward / body.leg_length
        ahead = smooth(ahead, sigma=0.03 / motion.frame_time)
        for peak in find_peaks(ahead, prominence=AHEAD)[0]:
            found.append((_vertex(ahead, int(peak)), float(foot)))
    return np.array(sorted(found)).reshape(-1, 2)


def _vertex(y: Array, peak: int) -> float:
    """Return where the parabola through a peak and its neighbours is highest."""
    before, here, after = y[peak - 1 : peak + 2]
    bend = before - 2.0 * here + after
    return peak + (0.5 * float((before - after) / bend) if bend < 0.0 else 0.0)


def is_gait(found: Array, frame_time: float) -> bool:
    """Return whether ``steps`` are those of a walk or run: left and right in turn, about evenly."""
    times = np.diff(found[:, 0]) * frame_time
    if len(found) < FEWEST or not (np.diff(found[:, 1]) != 0).all():
        return False
    return bool(times.min() > QUICKEST and times.max() < UNEVEN * times.min())


def match(walks: Sequence[Array], poses: Sequence[Array]) -> Array | None:
    """Return the frames (K, N) of the steps that several walks have in common, or None.

    ``walks`` are ``steps``; ``poses`` (T, D) say what each body looks like in each frame. As many steps as
    possible are matched, each with a step of the same foot; where several matches have as many, the poses
    must be most alike.
    """
    fewest = min(range(len(walks)), key=lambda i: len(walks[i]))
    shifts = []
    for walk, pose in zip(walks, poses, strict=True):
        shift = _shift(walks[fewest], walk, poses[fewest], pose)
        if shift is None:
            return None
        shifts.append(shift)
    first = max(0, -min(shifts))
    last = min(len(walk) - shift for walk, shift in zip(walks, shifts, strict=True))
    last = min(last, len(walks[fewest]))
    if last - first < FEWEST:
        return None
    pairs = zip(walks, shifts, strict=True)
    return np.stack([walk[first + shift : last + shift, 0] for walk, shift in pairs], axis=1)


def _shift(a: Array, b: Array, pose_a: Array, pose_b: Array) -> int | None:
    """Return how many steps later in ``b`` a step of ``a`` is found; None where too few belong together."""
    ranks = []
    for shift in range(FEWEST - len(a), len(b) - FEWEST + 1):
        here = np.arange(max(0, -shift), min(len(a), len(b) - shift))
        one, other = a[here], b[here + shift]
        if (one[:, 1] == other[:, 1]).all():
            apart = pose_a[one[:, 0].astype(int)] - pose_b[other[:, 0].astype(int)]
            ranks.append((-len(here), float(np.linalg.norm(apart, axis=1).mean()), shift))
    return min(ranks)[2] if ranks else None


def with_ends(matched: Array, lengths: Sequence[int]) -> Array:
    """Return matched steps (K, N) with the start and the end, whole frames, of the common stretch.

    The ends of the clips count as one moment if they are within a quarter of a step of each other, or if all
    do something else there for more than one and a half steps: then nothing is cut off. Else all begin,
    and end, as far from the step beside as the clip that has least before, or after, it.
    """
    last = np.array(lengths, float) - 1.0
    before = _room(matched[0], matched[1] - matched[0])
    after = _room(last - matched[-1], matched[-1] - matched[-2])
    start, end = np.round(matched[0] - before), np.round(matched[-1] + after)
    # A step beside an end would make a knot too near to it.
    inner = matched[(matched > start + 1.0).all(axis=1) & (matched < end - 1.0).all(axis=1)]
    return np.concatenate([start[None], inner, end[None]])


def _room(frames: Array, step: Array) -> Array:
    """Return how many of the ``frames`` (N,) beyond the last matched step to take."""
    share = frames / step
    if np.ptp(share) <= KEPT_END or share.min() > ANOTHER:
        return frames
    return share.min() * step
