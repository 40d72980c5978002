"""Parts that two lists share: empty means all, nothing in common means nothing."""

from itertools import product

import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.parts import PARTS, common_parts

BODY = Body.of(samples.walk().motion)
LISTS = [(), ("arms",), ("upper",), ("left", "head"), ("left_elbow",), ("legs", "right_wrist"), ("torso",)]


@pytest.mark.parametrize(("one", "other"), list(product(LISTS, LISTS)))
def test_the_joints_are_those_in_both(one, other):
    both = common_parts(one, other)
    expected = set(BODY.joints(one)) & set(BODY.joints(other))
    assert (set(BODY.joints(both)) if both is not None else set()) == expected


def test_an_empty_list_is_the_whole_body():
    assert common_parts((), ()) == ()
    assert common_parts(("arms",), ()) == ("arms",)
    assert common_parts(("arms",), ("legs",)) is None
    assert all(common_parts((name,), (name,)) is not None for name in PARTS)
