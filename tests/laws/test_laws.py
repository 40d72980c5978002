"""Laws that every registered edit obeys from the day it is written.

An edit joins by being registered; what it is tried with stands in CASES, what it is excused from stands
in EXCUSED with the reason.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import mien.edits
from mien.edits.pipeline import apply
from mien.edits.registry import EDITS, Parameter
from mien.kinematics.body import PARTS, Body
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion as quat
from mien.samples import SAMPLES, SKELETONS

# Edit -> parameters to try beside the defaults. Every new edit gets a line here.
CASES: Mapping[str, list[dict[str, Any]]] = {
    "bounce": [{"gain": 2.0}, {"gain": 0.3}, {"beat": 0.02}],
    "control_points": [
        {"pelvis": 0.92, "torso": 0.6},
        {"left_head": 1.3, "right_head": 1.3, "left_pelvis": 1.2, "right_pelvis": 1.2},
        {
            "pelvis": 1.2,
            "torso": 3.0,
            "left_chest": 1.4,
            "right_chest": 1.4,
            "left_ground": 0.7,
            "right_ground": 0.7,
        },
    ],
    "displacement": [
        {"keys": "0.4 head 20 0 0; trunk 8 0 0 | 1 none | 1.8 elbows_out"},
        {"keys": "0.5 arms_legs_in | 2 head_down", "ends": "hold", "method": "body_fixed"},
    ],
    "foot_plant": [{}, {"travel": False}],
    "grid": [
        {"path": 0.4, "timing": 1.6},
        {"path": 1.6, "timing": 0.5},
        {"path": 0.6, "timing": 0.3, "mode": "bilinear"},
    ],
    "in_place": [{}, {"amount": 0.5}],
    "mirror": [{}],
    "nervous": [{"paths": 1.0, "rhythm": 0.2}, {"paths": 0.6, "seed": 7}, {"rhythm": 0.3}],
    "path_length": [{"mid": 1.6}, {"mid": 0.4, "high": 0.5}, {"mid": 1.5, "mode": "edges"}],
    "posture": [
        {"head": 25, "trunk": 10, "elbows": 20, "arms": 12, "legs": 3},
        {"pose": "head_down"},
        {"pose": "arms_legs_in", "amount": 0.5, "method": "additive"},
    ],
    "repair": [{}, {"what": ("limits", "collision", "floor")}],
    "resample": [{"fps": 40}],
    "restore": [{"amount": 0.5}, {"amount": 1.0}],
    "sway": [
        {"hips_tilt": 2.0, "hips_turn": 0.5},
        {"shoulders_tilt": 2.5, "shoulders_turn": 1.8},
        {"hips_tilt": 0.4, "hips_turn": 2.0, "shoulders_tilt": 0.5, "shoulders_turn": 0.4},
        {"shift": 5},
    ],
    "tempo": [{"rate": 1.25}, {"rate": 0.8, "travel": "speed"}, {"rate": 1.5, "flight": "free"}],
    "timing": [
        {"acceleration": 0.6},
        {"acceleration": -0.8},
        {"acceleration": 0.5, "limbs": ("left_arm", "right_arm")},
        {"acceleration": 0.8, "where": "impacts"},
        {"acceleration": -0.8, "where": "impacts"},
    ],
    "tremor": [{"amount": 3}, {"amount": 5, "low": 0.3, "high": 1, "seed": 7}],
    "trim": [{"end": 1.5}],
    "waveshape": [{"small": 0.3}, {"small": 1.8, "large": 0.6, "border": 15}, {"limit": 20}],
}
# Edit without a neutral value -> parameters that leave the motion as it is, or why there are none.
NEUTRAL: Mapping[str, dict[str, Any] | str] = {
    "foot_plant": {},
    "repair": {},
    "mirror": "a mirror always swaps; twice is the motion again, which its own tests show",
    "resample": {},
    "trim": {},
}
# (edit, law) -> why this edit, or "edit.parameter" where that is given, need not obey that law.
EXCUSED: Mapping[tuple[str, str], str] = {
    ("grid", "result_does_not_depend_on_the_frame_rate"): "path_length with foot_plant after it moves a knee "
    "by up to 8 % from rate to rate, as contacts begin on whole frames; tests/edits/test_grid.py shows that "
    "a point of the square is not worse than the nine",
    ("grid", "result_does_not_depend_on_the_skeleton"): "it times limbs as timing does, see there",
    ("nervous", "mirror_commutes"): "the arms wander each at its own times, as hands do in tremor",
    (
        "repair",
        "result_does_not_depend_on_the_frame_rate",
    ): "balance looks at what planted feet span, and a "
    "contact that the end of the clip cuts is seen at one rate and not at the other (2 % of a leg)",
    (
        "sway.shift",
        "mirror_commutes",
    ): "whoever stands evenly on both legs has to begin with one of them, and "
    "begins with the same one in the mirror",
    ("tempo", "result_does_not_depend_on_the_frame_rate"): "steps that keep their speed stand by the middle "
    "of a contact, and one that the end of the clip cuts is seen at one rate and not at the other; "
    "tests/edits/test_tempo.py shows it for whole steps",
    ("timing", "result_does_not_depend_on_the_skeleton"): "it times the tip of the hand, and skeletons have "
    "hands of different lengths, so that pauses fall some hundredths of a second apart",
    ("tremor", "mirror_commutes"): "left and right shake by noise of their own; if that commuted with a "
    "mirror, both hands would shake as one",
}

# Name of a sample, the form it is written in: three skeletons, units, axes, rates and headings.
CLIPS: Mapping[str, tuple[str, dict[str, Any]]] = {
    "walk, standard22, cm": ("walk", {"skeleton": "standard22", "fps": 60.0}),
    "turn, capture31, inch, z up": (
        "turn",
        {"skeleton": "capture31", "fps": 50.0, "unit": "inch", "up": "z"},
    ),
    "tired walk, poser43, m": (
        "tired_walk",
        {"skeleton": "poser43", "fps": 30.0, "unit": "m", "heading": 2.0},
    ),
    "wave, standard22, m, z up": ("wave", {"skeleton": "standard22", "fps": 60.0, "unit": "m", "up": "z"}),
}
FIRST = next(iter(CLIPS))


@cache
def sample(name: str, **form: Any) -> Motion:
    return SAMPLES[name](**form).motion


def clip(which: str, **changes: Any) -> Motion:
    """Return a sample of at most three seconds, in its form or a changed one."""
    name, form = CLIPS[which]
    motion = sample(name, **(form | changes))
    return motion[: int(3 * motion.fps) + 1]


def pairs() -> Iterator[Any]:
    """Every edit with every one of its cases."""
    for name in sorted(EDITS):
        for number, parameters in enumerate(CASES.get(name, [])):
            yield pytest.param(name, parameters, id=f"{name}-{number}")


every_case = pytest.mark.parametrize(("name", "parameters"), list(pairs()))
every_edit = pytest.mark.parametrize("name", sorted(EDITS))
every_clip = pytest.mark.parametrize("which", CLIPS)


@pytest.fixture(autouse=True)
def excused(request: pytest.FixtureRequest) -> None:
    """Skip what EXCUSED names, with its reason."""
    if "name" in request.fixturenames:
        law = request.function.__name__.removeprefix("test_")
        name = request.getfixturevalue("name")
        given = request.getfixturevalue("parameters") if "parameters" in request.fixturenames else ()
        for subject in (name, *(f"{name}.{parameter}" for parameter in given)):
            if reason := EXCUSED.get((subject, law)):
                pytest.skip(reason)


def points(motion: Motion) -> np.ndarray:
    """World positions (T, J, 3) in leg lengths."""
    return world(motion)[1] / Body.of(motion).leg_length


def preparation(name: str, parameters: Mapping[str, Any]) -> list[Step]:
    """What is done before an edit: a change of pose, so that repairs have something to mend."""
    if "collision" in parameters.get("what", ()):
        return [Step("posture", {"trunk": 12, "legs": 5, "arms": -25, "fade": False})]  # arms in the body
    mends = EDITS[name].kind == "repair" or name == "restore"
    return [Step("posture", {"trunk": 12, "legs": 5})] if mends else []


def done(motion: Motion, name: str, parameters: Mapping[str, Any]) -> Motion:
    """The edit, after what is done before it."""
    return apply(motion, [*preparation(name, parameters), Step(name, parameters)])


def moved(motion: Motion, yaw: float, shift: np.ndarray) -> Motion:
    """Turn a motion about the up axis and shift it."""
    turn = quat.exp(yaw * Body.of(motion).up)
    roots = motion.skeleton.parents < 0
    rotations, translations = np.array(motion.rotations), np.array(motion.translations)
    rotations[:, roots] = quat.multiply(turn, rotations[:, roots])
    translations[:, roots] = quat.rotate(turn, translations[:, roots]) + shift
    return motion.with_(rotations=rotations, translations=translations)


def angle(a: np.ndarray, b: np.ndarray) -> float:
    """The largest angle between rotations, in radians."""
    return float(np.linalg.norm(quat.log(quat.multiply(quat.conjugate(a), b)), axis=-1).max())


def other_side(role: str) -> str:
    """Return the role's partner in a mirror."""
    side, _, name = role.partition("_")
    return {"left": f"right_{name}", "right": f"left_{name}"}.get(side, role)


def is_sound(before: Motion, after: Motion) -> None:
    """No NaN, unit quaternions that do not flip, bones as long as they were."""
    assert np.isfinite(after.rotations).all()
    assert np.isfinite(after.translations).all()
    np.testing.assert_allclose(np.linalg.norm(after.rotations, axis=-1), 1.0, atol=1e-9)
    assert (np.einsum("tji,tji->tj", after.rotations[1:], after.rotations[:-1]) > 0).all()
    hips = Body.of(before).roles["hips"]
    bones = [j for j in before.skeleton.descendants(hips) if j != hips]
    length = np.linalg.norm(before.translations[:, bones], axis=-1)
    found = np.linalg.norm(after.translations[:, bones], axis=-1)
    slack = 1e-9 * Body.of(before).leg_length
    assert (found.min(axis=0) >= length.min(axis=0) - slack).all()
    assert (found.max(axis=0) <= length.max(axis=0) + slack).all()


@every_edit
def test_edit_has_cases(name: str) -> None:
    assert CASES.get(name), f"add a line for {name!r} to CASES in tests/laws/test_laws.py"
    follows = any(p.about.neutral is not None for p in EDITS[name].parameters.values())
    assert follows or name in NEUTRAL, f"say in NEUTRAL which parameters of {name!r} change nothing, or why"


def test_tables_name_only_what_exists() -> None:
    laws = {n.removeprefix("test_") for n in globals() if n.startswith("test_")}
    assert {*CASES, *NEUTRAL, *(name.partition(".")[0] for name, _ in EXCUSED)} <= set(EDITS)
    assert {law for _, law in EXCUSED} <= laws
    assert all(len(reason) > 20 for reason in EXCUSED.values())


@every_case
def test_a_case_does_something(name: str, parameters: dict[str, Any]) -> None:
    """What changes no clip would obey every law."""
    for whole in map(clip, CLIPS):
        motion, after = apply(whole, preparation(name, parameters)), done(whole, name, parameters)
        if len(after) != len(motion) or after.frame_time != motion.frame_time:
            return
        if max(angle(after.rotations, motion.rotations), np.abs(points(after) - points(motion)).max()) > 0.01:
            return
    pytest.fail("no clip is changed: choose other parameters, or a clip on which they do something")


@every_clip
@every_case
def test_neutral_parameters_change_nothing(name: str, parameters: dict[str, Any], which: str) -> None:
    motion, known = clip(which), EDITS[name].parameters
    neutral = {n: p.about.neutral for n, p in known.items() if p.about.neutral is not None}
    if not neutral and isinstance(NEUTRAL[name], str):
        pytest.skip(str(NEUTRAL[name]))
    values = parameters | neutral if neutral else dict(NEUTRAL[name])
    after = apply(motion, [Step(name, values)])
    assert angle(after.rotations, motion.rotations) < 1e-9
    np.testing.assert_allclose(points(after), points(motion), atol=1e-9)


@every_case
def test_strength_zero_is_the_very_motion(name: str, parameters: dict[str, Any]) -> None:
    motion = clip(FIRST)
    assert apply(motion, [Step(name, parameters, strength=0.0)]) is motion


@every_clip
@every_case
def test_strength_grows_from_nothing(name: str, parameters: dict[str, Any], which: str) -> None:
    """A millionth of the strength makes at most some hundred-thousandths of a leg length of difference."""
    if EDITS[name].kind != "pose":
        pytest.skip("only pose edits follow strength")
    motion = clip(which)
    after = apply(motion, [Step(name, parameters, strength=1e-6)])
    assert np.abs(points(after) - points(motion)).max() < 5e-5


@every_clip
@every_case
def test_result_is_sound(name: str, parameters: dict[str, Any], which: str) -> None:
    motion = clip(which)
    is_sound(motion, done(motion, name, parameters))


@every_clip
@every_case
def test_input_is_untouched(name: str, parameters: dict[str, Any], which: str) -> None:
    motion = clip(which)
    before = motion.rotations.tobytes(), motion.translations.tobytes(), motion.skeleton.offsets.tobytes()
    after = done(motion, name, parameters)
    assert (
        motion.rotations.tobytes(),
        motion.translations.tobytes(),
        motion.skeleton.offsets.tobytes(),
    ) == before
    assert not after.rotations.flags.writeable
    assert not after.translations.flags.writeable
    assert motion.history == ()


@every_clip
@every_case
def test_history_replays_to_the_same_bytes(name: str, parameters: dict[str, Any], which: str) -> None:
    motion = clip(which)
    once = done(motion, name, parameters)
    for first in (once, apply(once, [Step(name, parameters)]), EDITS[name].perform(motion, parameters)):
        again = apply(motion, first.history) if first.history else first
        assert again.rotations.tobytes() == first.rotations.tobytes()
        assert again.translations.tobytes() == first.translations.tobytes()


@every_clip
@every_case
def test_yaw_and_translation_commute(name: str, parameters: dict[str, Any], which: str) -> None:
    motion = clip(which)
    body = Body.of(motion)
    shift = body.leg_length * (3.0 * body.forward - 7.0 * body.left)
    one = done(moved(motion, 2.1, shift), name, parameters)
    other = moved(done(motion, name, parameters), 2.1, shift)
    np.testing.assert_allclose(points(one), points(other), atol=1e-6)


@every_clip
@every_case
def test_result_does_not_depend_on_the_unit(name: str, parameters: dict[str, Any], which: str) -> None:
    metres, inches = (done(clip(which, unit=unit), name, parameters) for unit in ("m", "inch"))
    assert angle(metres.rotations, inches.rotations) < 1e-6
    np.testing.assert_allclose(points(metres), points(inches), atol=1e-6)


@every_clip
@every_case
def test_result_does_not_depend_on_the_frame_rate(name: str, parameters: dict[str, Any], which: str) -> None:
    """The same movement sampled at 60 and 120 Hz: at the frames both have, within 1.5 % of a leg length.

    Not closer, as contacts and pauses begin and end on whole frames.
    """
    slow, fast = (done(clip(which, fps=fps), name, parameters) for fps in (60.0, 120.0))
    assert slow.duration == pytest.approx(fast.duration, abs=slow.frame_time)
    step = round(fast.fps / slow.fps)
    common = min(len(slow), len(fast[::step]))
    assert np.abs(points(slow)[:common] - points(fast[::step])[:common]).max() < 0.015


@every_clip
@every_case
@pytest.mark.parametrize("skeleton", SKELETONS)
def test_result_does_not_depend_on_the_skeleton(
    name: str, parameters: dict[str, Any], which: str, skeleton: str
) -> None:
    """The same movement on another skeleton: every role where it is on the first, within 3 %.

    Not closer, as where a rest pose says nothing the calm stance is estimated from the movement.
    """
    one, other = clip(which), clip(which, skeleton=skeleton)
    here, there = Body.of(one).roles, Body.of(other).roles
    roles = sorted(set(here) & set(there))
    first = points(done(one, name, parameters))[:, [here[r] for r in roles]]
    second = points(done(other, name, parameters))[:, [there[r] for r in roles]]
    assert np.abs(first - second).max() < 0.03


@every_clip
@every_case
def test_mirror_commutes(name: str, parameters: dict[str, Any], which: str) -> None:
    motion = clip(which)
    body, positions = Body.of(motion), points(motion)
    here = list(body.roles.values())
    there = [body.roles.get(other_side(role), joint) for role, joint in body.roles.items()]
    normal = positions[0, body.roles["left_hip"]] - positions[0, body.roles["right_hip"]]
    normal -= (normal @ body.up) * body.up
    normal /= np.linalg.norm(normal)

    def reflected(seen: np.ndarray) -> np.ndarray:
        return seen[:, there] - 2.0 * (seen[:, there] @ normal)[..., None] * normal

    glass = apply(motion, [Step("mirror")]).with_(history=(), reference=None)
    offset = points(glass)[:, here] - reflected(positions)
    place = offset.mean(axis=(0, 1))  # where the mirror stands is not asked
    assert np.abs(offset - place).max() < 0.01, "the mirrored sample is not the mirror image of the sample"
    one = points(done(glass, name, parameters))[:, here]
    other = reflected(points(done(motion, name, parameters))) + place
    assert np.abs(one - other).max() < 0.01


@every_clip
@every_case
@pytest.mark.parametrize("frames", [1, 2, 3])
def test_very_short_clips_are_sound(name: str, parameters: dict[str, Any], which: str, frames: int) -> None:
    motion = clip(which)[:frames]
    is_sound(motion, done(motion, name, parameters))


def bounds() -> Iterator[Any]:
    for name in sorted(EDITS):
        for p in EDITS[name].parameters.values():
            for value in {p.about.low, p.about.high} - {None}:
                yield pytest.param(name, p.name, p.kind(value), id=f"{name}-{p.name}={value:g}")


@pytest.mark.parametrize(("name", "parameter", "value"), list(bounds()))
def test_ends_of_every_range_are_sound(name: str, parameter: str, value: float) -> None:
    motion = clip(FIRST)
    for case in CASES.get(name, [{}])[:1]:
        try:
            after = done(motion, name, case | {parameter: value})
        except mien.MienError as refusal:
            if f"{name}: " not in str(refusal):
                raise  # a refusal says which edit it comes from
        else:
            is_sound(motion, after)


def values(parameter: Parameter) -> st.SearchStrategy[Any]:
    """Anything a parameter allows."""
    about, default = parameter.about, st.just(parameter.default)
    if parameter.kind is float:
        return st.floats(about.low, about.high, allow_nan=False, allow_infinity=False) | default
    if parameter.kind is int:
        return st.integers(int(about.low or 0), int(about.high or 9)) | default
    if parameter.kind is bool:
        return st.booleans()
    if parameter.choices:
        one = st.sampled_from(parameter.choices)
        return one if parameter.kind is str else st.lists(one, unique=True).map(tuple)
    return default


@every_edit
@settings(max_examples=12, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_anything_allowed_is_sound_and_replays(name: str, data: st.DataObject) -> None:
    motion = clip(data.draw(st.sampled_from(list(CLIPS))))[: data.draw(st.sampled_from([1, 7, 60]))]
    step = Step(
        name,
        {n: data.draw(values(p)) for n, p in EDITS[name].parameters.items()},
        strength=data.draw(st.floats(0, 2)),
        parts=tuple(data.draw(st.lists(st.sampled_from(sorted(PARTS)), max_size=2, unique=True))),
        span=data.draw(st.none() | st.just((0.2, 0.7))),
    )
    try:
        after = apply(motion, [step])
    except mien.MienError as refusal:
        if f"{name}: " not in str(refusal):
            raise
        return
    is_sound(motion, after)
    again = apply(motion, after.history)
    assert again.rotations.tobytes() == after.rotations.tobytes()
    assert again.translations.tobytes() == after.translations.tobytes()
