"""Four made-up skeletons for the one figure: other names, rest poses, local axes and extra joints.

Each is a ``Rig``: which joint follows which segment of the figure, where it sits in the upright
stance, and how its own axes lie in that segment. All rigs put the joints of the same role at the same
place, so a motion looks the same on each of them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import MienError, unknown
from ..formats.bvh_header import depth_first
from ..rotations import quaternion
from ..typing import Array, Integers
from .figure import INDEX, PARENTS, SEGMENTS, SIDES, STANCE, STATURE
from .pose import about

GROUND = ""  # the segment of a dummy root, which stays at the origin


@dataclass(frozen=True, eq=False)
class Rig:
    """A skeleton before unit and up axis are chosen.

    ``segments`` (J): the figure's segment that each joint follows (-1: the ground). ``points`` (J, 3)
    and ``end_points`` (E, 3): places in the upright stance, metres. ``frames`` (J, 4): the joint's
    axes in the axes of its segment. ``roles``: role -> joint name. ``channels`` (J): the columns of a
    BVH file.
    """

    names: tuple[str, ...]
    parents: Integers
    segments: Integers
    points: Array
    frames: Array
    end_parents: Integers
    end_points: Array
    roles: Mapping[str, str]
    channels: tuple[tuple[str, ...], ...]


Joint = tuple[str, str, str, Array]  # name, parent, segment, place in the upright stance
End = tuple[str, Array]  # the joint it hangs on, place


def _rig(
    joints: Sequence[Joint],
    ends: Sequence[End],
    roles: Mapping[str, str],
    frames: Array,
    *,
    root: str,
    others: str,
) -> Rig:
    """Return the rig with its joints in the order a file nests them.

    ``root`` and ``others`` spell the channels: lower case positions, upper case rotations.
    """
    listed = [j[0] for j in joints]
    order = depth_first(np.array([listed.index(j[1]) if j[1] else -1 for j in joints]))
    joints = [joints[i] for i in order]
    names = [j[0] for j in joints]
    ends = sorted(ends, key=lambda end: names.index(end[0]))
    return Rig(
        names=tuple(names),
        parents=np.array([names.index(j[1]) if j[1] else -1 for j in joints]),
        segments=np.array([INDEX.get(j[2], -1) for j in joints]),
        points=np.array([j[3] for j in joints]),
        frames=frames[order],
        end_parents=np.array([names.index(e[0]) for e in ends]),
        end_points=np.array([e[1] for e in ends]),
        roles=roles,
        channels=(_channels(root), *[_channels(others)] * (len(names) - 1)),
    )


def _channels(letters: str) -> tuple[str, ...]:
    return tuple(f"{c.upper()}{'rotation' if c.isupper() else 'position'}" for c in letters)


def _rest(joints: Sequence[Joint], arms: float, legs: float) -> Array:
    """Return the frames of a rest pose with all axes parallel and the limbs raised sideways (degrees)."""
    frames = np.tile(quaternion.IDENTITY, (len(joints), 1))
    for i, (_, _, segment, _) in enumerate(joints):
        side, _, name = segment.rpartition("_")
        raised = arms * (name in ("shoulder", "elbow", "wrist")) + legs * (name in ("hip", "knee"))
        if side and raised:
            frames[i] = quaternion.conjugate(about(2, SIDES[side] * np.radians(raised)))
    return frames


def _along_bones(joints: Sequence[Joint], ends: Sequence[End]) -> Array:
    """Return frames whose x axis runs along the bone (on the right side: back along it)."""
    frames = np.tile(quaternion.IDENTITY, (len(joints), 1))
    for i, (name, _, segment, point) in enumerate(joints):
        tips = [j[3] for j in joints if j[1] == name] + [e[1] for e in ends if e[0] == name]
        if segment == GROUND:
            continue
        x = (tips[0] - point) / np.linalg.norm(tips[0] - point)
        x = -x if segment.startswith("right") else x
        helper = np.array([1.0, 0.0, 0.0]) if abs(x[0]) < 0.9 else np.array([0.0, 0.0, 1.0])
        z = np.cross(x, helper) / np.linalg.norm(np.cross(x, helper))
        frames[i] = quaternion.from_matrix(np.stack([x, np.cross(z, x), z], axis=-1))
    return frames


def _at(x: float, y: float, z: float) -> Array:
    return STATURE * np.array([x, y, z])


def _spelt(trunk: str, limbs: str, spell: Callable[[str, str], str]) -> dict[str, str]:
    """Return segment -> joint name from two lists of words; ``spell(side, word)`` names a limb's joint."""
    names = dict(zip(SEGMENTS, trunk.split(), strict=False))
    parts = [s.removeprefix("left_") for s in SEGMENTS if s.startswith("left_")]
    for side in SIDES:
        names |= {f"{side}_{p}": spell(side, word) for p, word in zip(parts, limbs.split(), strict=True)}
    return names


def _bones(names: Mapping[str, str], *, above: Mapping[str, str]) -> list[Joint]:
    """Return a joint for every segment, hung on the one before it or on what ``above`` says."""
    joints = []
    for segment, parent in zip(SEGMENTS, PARENTS.tolist(), strict=True):
        usual = names[SEGMENTS[parent]] if parent >= 0 else ""
        joints.append((names[segment], above.get(names[segment], usual), segment, STANCE[segment]))
    return joints


def _tips(names: Mapping[str, str], *parts: str) -> list[End]:
    """Return the end sites of the head and of the given limb joints."""
    tip = {"wrist": "hand_tip", "toe": "toe_tip"}
    limbs = [(f"{side}_{part}", f"{side}_{tip[part]}") for side in SIDES for part in parts]
    return [(names[joint], STANCE[end]) for joint, end in [("head", "head_tip"), *limbs]]


def _roles(names: Mapping[str, str]) -> dict[str, str]:
    return {segment: name for segment, name in names.items() if segment != "waist"}


def _standard22() -> Rig:
    """Game-engine names, T-pose, axes parallel to the world."""
    names = _spelt(
        "Hips Spine Spine1 Chest Neck Head",
        "Shoulder Arm ForeArm Hand UpLeg Leg Foot ToeBase",
        lambda side, word: side.title() + word,
    )
    joints = _bones(names, above={})
    frames = _rest(joints, 90.0, 0.0)
    return _rig(joints, _tips(names, "wrist", "toe"), _roles(names), frames, root="xyzZXY", others="ZXY")


def _capture31() -> Rig:
    """Capture-studio names with dummy hip joints, a double neck and hand dummies; A-pose."""
    names = _spelt(
        "Hips LowerBack Spine Spine1 Neck Head",
        "Shoulder Arm ForeArm Hand UpLeg Leg Foot ToeBase",
        lambda side, word: side.title() + word,
    )
    hung = {"LeftUpLeg": "LHipJoint", "RightUpLeg": "RHipJoint", "Head": "Neck1"}
    joints, ends = _bones(names, above=hung), _tips(names, "toe")
    joints.append(("Neck1", "Neck", "neck", 0.5 * (STANCE["neck"] + STANCE["head"])))
    for side, sign in SIDES.items():
        long, letter, hand = side.title(), side[0].upper(), f"{side}_wrist"
        knuckle, thumb = _at(sign * 0.106, 0.436, -0.014), _at(sign * 0.098, 0.466, 0.004)
        joints += [
            (f"{letter}HipJoint", "Hips", "hips", STANCE["hips"]),
            (f"{long}FingerBase", f"{long}Hand", hand, STANCE[hand]),
            (f"{long}HandIndex1", f"{long}FingerBase", hand, knuckle),
            (f"{letter}Thumb", f"{long}Hand", hand, thumb),
        ]
        ends += [(f"{long}HandIndex1", STANCE[f"{side}_hand_tip"])]
        ends += [(f"{letter}Thumb", thumb + _at(0.0, -0.02, 0.012))]
    frames = _rest(joints, 45.0, 5.0)
    return _rig(joints, ends, _roles(names), frames, root="xyzZYX", others="ZYX")


def _poser43() -> Rig:
    """Poser-like names with eyes, jaw and fingers; arms hang in the rest pose."""
    names = _spelt(
        "hip abdomen abdomen2 chest neck head",
        "Collar Shldr ForeArm Hand Thigh Shin Foot Toe",
        lambda side, word: side[0] + word,
    )
    joints = _bones(names, above={"lThigh": "lButtock", "rThigh": "rButtock"})
    joints.append(("jaw", "head", "head", _at(0.0, 0.905, 0.015)))
    ends = [*_tips(names, "toe"), ("jaw", _at(0.0, 0.870, 0.050))]
    for side, sign in SIDES.items():
        joints.append((f"{side}Eye", "head", "head", _at(sign * 0.018, 0.936, 0.045)))
        ends.append((f"{side}Eye", _at(sign * 0.018, 0.936, 0.055)))
        joints.append((f"{side[0]}Buttock", "hip", "hips", _at(sign * 0.03, 0.540, -0.01)))
        _fingers(joints, ends, side)
    frames = _rest(joints, 0.0, 0.0)
    return _rig(joints, ends, _roles(names), frames, root="YXZxyz", others="XYZ")


def _fingers(joints: list[Joint], ends: list[End], side: str) -> None:
    """Add thumb, index, middle and ring finger, two joints each, gently curled towards the palm."""
    mirror, letter, hand = np.array([SIDES[side], 1.0, 1.0]), side[0], f"{side}_wrist"
    for name, z in (("Thumb", 0.010), ("Index", 0.003), ("Mid", -0.012), ("Ring", -0.026)):
        thumb = name == "Thumb"
        base = _at(0.100, 0.470, z) if thumb else _at(0.106, 0.434, z)
        middle = base + (_at(-0.004, -0.018, 0.008) if thumb else _at(-0.003, -0.027, 0.0))
        tip = middle + (_at(-0.002, -0.015, 0.002) if thumb else _at(-0.008, -0.024, 0.0))
        joints.append((f"{letter}{name}1", f"{letter}Hand", hand, base * mirror))
        joints.append((f"{letter}{name}2", f"{letter}{name}1", hand, middle * mirror))
        ends.append((f"{letter}{name}2", tip * mirror))


def _engine23() -> Rig:
    """Underscore names under a dummy root; every bone lies along its own x axis."""
    names = _spelt(
        "pelvis spine_01 spine_02 spine_03 neck_01 head",
        "clavicle upperarm lowerarm hand thigh calf foot ball",
        lambda side, word: f"{word}_{side[0]}",
    )
    joints = [("root", "", GROUND, np.zeros(3)), *_bones(names, above={"pelvis": "root"})]
    ends = _tips(names, "wrist", "toe")
    frames = _along_bones(joints, ends)
    return _rig(joints, ends, _roles(names), frames, root="xyzYZX", others="xyzYZX")


RIGS: Mapping[str, Callable[[], Rig]] = {
    "standard22": _standard22,
    "capture31": _capture31,
    "poser43": _poser43,
    "engine23": _engine23,
}


def rig(name: str) -> Rig:
    """Return the rig of that name; ``MienError`` with the nearest name if there is none."""
    if name not in RIGS:
        raise MienError(unknown("sample skeleton", name, RIGS))
    return RIGS[name]()
