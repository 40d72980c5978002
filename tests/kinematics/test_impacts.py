"""Impacts: where hands and feet meet something, and from when on they go there."""

from itertools import pairwise

import numpy as np
import pytest

import mien
from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect
from mien.kinematics.impacts import LONGEST, impacts, landings
from mien.kinematics.lead_in import lead_in
from mien.samples import SKELETONS

ALL = ("left_arm", "right_arm", "left_leg", "right_leg", "head")


def found(motion, limbs=ALL, **options):
    return impacts(motion, Body.of(motion), limbs=limbs, **options)


@pytest.mark.parametrize("fps", [30.0, 60.0, 120.0])
@pytest.mark.parametrize("skeleton", SKELETONS)
def test_the_feet_of_a_walk_land_at_heel_strike_and_set_off_at_toe_off(fps, skeleton):
    sample = samples.walk(seconds=4.0, fps=fps, skeleton=skeleton)
    at = found(sample.motion)
    assert set(at) == {"left_leg", "right_leg"}
    for side in ("left", "right"):
        stretches = at[f"{side}_leg"] / fps
        strikes = np.array(sample.events[f"{side}_heel_strike"])
        offs = np.array(sample.events[f"{side}_toe_off"])
        for leave, land in stretches:
            assert np.abs(strikes - land).min() < 0.03
            assert leave == 0.0 or np.abs(offs - leave).min() < 0.05
        inside = strikes[(strikes > 0.2) & (strikes < 3.8)]
        assert len(stretches) >= len(inside)


def test_stretches_of_a_foot_begin_and_end_with_its_contacts():
    motion = samples.walk(seconds=4.0).motion
    planted = detect(motion).feet
    for foot, side in enumerate(("left", "right")):
        stretches = found(motion)[f"{side}_leg"]
        assert len(stretches) >= 3
        for leave, land in stretches.astype(int):
            assert planted[land, foot]
            assert planted[leave, foot] or leave == 0
            assert not planted[leave + 1 : land, foot].any()


def test_what_slides_or_hardly_stands_has_not_landed():
    stands = np.zeros(30, bool)
    stands[[*range(6), *range(10, 16), *range(20, 23), *range(27, 30)]] = True
    up = np.zeros(30, bool)
    up[[18, 25]] = True
    # Between the first two contacts it only slides; the last may be too short to be one.
    np.testing.assert_array_equal(landings(stands, up, 3.0, 0), [[15, 20], [22, 27]])
    np.testing.assert_array_equal(landings(stands, up, 4.0, 0), [[15, 20]])
    np.testing.assert_array_equal(landings(stands[7:], up[7:], 3.0, 0), [[8, 13], [15, 20]])
    np.testing.assert_array_equal(landings(stands[17:], up[17:], 3.0, 0), [[0, 3], [5, 10]])
    assert landings(np.ones(9, bool), np.ones(9, bool), 2.0, 0).shape == (0, 2)
    assert landings(np.zeros(9, bool), np.ones(9, bool), 2.0, 0).shape == (0, 2)


def test_a_loop_has_landings_over_its_seam():
    stands = np.zeros(40, bool)
    stands[5:20] = True
    np.testing.assert_array_equal(landings(stands, ~stands, 3.0, 40), [[-21, 5]])
    for shift in range(40):
        rolled = np.roll(stands, shift)
        (leave, land), *more = landings(rolled, ~rolled, 3.0, 40)
        assert not more
        assert (land, land - leave) == ((5 + shift) % 40, 26)
    assert landings(np.ones(40, bool), np.ones(40, bool), 3.0, 40).shape == (0, 2)


@pytest.mark.parametrize("make", [samples.knock, samples.punch, samples.walk, samples.jump])
def test_stretches_are_in_order_apart_and_neither_short_nor_long(make):
    motion = make().motion
    assert found(motion)
    for longest in (0.3, LONGEST):
        for stretches in found(motion, longest=longest).values():
            starts, ends = stretches.T / motion.fps
            assert (starts[1:] >= ends[:-1]).all()
            assert (ends - starts >= 0.1 - 1e-9).all()
            assert (ends - starts <= longest + 1e-9).all()


def test_a_knock_is_wound_up_for_in_the_rest_before():
    sample = samples.knock()
    starts, ends = found(sample.motion)["right_arm"].T / sample.motion.fps
    begins = np.array(sample.events["stroke"])
    assert (starts < begins).all()
    assert (starts[1:] > ends[:-1] + 0.1).all()  # the way back is no wind-up


def test_only_what_is_asked_for():
    motion = samples.walk().motion
    assert set(found(motion, ("left_leg", "right_arm"))) == {"left_leg"}
    assert found(motion, ("head",)) == {}
    assert found(samples.still().motion) == {}


def test_neither_unit_axis_nor_heading_matter():
    forms = ({}, {"unit": "inch"}, {"up": "z"}, {"heading": 2.0})
    for make in (samples.punch, samples.walk):
        one, *others = (found(make(**form).motion) for form in forms)
        assert one
        for other in others:
            assert set(other) == set(one)
            for limb, stretches in one.items():
                np.testing.assert_allclose(other[limb], stretches, atol=0.2)


@pytest.mark.parametrize("frames", [1, 2, 3, 8])
def test_short_clips(frames):
    assert found(samples.walk().motion[:frames]) == {}


@pytest.mark.parametrize(
    "name", ["bandai1/dataset-1_walk_normal_001.bvh", "cmu_daz/02_01.bvh", "xia/neutral_01_000.bvh"]
)
def test_captured_walks_land_in_turn(data, name):
    if not (data / name).exists():
        pytest.skip(f"no {name}")
    motion = mien.load(data / name)
    at = found(motion[lead_in(motion) :])
    assert set(at) == {"left_leg", "right_leg"}
    lands = sorted((land, limb) for limb, stretches in at.items() for _, land in stretches)
    assert len(lands) >= 4
    assert all(one != other for (_, one), (_, other) in pairwise(lands))
