"""Going over from one motion to another."""

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from mien import samples
from mien.kinematics.blending import blend
from mien.motion import Motion
from mien.rotations import quaternion as quat


def pair() -> tuple[Motion, Motion]:
    before = samples.walk(seconds=0.5, fps=30.0).motion
    random = np.random.default_rng(5)
    turned = quat.multiply(before.rotations, quat.exp(random.normal(size=(*before.rotations.shape[:2], 3))))
    moved = before.translations + random.normal(size=before.translations.shape)
    return before, before.with_(rotations=turned, translations=moved)


def test_the_ends_are_the_two_motions_exactly() -> None:
    before, after = pair()
    shape = before.rotations.shape[:2]
    for weight, wanted in ((0.0, before), (1.0, after)):
        found = blend(before, after, np.full(shape, weight))
        np.testing.assert_array_equal(np.abs(found.rotations), np.abs(wanted.rotations))
        assert found.translations.tobytes() == wanted.translations.tobytes()


def test_in_between_it_is_the_shorter_arc() -> None:
    before, after = pair()
    weights = np.random.default_rng(6).random(before.rotations.shape[:2])
    found = blend(before, after, weights)
    for frame, joint in np.ndindex(*weights.shape):
        ends = Rotation.from_quat([before.rotations[frame, joint], after.rotations[frame, joint]])
        wanted = Slerp([0.0, 1.0], ends)(weights[frame, joint])
        error = (wanted.inv() * Rotation.from_quat(found.rotations[frame, joint])).magnitude()
        assert error < 1e-7
    wanted = before.translations + weights[..., None] * (after.translations - before.translations)
    np.testing.assert_allclose(found.translations, wanted, atol=1e-12)
