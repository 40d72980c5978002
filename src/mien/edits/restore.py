"""Go back towards the motion before the edits, on some body parts or for a while.

To the motion: poses are blended with those of the original at the same moment; the way over the ground is
left as it is. To the viewer: less of the edit. It is the thesis's last resort, to revert an edit where it
breaks the body (Förger 2011, section 3.5), by degrees, and only for the limb and the time that need it.
"""

from typing import Annotated

import numpy as np

from ..errors import MienError
from ..kinematics.blending import blend
from ..kinematics.body import Body
from ..kinematics.fk import world
from ..kinematics.legs import Placed, shifted
from ..motion import Motion
from .registry import Param, edit


@edit(
    kind="pose",
    paper="Förger 2011, section 3.5",
    equation="q' = q (q^-1 q_original)^amount for every joint; height of the hips likewise",
    deviations="by degrees, per limb and time span, where the thesis goes back altogether",
)
def restore(
    motion: Motion,
    *,
    original: Motion | None = None,
    amount: Annotated[float, Param("0 the edit, 1 the original", 0.0, 1.0, neutral=0.0)] = 0.0,
    travel: Annotated[bool, Param("also go back to the original's way over the ground")] = False,
    why: Annotated[str, Param("what it is for; changes nothing")] = "",
) -> Motion:
    """Blend every pose with the original's at that moment; without ``travel`` the way stays that of the edit.

    ``original`` is the motion before the edits, with the same skeleton and frames. Feet may slide
    afterwards: put ``foot_plant`` behind it. Raises ``MienError`` when the frames differ, ``BodyError`` where
    no body is found.
    """
    original = original or motion
    if motion.rotations.shape != original.rotations.shape:
        raise MienError(
            f"restore: the original has {len(original)} frames of {len(original.skeleton)} joints, the "
            f"edited motion {len(motion)} of {len(motion.skeleton)}; both must be the same"
        )
    if amount == 0.0:
        return motion
    body = Body.of(original)
    out = blend(motion, original, np.full(motion.rotations.shape[:2], amount))
    if travel:
        return out
    hips = body.roles["hips"]
    here, there = world(motion)[1][:, hips], Placed.of(out, body)
    away = here - there.positions[:, hips]
    return shifted(there, away - (away @ body.up)[:, None] * body.up, body).motion
