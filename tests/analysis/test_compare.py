import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import mien
from mien import samples
from mien.analysis.compare import FRAMES, SHARES, before_after, compare
from mien.errors import MienError
from mien.kinematics.body import Body


@pytest.fixture(scope="module")
def walk() -> mien.Motion:
    return samples.walk(seconds=2.0, fps=30.0).motion


def turned(motion: mien.Motion, name: str, degrees: np.ndarray) -> mien.Motion:
    """Turn one joint about its own y axis, by SciPy."""
    joint = motion.skeleton.names.index(name)
    rotations = np.array(motion.rotations)
    turn = Rotation.from_rotvec(np.radians(degrees)[:, None] * [0.0, 1.0, 0.0])
    rotations[:, joint] = (Rotation.from_quat(rotations[:, joint]) * turn).as_quat()
    return motion.with_(rotations=rotations)


def test_a_clip_is_the_same_as_itself(walk: mien.Motion) -> None:
    found = compare(walk, walk)
    assert found.same
    assert found.aligned == FRAMES
    assert found.rotation_max.max() < 1e-12
    for change in found.changes:
        np.testing.assert_equal(change.after, change.before)


def test_a_joint_turned_by_known_angles(walk: mien.Motion) -> None:
    degrees = np.linspace(-10.0, 30.0, len(walk))
    found = compare(walk, turned(walk, "LeftForeArm", degrees))
    elbow, hand = (found.joints.index(name) for name in ("LeftForeArm", "LeftHand"))
    assert found.rotation_max[elbow] == pytest.approx(30.0)
    assert found.rotation_mean[elbow] == pytest.approx(np.abs(degrees).mean())
    assert np.delete(found.rotation_max, elbow).max() < 1e-6
    forearm = walk.skeleton.offsets[hand] / Body.of(walk).leg_length
    across = np.linalg.norm(np.cross([0.0, 1.0, 0.0], forearm))
    assert found.distance_max[hand] == pytest.approx(2 * across * np.sin(np.radians(15)), rel=1e-6)
    assert np.flatnonzero(found.distance_max > 1e-9).tolist() == [hand]
    assert found.hips_max == 0.0
    assert not found.same


def test_hips_moved_away_leave_the_pose_the_same(walk: mien.Motion) -> None:
    body = Body.of(walk)
    moved = np.array(walk.translations)
    moved[:, body.roles["hips"]] += 0.3 * body.leg_length * body.forward
    found = compare(walk, walk.with_(translations=moved))
    assert found.hips_mean == pytest.approx(0.3, rel=1e-6)
    assert found.distance_max.max() < 1e-9
    assert not found.same


def test_order_of_joints_and_unit_do_not_matter(walk: mien.Motion) -> None:
    order = np.array([0, 18, 19, 20, 21, *range(1, 18)])
    place = np.argsort(order)
    parents = walk.skeleton.parents[order]
    skeleton = mien.Skeleton(
        tuple(walk.skeleton.names[j] for j in order),
        np.where(parents < 0, -1, place[parents]),
        0.01 * walk.skeleton.offsets[order],
        place[walk.skeleton.end_parents],
        0.01 * walk.skeleton.end_offsets,
    )
    other = walk.with_(
        skeleton=skeleton, rotations=walk.rotations[:, order], translations=0.01 * walk.translations[:, order]
    )
    found = compare(walk, other)
    assert found.rotation_max.max() < 1e-5
    assert max(found.distance_max.max(), found.hips_max) < 1e-9


def test_clips_of_different_length_are_compared_at_the_same_share(walk: mien.Motion) -> None:
    half = walk[::2]
    found = compare(walk, half)
    assert found.aligned == SHARES
    assert not found.same
    step = np.degrees(
        2 * np.arccos(np.clip(np.abs((walk.rotations[1:] * walk.rotations[:-1]).sum(-1)), 0, 1))
    )
    assert (found.rotation_max <= step.max(axis=0) + 1e-6).all(), "never further apart than one frame"


def test_different_skeletons_are_refused_with_the_joints_named(walk: mien.Motion) -> None:
    names = ["Skull" if n == "Head" else n for n in walk.skeleton.names]
    other = walk.with_(skeleton=mien.Skeleton(tuple(names), walk.skeleton.parents, walk.skeleton.offsets))
    with pytest.raises(MienError, match=r"only in the first 1, only in the second 1 joints \(Head, Skull\)"):
        compare(walk, other)


def test_an_edit_is_judged_on_the_feet_of_the_original(walk: mien.Motion) -> None:
    """Shorter paths without repair make the feet slide, also where their own contacts would hide it."""
    slid = mien.apply(walk, [mien.Step("path_length", {"mid": 0.4})])
    planted = mien.apply(slid, [mien.Step("foot_plant")])
    loose, kept = ({c.name: c for c in before_after(walk, m)} for m in (slid, planted))
    assert loose["foot_slide"].after > loose["foot_slide"].before + 5.0
    assert kept["foot_slide"].after < kept["foot_slide"].before + 0.2
    assert kept["step_length"].after < 0.8 * kept["step_length"].before


def test_everything_is_plain_data(walk: mien.Motion) -> None:
    data = compare(walk, turned(walk, "Head", np.full(len(walk), 5.0))).as_data()
    json.dumps(data)
    assert len(data["joints"]) == 22
    assert {"Head", "LeftHand", "RightToeBase"} <= set(data["tips"])


def test_two_separate_clips_are_each_judged_on_their_own_feet(walk: mien.Motion) -> None:
    """A mirrored clip slides as little as the clip: its feet stand at other times."""
    mirrored = mien.apply(walk, mien.Step("mirror")).with_(history=(), reference=None)
    found = {c.name: c for c in compare(walk, mirrored).changes}
    assert found["foot_slide"].after == pytest.approx(found["foot_slide"].before, abs=0.05)
    assert found["foot_sink"].after == pytest.approx(found["foot_sink"].before, abs=0.05)
    assert {c.name: c for c in before_after(walk, mirrored)}["foot_slide"].after > 20.0


def test_an_edit_is_known_to_be_one(walk: mien.Motion) -> None:
    slid = mien.apply(walk, mien.Step("path_length", {"mid": 0.4}))
    more = mien.apply(slid, mien.Step("posture", {"head": 10.0}))
    for a, b in ((walk, slid), (walk, more), (slid, more)):
        found, wanted = (
            [c.after for c in changes] for changes in (compare(a, b).changes, before_after(a, b))
        )
        np.testing.assert_equal(found, wanted)


def test_what_is_no_motion_is_told_so(walk: mien.Motion) -> None:
    for find in (compare, before_after):
        with pytest.raises(MienError, match=r"mien\.load\('walk\.bvh'\)"):
            find(walk, "walk.bvh")
