"""Numbers over time that say how a motion is done: how high the hips are, how fast hands and joints move."""

from collections.abc import Callable, Mapping

import numpy as np

from ..errors import MienError, unknown
from ..kinematics.body import SIDES, Body
from ..kinematics.fk import world
from ..kinematics.lead_in import still_before, without_lead_in
from ..motion import Motion
from ..signal.derivatives import derivatives
from ..typing import Array

JOINT = "joint:"  # before a joint's name: how fast that joint moves
CENTIMETRES = 100.0


def curve(motion: Motion, name: str, *, body: Body | None = None) -> tuple[str, Array]:
    """Return the unit of a curve and its values (T,): one of ``CURVES``, or ``joint:NAME``.

    Heights are above the floor of ``body``, that of the motion unless given. Speeds are of all three axes.
    Both are metric by ``body.metres_per_unit``, which is an estimate.
    Over a still before the action, such as a T-pose, curves are as if the body waited in its next pose.
    Raises ``MienError`` for another name, ``BodyError`` where no body is found.

    >>> from mien.samples import walk
    >>> unit, values = curve(walk(seconds=2.0).motion, "hips height")
    >>> unit, values.shape
    ('cm', (121,))
    """
    body = body or Body.of(motion)
    motion = without_lead_in(motion, still_before(motion))
    if name.startswith(JOINT):
        joint = name.removeprefix(JOINT)
        if joint not in motion.skeleton.names:
            raise MienError(unknown("joint", joint, motion.skeleton.names))
        return "m/s", _speed(motion, body, [motion.skeleton.names.index(joint)])
    if name not in CURVES:
        raise MienError(unknown("curve", name, [*CURVES, f"{JOINT}NAME"]))
    unit, values = CURVES[name]
    return unit, values(motion, body)


def _hips_height(motion: Motion, body: Body) -> Array:
    above = world(motion)[1][:, body.roles["hips"]] @ body.up - body.floor
    return np.asarray(above * body.metres_per_unit * CENTIMETRES)


def _hand_speed(motion: Motion, body: Body) -> Array:
    """Return the mean speed of both hands against the hips, so that walking on does not count."""
    joints = [body.roles.get(f"{s}_wrist", body.roles[f"{s}_elbow"]) for s in SIDES]
    return _speed(motion, body, joints, against=body.roles["hips"])


def _foot_speed(motion: Motion, body: Body) -> Array:
    return _speed(motion, body, [body.roles[f"{s}_ankle"] for s in SIDES])


def _hips_speed(motion: Motion, body: Body) -> Array:
    return _speed(motion, body, [body.roles["hips"]])


def _speed(motion: Motion, body: Body, joints: list[int], *, against: int | None = None) -> Array:
    """Return the mean speed (T,) of joints in metres a second."""
    points = world(motion)[1]
    moved = points[:, joints] - (0.0 if against is None else points[:, [against]])
    (velocity,) = derivatives(moved, motion.frame_time, orders=[1])
    speeds = np.linalg.norm(velocity, axis=2)
    return np.asarray(speeds.mean(axis=1) * body.metres_per_unit)


CURVES: Mapping[str, tuple[str, Callable[[Motion, Body], Array]]] = {
    "hips height": ("cm", _hips_height),
    "hips speed": ("m/s", _hips_speed),
    "hand speed": ("m/s", _hand_speed),
    "foot speed": ("m/s", _foot_speed),
}
