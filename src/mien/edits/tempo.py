"""Do it faster or slower: the whole body in another time.

To the motion: everything happens ``rate`` times as fast, so the clip gets shorter or longer. Planted feet
stay, as they are shown standing at other moments. What flies goes on falling by gravity: a jump is shown at
its own pace, or nearly, and in the short flights of a run the bounce gets lower where they get shorter. To
the viewer: quick reads as excited, happy or angry, slow as sad, tired or calm (Gross et al. 2012; Halovic &
Kroos 2018).

With ``travel="speed"`` the cadence changes while the speed over the ground stays: quicker steps are shorter.
"""

from typing import Annotated, Literal

import numpy as np

from ..kinematics.body import Body
from ..kinematics.lead_in import lead_in
from ..kinematics.resampling import sampled
from ..kinematics.retiming import frames_at, free_flight, kept_speed
from ..motion import Motion
from ..typing import Array
from .registry import Param, edit


@edit(
    kind="rhythm",
    paper="Förger 2011, section 5.2; Halovic & Kroos 2018",
    equation="u'(t) = r(u); in flight: height above the line from take-off to landing x 1 / r^2",
    deviations="the thesis left the length of clips alone, and names a change of it as what excited, relaxed "
    "and angry lack",
)
def tempo(
    motion: Motion,
    *,
    original: Motion | None = None,
    rate: Annotated[float | Array, Param("how many times as fast", 0.25, 4.0, neutral=1.0)] = 1.0,
    travel: Annotated[
        Literal["steps", "speed"],
        Param("what stays as it is: the length of steps, or the speed over the ground"),
    ] = "steps",
    flight: Annotated[
        Literal["gravity", "free"], Param("flights fall by gravity, or change their time like the rest")
    ] = "gravity",
) -> Motion:
    """Show the motion ``rate`` times as fast, at the same frame rate.

    ``rate`` may be one number for each frame (T,), told at the frames of the motion as it comes in.
    ``original``, the motion before all edits, says where feet stand and when the body flies. A flight is
    shown at most as much faster or slower as changes its height by 0.05 leg lengths; around it the rate goes
    over within 0.1 s. Raises ``BodyError`` where no body is found.
    """
    rates = np.broadcast_to(np.asarray(rate, float), (len(motion),))
    if (rates == 1.0).all() or len(motion) < 2:
        return motion
    original = original or motion
    body = Body.of(original)
    rates = np.where(np.arange(len(motion)) < lead_in(original), 1.0, rates)
    if flight == "gravity":
        motion, rates = free_flight(motion, original, body, rates)
    if travel == "speed":
        motion = kept_speed(motion, original, body, rates)
    return sampled(motion, frames_at(rates), frame_time=motion.frame_time)
