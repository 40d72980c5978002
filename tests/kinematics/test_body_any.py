"""Whatever tree comes in, a body comes out or a BodyError: never another error, a warning or a NaN."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.errors import BodyError
from mien.kinematics.body import ROLES, Body
from mien.motion import Motion, Skeleton
from mien.rotations import quaternion as quat
from mien.samples import SKELETONS, still


def is_sound(motion: Motion, chosen: dict[str, str]) -> None:
    """Anything but a body of finite numbers or a BodyError fails the test."""
    try:
        body = Body.of(motion, map=chosen)
    except BodyError:
        return
    assert np.isfinite([body.leg_length, body.height, body.floor, *body.neutral.ravel()]).all()
    assert body.leg_length > 0


WORDS = ["Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "RightArm", "Head", "Spine", "l_hand", "x", "RightHip"]


@settings(max_examples=100, deadline=None)
@given(st.data())
def test_any_tree_at_all_gives_a_clear_error_unless_it_is_a_body(data: st.DataObject) -> None:
    joints, frames = data.draw(st.integers(1, 24)), data.draw(st.integers(1, 4))
    parents = [-1] + [data.draw(st.integers(-1, j - 1)) for j in range(1, joints)]
    words = data.draw(st.lists(st.sampled_from(WORDS), min_size=joints, max_size=joints))
    random = np.random.default_rng(data.draw(st.integers(0, 2**32 - 1)))
    offsets = random.normal(size=(joints, 3)) * random.integers(0, 2, (joints, 1))
    skeleton = Skeleton(tuple(words), np.array(parents), offsets, np.array([joints - 1]), np.zeros((1, 3)))
    local = quat.normalise(random.normal(size=(frames, joints, 4)))
    is_sound(Motion(skeleton, local, np.tile(offsets, (frames, 1, 1)), 0.1), {})


@settings(max_examples=100, deadline=None)
@given(st.data())
def test_any_bent_and_crippled_humanoid_gives_a_body_or_a_clear_error(data: st.DataObject) -> None:
    motion = still(skeleton=data.draw(st.sampled_from(SKELETONS)), seconds=0.05).motion
    random = np.random.default_rng(data.draw(st.integers(0, 2**32 - 1)))
    size = 10.0 ** data.draw(st.integers(-6, 6)) * (random.random((len(motion.skeleton), 1)) > 0.1)
    offsets = motion.skeleton.offsets * size
    if data.draw(st.booleans()):
        named = tuple(f"joint_{i}" for i in range(len(motion.skeleton)))
        motion = motion.with_(skeleton=replace(motion.skeleton, names=named))
    skeleton = replace(motion.skeleton, offsets=offsets)
    local = quat.normalise(
        motion.rotations
        + data.draw(st.sampled_from([0.0, 0.2, 3.0])) * random.normal(size=motion.rotations.shape)
    )
    pairs = st.tuples(st.sampled_from(ROLES), st.sampled_from(skeleton.names))
    is_sound(
        Motion(skeleton, local, np.tile(offsets, (len(motion), 1, 1)), 0.1),
        dict(data.draw(st.just([]) | st.lists(pairs, max_size=2))),
    )
