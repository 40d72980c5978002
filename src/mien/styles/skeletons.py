"""Clips of one skeleton: joints in one order, lengths in one unit, without the still they may start with."""

from collections.abc import Sequence

import numpy as np

from ..errors import MienError
from ..kinematics.lead_in import lead_in
from ..motion import Motion, require_motion
from ..typing import Array, Integers

# How far a bone may be from that of the first clip, as a share of its length or of a tenth of the body's
# longest bone, whichever is more.
TOLERANCE = 0.01


def on_one_skeleton(motions: Sequence[Motion]) -> list[Motion]:
    """Return the clips on the skeleton of the first, each from its first frame that is no T-pose.

    Joints are put into the order of the first, lengths into its unit. Raises ``MienError`` naming the
    joints where names, parents or bones differ; roots and joints that move may be anywhere.
    """
    for motion in motions:
        require_motion(motion)
    if len(motions) < 2:
        raise MienError(f"a blend needs two clips or more, got {len(motions)}")
    trimmed = [motion[lead_in(motion) :] for motion in motions]
    first = trimmed[0]
    return [first, *(_like(first, other, number) for number, other in enumerate(trimmed[1:], start=2))]


def _like(first: Motion, other: Motion, number: int) -> Motion:
    order = _order(first, other, number)
    rotations, translations = other.rotations[:, order], other.translations[:, order]
    scale = _scale(first, translations, number)
    return Motion(
        first.skeleton,
        rotations,
        translations * scale,
        other.frame_time,
        name=other.name,
    )


def _order(first: Motion, other: Motion, number: int) -> Integers:
    """Return where each joint of the first clip stands in the other."""
    here, there = first.skeleton, other.skeleton
    place = {name: index for index, name in enumerate(there.names)}
    lost = [name for name in here.names if name not in place]
    added = [name for name in there.names if name not in set(here.names)]
    if lost or added:
        some = ", ".join([*lost, *added][:6])
        raise MienError(
            f"clip {number} has another skeleton than clip 1: it lacks {len(lost)} and adds {len(added)} "
            f"joints ({some}); blend clips of one skeleton"
        )
    order = np.array([place[name] for name in here.names], np.int64)
    parents = [there.names[p] if p >= 0 else "" for p in there.parents[order].tolist()]
    wrong = [
        name
        for name, p, theirs in zip(here.names, here.parents.tolist(), parents, strict=True)
        if (here.names[p] if p >= 0 else "") != theirs
    ]
    if wrong:
        raise MienError(
            f"clip {number} has another skeleton than clip 1: {', '.join(wrong[:6])} hang on other joints; "
            "blend clips of one skeleton"
        )
    return order


def _scale(first: Motion, translations: Array, number: int) -> float:
    """Return the unit of the other clip in that of the first; raise where a bone is another."""
    fixed = _fixed(first.translations) & _fixed(translations) & (first.skeleton.parents >= 0)
    ours, theirs = (np.median(t[:, fixed], axis=0) for t in (first.translations, translations))
    lengths, others = np.linalg.norm(ours, axis=1), np.linalg.norm(theirs, axis=1)
    longest = float(lengths.max(initial=0.0))
    if not longest or not others.max() > 0.0:
        return 1.0
    long = (lengths > 0.1 * longest) & (others > 0.0)
    scale = float(np.median(lengths[long] / others[long])) if long.any() else 1.0
    off = np.linalg.norm(scale * theirs - ours, axis=1) / np.maximum(lengths, 0.1 * longest)
    if (off > TOLERANCE).any():
        names = np.array(first.skeleton.names)[fixed]
        worst = np.argsort(-off, kind="stable")[:6]
        some = ", ".join(f"{names[j]} by {100.0 * off[j]:.1f} %" for j in worst if off[j] > TOLERANCE)
        raise MienError(
            f"clip {number} has other bones than clip 1 ({some} of their length); blend clips of one body"
        )
    return scale


def _fixed(translations: Array) -> Array:
    """Return which joints (J,) do not move along their bone by more than a hundredth of its length."""
    size = np.linalg.norm(translations, axis=-1).max(axis=0)
    return np.asarray(np.ptp(translations, axis=0).max(axis=-1) <= TOLERANCE * size)
