"""Motions as bytes for the page: a head in JSON, then its arrays as float32.

``b"MIEN"``, the length of the head as four bytes (little-endian), the head (``messages.Frames``) in UTF-8
padded with spaces to a multiple of four, then the arrays one after the other, each from a multiple of four.
The page works out world transforms itself, pose by pose: so that it can blend rotations, and less travels.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from ..kinematics.contacts import detect
from ..motion import Motion
from ..render.figure import Figure
from ..render.mannequin import stance
from ..typing import Array
from .messages import Frames, PlaceInArrays, Shape

MAGIC = b"MIEN"
LEG_METRES = 0.87  # a leg where the clip's unit is not known
ALIGNMENT = 4


def encode(motion: Motion, clip: str, *, like: Figure | None = None, **more: Any) -> bytes:
    """Return a motion as bytes; ``like`` is the figure of its source, ``more`` goes in the head.

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
    drawn = range(len(motion.skeleton)) if figure.drawn is None else figure.drawn
    return Frames(
        clip=clip,
        name=motion.name,
        frames=len(motion),
        frame_time=motion.frame_time,
        joints=list(motion.skeleton.names),
        parents=motion.skeleton.parents.tolist(),
        moving=list(moving),
        drawn=[int(joint) for joint in drawn],
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
