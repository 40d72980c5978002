"""What looks odd in a clip before anything is done to it: sentences for a person.

A note is a suspicion, not an error: each says what was seen, and what to do if it is not meant.
"""

import numpy as np

from ..errors import BodyError
from ..kinematics.body import Body
from ..kinematics.contacts import foot_points, spans
from ..kinematics.fk import world
from ..kinematics.lead_in import lead_in
from ..motion import Motion
from ..typing import Array

JUMP = 0.3, 20.0  # leg lengths between two frames, and leg lengths a second: sprinters reach 14
SWING = 0.1, 1.4  # seconds that a stepping foot may plausibly be under way
USUAL_SWING = 0.45  # seconds, at an ordinary walk and run alike (Winter 2009: 40 % of a stride)
STEP = 0.6  # leg lengths that a foot goes forward in what counts as a step
HOVER, FLIGHT = 0.12, 0.8  # leg lengths above the floor; seconds that nobody can jump for
STILL = 0.35  # leg lengths a second: a foot that stands is slower (see kinematics.contacts)
RATES = 24, 25, 30, 50, 60, 100, 120, 240


def notes(motion: Motion) -> list[str]:
    """Return a sentence for each thing that looks odd; an empty list if nothing does.

    Looked for: joints that lie on their parents although their bones are long, a single frame, no movement
    at all, joints that turn while nothing travels, a still such as a T-pose before the motion, hips that
    jump, feet that hover, and a frame rate at which feet swing too slowly or too fast to be human. The last
    three need a humanoid and are left out without one.
    """
    if len(motion) == 1:
        return [*_folded(motion), "there is one frame only: a pose, not a motion"]
    return [*_folded(motion), *_movement(motion), *_start(motion), *doubts(motion)]


def doubts(motion: Motion) -> list[str]:
    """Return those of the ``notes`` that make an edit doubtful: jumping hips, hovering feet, an odd rate."""
    return _steps(motion) if len(motion) > 1 else []


def _folded(motion: Motion) -> list[str]:
    """Look for position channels that hold zeros where the bones of the skeleton are long."""
    long = np.linalg.norm(motion.skeleton.offsets, axis=1)
    moved = np.linalg.norm(motion.translations, axis=-1).max(axis=0)
    folded = int(((moved < 1e-3 * long) & (motion.skeleton.parents >= 0)).sum())
    if 2 * folded < len(motion.skeleton):
        return []
    return [
        f"{folded} of {len(motion.skeleton)} joints lie on their parents, though the skeleton gives their "
        "bones a length: the position channels hold zeros, perhaps meant to be added to the bones"
    ]


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
    rotations, positions = world(motion)
    feet = foot_points(motion, body, rotations, positions)[lead_in(motion) :]
    return [
        *_jumps(motion, positions, body),
        *_hovering(feet, body, motion.frame_time),
        *_rate(motion, positions[lead_in(motion) :], body),
    ]


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


def _hovering(feet: Array, body: Body, frame_time: float) -> list[str]:
    """Look for feet (T, 2, 2, 3) that are in the air longer than a jump and stand on nothing there."""
    height = (feet @ body.up - body.floor).min(axis=(1, 2)) / body.leg_length
    air = np.zeros(len(feet), bool)
    for start, stop in spans(height > HOVER):
        air[start:stop] = (stop - start) * frame_time > FLIGHT
    if air.mean() < 0.5:
        return []
    speed = np.linalg.norm(np.gradient(feet, frame_time, axis=0), axis=-1).min(axis=(1, 2)) / body.leg_length
    if (speed[air] < STILL).mean() > 0.2:  # somebody who climbs, sits or hangs holds the feet still
        return []
    return [
        f"the feet hover about {np.median(height[air]):.1f} leg lengths above the floor for {air.mean():.0%} "
        "of the time and stand on nothing there: heights that drift, or a clip in which nobody stands; an "
        "edit holds feet in place only where they stand"
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
