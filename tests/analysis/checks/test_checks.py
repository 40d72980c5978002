"""Every check has a clip that fails it and nothing else; samples and captures pass."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.checks.report import CHECKS, Report, check
from mien.edits.pipeline import apply
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.recipe import Step
from mien.rotations import quaternion as quat
from mien.samples import SAMPLES
from mien.samples.curves import keyed
from mien.samples.figure import SIDES
from mien.samples.gestures import REST, statue
from mien.samples.pose import Arm, Turn, about, build, planted
from mien.samples.sample import Truth, sample

SECONDS, FPS = 6.0, 60.0
T = np.arange(int(SECONDS * FPS) + 1) / FPS
SLOW = keyed(T, [(1.0, 0.0), (3.0, 1.0)])  # from 0 to 1 in two seconds


def standing(**arms: Arm) -> Motion:
    """A statue that moves nothing but the arms that are given."""
    pose, contacts = statue(T)
    figure, angles = build(replace(pose, arms={"left": REST, "right": REST} | arms))
    return sample("statue", figure, Truth(contacts, angles)).motion


def turned(motion: Motion, role: str, axis: str, degrees: np.ndarray) -> Motion:
    """A joint turned about an axis of the body, as seen in the world."""
    body = Body.of(motion)
    joint = body.roles[role]
    parent = int(motion.skeleton.parents[joint])
    vector = getattr(body, axis) * np.radians(degrees)[:, None]
    inner = quat.rotate(quat.conjugate(world(motion)[0][:, parent]), vector)
    rotations = np.array(motion.rotations)
    rotations[:, joint] = quat.multiply(quat.exp(inner), rotations[:, joint])
    return motion.with_(rotations=quat.continuous(rotations))


def moved(motion: Motion, shift: np.ndarray) -> Motion:
    """The whole body shifted (T, 3), in metres."""
    translations = np.array(motion.translations)
    translations[:, 0] += 100.0 * shift
    return motion.with_(translations=translations)


Pair = tuple[Motion, Motion | None]  # the clip, and its source


def sliding() -> Pair:
    """All of a walk drifts aside by 5 cm a second."""
    walk = samples.walk(seconds=4.0).motion
    return moved(walk, 0.05 * walk.times[:, None] * [[1.0, 0.0, 0.0]]), walk


def sinking() -> Pair:
    still = standing()
    return moved(still, -0.03 * SLOW[:, None] * [[0.0, 1.0, 0.0]]), still


def hovering() -> Pair:
    still = standing()
    return moved(still, 0.03 * SLOW[:, None] * [[0.0, 1.0, 0.0]]), still


def growing() -> Pair:
    """A forearm a fiftieth longer."""
    still = standing()
    translations = np.array(still.translations)
    translations[:, Body.of(still).roles["left_wrist"]] *= 1.0 + 0.02 * SLOW[:, None]
    return still.with_(translations=translations), still


def looking_back() -> Pair:
    """The head turned by 110 degrees."""
    still = standing()
    return turned(still, "head", "up", 110.0 * SLOW), still


def hand_in_belly() -> Pair:
    d = np.pi / 180.0
    before = Arm(flexion=0.0, abduction=8.0 * d, rotation=-12.0 * d, elbow=14.0 * d)
    inside = replace(before, elbow=(14.0 + 80.0 * SLOW) * d, rotation=(-12.0 - 68.0 * SLOW) * d)
    inside = replace(inside, abduction=(8.0 - 4.0 * SLOW) * d, flexion=-14.0 * d * SLOW)
    return standing(left=inside), standing(left=before)


def leaning() -> Pair:
    """The whole body leans back at the ankles, stiff, until it would fall."""
    still = standing()
    return apply(still, [Step("posture", {"lean": ((1.0, 0.0), (3.0, -13.0))}), Step("foot_plant")]), still


def one_legged_squat() -> Pair:
    """On one leg, straight; and slowly down as deep as few people can."""

    def stance(down: np.ndarray) -> Motion:
        pose, contacts = statue(T)
        hips = pose.hips + np.stack([0.0 * T + 0.075, -0.05 - 0.33 * down, 0.02 - 0.17 * down], axis=-1)
        feet = dict(pose.feet)
        lifted = np.array([0.0, 0.22, 0.42]) + 0.0 * down[:, None]
        up = about(0, np.radians(-25.0 - 45.0 * down))
        foot = replace(feet["right"], ankle=feet["right"].ankle + lifted, rotation=up, toes=up)
        feet["right"] = foot
        lean = Turn(0.0, np.radians(38.0) * down)
        arms = {s: replace(REST, flexion=np.radians(-2.0 + 75.0 * down)) for s in SIDES}
        figure, angles = build(replace(pose, hips=hips, feet=feet, thorax=lean, arms=arms))
        return sample("stance", figure, Truth(contacts, angles)).motion

    return stance(SLOW), stance(0.0 * T)


def swaying() -> Pair:
    """With the feet far apart the body is thrown to one side and back once, by 3 m/s2."""

    def stance(sway: np.ndarray) -> Motion:
        pose, contacts = statue(T)
        feet = {
            side: planted(np.array([0.42 * sign, 0.0, 0.0]), 0.0, 0.0 * T) for side, sign in SIDES.items()
        }
        hips = pose.hips + np.stack([sway, 0.0 * T - 0.13, 0.0 * T], axis=-1)
        arms = dict.fromkeys(SIDES, replace(REST, abduction=np.radians(25.0)))
        figure, angles = build(replace(pose, hips=hips, feet=feet, arms=arms))
        return sample("stance", figure, Truth(contacts, angles)).motion

    once = keyed(T, [(2.0, 0.0), (2.4, 0.08), (2.8, 0.0)])
    return stance(once), stance(0.0 * T)


def floating() -> Pair:
    """A jump shown at three fifths of its speed."""
    jump = samples.jump(fps=60.0).motion
    return jump.with_(frame_time=jump.frame_time / 0.6), None


def trembling() -> Pair:
    still = standing()
    return turned(still, "left_shoulder", "left", 1.0 * np.sin(2.0 * np.pi * 12.0 * T) * SLOW), still


def popping() -> Pair:
    """A hand turned about itself in one single frame."""
    still = standing()
    once = np.zeros(len(T))
    once[200] = 30.0
    return turned(still, "left_wrist", "up", once), still


def something_else() -> Pair:
    """Both arms up in the air for most of the time: another action, though a possible one."""
    up = keyed(T, [(0.2, 0.0), (1.4, 1.0)])
    raised = replace(REST, abduction=np.radians(8.0 + 130.0 * up))
    return standing(left=raised, right=raised), standing()


FAULTS: dict[str, list[Callable[[], Pair]]] = {
    "foot_slide": [sliding],
    "floor": [sinking, hovering],
    "bones": [growing],
    "limits": [looking_back],
    "collision": [hand_in_belly],
    "balance": [leaning],
    "torque": [one_legged_squat],
    "ground": [swaying],
    "flight": [floating],
    "jitter": [trembling],
    "popping": [popping],
    "content": [something_else],
}


def test_every_check_has_a_clip_that_fails_it() -> None:
    assert set(FAULTS) == set(CHECKS)


@pytest.mark.parametrize(
    ("name", "fault"),
    [pytest.param(n, f, id=f"{n}-{f.__name__}") for n, some in FAULTS.items() for f in some],
)
def test_a_fault_fails_exactly_its_check(name: str, fault: Callable[[], Pair]) -> None:
    clip, source = fault()
    report = check(clip.with_(reference=None), against=source)
    told = {f.check.name: (f.value, f.source, f.allowed) for f in report.findings}
    assert report.failed == (name,), {n: told[n] for n in (*report.failed, name)}
    assert report[name].marks
    if source is not None:
        assert check(source, against=source).passed


@pytest.mark.parametrize("name", SAMPLES)
@pytest.mark.parametrize("form", [{}, {"skeleton": "capture31", "unit": "inch", "up": "z", "fps": 30.0}])
def test_samples_pass(name: str, form: dict[str, Any]) -> None:
    if name == "spin":
        pytest.skip("turns as if on a plate: its feet slide")
    report = check(SAMPLES[name](**form).motion)
    assert report.passed, report


def test_marks_say_when_and_which_part() -> None:
    clip, source = looking_back()
    (mark,) = check(clip.with_(reference=None), against=source)["limits"].marks
    assert mark.parts == ("head",)
    # Beyond 85 + 5 degrees once the smooth turn has done 0.82 of its way.
    assert mark.start == pytest.approx(float(T[np.argmax(110.0 * SLOW > 90.0)]), abs=0.03)
    assert mark.end == pytest.approx(T[-1], abs=0.03)


def test_the_report_as_data_and_as_lines() -> None:
    clip, source = looking_back()
    report = check(clip.with_(reference=None), against=source)
    data = report.as_data()
    assert data["passed"] is False
    assert [c["check"] for c in data["checks"]] == list(CHECKS)
    limits = next(c for c in data["checks"] if c["check"] == "limits")
    assert limits["value"] == pytest.approx(25.0, abs=1.0)
    assert limits["marks"][0]["parts"] == ["head"]
    lines = report.timeline(width=60)
    assert lines["limits"][:20] == "." * 20
    assert lines["limits"][-20:] == "!" * 20
    assert set(lines["bones"]) == {"."}
    assert repr(report) == "Report('statue' against its source, 12 checks: failed: limits)"


def test_an_edited_motion_is_compared_with_what_it_was_made_from() -> None:
    walk = samples.walk(seconds=2.0).motion
    sad = mien.edit(walk, [step for step in mien.preset("sad").steps if step.edit != "tempo"])
    assert check(sad).against
    assert not check(walk).against
    own, given = check(sad), check(sad.with_(reference=None), against=walk)
    assert [f.value for f in own.findings] == pytest.approx([f.value for f in given.findings], rel=1e-6)


def test_a_clip_of_another_length_is_compared_by_its_worst() -> None:
    walk = samples.walk(seconds=3.0).motion
    report = check(walk[:120], against=walk)
    assert report.passed
    assert report["content"].value == 0.0


def test_only_what_is_asked_for() -> None:
    report = check(samples.walk(seconds=1.0).motion, only=["bones", "limits"])
    assert [f.check.name for f in report.findings] == ["bones", "limits"]


@pytest.mark.parametrize("frames", [1, 2, 3, 7])
def test_very_short_clips(frames: int) -> None:
    report: Report = check(samples.walk(seconds=1.0).motion[:frames])
    assert all(np.isfinite(f.value) for f in report.findings)


def test_unit_axis_heading_and_rate_do_not_matter() -> None:
    edit = [Step("posture", {"trunk": 25.0, "legs": 10.0})]
    here, there = (
        check(apply(samples.walk(seconds=2.0, fps=60.0, **form).motion, edit))
        for form in ({}, {"unit": "m", "up": "z", "heading": 2.0})
    )
    for one, other in zip(here.findings, there.findings, strict=True):
        assert one.value == pytest.approx(other.value, rel=0.02, abs=0.02), one.check.name
        assert one.passed == other.passed


@pytest.fixture(scope="module")
def captures(data) -> list[Report]:
    """The reports of all real clips of humanoids, each judged by itself."""
    files = [f for f in sorted(data.rglob("*.bvh")) if not {"malformed", "stylized_outputs"} & set(f.parts)]
    out = []
    for file in files:
        try:
            motion = mien.load(file, salvage=True, fps=60.0 if "badheader" in str(file) else None)
            out.append(check(motion))
        except mien.MienError:
            continue
    return out


@pytest.mark.parametrize("name", [n for n, c in CHECKS.items() if not c.needs_source])
def test_ninety_five_of_a_hundred_captures_pass(captures: list[Report], name: str) -> None:
    assert len(captures) > 200
    passed = np.mean([r[name].passed for r in captures])
    assert passed >= 0.95


def test_a_pose_of_the_source_is_judged_as_there_whatever_the_rest_of_the_clip_does() -> None:
    """Elbows bend about the axes of the source's body; an edit that bends them otherwise moves no hinge."""
    source = turned(samples.wave(seconds=6.0).motion, "right_elbow", "left", np.full(361, 60.0))
    edited = turned(source, "right_elbow", "left", np.where(source.times < 4.0, 40.0, 0.0))
    late = edited.times > 4.1
    np.testing.assert_array_equal(edited.rotations[late], source.rotations[late])
    limits, without = (check(m, against=source)["limits"] for m in (edited, source))
    np.testing.assert_allclose(limits.over[late], without.over[late], atol=1e-9)
    assert limits.over[~late].max() > without.over[~late].max() + 5.0, "the other plane is seen where it is"
