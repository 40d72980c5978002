"""Clusters of like poses: what a sad crouch needs is nothing for a walk.

A. Aristidou et al., *Emotion control of unstructured dance movements*, SCA 2017, section 3.5 and equation 5:
``d(u, v) = |h_u - h_v| + sum_j w_j |log(q_uj^-1 q_vj)|^2`` with the height ``h`` of the pelvis and the
rotations ``q`` of the joints, place and heading left out; hierarchical clustering, five clusters.

Differences: the printed first term has a sign and so is no distance: its square is taken, in units of
``HEIGHT``. Rotations are those of segments against each other (``kinematics.poses``), so that poses of any
skeleton compare, weights shared among the segments that both have. Clusters stand for themselves by their
medoid. Average linkage makes clusters of a few odd poses; those count for none.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..kinematics.body import ARM, Body
from ..kinematics.fk import world
from ..kinematics.poses import SEGMENTS, segment_rotations
from ..motion import Motion
from ..typing import Array, Integers

COUNT = 5
MOST = 1500  # poses that are compared each with each; more are thinned out evenly
FEWEST = 0.01  # share of the poses that makes a cluster; fewer are odd ones
HEIGHT = 0.2  # leg lengths: a pelvis so much lower counts as one weight of a turn by 57 degrees
TRUNK_WEIGHTS = {"hips": 2.0, "trunk": 1.0, "neck": 1.0, "head": 1.0}
ARM_WEIGHT, LEG_WEIGHT = 1.5, 0.5


def _weight(segment: str) -> float:
    limb = ARM_WEIGHT if segment.partition("_")[2] in ARM else LEG_WEIGHT
    return TRUNK_WEIGHTS.get(segment, limb)


WEIGHTS: Mapping[str, float] = {segment: _weight(segment) for segment in SEGMENTS}


@dataclass(frozen=True, eq=False)
class PoseSet:
    """Poses without place and heading: ``heights`` (N,) of the pelvis over the floor in leg lengths.

    ``turns`` segment -> rotations (N, 4) against its parent segment, in anatomical axes.
    """

    heights: Array
    turns: Mapping[str, Array]

    def __len__(self) -> int:
        return len(self.heights)

    @classmethod
    def of(cls, motion: Motion, body: Body) -> Self:
        """Return the poses of all frames of a motion."""
        up = (world(motion)[1][:, body.roles["hips"]] @ body.up - body.floor) / body.leg_length
        return cls(up, segment_rotations(motion, body))

    @classmethod
    def joined(cls, parts: Sequence["PoseSet"]) -> Self:
        """Return all poses one after the other, with the segments that all have."""
        common = [s for s in SEGMENTS if all(s in part.turns for part in parts)]
        turns = {s: np.concatenate([part.turns[s] for part in parts]) for s in common}
        return cls(np.concatenate([part.heights for part in parts]), turns)

    def __getitem__(self, some: Integers) -> "PoseSet":
        return PoseSet(self.heights[some], {s: q[some] for s, q in self.turns.items()})


def distances(one: PoseSet, other: PoseSet) -> Array:
    """Return how unlike each pose of ``one`` is to each of ``other`` (N, M): equation 5, in radians squared.

    ``w_h ((h_u - h_v) / HEIGHT)^2 + sum_j w_j theta_j^2``, weights adding up to 1 over the segments both
    have and the height. A rotation and its negative are the same.

    >>> two = PoseSet(np.array([0.9, 1.1]), {"head": np.array([[0.0, 0, 0, 1], [1.0, 0, 0, 0]])})
    >>> distances(two, two).round(2)
    array([[0.  , 3.88],
           [3.88, 0.  ]])
    """
    common = [s for s in SEGMENTS if s in one.turns and s in other.turns]
    found = WEIGHTS["hips"] * ((one.heights[:, None] - other.heights) / HEIGHT) ** 2
    for segment in common:
        cosine = np.minimum(np.abs(one.turns[segment] @ other.turns[segment].T), 1.0)
        found = found + WEIGHTS[segment] * (2.0 * np.arccos(cosine)) ** 2
    return np.asarray(found / (WEIGHTS["hips"] + sum(WEIGHTS[s] for s in common)))


def medoids(poses: PoseSet, *, count: int = COUNT) -> Integers:
    """Return the index of the pose in the middle of each cluster, the largest cluster first.

    Average linkage is cut where ``count`` clusters, or as many as there are, hold ``FEWEST`` of the poses.
    """
    from scipy.cluster.hierarchy import fcluster, linkage
    from scipy.spatial.distance import squareform

    thin = np.linspace(0, len(poses) - 1, min(len(poses), MOST)).round().astype(np.int64)
    away = distances(poses[thin], poses[thin])
    away = 0.5 * (away + away.T)
    np.fill_diagonal(away, 0.0)
    if len(thin) < 2:
        return thin
    tree = linkage(squareform(away, checks=False), "average")
    best: list[Integers] = []
    for cut in range(1, min(len(thin), 40 * count) + 1):
        labels = fcluster(tree, cut, "maxclust")
        groups = [np.flatnonzero(labels == label) for label in np.unique(labels)]
        large = [group for group in groups if len(group) >= FEWEST * len(thin)]
        if len(best) < len(large) <= count:
            best = large
        if len(best) == count:
            break
    best.sort(key=len, reverse=True)
    return thin[[group[np.argmin(away[np.ix_(group, group)].sum(axis=1))] for group in best]]


def nearest(poses: PoseSet, centres: PoseSet) -> Integers:
    """Return which of ``centres`` each pose (N,) is most like."""
    return np.asarray(distances(poses, centres).argmin(axis=1))


def settled(labels: Integers, shortest: int) -> Integers:
    """Return labels (N,) without stays shorter than ``shortest``: each goes to its longer neighbour.

    >>> settled(np.array([0, 0, 0, 1, 0, 0, 2, 2, 2]), 2).tolist()
    [0, 0, 0, 0, 0, 0, 2, 2, 2]
    """
    out = np.array(labels)
    while True:
        starts = np.flatnonzero(np.diff(out, prepend=out[0] - 1))
        stops = np.append(starts[1:], len(out))
        lengths = stops - starts
        i = int(lengths.argmin())
        if len(starts) < 2 or lengths[i] >= shortest:
            return out
        beside = [j for j in (i - 1, i + 1) if 0 <= j < len(starts)]
        out[starts[i] : stops[i]] = out[starts[max(beside, key=lambda j: lengths[j])]]
