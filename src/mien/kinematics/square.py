"""A square of motions: longer or shorter paths one way, added acceleration or even speed the other.

Nine motions stand at its corners, on the middles of its sides and in its centre (Förger 2011, section
3.6); any other point is made from those around it. ``path`` is 0 for short, 1 for the original's and 2 for
long paths; ``timing`` 0 for added acceleration, 1 for the original's and 2 for constant speed, as in the
thesis's figure 28.

``bilinear`` is the thesis's way: the weighted mean of four motions, direction vector by direction vector.
``timemap`` takes that mean along the path length only and, along the timing, the mean of the maps of time,
so that limbs stay on their paths: the mean of two poses that a limb takes at different moments lies beside.

In both the feet are put where the equally weighted ankles of the neighbours are, while they stand.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, Self

import numpy as np

from ..motion import Motion
from ..rotations import directions, quaternion
from ..signal.bridging import nearness
from ..signal.time_map import Rule, between
from ..typing import Array, Mask
from .ankles import Ankles, move_ankles
from .body import Body
from .bones import main_bones
from .limb_timing import USUAL, LimbMaps, limb_maps, loop, show

Mode = Literal["timemap", "bilinear"]
Paths = tuple[Motion, Motion, Motion]
# Seconds around a contact over which its correction sets in and dies out.
REACH = 0.15


def corners(path: float, timing: float) -> Iterator[tuple[float, int, int]]:
    """Yield (weight, path, timing) of the motions that make a point: four, two on a line, one at a corner.

    With ``i = min(floor path, 1)``, ``j = min(floor timing, 1)``, ``a = path - i`` and ``b = timing - j``
    the weights are ``(1-a)(1-b)``, ``a(1-b)``, ``(1-a)b`` and ``ab``: they add up to 1.
    """
    i, j = min(int(path), 1), min(int(timing), 1)
    a, b = path - i, timing - j
    for weight, k, m in (((1 - a) * (1 - b), 0, 0), (a * (1 - b), 1, 0), ((1 - a) * b, 0, 1), (a * b, 1, 1)):
        if weight:
            yield weight, i + k, j + m


@dataclass(frozen=True, eq=False)
class Square:
    """What all points of the square are made from.

    ``paths`` are the motions with short, the original's and long paths, feet fixed. ``shifts`` limb ->
    (3, 3, T): how many frames later than its own frame a limb shows, for each path and timing; in a loop
    ``round_length`` frames make a round. ``standing`` (T, 2) is 1 while a foot stands and falls to 0
    around that. ``axes`` (J, 3) are those of the joints' direction vectors. ``timed`` holds the six retimed
    motions where the mode needs them.
    """

    body: Body
    mode: Mode
    paths: Paths
    shifts: Mapping[str, Array]
    round_length: int
    standing: Array
    ankles: tuple[Ankles, ...]
    axes: tuple[Array, Array]
    timed: Mapping[tuple[int, int], Motion]

    @classmethod
    def of(cls, paths: Paths, body: Body, *, rules: Sequence[Rule], planted: Mask, mode: Mode) -> Self:
        """Make the square of three motions; ``planted`` (T, 2) says when which foot stands.

        ``rules`` are those of added acceleration and of constant speed; without them timing changes nothing.
        """
        around = loop(paths[1], body)
        shifts = _shifts(paths, body, rules, around)
        reach = REACH / paths[1].frame_time
        standing = np.stack([nearness(planted[:, foot], reach=reach) for foot in range(2)], axis=1)
        ankles = tuple(Ankles.of(motion, body) for motion in paths)
        axes = directions.axes(main_bones(paths[1].skeleton))
        square = cls(body, mode, paths, shifts, around, standing, ankles, axes, {})
        if mode == "timemap":
            return square
        timed = {(i, j): square.corner(i, j) for i in range(3) for j in (0, 2)}
        return replace(square, timed=timed)

    def corner(self, path: int, timing: int) -> Motion:
        """Return one of the nine motions."""
        if timing == 1:
            return self.paths[path]
        if (path, timing) in self.timed:
            return self.timed[path, timing]
        return show(self.paths[path], self.body, self._maps(path, timing))

    def point(self, path: float, timing: float) -> Motion:
        """Return the motion at any point of the square, coordinates from 0 to 2."""
        if path == int(path) and timing == int(timing):
            return self.corner(int(path), int(timing))
        if self.mode == "bilinear":
            return self._mean(path, timing, slice(None))
        return show(self._mean(path, 1.0, slice(None)), self.body, self._maps(path, timing))

    def frame(self, index: int, path: float, timing: float) -> tuple[Array, Array]:
        """Return rotations (J, 4) and translations (J, 3) of one frame of ``point``, without the others."""
        if self.mode == "bilinear":
            pose = self._mean(path, timing, [index])
            return pose.rotations[0], pose.translations[0]
        length = self.round_length or len(self.paths[1])
        shown = {
            limb: between(at[index : index + 1], length, wrap=self.round_length > 0)
            for limb, at in self._maps(path, timing).frames.items()
        }
        needed = [index, *(int(frames[0]) for here, after, _ in shown.values() for frames in (here, after))]
        pose = self._mean(path, 1.0, needed)
        rotations, translations = np.array(pose.rotations[0]), np.array(pose.translations[0])
        for number, (limb, (_, _, weight)) in enumerate(shown.items()):
            joints, here = self.body.joints((limb,)), 2 * number + 1
            a, b = pose.rotations[here : here + 2, joints]
            rotations[joints] = quaternion.slerp(a, b, weight[0])
            start, end = pose.translations[here : here + 2, joints]
            translations[joints] = start + weight[0] * (end - start)
        return rotations, translations

    def _maps(self, path: float, timing: float) -> LimbMaps:
        """Return which frame every limb shows: its own plus the mean of the shifts around the point."""
        if timing == 1.0:
            return LimbMaps({}, self.round_length)
        own, parts = np.arange(len(self.paths[1])), list(corners(path, timing))
        later = {limb: sum(w * by[i, j] for w, i, j in parts) for limb, by in self.shifts.items()}
        return LimbMaps({limb: own + by for limb, by in later.items() if np.any(by)}, self.round_length)

    def _mean(self, path: float, timing: float, frames: slice | Sequence[int]) -> Motion:
        """Return the mean of the motions around a point at some frames, feet where they stand."""
        parts = [(weight, self.corner(i, j)) for weight, i, j in corners(path, timing)]
        middle = self.paths[1]
        if len(parts) == 1:
            return _at(parts[0][1], frames)
        joints = middle.skeleton.descendants(self.body.roles["hips"])
        u, v = (axis[joints] for axis in self.axes)
        mean: Any = sum(
            w * directions.encode(motion.rotations[frames][:, joints], u, v) for w, motion in parts
        )
        own = middle.rotations[frames]
        rotations = np.array(own)
        rotations[:, joints] = directions.decode(mean, u, v, fallback=own[:, joints])
        moved = middle.translations[frames]
        moved = moved + sum(w * (motion.translations[frames] - moved) for w, motion in parts)
        return self._stood(middle.with_(rotations=rotations, translations=moved), path, frames)

    def _stood(self, motion: Motion, path: float, frames: slice | Sequence[int]) -> Motion:
        """Return the motion with standing feet where the mean of the neighbours' ankles is."""
        before = min(int(path), 1)
        if path == before or not self.standing.any():
            return motion
        goal = self.ankles[before][frames].towards(self.ankles[before + 1][frames], path - before)
        return move_ankles(motion, self.body, goal, share=self.standing[frames])


def _shifts(paths: Paths, body: Body, rules: Sequence[Rule], around: int) -> dict[str, Array]:
    """Return how many frames later each limb shows, (3, 3, T) for each path and timing."""
    own = np.arange(len(paths[1]))
    out: dict[str, Array] = {}
    for i, motion in enumerate(paths):
        for j, rule in zip((0, 2), rules, strict=False):
            for limb, at in limb_maps(motion, body, rule, limbs=USUAL, round_length=around).frames.items():
                later = at - own
                if around:  # a frame that starts over is as near from the other side
                    later = (later + 0.5 * around) % around - 0.5 * around
                out.setdefault(limb, np.zeros((3, 3, len(own))))[i, j] = later
    return out


def _at(motion: Motion, frames: slice | Sequence[int]) -> Motion:
    if frames == slice(None):
        return motion
    return motion.with_(rotations=motion.rotations[frames], translations=motion.translations[frames])
