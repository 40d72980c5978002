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


def _rig(
    joints: Sequence[Joint],
    ends: Sequence[tuple[str, Array]],
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


def _along_bones(joints: Sequence[Joint], ends: Sequence[tuple[str, Array]]) -> Array:
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


_SHORT = {"Left": "left", "Right": "right"}
_ROLES = tuple(s for s in SEGMENTS if s != "waist")


def _at(x: float, y: float, z: float) -> Array:
    return STATURE * np.array([x, y, z])


def _standard22() -> Rig:
    """Game-engine names, T-pose, axes parallel to the world."""
    trunk = {
        "hips": "Hips",
        "spine": "Spine",
        "waist": "Spine1",
        "chest": "Chest",
        "neck": "Neck",
        "head": "Head",
    }
    arm = {"collar": "Shoulder", "shoulder": "Arm", "elbow": "ForeArm", "wrist": "Hand"}
    leg = {"hip": "UpLeg", "knee": "Leg", "ankle": "Foot", "toe": "ToeBase"}
    names = dict(trunk)
    for long, side in _SHORT.items():
        names |= {f"{side}_{k}": f"{long}{v}" for k, v in (arm | leg).items()}
    joints = [(names[s], names.get(_above(s), ""), s, STANCE[s]) for s in SEGMENTS]
    ends = [("Head", STANCE["head_tip"])]
    for long, side in _SHORT.items():
        ends += [(f"{long}Hand", STANCE[f"{side}_hand_tip"]), (f"{long}ToeBase", STANCE[f"{side}_toe_tip"])]
    return _rig(
        joints, ends, {r: names[r] for r in _ROLES}, _rest(joints, 90.0, 0.0), root="xyzZXY", others="ZXY"
    )


def _above(segment: str) -> str:
    parent = int(PARENTS[INDEX[segment]])
    return SEGMENTS[parent] if parent >= 0 else ""


def _capture31() -> Rig:
    """Capture-studio names with dummy hip joints, a double neck and hand dummies; A-pose."""
    joints: list[Joint] = [("Hips", "", "hips", STANCE["hips"])]
    ends: list[tuple[str, Array]] = []
    for long, side in _SHORT.items():
        legs = ["hip", "knee", "ankle", "toe"]
        chain = [f"{long}{n}" for n in ("UpLeg", "Leg", "Foot", "ToeBase")]
        joints.append((f"{long[0]}HipJoint", "Hips", "hips", STANCE["hips"]))
        for name, above, part in zip(chain, [f"{long[0]}HipJoint", *chain], legs, strict=False):
            joints.append((name, above, f"{side}_{part}", STANCE[f"{side}_{part}"]))
        ends.append((chain[-1], STANCE[f"{side}_toe_tip"]))
    halfway = 0.5 * (STANCE["neck"] + STANCE["head"])
    joints += [
        ("LowerBack", "Hips", "spine", STANCE["spine"]),
        ("Spine", "LowerBack", "waist", STANCE["waist"]),
        ("Spine1", "Spine", "chest", STANCE["chest"]),
        ("Neck", "Spine1", "neck", STANCE["neck"]),
        ("Neck1", "Neck", "neck", halfway),
        ("Head", "Neck1", "head", STANCE["head"]),
    ]
    ends.append(("Head", STANCE["head_tip"]))
    for long, side in _SHORT.items():
        _capture_arm(joints, ends, long, side)
    roles = {"hips": "Hips", "spine": "LowerBack", "chest": "Spine1", "neck": "Neck", "head": "Head"}
    for long, side in _SHORT.items():
        parts = {"collar": "Shoulder", "shoulder": "Arm", "elbow": "ForeArm", "wrist": "Hand"}
        parts |= {"hip": "UpLeg", "knee": "Leg", "ankle": "Foot", "toe": "ToeBase"}
        roles |= {f"{side}_{k}": f"{long}{v}" for k, v in parts.items()}
    return _rig(joints, ends, roles, _rest(joints, 45.0, 5.0), root="xyzZYX", others="ZYX")


def _capture_arm(joints: list[Joint], ends: list[tuple[str, Array]], long: str, side: str) -> None:
    sign = [SIDES[side], 1.0, 1.0]
    parts = {"collar": "Shoulder", "shoulder": "Arm", "elbow": "ForeArm", "wrist": "Hand"}
    above = "Spine1"
    for part, name in parts.items():
        joints.append((f"{long}{name}", above, f"{side}_{part}", STANCE[f"{side}_{part}"]))
        above = f"{long}{name}"
    knuckle, thumb = _at(0.106, 0.436, -0.014) * sign, _at(0.098, 0.466, 0.004) * sign
    hand = f"{side}_wrist"
    joints.append((f"{long}FingerBase", above, hand, STANCE[hand]))
    joints.append((f"{long}HandIndex1", f"{long}FingerBase", hand, knuckle))
    joints.append((f"{long[0]}Thumb", above, hand, thumb))
    ends.append((f"{long}HandIndex1", STANCE[f"{side}_hand_tip"]))
    ends.append((f"{long[0]}Thumb", thumb + _at(0.0, -0.02, 0.012)))


def _poser43() -> Rig:
    """Poser-like names with eyes, jaw and fingers; arms hang in the rest pose."""
    joints: list[Joint] = [
        ("hip", "", "hips", STANCE["hips"]),
        ("abdomen", "hip", "spine", STANCE["spine"]),
        ("abdomen2", "abdomen", "waist", STANCE["waist"]),
        ("chest", "abdomen2", "chest", STANCE["chest"]),
        ("neck", "chest", "neck", STANCE["neck"]),
        ("head", "neck", "head", STANCE["head"]),
        ("jaw", "head", "head", _at(0.0, 0.905, 0.015)),
        ("leftEye", "head", "head", _at(0.018, 0.936, 0.045)),
        ("rightEye", "head", "head", _at(-0.018, 0.936, 0.045)),
    ]
    ends = [("jaw", _at(0.0, 0.870, 0.050)), ("head", STANCE["head_tip"])]
    ends += [(n, p + _at(0.0, 0.0, 0.01)) for n, _, _, p in joints if n.endswith("Eye")]
    roles = {"hips": "hip", "spine": "abdomen", "chest": "chest", "neck": "neck", "head": "head"}
    arm = {"collar": "Collar", "shoulder": "Shldr", "elbow": "ForeArm", "wrist": "Hand"}
    leg = {"hip": "Thigh", "knee": "Shin", "ankle": "Foot", "toe": "Toe"}
    for side in ("right", "left"):
        names = {part: f"{side[0]}{name}" for part, name in (arm | leg).items()}
        for part, name in (arm | leg).items():
            del name
            above = {"collar": "chest", "hip": f"{side[0]}Buttock"}.get(part) or names[
                _above(f"{side}_{part}")[len(side) + 1 :]
            ]
            if part == "hip":
                joints.append((above, "hip", "hips", _at(0.03 * SIDES[side], 0.540, -0.01)))
            joints.append((names[part], above, f"{side}_{part}", STANCE[f"{side}_{part}"]))
            if part == "wrist":
                _fingers(joints, ends, side)
        ends.append((names["toe"], STANCE[f"{side}_toe_tip"]))
        roles |= {f"{side}_{part}": name for part, name in names.items()}
    return _rig(joints, ends, roles, _rest(joints, 0.0, 0.0), root="YXZxyz", others="XYZ")


def _fingers(joints: list[Joint], ends: list[tuple[str, Array]], side: str) -> None:
    """Thumb, index, middle and ring finger, two joints each, gently curled towards the palm."""
    sign, letter, hand = np.array([SIDES[side], 1.0, 1.0]), side[0], f"{side}_wrist"
    for name, z in (("Thumb", 0.010), ("Index", 0.003), ("Mid", -0.012), ("Ring", -0.026)):
        thumb = name == "Thumb"
        base = _at(0.100, 0.470, z) if thumb else _at(0.106, 0.434, z)
        middle = base + (_at(-0.004, -0.018, 0.008) if thumb else _at(-0.003, -0.027, 0.0))
        tip = middle + (_at(-0.002, -0.015, 0.002) if thumb else _at(-0.008, -0.024, 0.0))
        joints.append((f"{letter}{name}1", f"{letter}Hand", hand, base * sign))
        joints.append((f"{letter}{name}2", f"{letter}{name}1", hand, middle * sign))
        ends.append((f"{letter}{name}2", tip * sign))


def _engine23() -> Rig:
    """Underscore names under a dummy root; every bone lies along its own x axis."""
    trunk = {"hips": "pelvis", "spine": "spine_01", "waist": "spine_02", "chest": "spine_03"}
    names = trunk | {"neck": "neck_01", "head": "head"}
    parts = {"collar": "clavicle", "shoulder": "upperarm", "elbow": "lowerarm", "wrist": "hand"}
    parts |= {"hip": "thigh", "knee": "calf", "ankle": "foot", "toe": "ball"}
    for side in SIDES:
        names |= {f"{side}_{part}": f"{name}_{side[0]}" for part, name in parts.items()}
    joints: list[Joint] = [("root", "", GROUND, np.zeros(3))]
    joints += [(names[s], names.get(_above(s), "root"), s, STANCE[s]) for s in SEGMENTS]
    ends = [("head", STANCE["head_tip"])]
    for side in SIDES:
        ends += [
            (names[f"{side}_{part}"], STANCE[f"{side}_{tip}_tip"])
            for part, tip in (("wrist", "hand"), ("toe", "toe"))
        ]
    return _rig(
        joints,
        ends,
        {r: names[r] for r in _ROLES},
        _along_bones(joints, ends),
        root="xyzYZX",
        others="xyzYZX",
    )


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
