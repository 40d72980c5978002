"""How far the joints of a body can turn, and how far beyond that they are.

Angles are those of each segment against the one it hangs on, from the calm stance: flexion and abduction
(how the bone is swung) and rotation (its twist). They say the same for every skeleton, and swing and twist
have no gimbal (the thesis could not define limits on Euler angles: Förger 2011, section 3.5).

Ranges: American Academy of Orthopaedic Surgeons, *Joint motion* (1965) and Norkin & White, *Measurement of
joint motion* (2016), the widest of the means for adults given there; the neck of Youdas et al. (1992). A foot
on the ground bends further than one in the air (50 degrees), and a hand's joint also turns the forearm.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..typing import Array
from .roles import SIDES

Pair = tuple[float, float]


@dataclass(frozen=True)
class Range:
    """What a joint can do, in degrees: (least, most) of flexion, of abduction and of rotation outward.

    A ``hinge`` bends in one plane: its ``abduction`` is how far the bone leaves that plane.
    """

    flexion: Pair
    abduction: Pair
    rotation: Pair
    hinge: bool = False


# Role -> the role it hangs on and its range. Of the trunk, flexion is forward and abduction to the left.
JOINTS: Mapping[str, tuple[str, Range]] = {
    "chest": ("hips", Range((-35, 85), (-40, 40), (-50, 50))),
    "head": ("chest", Range((-80, 60), (-50, 50), (-85, 85))),
    "shoulder": ("chest", Range((-70, 188), (-75, 188), (-110, 110))),
    "elbow": ("shoulder", Range((-15, 158), (-30, 30), (-100, 100), hinge=True)),
    "wrist": ("elbow", Range((-90, 90), (-90, 90), (-120, 120))),
    "hip": ("hips", Range((-40, 130), (-40, 60), (-60, 60))),
    "knee": ("hip", Range((-10, 158), (-20, 20), (-40, 40), hinge=True)),
    "ankle": ("knee", Range((-65, 50), (-45, 45), (-45, 45))),
}
SIDELESS = ("chest", "head")
OVERHEAD = 120.0  # degrees: beyond, swing and twist of a ball joint say nothing (they turn over at 180)


def plain(name: str) -> str:
    """Return the name of a joint without its side."""
    return name.removeprefix("left_").removeprefix("right_")


def range_of(name: str) -> Range:
    """Return what a joint can do, such as ``left_knee``."""
    return JOINTS[plain(name)][1]


NAMES = (*SIDELESS, *(f"{side}_{role}" for side in SIDES for role in JOINTS if role not in SIDELESS))


@dataclass(frozen=True, eq=False)
class JointAngles:
    """``names`` (R) such as ``left_knee``; ``angles`` (T, R, 3) flexion, abduction, rotation, in degrees."""

    names: tuple[str, ...]
    angles: Array

    def beyond(self) -> Array:
        """Return how far beyond its range each joint is (T, R), in degrees; 0 inside.

        Swing is bounded by an ellipse through the four limits, twist by its two; the larger excess counts.
        """
        ranges = [range_of(name) for name in self.names]
        flexion, abduction = self.angles[..., 0], self.angles[..., 1]
        limits = np.array([[r.flexion, r.abduction, r.rotation] for r in ranges], float)  # (R, 3, 2)
        hinge = np.array([r.hinge for r in ranges])
        over = np.maximum(limits[:, :, 0] - self.angles, self.angles - limits[:, :, 1])
        bent = np.where(flexion < 0, -limits[:, 0, 0], limits[:, 0, 1])
        aside = np.where(abduction < 0, -limits[:, 1, 0], limits[:, 1, 1])
        radius = np.hypot(flexion / bent, abduction / aside)
        swung = np.hypot(flexion, abduction) * (1.0 - 1.0 / np.maximum(radius, 1.0))
        swing = np.where(hinge, np.maximum(over[..., 0], over[..., 1]), swung)
        ball = np.array([plain(name) in ("shoulder", "hip") for name in self.names])
        raised = ball & (np.hypot(flexion, abduction) > OVERHEAD)
        return np.where(raised, 0.0, np.maximum(np.maximum(swing, over[..., 2]), 0.0))
