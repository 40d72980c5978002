"""One skeleton: other orders and units are taken, other joints and bones are refused by name."""

from dataclasses import replace

import numpy as np
import pytest

from mien import samples
from mien.errors import MienError
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.styles.skeletons import on_one_skeleton


def changed(motion: Motion, **fields: object) -> Motion:
    return motion.with_(skeleton=replace(motion.skeleton, **fields))


def longer(motion: Motion, name: str, factor: float) -> Motion:
    joint = motion.skeleton.names.index(name)
    translations = np.array(motion.translations)
    translations[:, joint] *= factor
    return motion.with_(translations=translations)


def reordered(motion: Motion, order: list[int]) -> Motion:
    skeleton, place = motion.skeleton, {old: new for new, old in enumerate(order)}
    parents = [place.get(int(skeleton.parents[old]), -1) for old in order]
    made = replace(
        skeleton,
        names=tuple(skeleton.names[old] for old in order),
        parents=parents,
        offsets=skeleton.offsets[order],
        end_parents=[place[int(p)] for p in skeleton.end_parents],
        layout=None,
    )
    return motion.with_(
        skeleton=made, rotations=motion.rotations[:, order], translations=motion.translations[:, order]
    )


def test_another_order_of_the_joints_is_put_right():
    walk, tired = samples.walk(seconds=1.0).motion, samples.tired_walk(seconds=1.0).motion
    hips = tired.skeleton.names.index("Hips")
    branches = tired.skeleton.children(hips)
    order = [hips] + [j for branch in reversed(branches) for j in tired.skeleton.descendants(branch)]
    order = [*range(hips), *order]
    shuffled = reordered(tired, order)
    assert shuffled.skeleton.names != tired.skeleton.names
    same = on_one_skeleton([walk, shuffled])[1]
    assert same.skeleton is walk.skeleton
    np.testing.assert_array_equal(world(same)[1], world(tired)[1])


@pytest.mark.parametrize("unit", ["m", "inch", "mm"])
def test_another_unit_becomes_that_of_the_first(unit):
    walk, tired = samples.walk(seconds=1.0).motion, samples.tired_walk(seconds=1.0, unit=unit).motion
    true = samples.tired_walk(seconds=1.0).motion
    np.testing.assert_allclose(world(on_one_skeleton([walk, tired])[1])[1], world(true)[1], atol=1e-6)


def test_where_the_hips_start_is_no_bone():
    walk, far = samples.walk(seconds=1.0).motion, np.array(samples.walk(seconds=1.0).motion.translations)
    hips = walk.skeleton.names.index("Hips")
    far[:, hips] += [1e4, 0, -1e4]
    for frames in (1, 61):
        moved = walk[:frames].with_(translations=far[:frames])
        assert len(on_one_skeleton([walk[:frames], moved])[1]) == frames


def test_a_t_pose_at_the_start_is_left_out():
    walk = samples.walk(seconds=2.0).motion
    rotations = np.concatenate([np.tile([0, 0, 0, 1.0], (1, len(walk.skeleton), 1)), walk.rotations])
    translations = np.concatenate([walk.translations[:1], walk.translations])
    still = walk.with_(rotations=rotations, translations=translations)
    one, other = on_one_skeleton([still, walk])
    np.testing.assert_array_equal(one.rotations, other.rotations)


def test_a_slightly_other_bone_passes_and_a_clearly_other_is_named():
    walk = samples.walk(seconds=1.0).motion
    assert on_one_skeleton([walk, longer(walk, "LeftLeg", 1.005)])
    with pytest.raises(MienError, match=r"clip 2 has other bones than clip 1 \(LeftLeg by 5.0 %"):
        on_one_skeleton([walk, longer(walk, "LeftLeg", 1.05)])


def test_a_bone_that_points_elsewhere_is_another_bone():
    walk = samples.walk(seconds=1.0).motion
    turned = np.array(walk.translations)
    joint = walk.skeleton.names.index("LeftForeArm")
    turned[:, joint] = turned[:, joint] @ np.array([[0, 1.0, 0], [-1, 0, 0], [0, 0, 1]])
    with pytest.raises(MienError, match="LeftForeArm by 141"):
        on_one_skeleton([walk, walk.with_(translations=turned)])


def test_joints_that_only_one_has_are_named():
    walk = samples.walk(seconds=1.0).motion
    names = ["Skull" if name == "Head" else name for name in walk.skeleton.names]
    with pytest.raises(MienError, match=r"lacks 1 and adds 1 joints \(Head, Skull\)"):
        on_one_skeleton([walk, changed(walk, names=tuple(names))])


def test_joints_that_hang_elsewhere_are_named():
    walk = samples.walk(seconds=1.0).motion
    parents = np.array(walk.skeleton.parents)
    parents[walk.skeleton.names.index("Head")] = walk.skeleton.names.index("Chest")
    with pytest.raises(MienError, match="Head hang on other joints"):
        on_one_skeleton([walk, changed(walk, parents=parents)])


def test_one_clip_or_none_is_no_blend():
    walk = samples.walk(seconds=1.0).motion
    for clips in ([], [walk]):
        with pytest.raises(MienError, match="two clips or more"):
            on_one_skeleton(clips)
    with pytest.raises(MienError, match="not a path"):
        on_one_skeleton([walk, "walk.bvh"])
