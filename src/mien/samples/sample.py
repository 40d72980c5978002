"""A synthetic clip with what is known to be true of it, and how a pose becomes a clip."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TypedDict

import numpy as np

from ..errors import MienError, unknown
from ..formats.bvh import new_layout
from ..kinematics.fk import to_local
from ..motion import Motion, Skeleton
from ..rotations import quaternion
from ..typing import Array, Mask
from .figure import LEG
from .pose import Figure, about
from .skeletons import Rig, rig

FPS = 60.0
METRES = {"m": 1.0, "dm": 0.1, "cm": 0.01, "mm": 0.001, "inch": 0.0254, "foot": 0.3048}
UP = {"y": np.array([0.0, 1.0, 0.0]), "z": np.array([0.0, 0.0, 1.0])}
FORWARD = {"y": np.array([0.0, 0.0, 1.0]), "z": np.array([0.0, -1.0, 0.0])}


class Form(TypedDict, total=False):
    """How a sample is written down: frames a second, skeleton, unit, up axis, heading (radians)."""

    fps: float
    skeleton: str
    unit: str
    up: str
    heading: float


@dataclass(frozen=True, eq=False)
class Sample:
    """A synthetic clip and the truth about it.

    ``contacts`` (T, 2, 2) bool: left and right foot, heel and toe on the floor. ``angles``: joint
    angles (T,) in radians by name. ``phases`` (T,) in cycles where the motion is periodic (right heel
    strike 0, left 0.5). ``events``: times in seconds by name. ``facts``: single numbers in seconds,
    radians and the clip's own unit. ``roles``: role -> joint name. ``up``, ``forward``: unit vectors,
    where the figure faces at heading 0 turned by the heading asked for. ``leg_length`` in the clip's unit.
    """

    motion: Motion
    contacts: Mask
    angles: Mapping[str, Array]
    phases: Array | None
    events: Mapping[str, tuple[float, ...]]
    facts: Mapping[str, float]
    roles: Mapping[str, str]
    up: Array
    forward: Array
    leg_length: float
    metres_per_unit: float

    def __repr__(self) -> str:
        return f"Sample({self.motion!r}, {len(self.angles)} angles, {len(self.facts)} facts)"


@dataclass(frozen=True, eq=False)
class Truth:
    """What a sample function knows beside the pose; lengths in ``lengths`` are in metres."""

    contacts: Mask
    angles: Mapping[str, Array]
    phases: Array | None = None
    events: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    facts: Mapping[str, float] = field(default_factory=dict)
    lengths: Mapping[str, float] = field(default_factory=dict)


def times(seconds: float, form: Form) -> Array:
    """Return the frame times (T,) from 0 up to and with ``seconds``."""
    fps = form.get("fps", FPS)
    if not (np.isfinite(fps) and fps > 0):
        raise MienError(f"fps must be above 0, got {fps}")
    if not (np.isfinite(seconds) and seconds >= 0):
        raise MienError(f"seconds must be 0 or more, got {seconds}")
    return np.arange(int(np.floor(seconds * fps + 1e-6)) + 1) / fps


def sample(
    name: str,
    figure: Figure,
    truth: Truth,
    *,
    fps: float = FPS,
    skeleton: str = "standard22",
    unit: str = "cm",
    up: str = "y",
    heading: float = 0.0,
) -> Sample:
    """Write the moving figure down on a skeleton, in a unit, up axis and heading."""
    if unit not in METRES:
        raise MienError(unknown("unit", unit, METRES))
    if up not in UP:
        raise MienError(unknown("up axis", up, UP))
    if not np.isfinite(heading):
        raise MienError(f"heading must be a finite angle in radians, got {heading}")
    chosen, scale = rig(skeleton), 1.0 / METRES[unit]
    upright = about(0, 0.5 * np.pi if up == "z" else 0.0)
    motion = _motion(figure, chosen, scale, upright, heading)
    return Sample(
        motion=motion.with_(frame_time=1.0 / fps, name=name),
        contacts=truth.contacts,
        angles=truth.angles,
        phases=truth.phases,
        events=truth.events,
        facts={**truth.facts, **{k: v * scale for k, v in truth.lengths.items()}},
        roles=chosen.roles,
        up=UP[up],
        forward=quaternion.rotate(quaternion.exp(heading * UP[up]), FORWARD[up]),
        leg_length=LEG * scale,
        metres_per_unit=METRES[unit],
    )


def _motion(figure: Figure, chosen: Rig, scale: float, upright: Array, heading: float) -> Motion:
    """Return the motion on a rig, one second a frame.

    With ``U`` from y-up to the clip's up axis, ``H`` the heading, ``Q`` the segment's rotation and ``B``
    the joint's frame in it, the joint's world rotation is ``U H Q B U^-1``: where ``Q`` undoes ``B``
    the joint's axes are the world's, as in the rest pose.
    """
    down = quaternion.conjugate(upright)
    frames = quaternion.multiply(chosen.frames, down)
    turn = quaternion.multiply(upright, about(1, heading))
    world = quaternion.multiply(turn, quaternion.multiply(figure.rotations[:, chosen.segments], frames))
    world[:, chosen.segments < 0] = quaternion.IDENTITY
    frames[chosen.segments < 0] = down
    skeleton = _skeleton(chosen, frames, scale)
    rotations, translations = to_local(world, np.zeros((*world.shape[:2], 3)), chosen.parents)
    translations[:] = skeleton.offsets
    translations[:, chosen.names.index(chosen.roles["hips"])] = scale * quaternion.rotate(turn, figure.hips)
    return Motion(skeleton, quaternion.continuous(rotations), translations, frame_time=1.0)


def _skeleton(chosen: Rig, frames: Array, scale: float) -> Skeleton:
    """Return the skeleton: bones of the upright stance seen from the axes of the joint they hang on."""
    into = scale * quaternion.to_matrix(quaternion.conjugate(frames))
    parents, ends = chosen.parents, chosen.end_parents
    bones = chosen.points - chosen.points[parents]
    bones[parents < 0] = 0.0
    offsets = np.einsum("jab,jb->ja", into[parents], bones)
    tips = np.einsum("eab,eb->ea", into[ends], chosen.end_points - chosen.points[ends])
    skeleton = Skeleton(chosen.names, parents, offsets, ends, tips)
    return replace(skeleton, layout=new_layout(skeleton, chosen.channels))
