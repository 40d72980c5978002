"""The Laban features of Aristidou et al. (2017), table 1, as data: 37 basic ones, 121 derived, 31 selected.

The printed table is damaged in places; numbers here are those that make it add up to 121 and 31: the derived
number of feature 15 is 49 (printed 45), those of 20 are 62 to 64 (printed 61, 61, 64), features 25 and 26
belong to Effort, feature 30 has three levels (89 to 91, selected 21 to 23). Labels of Shape and Space are set
as in the authors' paper of 2015: volumes, torso and hands are Shape, way and area are Space.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

COMPONENTS = ("Body", "Effort", "Shape", "Space")
ALL, SPEED, ACCELERATION = ("max", "min", "std", "mean"), ("max", "std", "mean"), ("max", "std")
WHOLE = ("window",)  # one value for the whole window, not a statistic of its frames
ZONES = ("above_head", "head_to_chest", "below_chest")


@dataclass(frozen=True)
class Feature:
    """One basic feature f^i.

    ``number`` (1 to 37), ``name``, its Laban ``component``, its ``unit``, and the ``definition`` in words.
    ``statistics`` of a window have derived numbers from ``first`` on; ``selected`` statistic -> its number (1
    to 31) among the features that tell emotions apart and are alike between dancers.
    """

    number: int
    name: str
    component: str
    unit: str
    first: int
    statistics: tuple[str, ...]
    definition: str
    selected: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class Derived:
    """One derived feature: ``number`` (1 to 121), its ``name``, basic ``feature`` and ``statistic``.

    ``selected`` is its number (1 to 31) among the selected ones, 0 for the others.
    """

    number: int
    name: str
    feature: Feature
    statistic: str
    selected: int


_BODY = (
    ("left_foot_hip_distance", 1, "left ankle to pelvis", 0),
    ("right_foot_hip_distance", 5, "right ankle to pelvis", 0),
    ("left_hand_shoulder_distance", 9, "left wrist to left shoulder", 0),
    ("right_hand_shoulder_distance", 13, "right wrist to right shoulder", 0),
    ("hands_distance", 17, "left wrist to right wrist", 1),
    ("left_hand_head_distance", 21, "left wrist to head", 0),
    ("right_hand_head_distance", 25, "right wrist to head", 0),
    ("left_hand_hip_distance", 29, "left wrist to pelvis", 2),
    ("right_hand_hip_distance", 33, "right wrist to pelvis", 3),
    ("hip_ground_distance", 37, "height of the pelvis above the floor", 4),
    (
        "hip_ground_minus_feet_hip",
        41,
        "height of the pelvis less the mean distance from pelvis to ankles: near 0 upright, below it in a "
        "crouch, above it in a jump",
        0,
    ),
    ("feet_distance", 45, "left ankle to right ankle", 5),
    ("left_hand_chest_distance", 113, "left wrist to chest", 30),
    ("right_hand_chest_distance", 117, "right wrist to chest", 31),
)
_MOVING = ("pelvis", "left_hand", "right_hand", "left_foot", "right_foot")
_VOLUMES = (
    (27, "volume_of_five_joints", 77, "convex hull of head, wrists and ankles", 18),
    (28, "volume_of_all_joints", 81, "convex hull of all 19 places of the body", 19),
    (31, "volume_of_upper_body", 97, "convex hull of the places above the pelvis", 26),
    (32, "volume_of_lower_body", 101, "convex hull of pelvis, hips, knees, ankles and toes", 27),
    (33, "volume_of_right_side", 105, "convex hull of trunk, head and right limbs", 28),
    (34, "volume_of_left_side", 109, "convex hull of trunk, head and left limbs", 29),
)


def _effort() -> list[Feature]:
    out = [
        Feature(
            15,
            "deceleration_peaks",
            "Effort",
            "per window",
            49,
            WHOLE,
            "how often the pelvis brakes: lows of the rate of change of its speed, 0.5 heights/s^2 deep or "
            "more, counted in the window",
            {"window": 6},
        )
    ]
    for i, place in enumerate(_MOVING):
        said = f"of the {place.replace('_', ' ')}"
        out.append(
            Feature(
                16 + i,
                f"{place}_speed",
                "Effort",
                "heights/s",
                50 + 3 * i,
                SPEED,
                f"length of the velocity {said}",
                {"mean": 7 + i},
            )
        )
        out.append(
            Feature(
                21 + i,
                f"{place}_acceleration",
                "Effort",
                "heights/s^2",
                65 + 2 * i,
                ACCELERATION,
                f"length of the acceleration {said}",
                {"max": 12 + i},
            )
        )
    jerk = "length of the jerk of the pelvis"
    return [
        *out,
        Feature(26, "pelvis_jerk", "Effort", "heights/s^3", 75, ACCELERATION, jerk, {"max": 17}),
    ]


def _shape() -> list[Feature]:
    out = [
        Feature(number, name, "Shape", "heights^3", first, ALL, said, {"mean": chosen})
        for number, name, first, said, chosen in _VOLUMES
    ]
    torso, levels = "head to pelvis", "how high the hands are: 1 above the head, 0 below the chest"
    zones = {zone: 21 + i for i, zone in enumerate(ZONES)}
    return [
        *out,
        Feature(29, "torso_height", "Shape", "heights", 85, ALL, torso, {"mean": 20}),
        Feature(30, "hands_level", "Shape", "share", 89, ZONES, levels, zones),
    ]


def _space() -> list[Feature]:
    way = "way of the pelvis over the ground in the window"
    area = "convex hull of the pelvis' way over the ground in the window, a second"
    volume = "convex hull of all places of the body in all frames of the window"
    return [
        Feature(35, "total_distance", "Space", "heights", 92, WHOLE, way, {"window": 24}),
        Feature(36, "area_per_second", "Space", "heights^2/s", 93, ALL, area, {"mean": 25}),
        Feature(37, "total_volume", "Space", "heights^3", 121, WHOLE, volume),
    ]


def _body() -> list[Feature]:
    return [
        Feature(i, name, "Body", "heights", first, ALL, said, {"mean": chosen} if chosen else {})
        for i, (name, first, said, chosen) in enumerate(_BODY, 1)
    ]


def _derived(feature: Feature) -> list[Derived]:
    return [
        Derived(
            feature.first + i,
            feature.name if statistic == "window" else f"{feature.name}_{statistic}",
            feature,
            statistic,
            feature.selected.get(statistic, 0),
        )
        for i, statistic in enumerate(feature.statistics)
    ]


# In the order of their numbers: FEATURES[i - 1] is f^i, DERIVED[i - 1] the i-th derived, SELECTED[i - 1] the
# i-th selected feature.
FEATURES: tuple[Feature, ...] = tuple(
    sorted((*_body(), *_effort(), *_shape(), *_space()), key=lambda f: f.number)
)
DERIVED: tuple[Derived, ...] = tuple(
    sorted((d for feature in FEATURES for d in _derived(feature)), key=lambda d: d.number)
)
SELECTED: tuple[Derived, ...] = tuple(sorted((d for d in DERIVED if d.selected), key=lambda d: d.selected))
