"""What is wished of one motion: its keyframes, their clusters of poses, and how features should be.

Keyframes are every fifth frame of 30 a second (Aristidou et al. 2017), of long clips fewer, evenly spread
over each cluster. Coefficients of the rules are those of a cluster; in time they go from one cluster's to the
next's around the moment where the poses do.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ..analysis.laban import pace_windows
from ..kinematics.body import Body
from ..kinematics.landmarks import landmarks
from ..kinematics.lead_in import lead_in
from ..motion import Motion
from ..typing import Array, Integers
from .control_features import KEYFRAMES, ORDER, POSE, Poses, faces, keyframes, measured, toned
from .pose_clusters import PoseSet, nearest, settled
from .wishes import Wanted

MOST, FEWEST = 16, 4  # keyframes of a clip, and of a cluster
STRIDE = 0.5  # seconds between windows that tell the pace
STAY = 1.0  # seconds: a shorter stay in a cluster is none
COUNT = len(POSE)


@dataclass(frozen=True, eq=False)
class Wish:
    """What is fitted.

    ``frames`` (K,) of the motion that are looked at, its ``poses`` there and the faces of their hulls
    (``near``); ``member`` (K,) which of the B clusters that occur each is in; ``stays`` (seconds, cluster):
    from when on the motion is in which. ``aim`` (K, 16) of the features of poses, as ``wanted`` of those
    clusters; the features of pace of each window (W, 14), their mean that is wanted, toned,
    and their weights.
    """

    motion: Motion
    body: Body
    frames: Integers
    poses: Poses
    near: Sequence[Integers]
    member: Integers
    aim: Array
    stays: tuple[tuple[float, int], ...]
    wanted: Wanted
    pace: Array
    pace_aim: Array
    pace_weights: Array

    @property
    def clusters(self) -> int:
        """How many clusters occur."""
        return len(self.wanted.numbers)

    @classmethod
    def of(cls, motion: Motion, wanted: Wanted) -> Self:
        """Return the wish for a motion. Raises ``BodyError`` where no body is found."""
        body = Body.of(motion)
        start = lead_in(motion)
        keys = keyframes(len(motion) - start, motion.frame_time) + start
        held = nearest(PoseSet.of(at(motion, keys), body), wanted.centres)
        present, labels = np.unique(settled(held, round(STAY * KEYFRAMES)), return_inverse=True)
        own = replace(wanted, numbers=wanted.numbers[present], weights=wanted.weights[present])
        chosen = _thinned(labels)
        looked = _looked(motion, body, keys[chosen], labels[chosen], own)
        share = np.bincount(labels, minlength=len(present)) / len(labels)
        points = landmarks(motion[start:], body).points / body.height
        pace = pace_windows(points, body, motion.frame_time, stride=STRIDE)
        mean = share @ own.numbers[:, COUNT:]
        if not own.absolute:
            mean = mean + toned(pace).mean(axis=0)
        changes = np.flatnonzero(np.diff(labels, prepend=-1))
        stays = tuple((float(keys[i] * motion.frame_time), int(labels[i])) for i in changes)
        weights = share @ own.weights[:, COUNT:]
        return cls(motion, body, *looked, stays, own, pace, mean, weights)

    def elsewhere(self, frames: Integers) -> Self:
        """Return the same wish, looked at in other frames (K,)."""
        starts = np.array([start for start, _ in self.stays])
        stay = np.searchsorted(starts, frames * self.motion.frame_time + 1e-9, side="right") - 1
        member = np.array([label for _, label in self.stays])[np.maximum(stay, 0)]
        _, poses, near, _, aim = _looked(self.motion, self.body, frames, member, self.wanted)
        return replace(self, frames=frames, poses=poses, near=near, member=member, aim=aim)

    def ruled(self, coefficients: Array) -> Array:
        """Return the points (N, K, 19, 3) by the rules, each keyframe by its cluster's of (N, B, 10)."""
        return self.poses.ruled(coefficients[:, self.member])

    def features(self, points: Array, *, near: Sequence[Integers] | None) -> Array:
        """Return the features (N, K, 16) of points (N, K, 19, 3).

        ``near`` are faces of hulls of points near enough; without them volumes are 0.
        """
        many, keys = points.shape[:2]
        found = None if near is None else [np.tile(part, (many, 1, 1)) for part in near]
        flat = points.reshape(many * keys, -1, 3)
        return measured(flat, self.poses.up, found=found, volumes=near is not None).reshape(many, keys, -1)

    def misses(self, points: Array, *, near: Sequence[Integers] | None) -> Array:
        """Return how far the features of points (N, K, 19, 3) are from the aim: (N, K, 16).

        Weighted so that the squares of a trial add up to the mean over the keyframes of each cluster.
        """
        often = np.bincount(self.member, minlength=self.clusters)[self.member]
        scale = self.wanted.weights[self.member, :COUNT] / np.sqrt(often)[:, None]
        return np.asarray((self.features(points, near=near) - self.aim) * scale)

    def pace_misses(self, c: Array) -> Array:
        """Return how far the features of pace (N, 14) are from wanted at tempo ``c`` (N,), by g4."""
        ruled = self.pace * c[:, None, None] ** ORDER
        return np.asarray((toned(ruled).mean(axis=1) - self.pace_aim) * self.pace_weights)


def _looked(
    motion: Motion, body: Body, frames: Integers, member: Integers, wanted: Wanted
) -> tuple[Integers, Poses, Sequence[Integers], Integers, Array]:
    """Return the frames, the poses there, faces of their hulls, their clusters, and the aim (K, 16)."""
    poses = Poses.of(at(motion, frames), body)
    near = faces(poses.points)
    aim = wanted.numbers[member, :COUNT]
    if wanted.absolute:
        aim = aim + poses.floor * (np.array(POSE) == 4)
    else:
        aim = aim + measured(poses.points, poses.up, found=near)
    return frames, poses, near, member, aim


def at(motion: Motion, frames: Integers) -> Motion:
    """Return a motion of some frames, with the body of the whole one."""
    return motion.with_(
        rotations=motion.rotations[frames],
        translations=motion.translations[frames],
        source=None,
        reference=None,
    )


def _thinned(labels: Integers) -> Integers:
    """Return which keyframes to look at: ``MOST`` in all, but ``FEWEST`` of each cluster that has them."""
    chosen = []
    for label in range(int(labels.max()) + 1):
        own = np.flatnonzero(labels == label)
        count = min(len(own), max(FEWEST, round(MOST * len(own) / len(labels))))
        chosen.append(own[np.linspace(0, len(own) - 1, count).round().astype(np.int64)])
    return np.sort(np.concatenate(chosen))
