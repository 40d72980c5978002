"""The seven things that a constraint may ask of points of a body (Gleicher 1998), with error and Jacobian.

A point is fixed to a joint. A constraint says how far its points, in world axes, are from what it asks
(``error``) and how that changes when they move (``jacobian``); ``solver.solve`` turns the joints so that the
errors vanish. Errors are lengths in the clip's unit, of angles and directions at the end of a lever. What is
asked may change over time: arrays have a row for every frame, or one row for all.

====================  ============================================================================
`ParameterRange`      the angle between two bones stays in a range
`AtPosition`          a point is at a place
`InRegion`            a point stays on one side of a plane
`SamePosition`        a point stays where it is, wherever that is, for a while
`OnPath`              a point goes along with another point
`AtDistance`          two points are so far apart, or at least, or at most
`Orientation`         the line from one point to another has a direction
====================  ============================================================================
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal, NamedTuple, Protocol, Self, get_args

import numpy as np

from ..errors import MienError, unknown
from ..typing import Array, Integers, Mask


class Point(NamedTuple):
    """A point fixed to a joint: ``offset`` (3,), or (T, 3) where it changes, in the joint's own axes."""

    joint: int
    offset: Array = np.zeros(3)


class Constraint(Protocol):
    """What the solver asks of a constraint on K points that gives m numbers.

    ``places`` (F, K, 3) are the points at the ``frames`` (F,) of the clip.
    """

    @property
    def share(self) -> Array:
        """How much of the error that is there at first is to vanish (T,) or (1,)."""

    @property
    def points(self) -> tuple[Point, ...]:
        """The points that it is about."""

    @property
    def bound(self) -> bool:
        """Whether it asks for no more than to stay on one side, so that the error is zero beyond."""

    def error(self, places: Array, frames: Integers) -> Array:
        """Return how far from what is asked the points are (F, m)."""

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return how the error changes with the points (F, m, K, 3)."""


ALL = np.ones(1)
NOTHING = 1e-9  # a length that is nothing, beside another
# What may change over time: the shape of its rows.
OVER_TIME: Mapping[str, tuple[int, ...]] = {
    **dict.fromkeys(("target", "offset", "direction", "place"), (3,)),
    **dict.fromkeys(("level", "distance", "share"), ()),
}
Distance = Literal["equal", "least", "most"]


def of_frames(values: Array, frames: Integers) -> Array:
    """Return the rows of some frames; of one row for all, that row."""
    return values[frames] if len(values) > 1 else values


def check(constraint: Constraint, name: str, *, frames: int, joints: int) -> None:
    """Raise ``MienError`` where a constraint does not fit a clip of so many frames and joints."""
    what = f"{name} ({type(constraint).__name__})"
    for word, row in OVER_TIME.items():
        value = getattr(constraint, word, None)
        if value is not None and np.shape(value) not in ((1, *row), (frames, *row)):
            shapes = f"{(1, *row)}, or {(frames, *row)} for the frames of the clip"
            raise MienError(f"{what}: {word} must have the shape {shapes}; got {np.shape(value)}")
    if not ((constraint.share >= 0.0) & (constraint.share <= 1.0)).all():
        raise MienError(f"{what}: share must be from 0 to 1")
    for point in constraint.points:
        if not 0 <= point.joint < joints:
            raise MienError(
                f"{what}: there is no joint {point.joint}; this skeleton has the joints 0 to {joints - 1}"
            )
        if np.shape(point.offset) not in ((3,), (frames, 3)):
            raise MienError(
                f"{what}: the offset of a point must have the shape (3,), or ({frames}, 3) for the frames of "
                f"the clip; got {np.shape(point.offset)}"
            )
        require_finite(np.atleast_2d(point.offset), f"{what}: the offset of a point")


def require_finite(rows: Array, what: str) -> None:
    """Raise ``MienError`` if rows over frames hold what is not a number; ``what`` says whose they are."""
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(bad):
        raise MienError(
            f"{what} is not a finite number in {len(bad)} of {len(rows)} frames, first in frame {bad[0]}; "
            "fill such gaps first"
        )


@dataclass(frozen=True, eq=False)
class AtPosition:
    """``x = target``: ``point`` is at ``target`` (T, 3) or (1, 3)."""

    point: Point
    target: Array
    share: Array = field(default_factory=lambda: ALL)
    bound: ClassVar[bool] = False

    @property
    def points(self) -> tuple[Point, ...]:
        """The point."""
        return (self.point,)

    def error(self, places: Array, frames: Integers) -> Array:
        """Return ``x - target`` (F, 3)."""
        return places[:, 0] - of_frames(self.target, frames)

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return the identity (F, 3, 1, 3)."""
        return np.broadcast_to(np.eye(3)[:, None], (len(places), 3, 1, 3))


@dataclass(frozen=True, eq=False)
class InRegion:
    """``n x >= level`` (T,) or (1,): ``point`` is on the side that the unit ``normal`` (3,) points to."""

    point: Point
    normal: Array
    level: Array
    share: Array = field(default_factory=lambda: ALL)
    bound: ClassVar[bool] = True

    @property
    def points(self) -> tuple[Point, ...]:
        """The point."""
        return (self.point,)

    def error(self, places: Array, frames: Integers) -> Array:
        """Return ``min(n x - level, 0)`` (F, 1)."""
        return np.minimum(places[:, 0] @ self.normal - of_frames(self.level, frames), 0.0)[:, None]

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return ``n`` where the point is out of the region (F, 1, 1, 3)."""
        return (self.error(places, frames) < 0.0)[:, :, None, None] * self.normal


@dataclass(frozen=True, eq=False)
class SamePosition:
    """``x(t) = place``: ``point`` stays put in each of the ``spans`` of frames ``(start, stop)``.

    ``place`` (T, 3) or (1, 3); where none is given it is the mean of where the point is in the span.
    """

    point: Point
    spans: tuple[tuple[int, int], ...]
    share: Array = field(default_factory=lambda: ALL)
    place: Array | None = None
    bound: ClassVar[bool] = False

    @property
    def points(self) -> tuple[Point, ...]:
        """The point."""
        return (self.point,)

    def error(self, places: Array, frames: Integers) -> Array:
        """Return ``x - place`` (F, 3); zero outside the spans."""
        out = np.zeros((len(places), 3))
        for inside in self._inside(frames):
            x = places[inside, 0]
            out[inside] = x - (
                x.mean(axis=0) if self.place is None else of_frames(self.place, frames[inside])
            )
        return out

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return the identity inside the spans (F, 3, 1, 3): the place is taken as fixed."""
        kept = np.zeros(len(frames))
        for inside in self._inside(frames):
            kept[inside] = 1.0
        return kept[:, None, None, None] * np.eye(3)[:, None]

    def held(self, x: Array) -> Self:
        """Return the constraint with a place: if none is given, the mean of ``x`` (T, 3) in each span."""
        if self.place is not None:
            return self
        place = np.array(x)
        for inside in self._inside(np.arange(len(x))):
            place[inside] = x[inside].mean(axis=0)
        return replace(self, place=place)

    def pulled(self, away: Array, pulling: Mask) -> Self:
        """Return the constraint with its places moved to where ``pulling`` frames (T,) are held from them.

        What holds a frame ``away`` (T, 3) has drawn it about half-way: the place goes twice as far.
        """
        place = np.array(np.broadcast_to(np.asarray(self.place), away.shape))
        for inside in self._inside(np.arange(len(away))):
            if (inside & pulling).any():
                place[inside] += 2.0 * away[inside & pulling].mean(axis=0)
        return replace(self, place=place)

    def _inside(self, frames: Integers) -> Iterator[Mask]:
        """Yield which of some frames are in each span, of the spans that have any."""
        masks = ((frames >= start) & (frames < stop) for start, stop in self.spans)
        yield from (inside for inside in masks if inside.any())


@dataclass(frozen=True, eq=False)
class OnPath:
    """``x = y + offset``: ``point`` goes along with ``leader``, ``offset`` (T, 3) or (1, 3) away."""

    point: Point
    leader: Point
    offset: Array
    share: Array = field(default_factory=lambda: ALL)
    bound: ClassVar[bool] = False

    @property
    def points(self) -> tuple[Point, ...]:
        """Both points."""
        return (self.point, self.leader)

    def error(self, places: Array, frames: Integers) -> Array:
        """Return ``x - y - offset`` (F, 3)."""
        return places[:, 0] - places[:, 1] - of_frames(self.offset, frames)

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return the identity for the point and its negative for the leader (F, 3, 2, 3)."""
        both = np.stack([np.eye(3), -np.eye(3)], axis=1)
        return np.broadcast_to(both, (len(places), *both.shape))


@dataclass(frozen=True, eq=False)
class AtDistance:
    """``|x - y| = distance`` (T,) or (1,), or at least, or at most so far."""

    one: Point
    other: Point
    distance: Array
    how: Distance = "equal"
    share: Array = field(default_factory=lambda: ALL)

    def __post_init__(self) -> None:
        if self.how not in get_args(Distance):
            raise MienError(unknown("distance", self.how, get_args(Distance)))

    @property
    def bound(self) -> bool:
        """Whether more, or less, is as good."""
        return self.how != "equal"

    @property
    def points(self) -> tuple[Point, ...]:
        """Both points."""
        return (self.one, self.other)

    def error(self, places: Array, frames: Integers) -> Array:
        """Return ``|x - y| - distance`` (F, 1), zero where that is allowed."""
        apart = _length(places[:, 0] - places[:, 1]) - of_frames(self.distance, frames)[:, None]
        if self.how == "least":
            return np.minimum(apart, 0.0)
        return np.maximum(apart, 0.0) if self.how == "most" else apart

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return the direction from one to the other and back (F, 1, 2, 3), zero where nothing is asked."""
        line = places[:, 0] - places[:, 1]
        line = line / np.maximum(_length(line), 1e-300)
        wanted = (self.error(places, frames) != 0.0) | (self.how == "equal")
        return np.stack([line, -line], axis=1)[:, None] * wanted[..., None, None]


@dataclass(frozen=True, eq=False)
class Orientation:
    """``(x - y) / |x - y| = direction``, unit (T, 3) or (1, 3), measured at the end of a ``lever``."""

    one: Point
    other: Point
    direction: Array
    lever: float
    share: Array = field(default_factory=lambda: ALL)
    bound: ClassVar[bool] = False

    @property
    def points(self) -> tuple[Point, ...]:
        """Both points."""
        return (self.one, self.other)

    def error(self, places: Array, frames: Integers) -> Array:
        """Return ``lever ((x - y) / |x - y| - direction)`` (F, 3)."""
        line = places[:, 0] - places[:, 1]
        return self.lever * (line / np.maximum(_length(line), 1e-300) - of_frames(self.direction, frames))

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return ``lever (1 - u u') / |x - y|`` and its negative (F, 3, 2, 3), zero where ``x = y``."""
        line = places[:, 0] - places[:, 1]
        length = _length(line)
        unit = line / np.maximum(length, 1e-300)
        slope = self.lever * _inverse(length, self.lever)
        across = slope[..., None] * (np.eye(3) - unit[:, :, None] * unit[:, None])
        return np.stack([across, -across], axis=2)


@dataclass(frozen=True, eq=False)
class ParameterRange:
    """``low <= angle <= high``: the angle at ``middle`` between its lines to ``one`` and ``other``, radians.

    Measured at the end of a ``lever``. So a knee bends neither too far nor beyond straight.
    """

    one: Point
    middle: Point
    other: Point
    low: float
    high: float
    lever: float
    share: Array = field(default_factory=lambda: ALL)
    bound: ClassVar[bool] = True

    @property
    def points(self) -> tuple[Point, ...]:
        """The three points."""
        return (self.one, self.middle, self.other)

    def error(self, places: Array, frames: Integers) -> Array:
        """Return ``lever`` times how far the angle is above ``high`` or (negative) below ``low`` (F, 1)."""
        u, v = places[:, 0] - places[:, 1], places[:, 2] - places[:, 1]
        angle = np.arctan2(_length(np.cross(u, v))[:, 0], np.einsum("fi,fi->f", u, v))
        return self.lever * (np.maximum(angle - self.high, 0.0) + np.minimum(angle - self.low, 0.0))[:, None]

    def jacobian(self, places: Array, frames: Integers) -> Array:
        """Return the change of the angle with each point (F, 1, 3, 3), zero inside the range."""
        u, v = places[:, 0] - places[:, 1], places[:, 2] - places[:, 1]
        normal = _normal(u, v)
        first = np.cross(u, normal) * _inverse(_length(u), self.lever) ** 2
        last = np.cross(normal, v) * _inverse(_length(v), self.lever) ** 2
        change = self.lever * np.stack([first, -first - last, last], axis=1)
        return np.asarray(change[:, None] * (self.error(places, frames) != 0.0)[..., None, None])


def _length(v: Array) -> Array:
    """Return the lengths (F, 1) of vectors (F, 3)."""
    return np.sqrt(np.einsum("fi,fi->f", v, v))[:, None]


def _inverse(length: Array, lever: float) -> Array:
    """Return one over lengths, zero for those that are nothing beside a lever: they have no direction."""
    return np.where(length > NOTHING * lever, 1.0 / np.maximum(length, 1e-300), 0.0)


def _normal(u: Array, v: Array) -> Array:
    """Return unit vectors (F, 3) across both ``u`` and ``v``; where these are in line, some across ``u``."""
    normal = np.cross(u, v)
    flat = _length(normal) <= NOTHING * _length(u) * _length(v)
    if flat.any():
        axis = np.eye(3)[np.argmin(np.abs(u), axis=1)]
        normal = np.where(flat, np.cross(u, axis), normal)
    return normal / np.maximum(_length(normal), 1e-300)
