"""What looks odd in a clip before anything is done to it: sentences for a person.

A note is a suspicion, not an error: each says what was seen, and what to do if it is not meant.
"""

import numpy as np

from ..errors import BodyError
from ..kinematics.body import Body
from ..kinematics.contacts import spans
from ..kinematics.fk import world
from ..kinematics.lead_in import lead_in
from ..motion import Motion
from ..typing import Array

JUMP = 0.3, 20.0  # leg lengths between two frames, and leg lengths a second: sprinters reach 14
SWING = 0.1, 1.4  # seconds that a stepping foot may plausibly be under way
USUAL_SWING = 0.45  # seconds, at an ordinary walk and run alike (Winter 2009: 40 % of a stride)
STEP = 0.6  # leg lengths that a foot goes forward in what counts as a step
RATES = 24, 25, 30, 50, 60, 100, 120, 240


def notes(motion: Motion) -> list[str]:
    """Return a sentence for each thing that looks odd; an empty list if nothing does.

    Looked for: a single frame, no movement at all, joints that turn while nothing travels, a still such
    as a T-pose before the motion, hips that jump, and a frame rate at which feet swing too slowly or too
    fast to be human. The last two need a humanoid and are left out without one.
    """
    if len(motion) == 1:
        return ["there is one frame only: a pose, not a motion"]
    return [*_movement(motion), *_start(motion), *doubts(motion)]


def doubts(motion: Motion) -> list[str]:
    """Return those of the ``notes`` that make an edit of the clip doubtful: hips that jump, an odd rate."""
    return _steps(motion) if len(motion) > 1 else []


def _movement(motion: Motion) -> list[str]:
    turns = (motion.rotations != motion.rotations[0]).any()
    travels = (motion.translations != motion.translations[0]).any()
    if not turns and not travels:
        return ["nothing moves: all frames are the same"]
    if not travels:
        return ["no joint changes its position: the body stays in place, whatever the legs do"]
    return [] if turns else ["no joint turns: the pose never changes"]


def _start(motion: Motion) -> list[str]:
    frames = lead_in(motion)
    if not frames:
        return []
    which = "frame 0 is" if frames == 1 else f"frames 0 to {frames - 1} are"
    return [
        f"{which} far from the motion that follows, as a T-pose or a calibration pose is; trim if not meant"
    ]


def _steps(motion: Motion) -> list[str]:
    try:
        body = Body.of(motion)
    except BodyError:
        return []
    positions = world(motion)[1]
    return [*_jumps(motion, positions, body), *_rate(motion, positions[lead_in(motion) :], body)]


def _jumps(motion: Motion, positions: Array, body: Body) -> list[str]:
    """Name the frames between which the hips go much faster than people do and than they mostly go."""
    hips = positions[:, body.roles["hips"]]
    steps = np.sqrt(np.square(np.diff(hips, axis=0)).sum(axis=1)) / body.leg_length
    far = max(JUMP[0], JUMP[1] * motion.frame_time, 8.0 * float(np.percentile(steps, 90)))
    found = [i for i in np.flatnonzero(steps > far).tolist() if i + 1 != lead_in(motion)]
    if not found:
        return []
    first, more = found[0], f", and {len(found) - 1} times more" if len(found) > 1 else ""
    return [
        f"the hips jump {steps[first]:.1f} leg lengths from frame {first} to frame {first + 1}{more}: "
        "broken positions, or a cut; trim if not meant"
    ]


def _rate(motion: Motion, positions: Array, body: Body) -> list[str]:
    """Compare how long a foot is under way in a step with what legs do: they swing like pendulums."""
    swings = [
        length * motion.frame_time
        for side in ("left", "right")
        for length in _swings(positions[:, body.roles[f"{side}_ankle"]], body)
    ]
    middle = float(np.median(swings)) if len(swings) > 1 else USUAL_SWING
    if SWING[0] <= middle <= SWING[1]:
        return []
    likely = motion.fps * middle / USUAL_SWING
    near = min(RATES, key=lambda rate: abs(np.log(rate / likely)))
    return [
        f"at {motion.fps:.4g} frames a second a foot takes {middle:.2f} s to step, where people take about "
        f"{USUAL_SWING} s; the rate may be nearer {near} (use --fps to override it)"
    ]


def _swings(ankle: Array, body: Body) -> list[int]:
    """Return how many frames each step of an ankle (T, 3) takes; not those the clip's ends cut."""
    flat = ankle - (ankle @ body.up)[:, None] * body.up
    speed = np.sqrt(np.square(np.diff(flat, axis=0)).sum(axis=1))
    if len(speed) == 0 or not speed.max() > 0:
        return []
    found = spans(speed > 0.25 * np.percentile(speed, 95))
    gone = [np.sqrt(np.square(flat[b] - flat[a]).sum()) for a, b in found]
    return [
        b - a
        for (a, b), far in zip(found, gone, strict=True)
        if far > STEP * body.leg_length and a > 0 and b < len(speed)
    ]
