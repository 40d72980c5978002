"""Whether joints turn further than bodies can.

Swing and twist of each joint against the ranges of ``kinematics.joint_limits``.
"""

from ...kinematics.joint_angles import joint_angles
from .check import Check, Measured
from .scene import Scene


def measure(scene: Scene) -> Measured:
    """Return how far beyond its range each joint is (T, R), in degrees."""
    found = joint_angles(scene.motion, scene.body, scene.rotations, axes=scene.hinges)
    return Measured(found.beyond(), found.names)


CHECK = Check("limits", "joints beyond their range", "degrees", 1, limit=45.0, tolerance=5.0, measure=measure)
