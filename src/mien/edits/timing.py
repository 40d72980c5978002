"""Make limbs dwell and rush, or move evenly, along an unchanged path.

To the motion: each limb gets its own map of time. Added acceleration stretches the short pauses where a
movement turns and hurries in between; constant speed does the reverse. To the viewer: rushing looks fast
and powerful, evenness weak and slow (not angry, nor relaxed: Förger 2011, section 5.2).

Speeds are those of hands, feet and head relative to the hips. Nothing is longer or shorter in the end:
segments of about a second keep their length, and borders are shared, so that limbs stay together.

At impacts only, a limb hurries just before it meets something and takes the time from its wind-up, so that it
comes in hard and stops hard; all else stays. That is what the thesis saw in its actress's anger, and proposes
(section 5.2). Below 0, landings are soft.
"""

from typing import Annotated, Literal

from ..kinematics.body import Body
from ..kinematics.lead_in import lead_in, without_lead_in
from ..kinematics.limb_timing import MEETING, USUAL, Limb, Relative, impact_maps, limb_maps, loop, show
from ..kinematics.loops import Boundary
from ..kinematics.swung_feet import keep_feet
from ..motion import Motion
from ..signal.time_map import Mode, Rule
from .registry import Param, edit

HARDEST = 2.0  # times as hard as it was a stop may get at impacts


@edit(
    kind="pose",
    paper="Förger 2011, section 3.4.3; impacts: section 5.2",
    equation="a > 0: d = 1 + 9 a in short pauses; a < 0: d = 1 + |a| (s / mean s - 1) where it moves; "
    "pose at t = original at D^-1(t), D = sum d; impacts: pose at t = original at u(t), "
    "u' = 1 + (2^(a/2) - 1) sin^2 just before each impact, u' = 1 - Q sin^2 in its wind-up, u = t elsewhere",
    deviations="a pause must be prominent (0.8 of both neighbours), as rounding makes minima of even motion; "
    "minima are looked for off the grid; no limb runs above `steepest` times its speed; limbs share borders. "
    "The thesis proposes impacts in words only: how they are found and how the time runs there is ours",
)
def timing(
    motion: Motion,
    *,
    acceleration: Annotated[
        float, Param("above 0: rush, or hit harder; below 0: even, or land softer", -1.0, 1.0, neutral=0.0)
    ] = 0.0,
    where: Annotated[
        Literal["everywhere", "impacts"],
        Param("in all movement, or only just before a hand or foot meets something"),
    ] = "everywhere",
    limbs: Annotated[
        tuple[Limb, ...] | None,
        Param("limbs to retime; none: arms and head, at impacts arms and legs"),
    ] = None,
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
        Param("longest stretch that keeps its length; none: 0.9, evenly 1.5", 0.3, 60.0, unit="s"),
    ] = None,
    steepest: Annotated[float, Param("how many times faster a limb may run", 1.1, 20.0)] = 2.5,
    boundary: Annotated[Boundary, Param("treat the clip as a loop: if it is one, never, always")] = "auto",
) -> Motion:
    """Redistribute the timing of limbs along their paths, each by its own speed.

    Above 0, sets of 0.15 s around a minimum of speed last ``1 + 9 a`` times as long; longer rests are left
    alone unless ``rests``. Continuous movement such as an arm swing takes 0.3 at most before it looks
    jerky. Below 0, durations go over into speeds. Limbs that the skeleton lacks are passed over; feet of legs
    that are named slide, so that they are only for clips in place.

    At ``impacts``, the last 0.15 s (0.2 of feet) run up to ``2^(a/2)`` times as fast, so that the stop is up
    to ``2^a`` times as hard: 1 doubles it, -1 halves it. Feet are retimed only in the air. ``mode``,
    ``rests`` and ``relative`` do not matter there. Raises ``BodyError`` where no body is found.
    """
    if acceleration == 0.0 or len(motion) < 3:
        return motion
    body = Body.of(motion)
    around = loop(motion, body, boundary=boundary)
    usual = MEETING if where == "impacts" else USUAL
    chosen = usual if limbs is None else limbs
    if where == "impacts":
        pace = min(HARDEST, steepest**2) ** (0.5 * acceleration)
        walked = _captured(motion)
        maps = impact_maps(
            motion, body, pace, limbs=chosen, original=walked, longest=segment, round_length=around
        )
        return keep_feet(show(motion, body, maps), motion, body, maps)
    rule = Rule(acceleration, mode, rests, segment, steepest)
    maps = limb_maps(motion, body, rule, limbs=chosen, relative=relative, round_length=around)
    return show(motion, body, maps)


def _captured(motion: Motion) -> Motion:
    """Return the motion before its edits, as its feet stand; a still at its start is no movement."""
    before = motion.reference or motion
    return without_lead_in(before, lead_in(before))
