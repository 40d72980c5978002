"""What a clip looks like in numbers, whatever its skeleton, unit, axes and frame rate.

There are two families of features. ``readable`` has posture, range and speed in terms of anatomy (degrees,
leg lengths, seconds), which people can read; ``geometry`` has distances between points of the body and the
spectra of their movement, and no angle. Both are of the body that faces ahead: heading and place are taken
out. They belong to the benchmark alone: no edit and no method may use them.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

import mien
from mien.kinematics.fk import end_positions, world
from mien.kinematics.heading import heading
from mien.kinematics.poses import neutral_world
from mien.rotations import quaternion
from mien.samples import tired_walk, walk
from mien.signal.bridging import smooth
from mien.typing import Array

RATE = 30.0  # Hz: every clip is looked at so often
CALM = 0.03  # seconds: Gaussian that takes the noise of a capture away
TURNS = 0.25  # seconds: Gaussian of the heading; the sway of a stride is no turn
SIDES = ("left", "right")
POINTS = ("shoulder", "elbow", "wrist", "hip", "knee", "ankle")
QUANTILES = (10, 50, 90)
BANDS = ((0.3, 1.0), (1.0, 2.0), (2.0, 3.5), (3.5, 6.0), (6.0, 10.0))  # Hz

# Below these, movement is noise: the logarithm of a range or a speed starts here.
LEAST = {"degrees": 2.0, "legs": 0.01, "legs/s": 0.05, "legs/s^2": 0.5, "legs/s^3": 5.0, "Hz": 0.1}


@dataclass(frozen=True)
class Feature:
    """The unit of a number, and whether two clips are compared by ratio instead of difference."""

    unit: str
    ratio: bool = False

    @property
    def visible(self) -> float:
        """Return the difference from which people would see one: 2 degrees, 1 % of a leg, 10 %."""
        return 0.1 if self.ratio else {"degrees": 2.0, "legs": 0.01}[self.unit]


@dataclass(frozen=True)
class View:
    """A clip as seen from itself, at ``RATE``.

    ``points`` role -> (T, 3) in leg lengths from the ground under the hips: ahead, to the left, up.
    ``ways`` name -> (T, 3) the unit direction of the face, the front of the hips and of the chest, the toes.
    ``placed`` role -> (T, 3) in leg lengths in the world; all along the same three axes.
    """

    points: Mapping[str, Array]
    ways: Mapping[str, Array]
    placed: Mapping[str, Array]

    @classmethod
    def of(cls, motion: mien.Motion, *, like: mien.Motion | None = None) -> "View":
        """Look at a motion.

        ``like`` is another clip of the same skeleton, whose stance says where face, chest, hips and toes
        point: a stance that is read from a bowed head or turned out feet would hide them.
        """
        body = mien.Body.of(motion)
        stance, calm = _stance(motion if like is None else like)
        rotations, positions = world(motion)
        axes = np.stack([calm.forward, calm.left, calm.up])
        yaw = smooth(heading(positions, calm), sigma=TURNS / motion.frame_time)
        back = quaternion.exp(-yaw[:, None] * body.up)
        ground = _level(positions[:, body.roles["hips"]], body)
        points, placed = {}, {}
        for role, at in _places(motion, body, rotations, positions).items():
            points[role] = _sampled(quaternion.rotate(back, at - ground) @ axes.T / body.leg_length, motion)
            placed[role] = _sampled(at @ axes.T / body.leg_length, motion)
        ways = {}
        for role in ("head", "hips", "chest", "left_ankle", "right_ankle"):
            if role in body.roles:
                j = body.roles[role]
                turned = quaternion.multiply(rotations[:, j], quaternion.conjugate(stance[j]))
                seen = quaternion.rotate(quaternion.multiply(back, turned), calm.forward)
                ways[role] = _unit(_sampled(seen @ axes.T, motion))
        return cls(points, ways, placed)

    def cut(self, start: float, stop: float) -> "View":
        """Return the part from one share of the clip to another."""
        frames = len(self.points["hips"])
        part = slice(int(start * frames), max(int(stop * frames), int(start * frames) + 4))
        cut = ({k: v[part] for k, v in all_.items()} for all_ in (self.points, self.ways, self.placed))
        return View(*cut)


def _stance(motion: mien.Motion) -> tuple[Array, mien.Body]:
    """Return the world rotations (J, 4) of the neutral stance, and the body that stands so."""
    body = mien.Body.of(motion)
    return neutral_world(motion, body)[0], body


def _places(motion: mien.Motion, body: mien.Body, rotations: Array, positions: Array) -> dict[str, Array]:
    """Return role -> (T, 3) in the world; where a skeleton ends with the forearm, its end is the wrist."""
    wanted = ["hips", "chest", "head", *(f"{s}_{p}" for s in SIDES for p in POINTS)]
    out = {role: positions[:, body.roles[role]] for role in wanted if role in body.roles}
    ends = end_positions(motion, rotations, positions)
    for side in SIDES:
        below = np.flatnonzero(motion.skeleton.end_parents == body.roles[f"{side}_elbow"])
        if f"{side}_wrist" not in out and len(below):
            out[f"{side}_wrist"] = ends[:, below[0]]
    return out


def _level(hips: Array, body: mien.Body) -> Array:
    """Return the points on the floor under the hips (T, 3)."""
    return hips - ((hips @ body.up) - body.floor)[:, None] * body.up


def _sampled(values: Array, motion: mien.Motion) -> Array:
    """Return values (T, 3) without the noise, at ``RATE``."""
    calm = smooth(values, sigma=CALM / motion.frame_time)
    span = motion.frame_time * (len(motion) - 1)
    at = np.linspace(0.0, span, max(2, round(span * RATE) + 1))
    times = motion.frame_time * np.arange(len(motion))
    return np.stack([np.interp(at, times, column) for column in calm.T], axis=-1)


def _unit(v: Array) -> Array:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)


def _both(view: View, role: str) -> tuple[Array, Array]:
    """Return a left and a right point as though both were left ones."""
    left, right = (view.points[f"{s}_{role}"] for s in SIDES)
    return left, right * [1.0, -1.0, 1.0]


# --- the readable family


def courses(view: View) -> dict[str, tuple[str, list[Array]]]:
    """Return name -> (unit, one course (T,) in time for the trunk or for each side)."""
    p, ways = view.points, view.ways
    shoulders, hips = ([p[f"{s}_{r}"] for s in SIDES] for r in ("shoulder", "hip"))
    top, low = np.mean(shoulders, axis=0), np.mean(hips, axis=0)
    trunk, line = _unit(top - low), shoulders[0] - shoulders[1]
    pelvis = hips[0] - hips[1]
    out = {
        "head down": ("degrees", [_pitch(ways["head"])]) if "head" in ways else ("degrees", []),
        "head turned": ("degrees", [_yaw(ways["head"])]) if "head" in ways else ("degrees", []),
        "chest down": ("degrees", [_pitch(ways["chest"])]) if "chest" in ways else ("degrees", []),
        "pelvis down": ("degrees", [_pitch(ways["hips"])]),
        "trunk forward": ("degrees", [_deg(np.arctan2(trunk[:, 0], trunk[:, 2]))]),
        "trunk aside": ("degrees", [_deg(np.arctan2(trunk[:, 1], trunk[:, 2]))]),
        "shoulders twisted": ("degrees", [_yaw(line * [1, -1, 1], 1) - _yaw(pelvis * [1, -1, 1], 1)]),
        "shoulders tilted": ("degrees", [_tilt(line)]),
        "pelvis tilted": ("degrees", [_tilt(pelvis)]),
        "pelvis turned": ("degrees", [_yaw(pelvis * [1, -1, 1], 1)]),
        "shoulders up": ("legs", [np.linalg.norm(top - low, axis=-1)]),
        "shoulder width": ("legs", [np.linalg.norm(line, axis=-1)]),
        "hip height": ("legs", [low[:, 2]]),
        "hips ahead of feet": ("legs", [-np.mean([p[f"{s}_ankle"][:, 0] for s in SIDES], axis=0)]),
        "feet apart": ("legs", [(p["left_ankle"] - p["right_ankle"])[:, 1]]),
    }
    if "chest" in p:
        out["shoulders forward"] = ("legs", [_across(top - p["chest"], trunk)])
    return out | _limb_courses(view)


def _limb_courses(view: View) -> dict[str, tuple[str, list[Array]]]:
    out: dict[str, tuple[str, list[Array]]] = {}

    def add(name: str, unit: str, values: Array) -> None:
        out.setdefault(name, (unit, []))[1].append(values)

    roles = ("shoulder", "elbow", "wrist")
    arms = [_both(view, r) for r in roles] if "left_wrist" in view.points else []
    for shoulder, elbow, wrist in zip(*arms, strict=True):
        upper, lower = _unit(elbow - shoulder), _unit(wrist - elbow)
        add("arm forward", "degrees", _deg(np.arcsin(np.clip(upper[:, 0], -1, 1))))
        add("arm out", "degrees", _deg(np.arcsin(np.clip(upper[:, 1], -1, 1))))
        add("elbow bend", "degrees", _angle(upper, lower))
        add("hand height", "legs", wrist[:, 2])
        add("hand ahead", "legs", wrist[:, 0])
        add("hand out", "legs", wrist[:, 1])
    legs = zip(*(_both(view, r) for r in ("hip", "knee", "ankle")), strict=True)
    for hip, knee, ankle in legs:
        thigh, shin = _unit(knee - hip), _unit(ankle - knee)
        add("thigh forward", "degrees", _deg(np.arcsin(np.clip(thigh[:, 0], -1, 1))))
        add("knee out", "degrees", _deg(np.arcsin(np.clip(thigh[:, 1], -1, 1))))
        add("knee bend", "degrees", _angle(thigh, shin))
        add("foot height", "legs", ankle[:, 2])
    for side, sign in zip(SIDES, (1.0, -1.0), strict=True):
        outward = sign * view.ways[f"{side}_ankle"][:, 1]  # a foot that points down has no yaw
        add("toes out", "degrees", _deg(np.arcsin(np.clip(outward, -1, 1))))
    return out


SIGNED = (
    "head turned",
    "trunk aside",
    "shoulders twisted",
    "shoulders tilted",
    "pelvis tilted",
    "pelvis turned",
)


def readable(view: View) -> dict[str, tuple[float, Feature]]:
    """Return name -> (number, its feature): posture, range and speed in terms of anatomy.

    Posture: the mean over time and sides. Range: 5th to 95th percentile, the mean of the sides. What is
    signed by side has a range only, so that a clip and its mirror image are the same.
    """
    out = {}
    for name, (unit, sides) in courses(view).items():
        if not sides:
            continue
        if name not in SIGNED:
            out[name] = (float(np.mean(sides)), Feature(unit))
        ends = [np.subtract(*np.percentile(s, [95, 5])) for s in sides]
        out[f"{name}: range"] = (float(np.mean(ends)), Feature(unit, ratio=True))
    return out | _speeds(view)


def _speeds(view: View) -> dict[str, tuple[float, Feature]]:
    """Return speed, acceleration, jerk and tempo of hands, feet, head and hips.

    Of hands and head as seen from the hips, of feet and hips in the world. Tempo is the mean frequency:
    speed over 2 pi times the distance from the mean place (both root mean squares).
    """
    out: dict[str, tuple[float, Feature]] = {}
    groups = {
        "hands": _from_hips(view, [f"{s}_wrist" for s in SIDES]),
        "head": _from_hips(view, ["head"]),
        "feet": [view.placed[f"{s}_ankle"] for s in SIDES],
        "feet, from hips": _from_hips(view, [f"{s}_ankle" for s in SIDES]),
        "hips": [view.placed["hips"]],
    }
    for name, tracks in groups.items():
        if not tracks:
            continue
        found = np.mean([_rates(track) for track in tracks], axis=0)
        units = ("legs/s", "legs/s^2", "legs/s^3", "Hz")
        words = ("speed", "acceleration", "jerk", "tempo")
        if name in ("feet", "hips"):  # the travel has no middle to swing about
            units, words = units[:3], words[:3]
        for word, unit, value in zip(words, units, found, strict=False):
            out[f"{name}: {word}"] = (float(value), Feature(unit, ratio=True))
    travel = np.linalg.norm(view.placed["hips"][-1, :2] - view.placed["hips"][0, :2])
    out["travel"] = (float(travel * RATE / (len(view.placed["hips"]) - 1)), Feature("legs/s", ratio=True))
    return out


def _from_hips(view: View, roles: list[str]) -> list[Array]:
    return [view.points[role] - view.points["hips"] for role in roles if role in view.points]


def _rates(track: Array) -> list[float]:
    """Return the root mean square of speed, acceleration and jerk, and the mean frequency."""
    out, moved = [], track
    for _ in range(3):
        moved = np.diff(moved, axis=0) * RATE if len(moved) > 1 else np.zeros((1, 3))
        out.append(_rms(moved))
    return [*out, out[0] / (2 * np.pi * max(_rms(track - track.mean(axis=0)), LEAST["legs"]))]


def _rms(v: Array) -> float:
    return float(np.sqrt(np.mean(np.sum(v * v, axis=-1))))


def _across(v: Array, trunk: Array) -> Array:
    """Return how far ahead of the line of the trunk ``v`` (T, 3) points."""
    ahead = _unit(np.array([1.0, 0.0, 0.0]) - trunk[:, :1] * trunk)
    return np.asarray(np.sum(v * ahead, axis=-1))


def _deg(radians: Array) -> Array:
    return np.asarray(np.degrees(radians))


def _pitch(way: Array) -> Array:
    return _deg(np.arcsin(np.clip(-way[:, 2], -1, 1)))


def _yaw(way: Array, axis: int = 0) -> Array:
    """Return the turn (T,) to the left of a direction that points along ``axis`` when it is not turned."""
    turn = np.unwrap(np.arctan2(way[:, 1 - axis], way[:, axis]))
    return _deg(turn - 2 * np.pi * np.round(np.median(turn) / (2 * np.pi)))


def _tilt(line: Array) -> Array:
    return _deg(np.arctan2(line[:, 2], np.linalg.norm(line[:, :2], axis=-1)))


def _angle(a: Array, b: Array) -> Array:
    return _deg(np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), np.sum(a * b, axis=-1)))


# --- the family of geometry and spectra


def geometry(view: View) -> dict[str, tuple[float, Feature]]:
    """Return name -> (number, its feature): distances, places and spectra, without any angle.

    Of every distance between two points and every height the 10th, 50th and 90th percentile over time, the
    mean of a pair and its mirror image; of every point the power of its movement in bands of frequency.
    """
    out: dict[str, tuple[float, Feature]] = {}
    roles = list(view.points)
    tracks: dict[str, list[Array]] = {}
    for a, b in combinations(roles, 2):
        tracks.setdefault(_pair(a, b), []).append(np.linalg.norm(view.points[a] - view.points[b], axis=-1))
    for role in roles:
        tracks.setdefault(f"{_plain(role)} height", []).append(view.points[role][:, 2])
        ahead = view.points[role][:, 0] - view.points["hips"][:, 0]
        tracks.setdefault(f"{_plain(role)} ahead", []).append(ahead)
    for name, sides in tracks.items():
        found = np.mean([np.percentile(s, QUANTILES) for s in sides], axis=0)
        for q, value in zip(QUANTILES, found, strict=True):
            out[f"{name} {q}%"] = (float(value), Feature("legs"))
    for role in ("hips", "head", "wrist", "elbow", "knee", "ankle"):
        powers = [_bands(view, r) for r in roles if _plain(r) == role]
        for band, power in zip(BANDS, np.mean(powers, axis=0), strict=True) if powers else ():
            out[f"{role} {band[0]:g}-{band[1]:g} Hz"] = (float(power), Feature("legs/s", ratio=True))
    return out


def _plain(role: str) -> str:
    return role.removeprefix("left_").removeprefix("right_")


def _pair(a: str, b: str) -> str:
    """Return one name for a pair of points and its mirror image."""
    across = a.split("_")[0] in SIDES and b.split("_")[0] in SIDES and a.split("_")[0] != b.split("_")[0]
    return " to ".join(sorted((_plain(a), _plain(b)))) + (" across" if across else "")


def _bands(view: View, role: str) -> Array:
    """Return the root mean square speed (legs/s) of a point in each of ``BANDS``; of hips in the world."""
    track = view.placed[role] if role == "hips" else view.points[role] - view.points["hips"]
    speed = np.diff(track, axis=0) * RATE
    speed = (speed - speed.mean(axis=0)) * np.hanning(len(speed) + 2)[1:-1, None] * np.sqrt(8 / 3)
    power = np.sum(np.abs(np.fft.rfft(speed, n=max(256, len(speed)), axis=0)) ** 2, axis=-1) * 2
    hertz = np.fft.rfftfreq(max(256, len(speed)), 1 / RATE)
    scale = max(256, len(speed)) * max(len(speed), 1)
    return np.array([np.sqrt(power[(hertz >= a) & (hertz < b)].sum() / scale) for a, b in BANDS])


# --- differences


FAMILIES = {"readable": readable, "geometry": geometry}


def difference(
    clip: Mapping[str, tuple[float, Feature]], neutral: Mapping[str, tuple[float, Feature]]
) -> dict[str, float]:
    """Return what a clip has that its neutral does not: differences, and logarithms of ratios."""
    out = {}
    for name in clip.keys() & neutral.keys():
        (value, feature), (was, _) = clip[name], neutral[name]
        if feature.ratio:
            least = LEAST[feature.unit]
            out[name] = float(np.log((abs(value) + least) / (abs(was) + least)))
        else:
            out[name] = value - was
    return out


def visible(clip: Mapping[str, tuple[float, Feature]]) -> dict[str, float]:
    """Return for each feature the difference from which people would see one."""
    return {name: feature.visible for name, (_, feature) in clip.items()}


def self_test() -> None:
    """See that skeleton, unit, axis, heading and frame rate do not matter, on clips of known truth."""
    forms = (
        {"skeleton": "standard22", "fps": 60.0},
        {"skeleton": "capture31", "fps": 50.0, "unit": "inch", "up": "z"},
        {"skeleton": "poser43", "fps": 120.0, "unit": "m", "heading": 2.0},
    )
    for name, family in FAMILIES.items():
        seen = [(family(View.of(walk(**f).motion)), family(View.of(tired_walk(**f).motion))) for f in forms]
        found = [difference(tired, calm) for calm, tired in seen]
        least = visible(seen[0][0])
        off = max(abs(d[n] - found[0][n]) / least[n] for d in found for n in least)
        size = np.mean([abs(found[0][n]) / least[n] for n in least])
        assert found[0].keys() == found[1].keys() == found[2].keys(), name
        assert off < 1.0 < size, (name, off, size)
        print(f"{name}: three skeletons differ by at most {off:.1f} of what can be seen, tired by {size:.1f}")
