"""A change of manner as a row of numbers with names and units: what a model of emotion reads.

Left and right are taken together, as nobody is sadder on one side: turns of both sides are averaged as in a
mirror. What a body lacks has not changed.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..kinematics.body import ARM, LEG
from ..typing import Array
from .manner import Change

AXES = ("pitch", "turn", "tilt")  # about left, up and forward
SIDED = (*ARM, *LEG)
# Of these only the pitch: to one side is nobody's mood.
MIDDLE = {
    "hips": "pelvis tipped forward",
    "trunk": "trunk bent forward",
    "neck": "neck bent forward",
    "head": "head bent forward",
}
GAINS = ("head", "torso", "arm", "leg")


@dataclass(frozen=True)
class MannerFeature:
    """One number of a change: its ``name``, what it is for a person, its ``unit``, and how much is clear.

    Values are in units of ``scale``; a ``factor`` is counted by its logarithm.
    """

    name: str
    label: str
    unit: str
    scale: float
    factor: bool = False

    def said(self, value: float) -> str:
        """Return a value, in units of ``scale``, as a person says it: ``+12 degrees`` or ``x 0.62``."""
        if self.factor:
            return f"x {np.exp(value * self.scale):.2f}"
        return f"{value * self.scale:+.{1 if self.scale < 5 else 0}f} {self.unit}"


def _features() -> tuple[MannerFeature, ...]:
    found = [MannerFeature(f"{s}_pitch", label, "degrees", 10.0) for s, label in MIDDLE.items()]
    words = {"pitch": "back", "turn": "turned out", "tilt": "out"}
    for role in SIDED:
        for axis in AXES:
            found.append(MannerFeature(f"{role}_{axis}", f"{role} {words[axis]}", "degrees", 10.0))
    found.append(MannerFeature("hips_height", "hips height", "% of a leg", 3.0))
    found += [MannerFeature(f"{limb}_swing", f"{limb} movement", "", 0.33, factor=True) for limb in GAINS]
    found.append(MannerFeature("rate", "quickness", "", 0.33, factor=True))
    found.append(MannerFeature("sharpness", "jerkiness", "", 0.33, factor=True))
    return tuple(found)


FEATURES = _features()


def manner_features(change: Change) -> Array:
    """Return a change as the numbers (F,) of ``FEATURES``, each in units of its ``scale``."""
    turns = change.pose.turns
    values: dict[str, float] = {f"{s}_pitch": turns.get(s, (0.0, 0.0, 0.0))[0] for s in MIDDLE}
    for role in SIDED:
        sides = [np.array(turns.get(f"{side}_{role}", (0.0, 0.0, 0.0))) for side in ("left", "right")]
        # Seen in a mirror a turn keeps its pitch, and the others change sign. Out is to the left for the
        # left.
        both = 0.5 * (sides[0] + sides[1] * [1.0, -1.0, -1.0])
        values |= {f"{role}_{axis}": float(v) for axis, v in zip(AXES, both, strict=True)}
    values["hips_height"] = 100.0 * change.hips_height
    values |= {f"{limb}_swing": value for limb, value in _gains(change.swing).items()}
    values |= {"rate": float(np.log(change.rate)), "sharpness": float(np.log(change.sharpness))}
    return np.array([values[f.name] / f.scale for f in FEATURES])


def _gains(swing: Mapping[str, float]) -> dict[str, float]:
    """Return the logarithm of the gain of head, torso, arms and legs."""
    logs = {limb: float(np.log(gain)) for limb, gain in swing.items()}
    out = {}
    for part in GAINS:
        found = [logs[limb] for limb in (part, f"left_{part}", f"right_{part}") if limb in logs]
        out[part] = float(np.mean(found)) if found else 0.0
    return out
