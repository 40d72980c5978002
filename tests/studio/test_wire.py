"""Motions as bytes: read back by a reader of its own, they are the motion."""

from collections.abc import Callable

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect
from mien.kinematics.fk import fk
from mien.motion import Motion
from mien.render.wire import encode
from mien.samples import SKELETONS
from mien.studio.square import encode_square


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_world_positions_come_back(skeleton: str, decode: Callable) -> None:
    motion = samples.walk(seconds=1.0, skeleton=skeleton, unit="cm").motion
    head, arrays = decode(encode(motion, "x"))
    translations = np.repeat(arrays["offsets"][None], head["frames"], axis=0)
    translations[:, head["moving"]] = arrays["translations"]
    got = fk(arrays["rotations"].astype(float), translations, np.array(head["parents"]))[1]
    want = fk(motion.rotations, motion.translations, motion.skeleton.parents)[1]
    assert np.abs(got - want).max() * head["metres"] < 1e-4
    assert head["joints"] == list(motion.skeleton.names)


def test_the_head_tells_the_body(decode: Callable) -> None:
    motion = samples.walk(seconds=1.0, unit="dm", up="z").motion
    head, arrays = decode(encode(motion, "x", notes=["said"]))
    body = Body.of(motion)
    assert head["shape"]["roles"] == body.roles
    assert head["metres"] == pytest.approx(0.1, rel=0.1)
    assert np.allclose(head["left"], body.left)
    assert np.allclose(head["up"], [0, 0, 1])
    assert head["notes"] == ["said"]
    assert np.array_equal(arrays["contacts"], detect(motion).feet)


def test_without_a_body_there_are_sticks(decode: Callable, rope: Motion) -> None:
    head, arrays = decode(encode(rope, "x"))
    assert head["shape"] is None
    assert head["drawn"]
    assert not arrays["contacts"].any()


def test_the_square_has_nine_motions_with_the_original_in_the_middle(decode: Callable) -> None:
    from mien.render.figure import Figure

    motion = samples.walk(seconds=1.5).motion
    head, arrays = decode(encode_square(motion, "x", like=Figure.of(motion)))
    assert sorted(arrays) == sorted(f"{a}_{c}" for a in ("rotations", "translations") for c in "ABCDEFGHI")
    assert np.array_equal(arrays["rotations_E"], motion.rotations.astype("<f4"))
    exact = samples.walk(seconds=1.5).motion
    import mien

    corner = mien.grid(exact).at(2, 0)
    assert np.array_equal(arrays["rotations_I"], corner.rotations.astype("<f4"))
    translations = np.repeat(exact.translations[:1], len(exact), axis=0).astype("<f4")
    translations[:, head["moving"]] = arrays["translations_I"]
    assert np.allclose(translations, corner.translations, atol=1e-4)
