"""Do to a clip what differs between two other clips: a neutral example and one in the manner that is wanted.

Amaya, Bruderlin and Calvert (1996), with mien's own edits as the way to do it: what comes out is a plain
recipe that can be read, tuned and done to any clip of any skeleton.
"""

from dataclasses import replace

from ..analysis.manner import FASTEST, LIMBS, SLOWEST, Change, Manner, difference
from ..edits import pipeline
from ..edits.registry import EDITS
from ..kinematics.balancing import weight_ahead
from ..kinematics.body import Body
from ..kinematics.poses import Pose
from ..motion import Motion
from ..recipe import Recipe, Step

SAME = 0.03  # factors nearer to 1 are left out
LEAST_TURN = 0.5  # degrees: smaller turns of a pose are left out
MOST_MORE = 25.0  # degrees that a second look may ask for on top
LEGS = ("hip", "knee", "ankle", "toe")
OUT = (("left", 1.0), ("right", -1.0))


def fitted(motion: Motion, change: Change, *, name: str) -> Recipe:
    """Return the recipe that makes just such a change on one motion.

    What an edit does depends on the clip: an arm that is raised moves less, a bent elbow bends less. So it is
    done once, what came out is measured, and what lacks of the posture is asked for on top. The hips go back
    as far as the weight went to the front, or the other way, as people's do.
    """
    body = Body.of(motion)
    before = Manner.of(motion, body=body)
    done = pipeline.apply(motion, as_recipe(change, name=name))
    found = difference(before, Manner.of(done, body=body))
    lacking = change.pose + found.pose * -1.0
    ahead = weight_ahead(done, body) - weight_ahead(motion, body)
    more = replace(
        change,
        pose=change.pose + _within(lacking, MOST_MORE),
        hips_forward=change.hips_forward - ahead,
    )
    return as_recipe(more, name=name)


def _within(pose: Pose, most: float) -> Pose:
    """Return a pose with no turn larger than ``most`` degrees."""
    turns = {}
    for segment, (x, y, z) in pose.turns.items():
        less = min(1.0, most / max((x * x + y * y + z * z) ** 0.5, 1e-9))
        turns[segment] = (x * less, y * less, z * less)
    return Pose(turns)


def as_recipe(change: Change, *, name: str) -> Recipe:
    """Return a change of manner as a recipe: how far limbs go, how they are held, how fast, feet planted."""
    steps = [*_path_lengths(change), *_posture(change), *_tempo(change)]
    return Recipe(name, (*steps, Step("foot_plant")) if steps else (), safe=True)


def _path_lengths(change: Change) -> list[Step]:
    """Return a step for each gain; limbs with the same share one."""
    limbs: dict[float, list[str]] = {}
    for limb in LIMBS:
        gain = round(change.swing.get(limb, 1.0), 2)
        if abs(gain - 1.0) > SAME:
            limbs.setdefault(gain, []).append(limb)
    bands = {"mode": "edges", "edge_low": SLOWEST, "edge_high": 2.0 * FASTEST}
    return [Step("path_length", {"mid": gain, **bands}, parts=tuple(names)) for gain, names in limbs.items()]


def _posture(change: Change) -> list[Step]:
    """Return the step that holds the body so; arms and feet drawn in stop softly before they meet the body.

    Where the legs are follows from hips and feet, which stay planted: of them only how far feet are apart.
    """
    turns = {s: t for s, t in change.pose.turns.items() if s.partition("_")[2] not in LEGS}
    values: dict[str, float | str] = {
        "arms": _aside(change, "shoulder"),
        "legs": _aside(change, "hip"),
        "hips_height": change.hips_height,
        "hips_forward": change.hips_forward,
    }
    for side, out in (("left", 1.0), ("right", -1.0)):
        shoulder = f"{side}_shoulder"
        if shoulder in turns:
            x, y, z = turns[shoulder]
            turns[shoulder] = (x, y, z - out * float(values["arms"]))
    clear = {s: t for s, t in turns.items() if max(map(abs, t)) >= LEAST_TURN}
    pose = Pose({s: (round(x, 1), round(y, 1), round(z, 1)) for s, (x, y, z) in clear.items()})
    values = {name: _rounded(name, float(value)) for name, value in values.items()}
    values = {name: value for name, value in values.items() if value}
    values |= {"pose": str(pose)} if clear else {}
    return [Step("posture", values)] if values else []


def _aside(change: Change, role: str) -> float:
    """Return how far a role of both sides is tilted outwards, in degrees."""
    turns = change.pose.turns
    sides = [sign * turns[f"{side}_{role}"][2] for side, sign in OUT if f"{side}_{role}" in turns]
    return sum(sides) / len(sides) if sides else 0.0


def _rounded(name: str, value: float) -> float:
    about = EDITS["posture"].parameters[name].about
    low, high = float(about.low or 0.0), float(about.high or 0.0)
    return round(min(max(value, low), high), 3 if name.startswith("hips") else 1)


def _tempo(change: Change) -> list[Step]:
    rate = round(change.rate, 2)
    return [Step("tempo", {"rate": rate})] if abs(rate - 1.0) > SAME else []
