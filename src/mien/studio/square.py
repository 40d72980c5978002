"""The nine motions of the square for the page, which blends between them while the pointer moves."""

from dataclasses import asdict

import numpy as np

from ..motion import Motion
from ..render.figure import Figure
from ..render.wire import frames_of, packed, places
from ..styles.grid import NINE, grid
from .messages import Frames


def encode_square(motion: Motion, clip: str, *, like: Figure) -> bytes:
    """Return the nine variants as one answer: head as of the clip, ``rotations_A`` to ``translations_I``.

    They have the frames of the clip, so the page can mix them pose by pose; the exact point comes from an
    edit ``grid``. Raises ``BodyError`` where no body is found.
    """
    nine = grid(motion).nine()
    moving = np.flatnonzero(
        np.max([np.ptp(v.translations, axis=0).max(axis=1) for v in nine.values()], axis=0) > 0.0
    )
    arrays = {}
    for corner in NINE:
        variant = nine[corner.letter]
        arrays[f"rotations_{corner.letter}"] = variant.rotations.astype("<f4")
        arrays[f"translations_{corner.letter}"] = variant.translations[:, moving].astype("<f4")
    head: Frames = frames_of(motion, like, clip, moving.tolist(), arrays=places(arrays))
    return packed(asdict(head), arrays)
