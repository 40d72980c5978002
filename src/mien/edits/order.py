"""The order in which edits are done where nobody says: time first, poses, how fast all is, then repairs."""

from collections.abc import Iterable

from ..recipe import Step
from .registry import EDITS

# An edit that is not named follows its kind.
ORDER = (
    *("trim", "resample", "mirror", "grid", "path_length", "waveshape", "sway", "bounce"),
    *("nervous", "timing"),
    *(
        "posture",
        "control_points",
        "displacement",
        "tremor",
        "restore",
        "tempo",
        "foot_plant",
        "repair",
        "in_place",
    ),
)
_LAST_OF_KIND = {"time": "mirror", "rhythm": "tempo", "pose": "posture", "repair": "foot_plant"}


def rank(name: str) -> int:
    """Return the place of an edit in the order."""
    return ORDER.index(name if name in ORDER else _LAST_OF_KIND[EDITS[name].kind])


def insert(steps: list[Step], step: Step) -> None:
    """Put a step before the first that comes later in the order."""
    later = [i for i, other in enumerate(steps) if rank(other.edit) > rank(step.edit)]
    steps.insert(later[0] if later else len(steps), step)


def merged(recipes: Iterable[Iterable[Step]]) -> tuple[Step, ...]:
    """Return the steps of several recipes as one, in order; repairs that are the same are done once."""
    steps = sorted((step for recipe in recipes for step in recipe), key=lambda step: rank(step.edit))
    made: list[Step] = []
    for step in steps:
        if EDITS[step.edit].kind != "repair" or step not in made:
            made.append(step)
    return tuple(made)
