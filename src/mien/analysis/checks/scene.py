"""What every check looks at: a motion with its world transforms, feet, contacts and forces, all done once."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np

from ...kinematics.body import Body
from ...kinematics.contacts import Contacts, detect_points, foot_points
from ...kinematics.dynamics import Dynamics, dynamics
from ...kinematics.fk import end_positions, world
from ...kinematics.joint_angles import hinge_axes
from ...kinematics.lead_in import lead_in
from ...motion import Motion
from ...typing import Array


@dataclass(frozen=True, eq=False)
class Scene:
    """A motion without the still it may start with, seen by the body of the clip it was made from.

    ``start`` frames were left out. ``contacts`` and ``ground`` are those of the source, where there is one
    frame for frame: planted is what was planted there. ``centimetres`` a unit of the clip.
    """

    motion: Motion
    body: Body
    start: int
    rotations: Array
    positions: Array
    feet: Array
    contacts: Contacts
    source: Self | None = field(default=None, repr=False)

    @classmethod
    def of(cls, motion: Motion, *, source: Self | None = None) -> Self:
        """Return the scene of a motion; ``source`` is that of the clip it is compared with."""
        same = source is not None and len(motion) == source.start + len(source.motion)
        body = source.body if source else Body.of(motion)
        start = source.start if source and same else lead_in(motion)
        seen = motion[start:] if start else motion
        rotations, positions = world(seen)
        feet = foot_points(seen, body, rotations, positions)
        contacts = source.contacts if source and same else detect_points(feet, body, seen.frame_time)
        return cls(seen, body, start, rotations, positions, feet, contacts, source if same else None)

    @property
    def centimetres(self) -> float:
        """Centimetres a unit of the clip, by the body's estimate."""
        return 100.0 * self.body.metres_per_unit

    @property
    def times(self) -> Array:
        """The times of the frames in seconds (T,), counted from the start of the clip."""
        return self.motion.times + self.start * self.motion.frame_time

    @cached_property
    def ends(self) -> Array:
        """Where the end sites are (T, E, 3)."""
        return end_positions(self.motion, self.rotations, self.positions)

    @cached_property
    def hinges(self) -> list[Array]:
        """The axes (3,) that elbows and knees bend about: those of the source, as a body keeps its hinges."""
        return self.source.hinges if self.source else hinge_axes(self.motion, self.body, self.rotations)

    @cached_property
    def dynamics(self) -> Dynamics:
        """The forces that the motion takes."""
        middle, planted = self.feet.mean(axis=2), self.contacts.feet
        return dynamics(self.motion, self.body, self.rotations, self.positions, middle, planted)

    @cached_property
    def lowest(self) -> Array:
        """The height of the body's lowest point above the floor (T,), in the clip's unit."""
        skeleton, up = self.motion.skeleton, self.body.up
        below = skeleton.descendants(self.body.roles["hips"])
        tips = np.isin(skeleton.end_parents, below)
        low = np.concatenate([self.positions[:, below] @ up, self.ends[:, tips] @ up], axis=1).min(axis=1)
        return np.minimum(low, (self.feet @ up).min(axis=(1, 2))) - self.body.floor

    @cached_property
    def tips(self) -> tuple[tuple[str, ...], Array]:
        """The names and places (T, P, 3) of head, hands, feet and hips."""
        roles = self.body.roles
        names = [n for n in ("hips", "head") if n in roles]
        joints = [roles[n] for n in names]
        for side in ("left", "right"):
            names += [f"{side}_hand", f"{side}_foot"]
            joints += [roles.get(f"{side}_wrist", roles[f"{side}_elbow"]), roles[f"{side}_ankle"]]
        return tuple(names), self.positions[:, joints]
