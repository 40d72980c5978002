"""Swap left and right: the motion as a mirror shows it.

To the motion: every joint does what its partner did, seen in a mirror that stands along the way the
clip starts, so it starts at the same place with the same heading and turns the other way. To the viewer: a
right-handed wave becomes a left-handed one.
"""

from ..kinematics.body import Body
from ..kinematics.mirroring import mirrored
from ..motion import Motion
from .registry import edit


@edit(
    kind="time",
    paper="",
    equation="W'_j = Y S (Y^-1 W_m N_m^-1) S N_j for partners j, m; S reflects left to right",
    deviations="goes through world rotations from the neutral stance, so the rest pose need not be symmetric",
)
def mirror(motion: Motion) -> Motion:
    """Swap left and right, about the vertical plane the hips face along in the first frame.

    Bones keep their lengths, so a body that is not symmetric itself gives a slightly different picture.
    Twice is the motion again (1e-9). Fingers and twist joints follow by name or place; a joint without
    a partner keeps its local rotation.
    """
    rotations, translations = mirrored(motion, Body.of(motion))
    return motion.with_(rotations=rotations, translations=translations)
