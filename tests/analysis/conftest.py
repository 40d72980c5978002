"""Clips made for tests: a body whose places are put where a test wants them."""

from collections.abc import Mapping

import numpy as np
import pytest

from mien.kinematics.body import Body
from mien.kinematics.fk import to_local, world
from mien.motion import Motion
from mien.samples import still

ROLES = {"pelvis": "hips", "hand": "wrist", "foot": "ankle"}


class Made:
    """A body that stands, and ways to move it."""

    @staticmethod
    def pose(frames: int, *, fps: float = 30.0, skeleton: str = "standard22") -> tuple[Motion, Body]:
        """A body that stands without any movement, and its body."""
        motion = still(seconds=0.0, fps=fps, skeleton=skeleton).motion
        rotations, moved = (
            np.repeat(array[:1], frames, axis=0) for array in (motion.rotations, motion.translations)
        )
        return motion.with_(rotations=rotations, translations=moved, source=None), Body.of(motion)

    @staticmethod
    def carried(motion: Motion, body: Body, path: np.ndarray) -> Motion:
        """The motion with the whole body moved by ``path`` (T, 3)."""
        moved = np.array(motion.translations)
        moved[:, body.roles["hips"]] += path
        return motion.with_(translations=moved, source=None)

    @staticmethod
    def joint(body: Body, place: str) -> int:
        """The joint of a place such as ``left_hand``."""
        side, _, rest = place.rpartition("_")
        role = ROLES.get(rest, rest)
        return body.roles[f"{side}_{role}" if side else role]

    @classmethod
    def placed(cls, motion: Motion, body: Body, places: Mapping[str, np.ndarray]) -> Motion:
        """The motion with some places, and nothing that hangs on them, put to world positions (T, 3)."""
        rotations, positions = world(motion)
        positions = np.array(positions)
        for place, where in places.items():
            positions[:, cls.joint(body, place)] = where
        local, moved = to_local(rotations, positions, motion.skeleton.parents)
        return motion.with_(rotations=local, translations=moved, source=None)


@pytest.fixture(scope="session")
def made() -> type[Made]:
    return Made
