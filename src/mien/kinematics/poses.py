"""Poses: how a held body differs from a calm upright one, said without any skeleton.

A pose gives each segment of the body a turn: a rotation vector in degrees about the body's own left,
up and forward axes, measured from the same segment of the neutral stance and relative to the segment
it hangs on. So the pose of one actor can be put on another, whatever the bones' names, lengths and
local axes. ``trunk`` and ``neck`` are whole chains: their turn is shared evenly by their joints.

Positive turns about left pitch forward (the head nods, the arm swings back); about up turn left;
about forward tip to the body's right (the left arm goes out).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self
from weakref import WeakKeyDictionary

import numpy as np

from ..errors import RecipeError, unknown
from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .body import ARM, LEG, SIDES, Body
from .fk import fk, world
from .heading import heading_rotation

Turn = tuple[float, float, float]

LIMB_SEGMENTS = tuple(f"{side}_{role}" for side in SIDES for role in ARM + LEG)
SEGMENTS = ("hips", "trunk", "neck", "head", *LIMB_SEGMENTS)

# A segment that a skeleton lacks hands its turn to another; without one, the turn is left out.
HEIRS = {"neck": "head", "head": "neck", "left_collar": "left_shoulder", "right_collar": "right_shoulder"}

# Published as words only (Förger 2011, section 5.1); the degrees are ours.
POSES: Mapping[str, Mapping[str, float]] = {
    "head_down": {"head": 25.0},
    "elbows_out": {"arms": 20.0, "elbows": 10.0},
    "arms_legs_in": {"arms": -8.0, "legs": -4.0},
}


@dataclass(frozen=True)
class Pose:
    """The turns of some segments: ``turns`` segment -> degrees about (left, up, forward)."""

    turns: Mapping[str, Turn] = field(default_factory=dict)

    def __post_init__(self) -> None:
        turns = {}
        for segment, turn in self.turns.items():
            if segment not in SEGMENTS:
                raise RecipeError("pose: " + unknown("segment", segment, SEGMENTS))
            values = tuple(float(v) for v in turn)
            if len(values) != 3 or not np.isfinite(values).all():
                raise RecipeError(f"pose: {segment} needs three numbers in degrees, got {list(turn)}")
            turns[segment] = values
        object.__setattr__(self, "turns", turns)

    def __str__(self) -> str:
        """Return the pose as one line, e.g. ``head 25 0 0; trunk 5 0 0``: what a recipe holds."""
        return "; ".join(" ".join([s, *map(_short, turn)]) for s, turn in self.turns.items())

    def __mul__(self, amount: float) -> Self:
        """Return the pose at another strength."""
        return type(self)({s: (amount * x, amount * y, amount * z) for s, (x, y, z) in self.turns.items()})

    def __add__(self, other: "Pose") -> Self:
        """Return both poses at once (turns add up)."""
        sums = {s: np.zeros(3) for s in (*self.turns, *other.turns)}
        for turns in (self.turns, other.turns):
            for segment, turn in turns.items():
                sums[segment] = sums[segment] + turn
        return type(self)({s: (float(v[0]), float(v[1]), float(v[2])) for s, v in sums.items()})

    @classmethod
    def parse(cls, text: str) -> Self:
        """Read the line that ``str(pose)`` writes."""
        turns: dict[str, Turn] = {}
        for item in filter(None, (part.strip() for part in text.split(";"))):
            segment, *numbers = item.split()
            try:
                x, y, z = map(float, numbers)
            except ValueError:
                raise RecipeError(f"pose: {item!r} is not a segment and three numbers in degrees") from None
            turns[segment] = (x, y, z)
        return cls(turns)


def _short(value: float) -> str:
    return str(int(value)) if value == int(value) else repr(value)


def named_pose(text: str) -> tuple[Mapping[str, float], Pose]:
    """Return what a pose parameter means: the posture values of a named pose, or a pose in one line."""
    if text in POSES:
        return POSES[text], Pose()
    if text in ("", "none"):
        return {}, Pose()
    if text.endswith(".toml"):
        raise RecipeError(
            f"a recipe holds the pose itself, so that it stays true when the file changes: "
            f"give str(mien.kinematics.poses.read_pose({text!r}))"
        )
    if " " not in text.strip():
        raise RecipeError(unknown("pose", text, [*POSES, "none"]))
    return {}, Pose.parse(text)


def posture_pose(values: Mapping[str, float]) -> Pose:
    """Return the turns of each segment, both sides alike, for values in degrees of the edit ``posture``.

    Those are ``head``, ``trunk``, ``lean``, ``shoulders``, ``arms``, ``arms_forward``, ``elbows`` and
    ``legs``; any that is left out is 0.
    """
    head, trunk, lean, shoulders = (values.get(name, 0.0) for name in ("head", "trunk", "lean", "shoulders"))
    turns = {"hips": (lean, 0.0, 0.0), "trunk": (trunk, 0.0, 0.0)}
    turns |= {"neck": (0.5 * head, 0.0, 0.0), "head": (0.5 * head, 0.0, 0.0)}
    arms, legs = values.get("arms", 0.0), values.get("legs", 0.0)
    for side in SIDES:
        out = 1.0 if side == "left" else -1.0
        turns[f"{side}_collar"] = (0.0, 0.0, out * shoulders)
        # What trunk and shoulders do above them is taken back, as arms hang by their weight.
        forward = values.get("arms_forward", 0.0) + trunk + lean
        turns[f"{side}_shoulder"] = (-forward, 0.0, out * (arms - shoulders))
        turns[f"{side}_elbow"] = (-values.get("elbows", 0.0), 0.0, 0.0)
        turns[f"{side}_hip"] = (0.0, 0.0, out * legs)
        turns[f"{side}_ankle"] = (-lean, 0.0, -out * legs)  # soles stay level
    return Pose({segment: turn for segment, turn in turns.items() if any(turn)})


def read_table(path: str | Path, *, kind: str) -> dict[str, Any]:
    """Return what is in a TOML file; raise ``RecipeError`` where it is not there or is not ``kind``."""
    import tomllib

    try:
        return tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise RecipeError(f"{path}: there is no such file") from None
    except OSError as error:
        raise RecipeError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise RecipeError(f"{path}: not {kind}: {error}") from None


def read_pose(path: str | Path) -> Pose:
    """Read a pose file (TOML: a table ``turns`` of segment = [left, up, forward] in degrees)."""
    turns = read_table(path, kind="a pose file").get("turns")
    if not isinstance(turns, dict):
        raise RecipeError(f"{path}: a pose file has a table [turns], e.g. head = [25, 0, 0]")
    try:
        return Pose(turns)
    except (RecipeError, TypeError, ValueError) as error:
        raise RecipeError(f"{path}: {error}") from None


def write_pose(path: str | Path, pose: Pose) -> None:
    """Write a pose file that ``read_pose`` reads back to the same numbers."""
    rows = [f"{s} = [{', '.join(map(repr, turn))}]" for s, turn in pose.turns.items()]
    head = "# Degrees about the body's left, up and forward axes, from the neutral pose.\n\n[turns]\n"
    Path(path).write_text(head + "\n".join(rows) + "\n", encoding="utf-8")


def pose_between(neutral: Motion, changed: Motion) -> Pose:
    """Return how ``changed`` is held differently from ``neutral``: ``v = log(N^T P)`` for each segment.

    Both are stills or short clips (their mean pose is taken) of the same actor. Where they stand and
    which way they face does not matter; the pitch and roll of the hips do (Förger 2011, section 3.4.2).
    """
    body = Body.of(neutral)
    same = neutral.skeleton.names == changed.skeleton.names
    before = _mean_segments(neutral, body)
    after = _mean_segments(changed, body if same else Body.of(changed))
    turns: dict[str, Turn] = {}
    for segment in SEGMENTS:
        if segment in before and segment in after:
            v = quaternion.log(quaternion.multiply(quaternion.conjugate(before[segment]), after[segment]))
            x, y, z = np.degrees(v)
            turns[segment] = (float(x), 0.0 if segment == "hips" else float(y), float(z))
    return Pose(turns)


def segment_joints(body: Body) -> dict[str, tuple[int, ...]]:
    """Return segment -> the joints that carry it, for the segments this body has."""
    limbs = {s: (body.roles[s],) for s in ("hips", "head", *LIMB_SEGMENTS) if s in body.roles}
    chains = {"trunk": body.spine, "neck": tuple(j for j in body.neck if j != body.roles.get("head"))}
    return {**limbs, **{name: joints for name, joints in chains.items() if joints}}


def neutral_world(motion: Motion, body: Body) -> tuple[Array, Array]:
    """Return the world rotations (J, 4) and positions (J, 3) of the neutral stance of this skeleton."""
    key = motion.translations[0].tobytes()
    known = _STANCES.get(body)
    if known is None or known[0] != key:
        rotations, positions = fk(body.neutral[None], motion.translations[:1], motion.skeleton.parents)
        for shared in (rotations, positions):
            shared.setflags(write=False)
        known = _STANCES[body] = key, rotations[0], positions[0]
    return known[1:]


# The stance that was asked for last, as it is asked for again and again while one motion is worked on.
_STANCES: WeakKeyDictionary[Body, tuple[bytes, Array, Array]] = WeakKeyDictionary()


def anatomical_axes(body: Body) -> Array:
    """Return the body's left, up and forward axes as the rows of a (3, 3) array, in world axes."""
    return np.stack([body.left, body.up, body.forward])


def segment_rotations(motion: Motion, body: Body) -> dict[str, Array]:
    """Return segment -> its rotations (T, 4) against its parent segment, in anatomical axes.

    The first segment, the hips, is told against the heading of the body. In the neutral stance all are one.
    """
    rotations, positions = world(motion)
    facing = quaternion.conjugate(heading_rotation(positions, body))
    stance = quaternion.conjugate(neutral_world(motion, body)[0])
    joints = segment_joints(body)
    upright = {
        s: quaternion.multiply(facing, quaternion.multiply(rotations[:, js[-1]], stance[js[-1]]))
        for s, js in joints.items()
    }
    out = {}
    for segment, rotation in upright.items():
        base = next((name for name in _ancestors(segment) if name in upright), None)
        turned = (
            rotation if base is None else quaternion.multiply(quaternion.conjugate(upright[base]), rotation)
        )
        out[segment] = _in_axes(turned, anatomical_axes(body))
    return out


def mean_rotation(q: Array) -> Array:
    """Return the mean rotation (4,) of (T, 4): the main axis of the sum of ``q q^T`` (Markley 2007)."""
    values, vectors = np.linalg.eigh(q.T @ q)
    main: Array = vectors[:, np.argmax(values)]
    return main


def _mean_segments(motion: Motion, body: Body) -> dict[str, Array]:
    return {name: mean_rotation(q) for name, q in segment_rotations(motion, body).items()}


def _ancestors(segment: str) -> list[str]:
    """Return the segments that ``segment`` may hang on, nearest first."""
    side, _, role = segment.partition("_")
    if role in ARM:
        return [*(f"{side}_{r}" for r in ARM[: ARM.index(role)][::-1]), "trunk", "hips"]
    if role in LEG:
        return [*(f"{side}_{r}" for r in LEG[: LEG.index(role)][::-1]), "hips"]
    core = ["hips", "trunk", "neck", "head"]
    return core[: core.index(segment)][::-1]


def _in_axes(q: Array, axes: Array) -> Array:
    """Return rotations with their axes given by components along the rows of ``axes``."""
    return np.concatenate([q[..., :3] @ axes.T, q[..., 3:]], axis=-1)
