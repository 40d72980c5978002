"""Whether the movement would take more strength than people have.

Torques of inverse dynamics (``kinematics.dynamics``), as multiples of what men of 18 to 25 can do. Fast
captured movements pass 1, as muscles that brake are stronger and as noise counts twice in accelerations.
"""

from .check import LASTING_FORCES, Check, Measured
from .scene import Scene


def measure(scene: Scene) -> Measured:
    """Return each joint's torque as a multiple of its strength (T, R)."""
    height = scene.body.height * scene.body.metres_per_unit
    return Measured(scene.dynamics.effort(height), scene.dynamics.joints)


CHECK = Check(
    "torque",
    "strength needed",
    "x strength",
    2,
    limit=3.0,
    tolerance=0.3,
    factor=1.5,
    measure=measure,
    lasting=LASTING_FORCES,
)
