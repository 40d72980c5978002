"""Change small and large movement apart: the size of every joint's movement goes through a curve.

To the motion: where a joint is near its slow mean it moves by another gain than where it is far away, and
it may be stopped softly before it goes too far. Where and when it moves stays. To the viewer: small
movement less and large as it was looks composed, every gesture meant; small movement more and large less
looks restless and held in at once; a limit looks stiff, as in too tight a coat.

``path_length`` has one gain for all sizes, but several for fast and slow. Feet move: let ``foot_plant``
follow.
"""

from collections.abc import Sequence
from typing import Annotated

import numpy as np

from ..kinematics.body import Body
from ..kinematics.heading import heading_free
from ..kinematics.loops import Boundary, period
from ..kinematics.smoothing import slow_mean
from ..motion import Motion
from ..rotations import quaternion
from ..signal.waveshaping import smooth_step, soft_limit, two_gains
from ..typing import Array
from .registry import Param, edit

NO_LIMIT = 180.0  # degrees
# How clear a mean must be to be any use, and for all: joints that go round and round are left alone.
UNCLEAR, CLEAR = 0.3, 0.6
# Cosine of half the way from the mean: from half a turn away, to three quarters, all is left alone too,
# as at a whole turn the direction of the way back is lost.
HALF_TURN, TOO_FAR = 0.0, -0.7


@edit(
    kind="pose",
    paper="Bruderlin & Williams 1995",
    equation="R' = M exp(f(|d|) d / |d|),  d = log(M^-1 R),  M = slow mean of R,  "
    "f(x) = large x + (small - large) border arctan(x / border)",
    deviations="the paper draws a curve for each Euler angle; here there is one for the angle from the slow "
    "mean, about whatever axis, so that nothing depends on how a file writes angles. The paper has soft "
    "limits, their exponential is ours. The hips' heading is left alone",
)
def waveshape(
    motion: Motion,
    *,
    small: Annotated[float, Param("gain of small movement", 0.0, 3.0, neutral=1.0)] = 1.0,
    large: Annotated[float, Param("gain of large movement", 0.0, 2.0, neutral=1.0)] = 1.0,
    border: Annotated[
        float,
        Param("angle from the mean at which small goes over into large", 1.0, 60.0, "degrees"),
    ] = 10.0,
    limit: Annotated[
        float,
        Param("no joint goes further from its mean; 180 is no limit", 5.0, NO_LIMIT, "degrees", NO_LIMIT),
    ] = NO_LIMIT,
    boundary: Annotated[
        Boundary,
        Param("beyond the ends: hold the pose, go round as a loop, or go round if it is a loop"),
    ] = "auto",
    joints: Sequence[int] | None = None,
) -> Motion:
    """Change small and large movement apart, and stop it softly before it goes too far.

    The angle between a joint and its slow mean (below 1 Hz) goes through the curve ``f``, whose slope is
    ``small`` at 0, ``large`` far away, and half way between them at ``border``. It never makes an angle
    larger than half a turn. The result stays as it is up to half the ``limit`` and never goes beyond it.
    ``small`` above 1 makes the noise of a body at rest larger too. ``joints`` limits the work.
    Raises ``BodyError`` where no body is found.
    """
    if small == large == 1.0 and limit >= NO_LIMIT:
        return motion
    body = Body.of(motion)
    hips = body.roles["hips"]
    below = motion.skeleton.descendants(hips)
    rotations, frame = heading_free(motion, body, steady=True)
    frames = period(rotations[:, below], boundary)
    wanted = below if joints is None else [j for j in below if j in set(joints)]
    some = quaternion.continuous(rotations[:, wanted])
    mean, clear = slow_mean(some, motion.fps, frames=frames)
    away = quaternion.multiply(quaternion.conjugate(mean), some)
    shaped = _resized(away, clear, small, large, np.radians(border), np.radians(limit))
    rotations[:, wanted] = quaternion.multiply(mean, shaped)
    rotations[:, hips] = quaternion.multiply(frame, rotations[:, hips])
    return motion.with_(rotations=quaternion.continuous(rotations))


def _resized(away: Array, clear: Array, small: float, large: float, border: float, limit: float) -> Array:
    """Return the rotations ``away`` (T, J, 4) from the mean with their angles put through the curve.

    Their signs are kept: an angle may be above half a turn (up to a whole one), and so never jumps.
    """
    sine = np.sqrt(np.einsum("tji,tji->tj", away[..., :3], away[..., :3]))
    angle = 2.0 * np.arctan2(sine, away[..., 3])
    gained = two_gains(angle, small=small, large=large, border=border)
    room = np.maximum(np.pi - angle, 0.0)
    wanted = _limited(angle + soft_limit(gained - angle, room, 0.5 * room), limit)
    trusted = smooth_step(clear, UNCLEAR, CLEAR) * smooth_step(away[..., 3], TOO_FAR, HALF_TURN)
    angle = angle + trusted * (wanted - angle)
    still = sine < 1e-9
    scale = np.where(still, 1.0, np.sin(0.5 * angle) / np.where(still, 1.0, sine))
    return quaternion.normalise(
        np.concatenate([scale[..., None] * away[..., :3], np.cos(0.5 * angle)[..., None]], axis=-1)
    )


def _limited(angle: Array, limit: float) -> Array:
    """Return angles softly limited; the limit gets harder towards half a turn, where it is none."""
    if limit >= np.pi:
        return angle
    return soft_limit(angle, limit, min(0.5 * limit, np.pi - limit))
