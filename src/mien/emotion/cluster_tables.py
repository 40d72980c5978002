"""What emotions change in each cluster of poses: the local tables of Aristidou et al. (2017), section 3.5.

Numbers are those that the four rules can change (``control_features.NUMBERS``), of every fifth frame, so
that what is wished is measured as what is fitted. A take is compared with its neutral take within each
cluster; half of what all takes of a performer have in common (another day, other markers) is taken out: some
of it is acting. Left and right are taken together.

Differences: the paper tells which features count in a cluster by limits on means in [0, 1]. Here a feature
counts by how much labels differ (``EFFECTIVE``) against how much takes of one label do (``consistent``); what
does not count is wished to stay, and all is weighed by the inverse of the latter. Poses are told apart
without the posture of their take, as a bow would go to the cluster of bows. A cluster that a label hardly
visits has the change of the label over all clusters.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol, Self

import numpy as np

from ..analysis.laban import pace_windows
from ..analysis.laban_table import SELECTED
from ..errors import MienError
from ..kinematics.body import Body
from ..kinematics.landmarks import landmarks
from ..kinematics.lead_in import lead_in
from ..kinematics.poses import SEGMENTS, mean_rotation
from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array, Integers
from .control_features import FLOOR, NUMBERS, POSE, keyframes, measured, toned
from .pose_clusters import PoseSet, medoids, nearest

HELD = 2.0  # takes of a label in a cluster that count as much as its change over all clusters
WHOLE = 6.0  # poses (1 s) of a take in a cluster that make it half a take
COMMON = 0.5  # of what all takes of a performer have in common that is taken out
EFFECTIVE = 0.25  # of the spread among takes of a label that labels differ by, at least
# Six volumes of one body say much the same; together they count as two features.
ALIKE = np.array([np.sqrt(1.0 / 3.0) if n in (18, 19, 26, 27, 28, 29) else 1.0 for n in NUMBERS])
# Left and right of a feature: what an emotion changes is the same on both sides.
_SIDES = {2: 3, 30: 31, 28: 29, 8: 9, 10: 11, 13: 14, 15: 16}
_OTHER = [NUMBERS.index({**_SIDES, **{b: a for a, b in _SIDES.items()}}.get(n, n)) for n in NUMBERS]
LEAST = np.array([FLOOR[SELECTED[n - 1].feature.unit] if n in POSE else 0.1 for n in NUMBERS])


@dataclass(frozen=True, eq=False)
class Seen:
    """One clip at every fifth frame: its ``poses`` (K) and their ``numbers`` (K, 30)."""

    poses: PoseSet
    numbers: Array

    @classmethod
    def of(cls, motion: Motion, *, body: Body) -> Self:
        """Return what is seen of a motion, without a T-pose that comes first."""
        motion = motion[lead_in(motion) :]
        frames = keyframes(len(motion), motion.frame_time)
        points = landmarks(motion, body).points / body.height
        pose = measured(points[frames], body.up)
        pose[:, POSE.index(4)] -= body.floor / body.height
        windows = toned(pace_windows(points, body, motion.frame_time))
        at = np.linspace(0, len(windows) - 1, len(frames)).round().astype(np.int64)
        still = motion.with_(
            rotations=motion.rotations[frames],
            translations=motion.translations[frames],
            source=None,
            reference=None,
        )
        return cls(PoseSet.of(still, body), np.concatenate([pose, windows[at]], axis=1))


class Labelled(Protocol):
    """A take: whose, of which label, what is seen of it and of its neutral take."""

    @property
    def label(self) -> str:
        """What it shows."""

    @property
    def performer(self) -> str:
        """Who shows it."""

    @property
    def seen(self) -> Seen:
        """What is seen of it."""

    @property
    def seen_neutral(self) -> Seen:
        """What is seen of its neutral take."""


@dataclass(frozen=True, eq=False)
class ClusterTables:
    """``centres`` (C), the poses that stand for clusters, and what is learned of each.

    ``changes`` label -> (C, 30), ``rest`` (C, 30) the numbers of neutral takes, ``weights`` (C, 30): the
    inverse of how much takes of a label differ. What tells no labels apart in a cluster is not to change.
    """

    centres: PoseSet
    changes: Mapping[str, Array]
    rest: Array
    weights: Array

    def as_data(self) -> dict[str, Any]:
        """Return the tables as plain data."""
        return {
            "heights": _plain(self.centres.heights),
            "turns": {s: _plain(q) for s, q in self.centres.turns.items()},
            "changes": {label: _plain(change) for label, change in self.changes.items()},
            "rest": _plain(self.rest),
            "weights": _plain(self.weights),
        }

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Self:
        """Return the tables from plain data. Raises ``MienError`` for numbers that do not fit together."""
        heights = np.array(data["heights"], float)
        count = len(heights)
        shape = count, len(NUMBERS)
        turns = {s: _array(q, (count, 4)) for s, q in data["turns"].items() if s in SEGMENTS}
        if not count or heights.ndim != 1 or not np.isfinite(heights).all():
            raise MienError("clusters: no heights")
        changes = {label: _array(change, shape) for label, change in data["changes"].items()}
        weights = _array(data["weights"], shape)
        if (weights < 0.0).any():
            raise MienError("clusters: weights are 0 or more")
        return cls(PoseSet(heights, turns), changes, _array(data["rest"], shape), weights)


def learn_tables(takes: Sequence[Labelled], labels: Sequence[str], *, neutral: str) -> ClusterTables:
    """Return the tables of ``labels`` that takes teach; that of ``neutral`` is nothing."""
    seen = [_as_neutral(take.seen, take.seen_neutral) for take in takes]
    every = PoseSet.joined(seen)
    centres = every[medoids(every)]
    count = len(centres)
    whole = {id(t): t.seen.numbers.mean(axis=0) - t.seen_neutral.numbers.mean(axis=0) for t in takes}
    common = {
        who: COMMON
        * np.mean([whole[id(t)] for t in takes if t.performer == who and t.label != neutral] or [0.0], axis=0)
        for who in {t.performer for t in takes}
    }
    local, often, members = [], [], []
    for take, poses in zip(takes, seen, strict=True):
        own, n = _means(take.seen.numbers, nearest(poses, centres), count)
        rest, m = _means(take.seen_neutral.numbers, nearest(take.seen_neutral.poses, centres), count)
        local.append(_both_sides(own - rest - common[take.performer]))
        often.append(np.minimum(n, m) / (np.minimum(n, m) + WHOLE))
        members.append((rest, m, take))
    change, weight = np.array(local), np.array(often)[..., None]
    changes = {neutral: np.zeros((count, len(NUMBERS)))}
    square, total = np.zeros((count, len(NUMBERS))), np.zeros((count, 1))
    for label in labels:
        mine = np.array([t.label == label for t in takes])
        if label == neutral or not mine.any():
            continue
        usual = _both_sides(
            np.mean([whole[id(t)] - common[t.performer] for t in takes if t.label == label], axis=0)
        )
        w = weight[mine]
        changes[label] = ((w * change[mine]).sum(axis=0) + HELD * usual) / (w.sum(axis=0) + HELD)
        square += (w * (change[mine] - changes[label]) ** 2).sum(axis=0)
        total += w.sum(axis=0)
    spread = np.sqrt((square + HELD * square.sum(axis=0) / max(float(total.sum()), 1e-9)) / (total + HELD))
    effect = np.sqrt(np.mean([changes[k] ** 2 for k in changes if k != neutral] or [square], axis=0))
    spread = np.maximum(spread, LEAST)
    counts = effect >= EFFECTIVE * spread
    changes = {label: np.where(counts, change, 0.0) for label, change in changes.items()}
    return ClusterTables(centres, changes, _rest(members, neutral), ALIKE / spread)


def _rest(members: Sequence[tuple[Array, Array, Labelled]], neutral: str) -> Array:
    """Return the mean numbers (C, 30) of neutral takes; where there are none, over all clusters."""
    own = [(rest, m[:, None]) for rest, m, take in members if take.label == neutral]
    total = sum(m for _, m in own)
    usual = sum((rest * m).sum(axis=0) for rest, m in own) / np.maximum(np.sum(total), 1e-9)
    found = sum(rest * m for rest, m in own) + usual
    return np.asarray(found / (total + 1.0))


def _means(numbers: Array, member: Integers, count: int) -> tuple[Array, Array]:
    """Return the mean of ``numbers`` (K, 30) in each cluster (C, 30), 0 where none, and how many (C,)."""
    shares = (member == np.arange(count)[:, None]).astype(float)
    often = shares.sum(axis=1)
    return shares @ numbers / np.maximum(often, 1.0)[:, None], often


def _both_sides(change: Array) -> Array:
    """Return changes (..., 30) as they are, and in the mirror, half and half."""
    return np.asarray(0.5 * (change + change[..., _OTHER]))


def _as_neutral(seen: Seen, rest: Seen) -> PoseSet:
    """Return the poses held as in the neutral take: mean turns and mean height are its."""
    poses, other = seen.poses, rest.poses
    turns = {}
    for segment, q in poses.turns.items():
        if segment in other.turns:
            back = quaternion.multiply(
                mean_rotation(other.turns[segment]), quaternion.conjugate(mean_rotation(q))
            )
            turns[segment] = quaternion.multiply(back, q)
    return replace(poses, heights=poses.heights + other.heights.mean() - poses.heights.mean(), turns=turns)


def _plain(values: Array) -> Any:
    return np.asarray(values).round(5).tolist()


def _array(values: Any, shape: tuple[int, ...]) -> Array:
    found = np.array(values, float)
    if found.shape != shape or not np.isfinite(found).all() or np.abs(found).max(initial=0.0) > 1e9:
        raise MienError(f"clusters: {shape} numbers are needed, got {found.shape}")
    return found
