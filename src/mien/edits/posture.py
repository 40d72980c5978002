"""Hold the body differently: a constant change of posture on every frame.

To the motion: the head sinks, the trunk bends, elbows go out, the stance widens, while the movement
itself goes on. To the viewer: head and trunk down read as sad or tired, elbows and feet apart as
strong, arms and feet drawn in as weak, afraid or feminine (Förger 2011, chapter 5). Where an arm or leg
is far from where it hangs, as in a reach or a kick, its change fades out, so that the aim is kept.

Feet move with the legs and hips: let ``foot_plant`` follow.
"""

from collections.abc import Mapping
from math import cos, radians, sin
from typing import Annotated

import numpy as np

from ..kinematics.body import SIDES, Body
from ..kinematics.fk import world
from ..kinematics.heading import heading_rotation, hips_frame
from ..kinematics.poses import named_pose, neutral_world, posture_pose
from ..kinematics.posing import Method, add_pose, soft_stop
from ..motion import Motion
from ..rotations import quaternion
from ..typing import Array
from .registry import Param, edit

FADE_START, FADE_END = 0.6, 1.1  # lengths of the limb that its end is away from where it hangs
FADE_CUTOFF = 3.0  # Hz
# Leg lengths: how near hands may hang to the hip joints, feet to the middle; limbs as levers.
HAND_ROOM, FOOT_ROOM = 0.05, 0.04
HEAD_DOWN, HEAD_UP = 50.0, 60.0  # degrees a neck bends forward and back (Youdas et al. 1992)
LIMB_LENGTH = {"arms": 0.65, "legs": 1.0}


def _degrees(doc: str, low: float, high: float) -> Param:
    return Param(doc, low, high, "degrees", neutral=0.0)


@edit(
    paper="Förger 2011, section 3.4.2",
    equation="enc'(t) = enc(t) + s w(t) (enc(P) - enc(N)),  w = 1 - smoothstep(0.6 L, 1.1 L, |e(t) - e_N|)",
    deviations="the default method adds the change joint by joint as anatomy has it (kinematics/posing.py); "
    "`additive` is the thesis's. Angles and fade-out limits were not published.",
)
def posture(
    motion: Motion,
    *,
    head: Annotated[float, _degrees("head down (+) or up (-), neck included", -60, 60)] = 0.0,
    trunk: Annotated[
        float, _degrees("trunk bent forward (+) or back (-); arms go on hanging", -45, 60)
    ] = 0.0,
    lean: Annotated[
        float, _degrees("whole body leaning forward (+) or back (-) at the ankles", -20, 20)
    ] = 0.0,
    shoulders: Annotated[float, _degrees("shoulders raised (+) or lowered (-)", -20, 30)] = 0.0,
    arms: Annotated[float, _degrees("upper arms away from the body (+) or closer (-)", -30, 60)] = 0.0,
    arms_forward: Annotated[float, _degrees("upper arms to the front (+) or back (-)", -60, 90)] = 0.0,
    elbows: Annotated[float, _degrees("elbows more bent (+) or straighter (-)", -90, 90)] = 0.0,
    legs: Annotated[float, _degrees("feet apart (+) or closer (-), as an angle at each hip", -15, 30)] = 0.0,
    hips_height: Annotated[
        float, Param("hips higher (+) or lower (-)", -0.5, 0.1, "leg lengths", neutral=0.0)
    ] = 0.0,
    hips_forward: Annotated[
        float, Param("hips to the front (+) or back (-) of the feet", -0.3, 0.3, "leg lengths", neutral=0.0)
    ] = 0.0,
    pose: Annotated[
        str, Param("a named pose (head_down, elbows_out, arms_legs_in) or one in a line")
    ] = "none",
    amount: Annotated[float, Param("how much of the pose; -1 is its reverse", -2, 2, neutral=0.0)] = 1.0,
    method: Annotated[Method, Param("how the change is added to each joint")] = "anatomical",
    fade: Annotated[bool, Param("fade out on limbs that are far from where they hang")] = True,
) -> Motion:
    """Hold head, trunk, arms and legs differently, through the whole clip.

    Angles in degrees are added to every frame, ``hips_height`` and ``hips_forward`` in leg lengths to the
    place of the hips. ``pose`` is the name of a pose in ``kinematics.poses.POSES`` or the line that
    ``str(Pose)`` writes, for example of ``pose_between(neutral, sad)`` from two captured stills.
    ``anatomical`` is the default for what real clips show: with ``additive`` a sharply bent elbow opens
    instead of bending (a punch: by 8 degrees where 25 more were asked), and both other methods turn
    the plane of the elbow (by up to 20 and 37 degrees) and bend straightened elbows backwards. Arms
    and legs drawn in stop softly before hands reach the hips and feet each other, and the head before
    the neck is bent further than necks bend.
    """
    named, captured = named_pose(pose)
    values = {
        "head": head,
        "trunk": trunk,
        "lean": lean,
        "shoulders": shoulders,
        "arms": arms,
        "arms_forward": arms_forward,
        "elbows": elbows,
        "legs": legs,
    }
    values = {name: value + amount * named.get(name, 0.0) for name, value in values.items()}
    if not (
        hips_height
        or hips_forward
        or any(values.values())
        or any(map(any, (captured * amount).turns.values()))
    ):
        return motion
    body = Body.of(motion)
    turned, positions = world(motion)
    facing = heading_rotation(positions, body)
    stopped = _stopped(values, _aside(body, positions, facing), _head_down(motion, body, turned))
    whole = posture_pose(stopped) + captured * amount
    weights = _fade_out(motion, body, positions, facing) if fade else {}
    rotations = add_pose(motion, body, whole, weights=weights, method=method)
    translations = motion.translations
    if values["lean"] or hips_height or hips_forward:
        translations = _shift_hips(motion, body, values["lean"], hips_height, hips_forward)
    return motion.with_(rotations=rotations, translations=translations)


def _stopped(values: Mapping[str, float], aside: Mapping[str, float], head_down: float) -> dict[str, float]:
    """Return the values with head, arms and legs moved no further than there is room for.

    ``aside`` is how far hips, hands and feet usually are from the middle, in leg lengths; ``head_down``
    how far the head is usually bent forward, in degrees. The limit is the same for all frames.
    """
    out = dict(values)
    way = 1.0 if out["head"] > 0.0 else -1.0
    room = HEAD_DOWN - head_down if way > 0.0 else HEAD_UP + head_down
    out["head"] = way * float(soft_stop(np.array(abs(out["head"])), np.array(max(room, 0.0))))
    for name, room in (("arms", aside["arm"] - aside["hip"] - HAND_ROOM), ("legs", aside["leg"] - FOOT_ROOM)):
        if out[name] < 0.0:
            angle = np.degrees(np.arcsin(np.clip(room / LIMB_LENGTH[name], 0.0, 1.0)))
            out[name] = -float(soft_stop(np.array(-out[name]), angle))
    return out


def _head_down(motion: Motion, body: Body, turned: Array) -> float:
    """Return how far the head is bent forward against the trunk, median over the clip, in degrees."""
    head = body.roles.get("head", body.roles.get("neck"))
    trunk = body.spine[-1] if body.spine else body.roles["hips"]
    if head is None:
        return 0.0
    stance = quaternion.conjugate(neutral_world(motion, body)[0])
    above, below = (quaternion.multiply(turned[:, j], stance[j]) for j in (head, trunk))
    bend = quaternion.log(quaternion.multiply(quaternion.conjugate(below), above)) @ body.left
    return float(np.degrees(np.median(bend)))


def _aside(body: Body, positions: Array, facing: Array) -> dict[str, float]:
    """Return how far from the middle hips, arms' ends and legs' ends usually are, in leg lengths.

    It is the median over the clip for the nearer of the two sides.
    """
    across = quaternion.rotate(facing, body.left) / body.leg_length
    out = {}
    for limb in ("arm", "leg", "hip"):
        ends = [
            body.roles[f"{side}_hip"] if limb == "hip" else _chain(body, f"{side}_{limb}")[-1]
            for side in SIDES
        ]
        places = positions[:, ends] - positions[:, [body.roles["hips"]]]
        left, right = np.median(np.einsum("tei,ti->te", places, across), axis=0)
        out[limb] = float(min(left, -right))
    return out


def _chain(body: Body, limb: str) -> list[int]:
    """Return the joints of an arm from the shoulder to the hand, of a leg from the hip to the ankle."""
    aside = {body.roles.get(f"{limb.split('_')[0]}_{role}") for role in ("collar", "toe")}
    return [joint for joint in body.limbs[limb] if joint not in aside]


def _fade_out(motion: Motion, body: Body, positions: Array, facing: Array) -> dict[str, Array]:
    """Return limb -> how much of the change shows (T,): less the further its end is from hanging."""
    hanging = neutral_world(motion, body)[1]
    hips = body.roles["hips"]
    weights = {}
    for limb in (f"{side}_{part}" for side in SIDES for part in ("arm", "leg")):
        chain = _chain(body, limb)
        length = np.linalg.norm(np.diff(hanging[chain], axis=0), axis=-1).sum()
        rest = quaternion.rotate(facing, hanging[chain[-1]] - hanging[hips])
        away = np.linalg.norm(positions[:, chain[-1]] - positions[:, hips] - rest, axis=-1) / length
        x = np.clip((away - FADE_START) / (FADE_END - FADE_START), 0.0, 1.0)
        weights[limb] = _low_pass(1.0 - x * x * (3.0 - 2.0 * x), motion.fps)
    return weights


def _low_pass(values: Array, fps: float) -> Array:
    """Return ``values`` (T,) without what is faster than the cut-off: a Gaussian, so no overshoot."""
    from scipy.ndimage import gaussian_filter1d

    sigma = np.sqrt(0.5 * np.log(2.0)) / (np.pi * FADE_CUTOFF) * fps  # half amplitude at the cut-off
    smooth: Array = gaussian_filter1d(values, sigma, mode="nearest", truncate=5.0)
    return smooth


def _shift_hips(motion: Motion, body: Body, lean: float, height: float, ahead: float) -> Array:
    """Return the translations with the hips moved: round the ankles by ``lean``, up and to the front."""
    angle = radians(lean)
    shift = (sin(angle) + ahead) * body.forward + (cos(angle) - 1.0 + height) * body.up
    translations = np.array(motion.translations)
    inner = quaternion.rotate(hips_frame(motion, body, steady=True), body.leg_length * shift)
    translations[:, body.roles["hips"]] += inner
    return translations
