"""Do to a clip what differs between two other clips: a neutral example and one in the manner that is wanted.

Amaya, Bruderlin and Calvert (1996), with mien's own edits as the way to do it: what comes out is a plain
recipe that can be read, tuned and done to any clip of any skeleton.
"""

from ..analysis.manner import FASTEST, LIMBS, SLOWEST, Change, Manner, difference
from ..kinematics.poses import Pose
from ..motion import Motion
from ..recipe import Recipe, Step

SAME = 0.03  # factors nearer to 1 are left out
LEAST_TURN = 0.5  # degrees: smaller turns of a pose are left out
LEAST_HEIGHT = 0.002  # leg lengths
HEIGHTS = (-0.5, 0.1)  # leg lengths


def from_example(example: Motion, neutral: Motion, *, name: str = "example") -> Recipe:
    """Return the recipe for what ``example`` has that ``neutral`` has not.

    Best are two clips of one action by one person. Raises ``BodyError`` where no body is found.

    >>> sad = from_example(mien.load("sad_wave.bvh"), mien.load("wave.bvh"))
    >>> mien.edit(mien.load("my_walk.bvh"), sad, strength=0.8)
    """
    return as_recipe(difference(Manner.of(neutral), Manner.of(example)), name=name)


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
    turns = {
        segment: (round(x, 1), round(y, 1), round(z, 1))
        for segment, (x, y, z) in change.pose.turns.items()
        if max(abs(x), abs(y), abs(z)) >= LEAST_TURN
    }
    height = round(min(max(change.hips_height, HEIGHTS[0]), HEIGHTS[1]), 3)
    values: dict[str, float | str] = {"pose": str(Pose(turns))} if turns else {}
    values |= {"hips_height": height} if abs(height) >= LEAST_HEIGHT else {}
    return [Step("posture", values)] if values else []


def _tempo(change: Change) -> list[Step]:
    rate = round(change.rate, 2)
    return [Step("tempo", {"rate": rate})] if abs(rate - 1.0) > SAME else []
