"""Motions as bytes for the page, and the fixtures by which the page's own tests compare with Python."""

import json
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import mien
from mien import samples
from mien.kinematics.body import Body
from mien.motion import Motion
from mien.render.figure import Figure
from mien.render.wire import encode

ROOT = Path(__file__).resolve().parents[2]


def unpacked(data: bytes) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return the head and the arrays, read as the format is described."""
    assert data[:4] == b"MIEN"
    start = 8 + int.from_bytes(data[4:8], "little")
    assert start % 4 == 0
    head = json.loads(data[8:start])
    arrays = {}
    for place in head["arrays"]:
        assert place["start"] % 4 == 0
        count = int(np.prod(place["shape"]))
        flat = np.frombuffer(data, place["type"], count, start + place["start"])
        arrays[place["name"]] = flat.reshape(place["shape"])
    return head, arrays


@pytest.fixture(scope="module")
def walk() -> Motion:
    return samples.walk(seconds=1.0, skeleton="capture31", unit="inch", up="z").motion


def test_what_travels_is_the_motion(walk: Motion) -> None:
    head, arrays = unpacked(encode(walk, "walk", notes=["hello"]))
    assert head["joints"] == list(walk.skeleton.names)
    assert head["frames"] == len(walk)
    assert head["notes"] == ["hello"]
    np.testing.assert_allclose(arrays["rotations"], walk.rotations, atol=1e-6)
    moved = np.repeat(arrays["offsets"][None], len(walk), axis=0)
    moved[:, head["moving"]] = arrays["translations"]
    np.testing.assert_allclose(moved, walk.translations, rtol=1e-6, atol=1e-4)
    assert set(np.unique(arrays["contacts"])) <= {0, 1}


def test_a_still_before_the_action_is_told(
    walk: Motion, with_t_pose: Callable[[Motion, int], Motion]
) -> None:
    assert unpacked(encode(walk, "walk"))[0]["still"] == 0
    posed = with_t_pose(walk, 3)
    assert unpacked(encode(posed, "walk"))[0]["still"] == 3
    bent = mien.apply(posed, [mien.Step("posture", {"head": 20.0})])
    assert unpacked(encode(bent, "walk"))[0]["still"] == 3, "an edit leaves it there"


def test_axes_are_right_handed_and_the_unit_is_metres(walk: Motion) -> None:
    head, _ = unpacked(encode(walk, "walk"))
    axes = np.array([head["left"], head["up"], head["forward"]])
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-6)
    assert np.linalg.det(axes) > 0.0
    assert head["metres"] == pytest.approx(0.0254, rel=0.1)
    assert head["shape"]["leg_length"] == pytest.approx(Body.of(walk).leg_length)


def test_a_motion_takes_the_floor_of_what_it_was_made_from(walk: Motion) -> None:
    raised = walk.with_(
        translations=walk.translations + np.array([0.0, 0.0, 4.0]) * (np.arange(31) == 0)[:, None]
    )
    own, _ = unpacked(encode(raised, "walk"))
    shared, _ = unpacked(encode(raised, "walk", like=Figure.of(walk)))
    assert own["floor"] == pytest.approx(shared["floor"] + 4.0, abs=0.5)
    assert shared["floor"] == pytest.approx(Body.of(walk).floor)


@pytest.fixture(scope="module")
def writer(script: Callable[[str], ModuleType]) -> ModuleType:
    """The script that writes the fixtures."""
    return script("frontend_fixtures")


def test_fixtures_of_the_page_are_current_and_small(writer: ModuleType) -> None:
    stale = writer.stale()
    assert not stale, f"{', '.join(stale)} out of date: run `{writer.COMMAND}` and commit what it wrote"
    files = list(writer.FOLDER.iterdir())
    assert {file.name for file in files} == set(writer.files())
    assert sum(file.stat().st_size for file in files) < 100_000


def test_what_has_no_body_travels_with_its_tips(writer: ModuleType) -> None:
    head, _ = unpacked(encode(writer.tail(), "tail"))
    assert head["shape"] is None
    assert head["drawn"] == [0, 1, 2, 3]
    assert head["tips"] == [3]
    assert head["tip_offsets"] == [[0.0, -15.0, 3.0]]
