"""Shared fixtures. Real clips are other people's and stay outside the project; tests skip without them."""

import importlib.util
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from hypothesis import settings

from mien import samples
from mien.kinematics.body import Body
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion

ROOT = Path(__file__).resolve().parents[1]
DATA = Path(os.environ.get("MIEN_DATA", ROOT.parent / "shared" / "data"))


# How long an example takes says nothing on a busy machine. The same examples every time, so that a
# commit passes or fails whoever runs it; MIEN_FUZZ=1 looks for new ones.
settings.register_profile("mien", deadline=None, derandomize=True)
settings.register_profile("fuzz", deadline=None, max_examples=1000)
settings.load_profile("fuzz" if os.environ.get("MIEN_FUZZ") else "mien")


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real clips (set MIEN_DATA to use another)."""
    if not DATA.is_dir():
        pytest.skip("no real clips: set MIEN_DATA to a folder that has them")
    return DATA


@pytest.fixture(scope="session")
def script() -> Callable[[str], ModuleType]:
    """Load one of the project's scripts by its name."""

    def load(name: str) -> ModuleType:
        spec = importlib.util.spec_from_file_location(name, ROOT / "scripts" / f"{name}.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    return load


@pytest.fixture
def rope() -> Motion:
    """A motion of something that is no body."""
    offsets = np.array([[0.0, 90.0, 0.0], [0.0, -10.0, 0.0], [0.0, -10.0, 0.0]])
    skeleton = Skeleton(("A", "B", "C"), np.array([-1, 0, 1]), offsets)
    rotations = np.tile([0.0, 0.0, 0.0, 1.0], (30, 3, 1))
    return Motion(skeleton, rotations, np.tile(offsets, (30, 1, 1)), 1 / 30, name="rope")


@pytest.fixture(scope="session")
def nameless() -> tuple[Motion, dict[str, str]]:
    """A walk in which no body is found, and which joint plays which role in it.

    Its names say nothing, and its right limbs are so much shorter than the left that they are no pair.
    """
    motion = samples.walk(seconds=2.5, fps=30.0).motion
    skeleton, roles = motion.skeleton, Body.of(motion).roles
    names = tuple(f"j{i:02}" for i in range(len(skeleton)))
    right = [j for role in ("right_hip", "right_shoulder") for j in skeleton.descendants(roles[role])[1:]]
    offsets, translations = np.array(skeleton.offsets), np.array(motion.translations)
    offsets[right] *= 0.8
    translations[:, right] *= 0.8
    lopsided = replace(skeleton, names=names, offsets=offsets, layout=None)
    made = motion.with_(skeleton=lopsided, translations=translations, source=None, name="nameless")
    return made, {role: names[joint] for role, joint in roles.items()}


@pytest.fixture(scope="session")
def with_t_pose() -> Callable[[Motion, int], Motion]:
    """Put before a clip so many frames of a T-pose that rushes to it: rotations all but at rest."""

    def made(motion: Motion, frames: int) -> Motion:
        first = np.zeros_like(motion.rotations[:1])
        first[..., 3] = 1.0
        share = np.arange(frames)[:, None] / frames
        ends = np.repeat(first, frames, 0), np.repeat(motion.rotations[:1], frames, 0)
        places = np.repeat(motion.translations[:1], frames, 0)
        return motion.with_(
            rotations=np.concatenate([quaternion.slerp(*ends, share), motion.rotations]),
            translations=np.concatenate([places, motion.translations]),
            source=None,
        )

    return made


@pytest.fixture(scope="session")
def held_t_pose() -> Callable[[Motion, int], Motion]:
    """Put before a clip so many frames of a T-pose that is held: rotations at rest."""

    def made(motion: Motion, frames: int) -> Motion:
        rest = np.zeros((frames, *motion.rotations.shape[1:]))
        rest[..., 3] = 1.0
        places = np.repeat(motion.translations[:1], frames, 0)
        return motion.with_(
            rotations=np.concatenate([rest, motion.rotations]),
            translations=np.concatenate([places, motion.translations]),
            source=None,
        )

    return made
