"""Laban features of real clips of many skeletons: finite, in range, and of a human size."""

from pathlib import Path

import numpy as np
import pytest

from mien import features, load
from mien.analysis.effort import effort
from mien.analysis.laban_table import DERIVED
from mien.errors import BodyError
from mien.kinematics.body import Body
from mien.signal.derivatives import derivatives

FOLDERS = ("bandai1", "bandai2", "cmu_daz", "cmu_iclone100j", "cmu_mb_misc", "exporters", "reactidle", "xia")


def clips(folder: Path) -> list[Path]:
    found = sorted(folder.glob("*.bvh"))
    if not found:
        pytest.skip(f"no clips in {folder.name}")
    return found if folder.name == "exporters" else found[:: max(1, len(found) // 3)]


@pytest.mark.parametrize("folder", FOLDERS)
def test_every_table_is_finite(data: Path, folder: str) -> None:
    measured = 0
    for path in clips(data / folder):
        motion = load(path)
        try:
            Body.of(motion)
        except BodyError:
            continue  # a leg, or one frame of a few joints
        found, factors = features(motion), effort(motion)
        for values in (found.frames, found.clip, found.windows(), factors.frames, factors.clip):
            assert np.isfinite(values).all(), path.name
        assert (found.windows().min(axis=0) <= found.clip + 1e-9).all()
        assert ((factors.frames[:, 2] >= 0.0) & (factors.frames[:, 2] <= 1.0)).all()
        measured += 1
    assert measured >= 3


@pytest.mark.parametrize("folder", ["bandai1", "cmu_daz", "xia"])
def test_sizes_are_human(data: Path, folder: str) -> None:
    for path in clips(data / folder):
        found = features(load(path))
        assert 0.4 < found["hip_ground_distance_mean"] < 0.65, path.name
        assert 0.15 < found["torso_height_mean"] < 0.5, path.name
        assert 0.003 < found["volume_of_all_joints_mean"] < 0.1, path.name
        assert found["pelvis_speed_mean"] < 4.0, path.name


def test_a_capture_at_120_and_at_30_frames_a_second(data: Path) -> None:
    """Every fourth frame of a capture tells nearly the same.

    Means do to 3 % of what the feature reaches. Peaks of acceleration and jerk need not: what shakes faster
    than 15 Hz is folded down to what is measured, and no filter takes it out again.
    """
    for path in sorted((data / "cmu_daz").glob("*.bvh"))[:6]:
        motion = load(path)[12:]
        body = Body.of(motion)
        one, other = features(motion, body=body), features(motion[::4], body=body)
        reach = np.abs(one.frames).max(axis=0)
        for d in DERIVED:
            if d.statistic == "mean":
                allowed = 0.03 * reach[d.feature.number - 1]
                assert one[d.name] == pytest.approx(other[d.name], abs=allowed), f"{path.name}: {d.name}"
        differ = np.abs(one.clip - other.clip) / np.maximum(np.abs(one.clip), 1e-3)
        assert np.median(differ) < 0.01, path.name


def test_moods_differ_as_people_say(data: Path) -> None:
    """Active walks are quicker and larger than those of one who is not confident, in every take."""
    walks = {
        style: [
            features(load(p)) for p in sorted((data / "bandai1").glob(f"dataset-1_walk_{style}_*.bvh"))[:2]
        ]
        for style in ("active", "not-confident")
    }
    if not all(walks.values()):
        pytest.skip("no such walks")
    for name in ("pelvis_speed_mean", "left_hand_speed_mean", "hands_distance_mean", "pelvis_jerk_max"):
        assert min(f[name] for f in walks["active"]) > max(f[name] for f in walks["not-confident"]), name


def test_derivatives_do_not_ring_on_a_capture(data: Path) -> None:
    path = sorted((data / "cmu_daz").glob("*.bvh"))[0]
    motion = load(path)[1:]
    hips = motion.translations[:, Body.of(motion).roles["hips"]]
    smooth, first = derivatives(hips, motion.frame_time, orders=(0, 1))
    assert np.abs(smooth - hips).max() < 0.02 * Body.of(motion).leg_length
    np.testing.assert_allclose(
        first[2:-2], np.gradient(smooth, motion.frame_time, axis=0)[2:-2], atol=0.02 * np.abs(first).max()
    )
