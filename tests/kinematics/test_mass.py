"""Where the mass of a body is."""

import numpy as np
import pytest

from mien import samples
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.kinematics.mass import PARTS, mass_model
from mien.motion import Motion
from mien.samples import SKELETONS

SIDED = ("upper_arm", "forearm", "hand", "thigh", "shank", "foot")


def centre(motion: Motion) -> np.ndarray:
    """The centre of mass (T, 3) over the floor, in metres."""
    body = Body.of(motion)
    found = mass_model(motion, body).centre_of_mass(*world(motion))
    return (found - body.floor * body.up) * body.metres_per_unit


def test_the_table_sums_to_one_body() -> None:
    """de Leva 1996: .0694 + .4346 + 2 (.0271 + .0162 + .0061 + .1416 + .0433 + .0137) = 1."""
    trunk = sum(PARTS[n].share for n in ("upper_trunk", "middle_trunk", "lower_trunk"))
    assert trunk == pytest.approx(0.4346)
    limbs = 2.0 * sum(PARTS[n].share for n in SIDED)
    assert PARTS["head"].share + trunk + limbs == pytest.approx(1.0, abs=1e-4)


def test_the_three_parts_of_the_trunk_balance_where_the_whole_does() -> None:
    """The table has the whole trunk's centre at 0.431 of the way down from the shoulders."""
    parts = [PARTS[n] for n in ("upper_trunk", "middle_trunk", "lower_trunk")]
    mean = sum(p.share * p.centre for p in parts) / sum(p.share for p in parts)
    assert mean == pytest.approx(1.0 - 0.431, abs=0.01)


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_an_upright_man_has_his_centre_at_56_percent_of_his_height(skeleton: str) -> None:
    """Standing with arms at the sides: 0.55 to 0.58 of stature (Winter 2009, table 4.1 summed up)."""
    motion = samples.still(seconds=0.2, sway=0.0, skeleton=skeleton).motion
    body = Body.of(motion)
    found = centre(motion)[0]
    assert found @ body.up / 1.75 == pytest.approx(0.565, abs=0.015)
    assert abs(found @ body.left) < 1e-3


def test_it_does_not_depend_on_unit_or_axis() -> None:
    one = samples.walk(seconds=1.0, unit="cm").motion
    other = samples.walk(seconds=1.0, unit="inch", up="z", skeleton="capture31").motion
    heights = [centre(m) @ Body.of(m).up for m in (one, other)]
    np.testing.assert_allclose(heights[0], heights[1], atol=0.004)


def test_limbs_are_weighed_between_their_joints() -> None:
    """A slow twin for the limbs: each centre on the line of its joints, at the table's share of it."""
    motion = samples.wave(seconds=2.0).motion
    body = Body.of(motion)
    rotations, positions = world(motion)
    model = mass_model(motion, body)
    centres = dict(zip(model.names, np.moveaxis(model.centres(rotations, positions), 1, 0), strict=True))
    for name, upper, lower, share in (
        ("upper_arm", "shoulder", "elbow", 0.5772),
        ("forearm", "elbow", "wrist", 0.4574),
        ("thigh", "hip", "knee", 0.4095),
        ("shank", "knee", "ankle", 0.4395),
    ):
        for side in ("left", "right"):
            a, b = (positions[:, body.roles[f"{side}_{r}"]] for r in (upper, lower))
            np.testing.assert_allclose(centres[f"{side}_{name}"], a + share * (b - a), atol=1e-6)


def test_raising_an_arm_raises_the_centre_by_its_share() -> None:
    """From hanging to straight up: the arm's own centre times the arm's share of the mass."""
    swing = samples.pendulum(seconds=1.0, amplitude=np.pi, frequency=0.5, fps=60.0).motion
    body = Body.of(swing)
    rotations, positions = world(swing)
    model = mass_model(swing, body)
    arm = [i for i, n in enumerate(model.names) if n.startswith("right") and n.split("_", 1)[1] in SIDED[:3]]
    heights = model.centres(rotations, positions)[:, arm] @ body.up
    moved = model.centre_of_mass(rotations, positions) @ body.up
    wanted = heights @ model.shares[arm]
    np.testing.assert_allclose(moved - moved[0], wanted - wanted[0], atol=1e-9)
    assert (moved.max() - moved.min()) * body.metres_per_unit > 0.02
