"""Make limbs dwell and rush, or move evenly, along an unchanged path.

To the motion: each limb gets its own map of time. Added acceleration stretches the short pauses where a
movement turns and hurries in between; constant speed does the reverse. To the viewer: rushing looks fast
and powerful, evenness weak and slow (not angry, nor relaxed: Förger 2011, section 5.2).

Speeds are those of hands, feet and head relative to the hips. Nothing is longer or shorter in the end:
segments of about a second keep their length, and borders are shared, so that limbs stay together.
"""

from typing import Annotated

from ..kinematics.body import Body
from ..kinematics.limb_timing import USUAL, Limb, Relative, limb_maps, loop, show
from ..kinematics.loops import Boundary
from ..motion import Motion
from ..signal.time_map import Mode, Rule
from .registry import Param, edit


@edit(
    kind="pose",
    paper="Förger 2011, section 3.4.3",
    equation="a > 0: d = 1 + 9 a in short pauses; a < 0: d = 1 + |a| (s / mean s - 1) where it moves; "
    "pose at t = original at D^-1(t), D = sum d",
    deviations="a pause must be prominent (0.8 of both neighbours), as rounding makes minima of even motion; "
    "minima are looked for off the grid; no limb runs above `steepest` times its speed; limbs share borders",
)
def timing(
    motion: Motion,
    *,
    acceleration: Annotated[
        float, Param("above 0: dwell and rush; below 0: constant speed", -1.0, 1.0, neutral=0.0)
    ] = 0.0,
    limbs: Annotated[
        tuple[Limb, ...], Param("limbs to retime; feet slide, so that legs are only for clips in place")
    ] = USUAL,
    mode: Annotated[
        Mode, Param("pauses at minima of speed, or in the thesis's fixed sets of 0.15 s")
    ] = "peaks",
    rests: Annotated[
        bool, Param("added acceleration also lengthens long rests, so that single actions rush too")
    ] = False,
    relative: Annotated[
        Relative,
        Param("speed relative to the place of the hips, or also to the heading"),
    ] = "position",
    segment: Annotated[
        float | None,
        Param("longest stretch that keeps its length; none: 0.9 accelerated, 1.5 even", 0.3, 60.0, unit="s"),
    ] = None,
    steepest: Annotated[float, Param("how many times faster a limb may run", 1.1, 20.0)] = 2.5,
    boundary: Annotated[Boundary, Param("treat the clip as a loop: if it is one, never, always")] = "auto",
) -> Motion:
    """Redistribute the timing of limbs along their paths, each by its own speed.

    Above 0, sets of 0.15 s around a minimum of speed last ``1 + 9 a`` times as long; longer rests are left
    alone unless ``rests``. Continuous movement such as an arm swing takes 0.3 at most before it looks
    jerky. Below 0, durations go over into speeds. Limbs that the skeleton lacks are passed over. Raises
    ``BodyError`` where no body is found.
    """
    if acceleration == 0.0 or len(motion) < 3:
        return motion
    body = Body.of(motion)
    rule = Rule(acceleration, mode, rests, segment, steepest)
    around = loop(motion, body, boundary=boundary)
    maps = limb_maps(motion, body, rule, limbs=limbs, relative=relative, round_length=around)
    return show(motion, body, maps)
