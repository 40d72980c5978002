"""Skeleton and Motion: the two types every room shares. Frozen, checked, with read-only arrays.

Frames first, joints second, components last. Quaternions ``xyzw``, unit, child-to-parent. Lengths in
the clip's own unit. ``T`` frames, ``J`` joints, ``E`` end sites.
"""

from collections.abc import Collection, Mapping
from copy import copy
from dataclasses import dataclass, field
from os import PathLike
from typing import Any, Self

import numpy as np

from .errors import MienError
from .recipe import Step
from .typing import Array, Integers


@dataclass(frozen=True, eq=False)
class Skeleton:
    """A tree of joints.

    ``names`` (J), ``parents`` (J, -1 for a root, else an earlier joint), ``offsets`` (J, 3) from the
    parent; ``end_parents`` (E) and ``end_offsets`` (E, 3) are the tips of the last bones.
    ``layout`` is whatever the file's format keeps aside so that saving gives back what came in.
    ``roles`` (role -> joint name) is what a user's map file says of the body; usually empty.
    """

    names: tuple[str, ...]
    parents: Integers
    offsets: Array
    end_parents: Integers = field(default_factory=lambda: np.zeros(0, np.int64))
    end_offsets: Array = field(default_factory=lambda: np.zeros((0, 3)))
    layout: Any = None
    roles: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        joints, ends = len(self.names), len(self.end_parents)
        object.__setattr__(self, "names", tuple(self.names))
        _set(self, "parents", (joints,), np.int64)
        _set(self, "offsets", (joints, 3))
        _set(self, "end_parents", (ends,), np.int64)
        _set(self, "end_offsets", (ends, 3))
        if joints == 0:
            raise MienError("a skeleton needs at least one joint")
        if (self.parents >= np.arange(joints)).any() or (self.parents < -1).any():
            raise MienError(f"every parent must be -1 or an earlier joint, got {self.parents.tolist()}")
        if ends and (self.end_parents.min() < 0 or self.end_parents.max() >= joints):
            raise MienError("every end site must hang on a joint of the skeleton")

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        return f"Skeleton({_count(len(self), 'joint')}: {self.names[0]} to {self.names[-1]})"

    def children(self, joint: int) -> list[int]:
        """Return the indices of the joints that hang directly on ``joint``."""
        return [int(i) for i in np.flatnonzero(self.parents == joint)]

    def descendants(self, joint: int) -> list[int]:
        """Return ``joint`` and all joints below it, in skeleton order."""
        below = {joint}
        for i in range(joint + 1, len(self)):
            if int(self.parents[i]) in below:
                below.add(i)
        return sorted(below)


@dataclass(frozen=True, eq=False)
class Motion:
    """A skeleton moving: ``rotations`` (T, J, 4) local, ``translations`` (T, J, 3) from the parent.

    A translation replaces the joint's offset (as in Blender and Maya); where a joint does not move
    it equals the offset. ``frame_time`` in seconds. ``history`` holds the steps that made this
    motion. ``source`` is the file format's own numbers, kept so that what no edit touched is written
    back unchanged. ``reference`` is the motion before the first step of ``history``, carried through
    the steps that change its frames: repairs compare with it, and it makes the history replay to the
    same bytes; one that no longer has the motion's shape is dropped. The arrays are taken over, not
    copied: do not write to them afterwards.
    """

    skeleton: Skeleton
    rotations: Array
    translations: Array
    frame_time: float
    history: tuple[Step, ...] = ()
    source: Any = None
    name: str = ""
    reference: Self | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        self._check({"rotations", "translations"})

    def _check(self, changed: Collection[str]) -> None:
        """Raise ``MienError`` for what cannot be; of the long arrays only what changed is looked at."""
        frames, joints = len(self.rotations), len(self.skeleton)
        _set(self, "rotations", (frames, joints, 4))
        _set(self, "translations", (frames, joints, 3))
        if frames == 0:
            raise MienError("a motion needs at least one frame")
        if not (np.isfinite(self.frame_time) and self.frame_time > 0):
            raise MienError(f"frame time must be above 0 seconds, got {self.frame_time}")
        if "translations" in changed and not np.isfinite(self.translations).all():
            raise MienError("translations hold a number that is not finite")
        if "rotations" in changed:
            length = np.einsum("tji,tji->tj", self.rotations, self.rotations)
            if not (np.abs(length - 1.0) < 1e-6).all():
                raise MienError("rotations must be unit quaternions (xyzw)")
        if self.reference is not None and self.reference.rotations.shape != self.rotations.shape:
            object.__setattr__(self, "reference", None)

    def __len__(self) -> int:
        return len(self.rotations)

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        size = f"{_count(len(self), 'frame')}, {_count(len(self.skeleton), 'joint')}"
        steps = f", {_count(len(self.history), 'step')}" if self.history else ""
        return f"Motion({name}{size}, {self.fps:.6g} fps, {self.duration:.2f} s{steps})"

    def _repr_html_(self) -> str:
        """Return a strip of poses for notebooks; the front door knows the room that draws it."""
        import mien

        return mien.render.strip_html(self)

    def __getitem__(self, frames: slice) -> Self:
        """Return the motion of a range of frames, e.g. ``motion[10:50]``.

        It keeps the history of the whole, which does not make this range: use the edit ``trim`` for that.
        """
        if not isinstance(frames, slice):
            raise MienError("give a range of frames, e.g. motion[10:50]")
        return self.with_(
            rotations=self.rotations[frames],
            translations=self.translations[frames],
            frame_time=self.frame_time * abs(frames.step or 1),
            source=None,
            reference=self.reference[frames] if self.reference else None,
        )

    @property
    def fps(self) -> float:
        """Frames a second."""
        return 1.0 / self.frame_time

    @property
    def duration(self) -> float:
        """Seconds from the first frame to the last: (T - 1) x frame time."""
        return (len(self) - 1) * self.frame_time

    @property
    def times(self) -> Array:
        """The time of every frame in seconds (T,)."""
        return np.arange(len(self)) * self.frame_time

    def with_(self, **fields: Any) -> Self:
        """Return a copy with some fields replaced."""
        unknown = set(fields) - set(self.__dataclass_fields__)
        if unknown:
            raise MienError(f"a motion has no {', '.join(sorted(unknown))}")
        made = copy(self)
        for name, value in fields.items():
            object.__setattr__(made, name, value)
        made._check(fields)
        return made


def require_motion(value: object) -> Motion:
    """Return ``value`` if it is a motion; else raise ``MienError`` that says how to get one."""
    if isinstance(value, Motion):
        return value
    if isinstance(value, str | PathLike):
        raise MienError(f"give a Motion, not a path: mien.load({str(value)!r})")
    raise MienError(f"give a Motion (mien.load reads one from a file), not {value!r:.60}")


def _count(number: int, thing: str) -> str:
    """Return how many there are of a thing, such as ``1 frame`` or ``3 joints``."""
    return f"{number} {thing}{'' if number == 1 else 's'}"


def _set(owner: object, name: str, shape: tuple[int, ...], dtype: type = np.float64) -> None:
    array: Array = np.asarray(getattr(owner, name), dtype).view()
    if array.shape != shape:
        raise MienError(f"{name} must have shape {shape}, got {array.shape}")
    array.setflags(write=False)
    object.__setattr__(owner, name, array)
