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
# What a number above 0 is for a person, and what one below. Of the middle only the pitch: to one side is
# nobody's mood.
MIDDLE = {
    "hips": ("pelvis tipped forward", "pelvis tipped back"),
    "trunk": ("trunk bent forward", "trunk bent back"),
    "neck": ("neck bent forward", "neck bent back"),
    "head": ("head bent forward", "head bent back"),
}
SIDES = {
    "collar": (
        ("shoulders rolled forward", "shoulders rolled back"),
        ("shoulders drawn back", "shoulders drawn forward"),
        ("shoulders raised", "shoulders lowered"),
    ),
    "shoulder": (
        ("upper arms back", "upper arms forward"),
        ("upper arms turned out", "upper arms turned in"),
        ("upper arms away from the body", "upper arms nearer to the body"),
    ),
    "elbow": (
        ("elbows straighter", "elbows more bent"),
        ("forearms turned out", "forearms turned in"),
        ("forearms out", "forearms in"),
    ),
    "wrist": (
        ("hands bent back", "hands bent forward"),
        ("hands turned out", "hands turned in"),
        ("hands bent out", "hands bent in"),
    ),
    "hip": (
        ("thighs back", "thighs forward"),
        ("legs turned out", "legs turned in"),
        ("thighs apart", "thighs closer together"),
    ),
    "knee": (
        ("knees more bent", "knees straighter"),
        ("shins turned out", "shins turned in"),
        ("shins out", "shins in"),
    ),
    "ankle": (
        ("feet pointing down", "feet pointing up"),
        ("feet turned out", "feet turned in"),
        ("feet tipped out", "feet tipped in"),
    ),
    "toe": (
        ("toes pointing down", "toes pointing up"),
        ("toes turned out", "toes turned in"),
        ("toes tipped out", "toes tipped in"),
    ),
}
GAINS = ("head", "torso", "arm", "leg")


@dataclass(frozen=True)
class MannerFeature:
    """One number of a change: its ``name``, what it is for a person, its ``unit``, and how much is clear.

    ``label`` says what a value above 0 is, ``opposite`` one below, where that has another word. Values are in
    units of ``scale``; a ``factor`` is counted by its logarithm.
    """

    name: str
    label: str
    opposite: str
    unit: str
    scale: float
    factor: bool = False

    def said(self, value: float) -> tuple[str, str]:
        """Return what a value, in units of ``scale``, is for a person, and how much.

        >>> FEATURES[3].said(-1.2), FEATURES[-1].said(-1.0)
        (('head bent back', '12 degrees'), ('jerkiness', 'x 0.72'))
        """
        if self.factor:
            return self.label, f"x {np.exp(value * self.scale):.2f}"
        amount = f"{abs(value) * self.scale:.{1 if self.scale < 5 else 0}f} {self.unit}"
        return (self.label if value >= 0.0 else self.opposite), amount


def _features() -> tuple[MannerFeature, ...]:
    found = [MannerFeature(f"{s}_pitch", *both, "degrees", 10.0) for s, both in MIDDLE.items()]
    for role in SIDED:
        for axis, both in zip(AXES, SIDES[role], strict=True):
            found.append(MannerFeature(f"{role}_{axis}", *both, "degrees", 10.0))
    found.append(MannerFeature("hips_height", "hips higher", "hips lower", "% of a leg", 3.0))
    factors = [(f"{limb}_swing", f"{limb} movement") for limb in GAINS]
    factors += [("rate", "quickness"), ("sharpness", "jerkiness")]
    found += [MannerFeature(name, label, label, "", 0.33, factor=True) for name, label in factors]
    return tuple(found)


FEATURES = _features()


def manner_features(change: Change) -> Array:
    """Return a change as the numbers (F,) of ``FEATURES``, each in units of its ``scale``."""
    turns = change.pose.turns
    values: dict[str, float] = {f"{s}_pitch": turns.get(s, (0.0, 0.0, 0.0))[0] for s in MIDDLE}
    for role in SIDED:
        sides = [np.array(turns.get(f"{side}_{role}", (0.0, 0.0, 0.0))) for side in ("left", "right")]
        # Seen in a mirror a turn keeps its pitch, and the others change sign; for the left, out is left.
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
