"""The samples know their own truth: what was put into them must be measured."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import mien
from mien import samples
from mien.analysis.measures import MEASURES, measures
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.rotations import quaternion
from mien.samples.sample import Sample

FORMS = (
    {},
    {"unit": "m", "fps": 120.0},
    {"up": "z", "unit": "inch", "heading": 2.0},
    *({"skeleton": name} for name in samples.SKELETONS),
)
# The rest pose of this rig is no stance, so what neutral is must be guessed from the clip.
NO_REST_POSE = "engine23"


@pytest.mark.parametrize("form", FORMS, ids=str)
@pytest.mark.parametrize("make", [samples.walk, samples.tired_walk], ids=["walk", "tired"])
def test_walks_measure_what_was_put_into_them(make: Callable[..., Sample], form: dict[str, object]) -> None:
    sample = make(**form)
    found = measures(sample.motion)
    assert set(found) == set(MEASURES)
    to_cm = 100.0 * sample.metres_per_unit
    mean = {name: float(np.degrees(angle.mean())) for name, angle in sample.angles.items()}
    assert found["elbow_flexion"] == pytest.approx(0.5 * (mean["left_elbow"] + mean["right_elbow"]), abs=1.0)
    if form.get("skeleton") != NO_REST_POSE:
        assert found["head_pitch"] == pytest.approx(mean["head_lean"], abs=2.0)
    assert found["speed"] == pytest.approx(sample.facts["speed"] * to_cm / 100, rel=0.03)
    assert found["step_length"] == pytest.approx(sample.facts["step_length"] * to_cm, rel=0.05)
    assert found["duration"] == pytest.approx(sample.motion.duration)
    assert found["foot_sink"] < 0.2
    assert found["foot_slide"] < 3.0


def test_a_bowed_head_is_lower_than_an_upright_one_on_any_rig() -> None:
    tired, walk = (
        measures(make(skeleton=NO_REST_POSE).motion)["head_pitch"]
        for make in (samples.tired_walk, samples.walk)
    )
    assert tired > walk + 5.0


def test_measures_do_not_depend_on_unit_axis_heading_or_rate() -> None:
    wanted = measures(samples.walk(fps=60.0).motion)
    for form in ({"unit": "m"}, {"up": "z"}, {"heading": 2.5}):
        found = measures(samples.walk(fps=60.0, **form).motion)
        for name, value in wanted.items():
            assert found[name] == pytest.approx(value, rel=1e-3, abs=1e-2), (name, form)
    found = measures(samples.walk(fps=120.0).motion)
    for name in ("head_pitch", "trunk_flexion", "elbow_flexion", "hips_height", "speed"):
        assert found[name] == pytest.approx(wanted[name], rel=0.02, abs=0.2), name


def test_arm_swing_of_a_pendulum_arm() -> None:
    """A sine of amplitude A has a range from 5th to 95th percentile of 2 A sin(0.45 pi)."""
    still = samples.still(seconds=4.0).motion
    body = Body.of(still)
    swung, turned = np.array(still.rotations), world(still)[0]
    angle = np.radians(30.0) * np.sin(2 * np.pi * np.arange(len(still)) / 60.0)
    for side in ("left", "right"):
        joint = body.roles[f"{side}_shoulder"]
        parent = turned[:, still.skeleton.parents[joint]]
        turn = quaternion.exp(angle[:, None] * body.left)
        local = quaternion.multiply(quaternion.conjugate(parent), quaternion.multiply(turn, parent))
        swung[:, joint] = quaternion.multiply(local, swung[:, joint])
    found = measures(still.with_(rotations=swung), body=body)
    assert found["arm_swing"] == pytest.approx(60.0 * np.sin(0.45 * np.pi), rel=0.03)


def test_trunk_and_head_bent_by_known_angles() -> None:
    still = samples.still(seconds=1.0).motion
    before = measures(still)
    after = measures(mien.edit(still, [mien.Step("posture", {"head": 20.0})]), body=Body.of(still))
    assert after["head_pitch"] - before["head_pitch"] == pytest.approx(20.0, abs=0.1)
    assert after["trunk_flexion"] == pytest.approx(before["trunk_flexion"], abs=1e-6)


def test_feet_that_slide_and_sink_are_measured() -> None:
    still = samples.still(seconds=2.0).motion
    body = Body.of(still)
    hips = int(body.roles["hips"])
    moved = np.array(still.translations)
    share = np.linspace(-0.5, 0.5, len(still))[:, None]
    moved[:, hips] += 6.0 * share * body.forward  # 3 cm from where the foot stands on average, slowly
    moved[len(still) // 2 :, hips] -= 2.0 * body.up
    from mien.analysis.measures import Footing

    footing = Footing.of(still, body)
    found = measures(still.with_(translations=moved), body=body, footing=footing)
    assert found["foot_slide"] - measures(still)["foot_slide"] == pytest.approx(3.0, abs=0.3)
    assert found["foot_sink"] - measures(still)["foot_sink"] == pytest.approx(2.0, abs=0.1)


def test_a_t_pose_before_the_motion_does_not_count() -> None:
    walk = samples.walk(fps=60.0).motion
    pose = np.array(Body.of(walk).neutral)
    for side, turn in (("left", 80.0), ("right", -80.0)):
        joint = Body.of(walk).roles[f"{side}_shoulder"]
        pose[joint] = quaternion.multiply(quaternion.exp(np.radians([0.0, 0.0, turn])), pose[joint])
    places = (
        walk.translations[:1] + 20.0 * Body.of(walk).forward * (np.arange(len(walk.skeleton)) == 0)[:, None]
    )
    still = walk.with_(
        rotations=np.concatenate([pose[None], walk.rotations]),
        translations=np.concatenate([places, walk.translations]),
    )
    body = Body.of(walk)
    wanted, found = measures(walk, body=body), measures(still, body=body)
    assert found.pop("duration") > wanted.pop("duration")
    for name, value in wanted.items():
        assert found[name] == pytest.approx(value), name


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_short_clips_have_measures_or_none(frames: int) -> None:
    with np.errstate(all="raise"):
        found = measures(samples.walk().motion[:frames])
    assert np.isfinite(found["head_pitch"])
    assert np.isfinite(found["speed"]) == (frames > 1)


def test_standing_still_has_no_steps() -> None:
    assert np.isnan(measures(samples.still().motion)["step_length"])


@pytest.mark.parametrize("middle", [0.0, 90.0, 180.0])
def test_arm_swing_of_an_arm_that_waves_to_the_side_or_overhead(middle: float) -> None:
    """Arms spread, or held overhead, that go 20 degrees to the front and back: no turning over at 180."""
    still = samples.still(seconds=4.0).motion
    body = Body.of(still)
    turned, raised = world(still)[0], np.array(still.rotations)
    swing = np.radians(20.0) * np.sin(2 * np.pi * np.arange(len(still)) / 60.0)
    for side, sign in (("left", 1.0), ("right", -1.0)):
        joint = body.roles[f"{side}_shoulder"]
        parent = turned[:, still.skeleton.parents[joint]]
        axis = body.left if middle != 90.0 else sign * body.up
        lift = quaternion.exp(sign * np.radians(middle) * body.forward)
        turn = quaternion.multiply(quaternion.exp(swing[:, None] * axis), lift)
        local = quaternion.multiply(quaternion.conjugate(parent), quaternion.multiply(turn, parent))
        raised[:, joint] = quaternion.multiply(local, raised[:, joint])
    found = measures(still.with_(rotations=raised), body=body)["arm_swing"]
    assert found == pytest.approx(40.0 * np.sin(0.45 * np.pi), rel=0.05)


def test_arm_swing_of_real_clips_is_an_angle(data: Path) -> None:
    for name in ("exporters/sample", "exporters/dab", "cmu_daz/05_20", "cmu_mb_misc/backflip"):
        motion = mien.load(data / f"{name}.bvh")
        assert 0.0 <= measures(motion)["arm_swing"] <= 180.0, name
