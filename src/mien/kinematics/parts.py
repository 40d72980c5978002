"""The parts of a body that a person names, and which parts two lists share."""

from collections.abc import Mapping, Sequence

from .roles import ARM, LEG, SIDES

# Names a person may give to --parts; each is a set of the five limbs and the torso.
PARTS: Mapping[str, tuple[str, ...]] = {
    "head": ("head",),
    "torso": ("torso",),
    "left_arm": ("left_arm",),
    "right_arm": ("right_arm",),
    "left_leg": ("left_leg",),
    "right_leg": ("right_leg",),
    "arms": ("left_arm", "right_arm"),
    "legs": ("left_leg", "right_leg"),
    "upper": ("head", "torso", "left_arm", "right_arm"),
    "left": ("left_arm", "left_leg"),
    "right": ("right_arm", "right_leg"),
}


def common_parts(one: Sequence[str], other: Sequence[str]) -> tuple[str, ...] | None:
    """Return the body parts in both lists, where an empty list is the whole body; None if there are none."""
    if not one or not other:
        return tuple(one or other)
    mine, its = _simple(one), _simple(other)
    both = [p for p in mine if p in its or _PART_OF.get(p) in its]
    both += [p for p in its if p not in both and _PART_OF.get(p) in mine]
    return tuple(both) or None


def _simple(parts: Sequence[str]) -> list[str]:
    """Return the parts with the names for several taken apart, each once."""
    return list(dict.fromkeys(p for part in parts for p in PARTS.get(part, (part,))))


# Role -> the part that it belongs to.
_PART_OF = {"neck": "head", "head": "head"} | dict.fromkeys(("hips", "spine", "chest"), "torso")
_PART_OF |= {f"{side}_{role}": f"{side}_arm" for side in SIDES for role in ARM}
_PART_OF |= {f"{side}_{role}": f"{side}_leg" for side in SIDES for role in LEG}
