"""What changed between two motions of the same skeleton, joint by joint and in sum."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import MienError
from ..kinematics.body import Body
from ..kinematics.fk import world
from ..motion import Motion, require_motion
from ..rotations import quaternion
from ..typing import Array, Integers
from .measures import MEASURES, Footing, measures


@dataclass(frozen=True)
class Change:
    """One measure before and after an edit."""

    name: str
    label: str
    unit: str
    digits: int
    before: float
    after: float


@dataclass(frozen=True, eq=False)
class Comparison:
    """What changed from ``a`` to ``b``.

    ``joints`` (J) names; ``rotation_mean`` and ``rotation_max`` (J) the angle in degrees between the
    local rotations; ``distance_mean`` and ``distance_max`` (J) between the joints' places as seen from
    the hips, ``hips_mean`` and ``hips_max`` between the hips' places in the world: all in leg lengths.
    ``tips`` names the joints at the ends of the limbs. ``aligned`` says which frames were compared.
    """

    joints: tuple[str, ...]
    rotation_mean: Array
    rotation_max: Array
    distance_mean: Array
    distance_max: Array
    hips_mean: float
    hips_max: float
    tips: tuple[str, ...]
    aligned: str
    centimetres: float
    changes: tuple[Change, ...]

    def __repr__(self) -> str:
        said = "nothing differs" if self.same else f"turned up to {self.rotation_max.max():.1f} degrees"
        return f"Comparison({len(self.joints)} joints, {self.aligned}: {said})"

    @property
    def same(self) -> bool:
        """Whether nothing moves differently: under a millionth of a degree and of a leg length."""
        parts = (self.rotation_max.max(), self.distance_max.max(), self.hips_max)
        return bool(max(parts) < 1e-6) and self.aligned == FRAMES

    def as_data(self) -> dict[str, Any]:
        """Return everything as plain data, for JSON."""
        columns = (self.rotation_mean, self.rotation_max, self.distance_mean, self.distance_max)
        keys = ("rotation_mean_degrees", "rotation_max_degrees", "distance_mean_legs", "distance_max_legs")
        rows = zip(self.joints, *(column.tolist() for column in columns), strict=True)
        return {
            "same": self.same,
            "aligned": self.aligned,
            "centimetres_per_leg": self.centimetres,
            "hips_mean_legs": self.hips_mean,
            "hips_max_legs": self.hips_max,
            "tips": list(self.tips),
            "joints": [{"joint": name, **dict(zip(keys, row, strict=True))} for name, *row in rows],
            "measures": [
                {"name": c.name, "unit": c.unit, "before": c.before, "after": c.after} for c in self.changes
            ],
        }


FRAMES = "frame by frame"
SHARES = "at the same share of each clip's length"


def compare(a: Motion, b: Motion) -> Comparison:
    """Return what changed from ``a`` to ``b``: two motions whose joints have the same names.

    Clips with the same number of frames are compared frame by frame, others at the same share of
    their length. Order of the joints, unit and place do not matter. The measures in ``changes`` are those
    of ``before_after`` where ``b`` was made from ``a`` by editing it; else each clip is judged where its own
    feet stand. Raises ``MienError`` naming the joints that only one of them has.
    """
    require_motion(a)
    require_motion(b)
    order = _same_joints(a, b)
    first, second, aligned = _frames(a, b)
    bodies = Body.of(a), Body.of(b)
    local = quaternion.multiply(quaternion.conjugate(a.rotations[first]), b.rotations[second][:, order])
    angle = np.degrees(np.linalg.norm(quaternion.log(local), axis=-1))
    places = [_places(motion, body) for motion, body in zip((a, b), bodies, strict=True)]
    (hips_a, joints_a), (hips_b, joints_b) = places
    apart = np.linalg.norm(joints_a[first] - joints_b[second][:, order], axis=-1)
    strayed = np.linalg.norm(hips_a[first] - hips_b[second], axis=-1)
    return Comparison(
        joints=a.skeleton.names,
        rotation_mean=angle.mean(axis=0),
        rotation_max=angle.max(axis=0),
        distance_mean=apart.mean(axis=0),
        distance_max=apart.max(axis=0),
        hips_mean=float(strayed.mean()),
        hips_max=float(strayed.max()),
        tips=_tips(a, bodies[0]),
        aligned=aligned,
        centimetres=100.0 * bodies[0].metres_per_unit * bodies[0].leg_length,
        changes=before_after(a, b) if _made_from(a, b) else _changes(measures(a), measures(b)),
    )


def before_after(before: Motion, after: Motion) -> tuple[Change, ...]:
    """Return every measure of ``analysis.measures`` before and after an edit.

    With the same skeleton and number of frames, the feet of ``after`` are judged where those of
    ``before`` stood; else each clip is judged by itself. For two clips of which neither was made from
    the other, use ``compare``.
    """
    body = Body.of(require_motion(before))
    footing = Footing.of(before, body)
    first = measures(before, body=body, footing=footing)
    edited = before.skeleton.names == require_motion(after).skeleton.names and len(before) == len(after)
    return _changes(first, measures(after, body=body, footing=footing) if edited else measures(after))


def _made_from(a: Motion, b: Motion) -> bool:
    """Return whether ``b`` is an edit of ``a`` whose frames and sides are still those of ``a``."""
    return b.reference is not None and (b.reference is a or b.reference is a.reference)


def _changes(first: Mapping[str, float], second: Mapping[str, float]) -> tuple[Change, ...]:
    return tuple(
        Change(name, m.label, m.unit, m.digits, first[name], second[name]) for name, m in MEASURES.items()
    )


def _same_joints(a: Motion, b: Motion) -> list[int]:
    """Return where each joint of ``a`` stands in ``b``."""
    there = {name: index for index, name in enumerate(b.skeleton.names)}
    here = set(a.skeleton.names)
    lost, added = [n for n in a.skeleton.names if n not in there], [n for n in there if n not in here]
    if lost or added:
        some = ", ".join([*lost, *added][:6])
        raise MienError(
            f"the clips have different skeletons: only in the first {len(lost)}, only in the second "
            f"{len(added)} joints ({some}); compare clips of one skeleton"
        )
    return [there[name] for name in a.skeleton.names]


def _frames(a: Motion, b: Motion) -> tuple[Integers, Integers, str]:
    """Return the frames of both to compare, and how they were chosen."""
    if len(a) == len(b):
        return np.arange(len(a)), np.arange(len(b)), FRAMES
    share = np.linspace(0.0, 1.0, max(len(a), len(b)))
    first, second = (np.rint(share * (len(m) - 1)).astype(np.int64) for m in (a, b))
    return first, second, SHARES


def _places(motion: Motion, body: Body) -> tuple[Array, Array]:
    """Return the hips (T, 3) in the world and the joints (T, J, 3) seen from them, in leg lengths."""
    positions = world(motion)[1] / body.leg_length
    hips = positions[:, body.roles["hips"]]
    return hips, positions - hips[:, None]


def _tips(motion: Motion, body: Body) -> tuple[str, ...]:
    """Return the names of the head and of the last joint of every limb."""
    return tuple(motion.skeleton.names[joints[-1]] for joints in body.limbs.values() if joints)
