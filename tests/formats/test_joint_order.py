"""A skeleton may list its joints in any order that has parents first; a file nests them depth first."""

from pathlib import Path

import numpy as np

import mien
from mien import samples
from mien.kinematics.fk import end_positions, world


def test_joints_listed_level_by_level_come_back_in_place(tmp_path: Path) -> None:
    motion = samples.walk(seconds=0.5).motion
    deep = [0]
    for joint in range(1, len(motion.skeleton)):
        deep.append(deep[motion.skeleton.parents[joint]] + 1)
    order = np.argsort(deep, kind="stable")  # breadth first
    place = np.argsort(order)
    parents = motion.skeleton.parents[order]
    skeleton = mien.Skeleton(
        names=tuple(motion.skeleton.names[j] for j in order),
        parents=np.where(parents < 0, -1, place[parents]),
        offsets=motion.skeleton.offsets[order],
        end_parents=place[motion.skeleton.end_parents],
        end_offsets=motion.skeleton.end_offsets,
    )
    wide = motion.with_(
        skeleton=skeleton,
        rotations=motion.rotations[:, order],
        translations=motion.translations[:, order],
    )
    mien.save(wide, tmp_path / "wide.bvh")
    again = mien.load(tmp_path / "wide.bvh")
    turned, places = world(motion)
    turned_again, places_again = world(again)
    for joint, name in enumerate(motion.skeleton.names):
        other = again.skeleton.names.index(name)
        np.testing.assert_allclose(places_again[:, other], places[:, joint], atol=1e-4)
    tips = np.sort(end_positions(motion, turned, places), axis=1)
    np.testing.assert_allclose(
        np.sort(end_positions(again, turned_again, places_again), axis=1), tips, atol=1e-4
    )
