"""Motions as bytes for the page: a head in JSON, then its arrays as float32.

``b"MIEN"``, the length of the head as four bytes (little-endian), the head (``Frames``) in UTF-8
padded with spaces to a multiple of four, then the arrays one after the other, each from a multiple of four.
The page works out world transforms itself, pose by pose: so that it can blend rotations, and less travels.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

import numpy as np

from ..kinematics.contacts import detect
from ..kinematics.lead_in import still_before
from ..motion import Motion
from ..typing import Array
from .figure import Figure
from .mannequin import stance

MAGIC = b"MIEN"
LEG_METRES = 0.87  # a leg where the clip's unit is not known
ALIGNMENT = 4


@dataclass(frozen=True)
class PlaceInArrays:
    """Where an array of a binary answer is: bytes from the start of the arrays, its type and its shape."""

    name: str
    type: Literal["float32", "uint8"]
    start: int
    shape: list[int]


@dataclass(frozen=True)
class Shape:
    """What a mannequin needs of a body: roles, the neutral stance in world axes, and measures.

    ``stance_rotations`` (J, 4) and ``stance_positions`` (J, 3); ``sole_depth`` and ``sole_length`` of the
    left and right foot in leg lengths.
    """

    roles: dict[str, int]
    spine: list[int]
    leg_length: float
    height: float
    stance_rotations: list[list[float]]
    stance_positions: list[list[float]]
    sole_depth: list[float]
    sole_length: list[float]


@dataclass(frozen=True)
class Frames:
    """A motion for the page, the head of a binary answer.

    Arrays: ``rotations`` (T, J, 4) from child to parent, ``translations`` (T, M, 3) of the ``moving`` joints,
    ``offsets`` (J, 3) of all, ``contacts`` (T, 2) left and right foot, 1 while it stands. ``shape`` is None
    where no body is found: then sticks are drawn between the ``drawn`` joints and to the ``tips``, the end
    sites: the joint that each hangs on, and where from there. ``steps`` is what was done, ``notes`` what has
    to be said about it, ``seconds`` what it took. ``still`` is how many
    frames at the start are a pose before the action, such as a T-pose.
    """

    clip: str
    name: str
    frames: int
    frame_time: float
    still: int
    joints: list[str]
    parents: list[int]
    moving: list[int]
    drawn: list[int]
    tips: list[int]
    tip_offsets: list[list[float]]
    metres: float
    up: list[float]
    forward: list[float]
    left: list[float]
    floor: float
    shape: Shape | None
    arrays: list[PlaceInArrays] = field(default_factory=list)
    steps: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    seconds: float = 0.0


def encode(motion: Motion, clip: str, *, like: Figure | None = None, **more: Any) -> bytes:
    """Return a motion as bytes; ``like`` is the figure of what it was made from, ``more`` goes in the head.

    >>> from mien.samples import wave
    >>> encode(wave(seconds=1.0).motion, "wave")[:4]
    b'MIEN'
    """
    figure = Figure.of(motion, like=like)
    moving = np.flatnonzero(np.ptp(motion.translations, axis=0).max(axis=1) > 0.0)
    arrays = {
        "rotations": motion.rotations.astype("<f4"),
        "translations": motion.translations[:, moving].astype("<f4"),
        "offsets": motion.translations[0].astype("<f4"),
        "contacts": _contacts(motion, figure),
    }
    frames = frames_of(motion, figure, clip, moving.tolist(), arrays=places(arrays), **more)
    return packed(asdict(frames), arrays)


def places(arrays: Mapping[str, Array]) -> list[PlaceInArrays]:
    """Return where each array starts."""
    found, start = [], 0
    for name, array in arrays.items():
        kind: Any = "uint8" if array.dtype == np.uint8 else "float32"
        found.append(PlaceInArrays(name, kind, start, list(array.shape)))
        start += _padded(array.nbytes)
    return found


def packed(head: Mapping[str, Any], arrays: Mapping[str, Array]) -> bytes:
    """Return head and arrays as one answer."""
    text = json.dumps(head, allow_nan=False, separators=(",", ":")).encode()
    text += b" " * (_padded(len(text)) - len(text))
    parts = [MAGIC, len(text).to_bytes(4, "little"), text]
    for array in arrays.values():
        parts += [array.tobytes(), b"\0" * (_padded(array.nbytes) - array.nbytes)]
    return b"".join(parts)


def _padded(length: int) -> int:
    return -(-length // ALIGNMENT) * ALIGNMENT


def frames_of(motion: Motion, figure: Figure, clip: str, moving: Sequence[int], **more: Any) -> Frames:
    """Return the head of an answer with a motion; ``moving`` joints have translations, ``more`` is added."""
    body = figure.body
    up, forward = figure.up, body.forward if body else np.array([0.0, 0.0, 1.0])
    skeleton = motion.skeleton
    drawn = np.arange(len(skeleton)) if figure.drawn is None else figure.drawn
    tips = np.isin(skeleton.end_parents, drawn)
    return Frames(
        clip=clip,
        name=motion.name,
        frames=len(motion),
        frame_time=motion.frame_time,
        still=still_before(motion),
        joints=list(skeleton.names),
        parents=skeleton.parents.tolist(),
        moving=list(moving),
        drawn=drawn.tolist(),
        tips=skeleton.end_parents[tips].tolist(),
        tip_offsets=skeleton.end_offsets[tips].tolist(),
        metres=figure.metres or LEG_METRES / figure.size,
        up=up.tolist(),
        forward=forward.tolist(),
        left=np.cross(up, forward).tolist(),
        floor=float(figure.floor),
        shape=_shape(figure),
        **more,
    )


def _shape(figure: Figure) -> Shape | None:
    body, soles = figure.body, figure.soles
    if body is None or soles is None:
        return None
    turned, standing = stance(figure.motion, body)
    return Shape(
        roles={role: int(joint) for role, joint in body.roles.items()},
        spine=[int(joint) for joint in body.spine],
        leg_length=float(body.leg_length),
        height=float(body.height),
        stance_rotations=turned.tolist(),
        stance_positions=standing.tolist(),
        sole_depth=list(soles.depth),
        sole_length=list(soles.length),
    )


def _contacts(motion: Motion, figure: Figure) -> Array:
    """Return which foot stands in each frame (T, 2), as 0 and 1."""
    if figure.body is None:
        return np.zeros((len(motion), 2), np.uint8)
    return detect(motion, body=figure.body).feet.astype(np.uint8)
