"""Mend what an edit did to the body: limits of joints, parts inside each other, the floor, the balance.

To the motion: joints that were turned too far are turned back, arms are pushed out of the body and off each
other, what sank into the floor is lifted, and the pelvis is moved over the feet. Each only where and as far
as it is needed, smoothly in and out, and only if it is better afterwards. To the viewer: nothing, which is
the point; the edit stays what it was.

What counts as broken is what the original does not do itself, near in time: somebody who holds the hands
folded may go on doing so.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from ..errors import MienError
from ..kinematics.balancing import astray, balanced
from ..kinematics.body import Body
from ..kinematics.capsules import capsules
from ..kinematics.contacts import detect_points, spans
from ..kinematics.joint_angles import hinge_axes, joint_angles
from ..kinematics.legs import Placed
from ..kinematics.limiting import limited
from ..kinematics.raising import lowest, raised
from ..kinematics.separation import separated
from ..motion import Motion
from ..signal.bridging import envelope
from ..typing import Array
from .registry import Param, edit

What = Literal["collision", "limits", "floor", "balance"]
# What may stay beyond the original: centimetres, degrees. Of a clip by itself: of any kind.
ADDED: Mapping[What, float] = {"collision": 0.9, "limits": 2.5, "floor": 0.6, "balance": 4.0}
ALONE: Mapping[What, float] = {"collision": 4.0, "limits": 8.0, "floor": 0.6, "balance": 15.0}
NEAR = 0.15  # seconds, twice over: what the original shows so near in time may be there too
MOVED = 5e-4  # radians, or leg lengths: below, nothing was changed


@dataclass(frozen=True)
class Mend:
    """``measure`` says how bad a motion is (T, P); ``fix`` gives one with no more of it than (T, P)."""

    measure: Callable[[Placed], Array]
    fix: Callable[[Motion, Array], Motion]


@edit(
    kind="repair",
    paper="Förger 2011, section 3.5; Gleicher 1998",
    equation="least |x' - x| with measure(x') <= measure(original), near in time, + a little",
    deviations="the thesis leaves limits, collisions and balance to who looks at the result, or goes back to "
    "the original; here they are mended first",
)
def repair(
    motion: Motion,
    *,
    original: Motion | None = None,
    what: Annotated[tuple[What, ...], Param("what to mend, in this order")] = (
        "collision",
        "limits",
        "floor",
        "balance",
    ),
) -> Motion:
    """Mend limits, collisions, floor and balance where an edit made them worse than in the original.

    ``original`` is the motion before the edits, with the same skeleton and frames. Without it a clip is
    judged by itself. Arms, joints beyond their limits, and the hips are moved; planted feet stay where they
    are. A change that does not make its own measure better is left out. Raises ``MienError`` when the frames
    differ, ``BodyError`` where no body is found.
    """
    alone, original = original is None, original or motion
    if motion.rotations.shape != original.rotations.shape:
        raise MienError(
            f"repair: the original has {len(original)} frames of {len(original.skeleton)} joints, the edited "
            f"motion {len(motion)} of {len(motion.skeleton)}; both must be the same"
        )
    body = Body.of(original)
    mends = _mends(original, body)
    for name in what:
        mend = mends[name]
        unit = 1.0 if name == "limits" else 0.01 / body.metres_per_unit
        now = mend.measure(Placed.of(motion, body))
        allowed = np.full_like(now, unit * ALONE[name])
        if not alone:
            source = mend.measure(Placed.of(original, body))
            allowed = _near(source, motion.frame_time) + unit * ADDED[name]
        excess = np.maximum(now - allowed, 0.0).sum(axis=1)
        if excess.any():
            fixed = mend.fix(motion, allowed)
            left = np.maximum(mend.measure(Placed.of(fixed, body)) - allowed, 0.0).sum(axis=1)
            motion = _better(motion, fixed, excess, left, body)
    return motion


def _mends(original: Motion, body: Body) -> Mapping[What, Mend]:
    """Return how each thing is measured and mended on edits of ``original``."""
    shape, start = capsules(original, body), Placed.of(original, body)
    hinges = hinge_axes(original, body, start.rotations)
    contacts = detect_points(start.feet, body, original.frame_time)

    def depth(pose: Placed) -> Array:
        return np.maximum(shape.contacts(pose.rotations, pose.positions).depth, 0.0)

    def beyond(pose: Placed) -> Array:
        return joint_angles(pose.motion, body, pose.rotations, axes=hinges).beyond()

    def sunk(pose: Placed) -> Array:
        return np.maximum(body.floor - lowest(pose.motion, body, pose.positions), 0.0)[:, None]

    def outside(pose: Placed) -> Array:
        return np.linalg.norm(astray(pose, body, contacts), axis=1)[:, None]

    return {
        "collision": Mend(depth, lambda m, allowed: separated(m, body, allowed)),
        "limits": Mend(beyond, lambda m, allowed: limited(m, body, allowed, axes=hinges)),
        "floor": Mend(sunk, lambda m, allowed: raised(m, body, contacts, allowed[:, 0])),
        "balance": Mend(outside, lambda m, allowed: balanced(m, body, contacts, allowed[:, 0])),
    }


def _near(values: Array, frame_time: float) -> Array:
    """Return a smooth curve over what ``values`` (T, P) are within 0.3 seconds."""
    reach = round(NEAR / frame_time)
    return np.stack(
        [envelope(column, reach=reach) if column.any() else column for column in values.T], axis=1
    )


def _better(before: Motion, after: Motion, excess: Array, left: Array, body: Body) -> Motion:
    """Return ``after`` in each stretch of change in which less is left than there was, else ``before``."""
    turned = np.abs(after.rotations - before.rotations).max(axis=(1, 2))
    moved = np.abs(after.translations - before.translations).max(axis=(1, 2)) / body.leg_length
    rotations, translations = np.array(before.rotations), np.array(before.translations)
    for start, stop in spans(np.maximum(turned, moved) > MOVED):
        if left[start:stop].sum() < excess[start:stop].sum():
            rotations[start:stop] = after.rotations[start:stop]
            translations[start:stop] = after.translations[start:stop]
    return before.with_(rotations=rotations, translations=translations)
