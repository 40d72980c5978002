"""The main bone of each joint: where the limb goes on from there."""

import numpy as np

from ..motion import Skeleton
from ..typing import Array


def main_bones(skeleton: Skeleton) -> Array:
    """Return the vector (J, 3) of each joint's main bone in its own rest axes, zero where it has none.

    That is the offset of its child or end site. Where several joints hang on one, it is the largest
    branch without an equal beside it (the spine at the hips, the neck at the chest: left and right limbs
    come in pairs), else the mean of all (the fingers of a hand).
    """
    size = np.ones(len(skeleton), np.int64)
    for joint in range(len(skeleton) - 1, 0, -1):
        if skeleton.parents[joint] >= 0:
            size[skeleton.parents[joint]] += size[joint]
    return np.stack([_main_bone(skeleton, joint, size) for joint in range(len(skeleton))])


def _main_bone(skeleton: Skeleton, joint: int, size: np.ndarray) -> Array:
    children = skeleton.children(joint)
    if not children:
        ends = skeleton.end_offsets[skeleton.end_parents == joint]
        return ends.mean(axis=0) if len(ends) else np.zeros(3)
    sizes = [int(size[c]) for c in children]
    single = [c for c, s in zip(children, sizes, strict=True) if sizes.count(s) == 1]
    if single:
        return skeleton.offsets[max(single, key=lambda c: int(size[c]))]
    return skeleton.offsets[children].mean(axis=0)
