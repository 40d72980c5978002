"""Poses at given times, and how the body gets from one to the next: displacement mapping's keys.

In one line, as a recipe holds them: ``1 head 25 0 0; trunk 10 0 0 | 2.5 none | 3 head_down``: a time in
seconds, then a pose (a name, or turns as ``str(Pose)`` writes them, or ``none``), and a bar between keys.
"""

from collections.abc import Mapping
from itertools import pairwise
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from ..curve import evaluate
from ..errors import RecipeError
from ..motion import Motion
from ..typing import Array
from .poses import Pose, named_pose, pose_between, posture_pose, read_pose, read_table

Keys = tuple[tuple[float, Pose], ...]


def parse_keys(text: str) -> Keys:
    """Return the keys written in ``text``; none for ``none`` or an empty text.

    Raises ``RecipeError`` for a key that is no time and pose, and where times do not go up.
    """
    if text.strip() in ("", "none"):
        return ()
    if text.endswith(".toml"):
        raise RecipeError(
            f"a recipe holds the keys themselves, so that it stays true when the file changes: "
            f"give format_keys(read_keys({text!r})) of mien.kinematics.keyed_poses"
        )
    return _in_order([_key(item) for item in text.split("|")])


def format_keys(keys: Keys) -> str:
    """Return the line that ``parse_keys`` reads back to the same keys."""
    return " | ".join(f"{time!r} {str(pose) or 'none'}" for time, pose in keys) or "none"


def keys_between(neutral: Motion, stills: Mapping[float, Motion]) -> Keys:
    """Return keys at the times of ``stills``, each how it is held differently from ``neutral``.

    Stills are as for ``pose_between``: short clips of one actor. ``neutral`` itself, at another time, is the
    way back.
    """
    return _in_order([(float(time), pose_between(neutral, still)) for time, still in sorted(stills.items())])


def read_keys(path: str | Path) -> Keys:
    """Read a file of keys: TOML with one table ``[[keys]]`` for each, of a ``time`` and a ``pose``.

    The pose is what stands in a line of keys, or the name of a pose file beside this file.
    """
    path = Path(path)
    rows = read_table(path, kind="a file of keys").get("keys")
    if not (isinstance(rows, list) and rows and all(isinstance(row, dict) for row in rows)):
        raise RecipeError(f"{path}: a file of keys has tables [[keys]], each with a time and a pose")
    try:
        return _in_order([_row(row, path.parent) for row in rows])
    except RecipeError as error:
        raise RecipeError(f"{path}: {error}") from None


def turns_at(keys: Keys, at: Array) -> dict[str, Array]:
    """Return segment -> its turn in degrees (T, 3) at the moments ``at`` (T,) in seconds.

    Each number goes along the monotone cubic of ``mien.curve`` from key to key: at a key it is the key's,
    between keys nothing goes beyond them, and before the first and after the last it stays. A segment that a
    key does not name is not turned there.
    """
    segments = dict.fromkeys(segment for _, pose in keys for segment in pose.turns)
    return {segment: _turn_at(keys, segment, at) for segment in segments}


def _turn_at(keys: Keys, segment: str, at: Array) -> Array:
    turns = [(time, pose.turns.get(segment, (0.0, 0.0, 0.0))) for time, pose in keys]
    return np.stack([evaluate(tuple((t, turn[i]) for t, turn in turns), at) for i in range(3)], axis=1)


def _key(text: str) -> tuple[float, Pose]:
    first, _, pose = text.strip().partition(" ")
    try:
        time = float(first)
    except ValueError:
        raise RecipeError(
            f"keys: {text.strip()!r} does not start with a time in seconds, such as 1.5 head 25 0 0"
        ) from None
    return _time(time), _pose(pose, time)


def _row(row: Mapping[str, Any], folder: Path) -> tuple[float, Pose]:
    if set(row) != {"time", "pose"} or not isinstance(row["pose"], str):
        raise RecipeError(f"keys: each has a time in seconds and a pose in quotes, got {dict(row)!r:.80}")
    time, pose = _time(row["time"]), row["pose"]
    return time, read_pose(folder / pose) if pose.endswith(".toml") else _pose(pose, time)


def _time(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise RecipeError(f"keys: a time must be a number of seconds, got {value!r}")
    return float(value)


def _pose(text: str, time: float) -> Pose:
    try:
        values, turns = named_pose(text.strip())
    except RecipeError as error:
        raise RecipeError(f"keys: at {time:g} s: {error}") from None
    return posture_pose(values) + turns if values else turns


def _in_order(keys: list[tuple[float, Pose]]) -> Keys:
    for (before, _), (after, _) in pairwise(keys):
        if not before < after:
            raise RecipeError(f"keys: their times must go up, got {after:g} s after {before:g} s")
    return tuple(keys)
