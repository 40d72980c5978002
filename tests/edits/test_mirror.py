"""Mirror: twice is the motion, once is its picture, from the same start."""

from pathlib import Path

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits.mirror import mirror
from mien.edits.posture import posture
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.heading import heading
from mien.kinematics.mirroring import partners
from mien.motion import Motion


def same(one: Motion, other: Motion) -> None:
    """Same rotations (whatever the sign of the quaternions) and translations."""
    unit = Body.of(one).leg_length
    np.testing.assert_allclose(np.abs(np.sum(one.rotations * other.rotations, axis=-1)), 1.0, atol=1e-12)
    np.testing.assert_allclose(one.translations, other.translations, atol=1e-9 * unit)


CLIPS = [("wave", {}), ("turn", {"up": "z", "unit": "inch"}), ("walk", {"heading": 2.3}), ("spin", {})]


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize(("clip", "form"), CLIPS)
def test_twice_is_the_motion(skeleton: str, clip: str, form: dict[str, object]) -> None:
    motion = samples.SAMPLES[clip](skeleton=skeleton, **form).motion
    same(mirror(mirror(motion)), motion)


@pytest.mark.parametrize("skeleton", samples.SKELETONS)
@pytest.mark.parametrize(("clip", "form"), CLIPS)
def test_every_joint_is_where_the_mirror_shows_its_partner(
    skeleton: str, clip: str, form: dict[str, object]
) -> None:
    """The samples' figure is symmetric, so positions reflect exactly, about the hip joints' line."""
    motion = samples.SAMPLES[clip](skeleton=skeleton, **form).motion
    roles = Body.of(motion).roles
    before, after = world(motion)[1], world(mirror(motion))[1]
    up = Body.of(motion).up
    side = before[0, roles["left_hip"]] - before[0, roles["right_hip"]]
    normal = side - (side @ up) * up
    normal /= np.linalg.norm(normal)
    picture = before - 2.0 * ((before - before[0, roles["hips"]]) @ normal)[..., None] * normal
    for role, joint in roles.items():
        swap = {"left": "right", "right": "left"}
        first, _, rest = role.partition("_")
        other = roles[f"{swap[first]}_{rest}" if first in swap else role]
        np.testing.assert_allclose(
            after[:, joint], picture[:, other], atol=2e-3 * Body.of(motion).leg_length, err_msg=role
        )


def test_it_starts_at_the_same_place_and_heading_and_turns_the_other_way() -> None:
    turn = samples.turn(seconds=4.0, heading=1.1).motion
    after = mirror(turn)
    body = Body.of(turn)
    hips = body.roles["hips"]
    np.testing.assert_allclose(world(after)[1][0, hips], world(turn)[1][0, hips], atol=1e-9)
    before, now = heading(world(turn)[1], body), heading(world(after)[1], body)
    assert now[0] == pytest.approx(before[0], abs=1e-6)
    np.testing.assert_allclose(now - now[0], -(before - before[0]), atol=1e-6)
    assert abs(before[-1] - before[0]) > 1.0


def test_symmetric_posture_commutes() -> None:
    walk = samples.walk(seconds=1.5, skeleton="capture31").motion
    values = {"head": 20.0, "trunk": 10.0, "arms": 12.0, "elbows": 25.0, "legs": 4.0, "lean": 2.0}
    one, other = mirror(posture(walk, **values)), posture(mirror(walk), **values)
    # the mirror stands by the hips, which the lean has tilted a little: 0.6 %
    np.testing.assert_allclose(world(one)[1], world(other)[1], atol=0.01 * Body.of(walk).leg_length)


def test_half_a_stride_later_a_symmetric_walk_is_its_own_mirror() -> None:
    """At 2 steps a second half a stride is 30 frames. Told by distances, as headings differ."""
    walk = samples.walk(seconds=3.0, fps=60.0, cadence=2.0).motion
    body = Body.of(walk)
    roles = list(body.roles.values())

    def distances(motion: Motion) -> np.ndarray:
        positions = world(motion)[1][:, roles]
        return np.linalg.norm(positions[:, :, None] - positions[:, None], axis=-1)

    one, other = distances(walk), distances(mirror(walk))
    np.testing.assert_allclose(one[30:], other[:-30], atol=0.005 * body.leg_length)
    assert np.abs(one[30:] - one[:-30]).max() > 0.1 * body.leg_length


@pytest.mark.parametrize(
    "clip",
    [
        "bandai1/dataset-1_walk_normal_001.bvh",
        "cmu_daz/02_01.bvh",
        "cmu_mb_misc/02_01.bvh",
        "cmu_iclone100j/002_01.bvh",
        "reactidle/000_genuine.bvh",
        "exporters/jesse_dance.bvh",
        "exporters/custom_skeleton_walk_example.bvh",
    ],
)
def test_real_skeletons(data: Path, clip: str) -> None:
    """Twice is the motion; once, joints are as far apart as their partners were."""
    if not (data / clip).is_file():
        pytest.skip(f"no {clip}")
    motion = mien.load(data / clip)[:120]
    after = mirror(motion)
    same(mirror(after), motion)
    body, partner = Body.of(motion), partners(motion.skeleton, Body.of(motion))
    roles = list(body.roles.values())
    gaps = []
    for positions, joints in ((world(motion)[1], partner[roles]), (world(after)[1], roles)):
        p = positions[:, joints]
        gaps.append(np.linalg.norm(p[:, :, None] - p[:, None], axis=-1))
    np.testing.assert_allclose(gaps[0], gaps[1], atol=0.05 * body.leg_length)
