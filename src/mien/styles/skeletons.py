"""Clips of one skeleton: joints in one order, lengths in one unit, without the still they may start with."""

from collections.abc import Sequence

import numpy as np

from ..errors import MienError
from ..kinematics.body import Body
from ..kinematics.lead_in import lead_in
from ..motion import Motion, Skeleton, require_motion
from ..typing import Array, Integers

# How far a bone may be from that of the first clip: a share of its length, or of a tenth of the longest bone.
TOLERANCE, TENTH = 0.01, 0.1


def on_one_skeleton(motions: Sequence[Motion]) -> list[Motion]:
    """Return the clips on the skeleton of the first, each from its first frame that is no T-pose.

    Joints are put into the order of the first, lengths into its unit. Raises ``MienError`` naming the
    joints where names, parents or bones below the hips differ; hips, and joints that move, may be anywhere.
    """
    for motion in motions:
        require_motion(motion)
    if len(motions) < 2:
        raise MienError(f"a blend needs two clips or more, got {len(motions)}")
    trimmed = [motion[lead_in(motion) :] for motion in motions]
    first = trimmed[0]
    hips = Body.of(first).roles["hips"]
    below = [joint for joint in first.skeleton.descendants(hips) if joint != hips]
    return [first, *(_like(first, other, below, number) for number, other in enumerate(trimmed[1:], start=2))]


def _like(first: Motion, other: Motion, below: list[int], number: int) -> Motion:
    """Return another clip on the skeleton of the first; ``below`` are the joints below the hips."""
    order = _order(first.skeleton, other.skeleton, number)
    translations = other.translations[:, order]
    scale = _scale(first.translations[:, below], translations[:, below])
    off = _off(first.translations[:, below], scale * translations[:, below])
    if (off > TOLERANCE).any():
        worst = [j for j in np.argsort(-off, kind="stable")[:6] if off[j] > TOLERANCE]
        some = ", ".join(f"{first.skeleton.names[below[j]]} by {100.0 * off[j]:.1f} %" for j in worst)
        raise MienError(
            f"clip {number} has other bones than clip 1 ({some} of their length); blend clips of one body"
        )
    rotations = other.rotations[:, order]
    return Motion(first.skeleton, rotations, scale * translations, other.frame_time, name=other.name)


def _order(here: Skeleton, there: Skeleton, number: int) -> Integers:
    """Return where each joint of one skeleton stands in the other, which is that of clip ``number``."""
    place = {name: index for index, name in enumerate(there.names)}
    lost = [name for name in here.names if name not in place]
    added = [name for name in there.names if name not in set(here.names)]
    if lost or added:
        some = ", ".join([*lost, *added][:6])
        raise MienError(
            f"clip {number} has another skeleton than clip 1: it lacks {len(lost)} and adds {len(added)} "
            f"joints ({some}); blend clips of one skeleton"
        )
    wrong = [name for name in here.names if _parent(here, name) != _parent(there, name)]
    if wrong:
        raise MienError(
            f"clip {number} has another skeleton than clip 1: {', '.join(wrong[:6])} hang on other joints; "
            "blend clips of one skeleton"
        )
    return np.array([place[name] for name in here.names], np.int64)


def _parent(skeleton: Skeleton, name: str) -> str:
    parent = int(skeleton.parents[skeleton.names.index(name)])
    return skeleton.names[parent] if parent >= 0 else ""


def _scale(ours: Array, theirs: Array) -> float:
    """Return the unit of the second clip's translations (T, J, 3) in that of the first."""
    ours, theirs = (np.linalg.norm(np.median(moved, axis=0), axis=-1) for moved in (ours, theirs))
    long = (ours > TENTH * ours.max(initial=0.0)) & (theirs > 0.0)
    return float(np.median(ours[long] / theirs[long])) if long.any() else 1.0


def _off(ours: Array, theirs: Array) -> Array:
    """Return how far each bone (J,) is from that of the first clip, as a share; 0 where a joint moves."""
    length = np.linalg.norm(np.median(ours, axis=0), axis=-1)
    apart = np.linalg.norm(np.median(theirs, axis=0) - np.median(ours, axis=0), axis=-1)
    size = np.maximum(length, TENTH * length.max(initial=0.0))
    moving = np.maximum(*(np.ptp(moved, axis=0).max(axis=-1) for moved in (ours, theirs))) > TOLERANCE * size
    return np.where(moving, 0.0, apart / np.where(size > 0.0, size, 1.0))
