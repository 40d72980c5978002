"""Several emotions in one recipe: sad turns into happy, in Python as in a file."""

import numpy as np
import pytest

import mien
from mien import samples
from mien.edits import pipeline
from mien.emotion.files import parse_recipe
from mien.errors import RecipeError
from mien.kinematics.body import Body
from mien.kinematics.fk import world
from mien.motion import Motion
from mien.recipe import Recipe

TURNING = {"sad": [(0, 1), (5, 0)], "happy": [(0, 0), (5, 1)]}
FILE = """
version = 1
name = "turning"
[[steps]]
emotion = "sad"
strength = [[0, 1], [5, 0]]
[[steps]]
emotion = "happy"
strength = [[0, 0], [5, 1]]
"""


def head_height(motion: Motion) -> np.ndarray:
    body = Body.of(motion)
    return world(motion)[1][:, body.roles["head"]] @ body.up / body.leg_length


def test_sad_becomes_happy_over_five_seconds() -> None:
    walk = samples.walk(seconds=5.0).motion
    made = mien.edit(walk, mien.mixed(TURNING), safe=False)
    whole = {word: mien.edit(walk, word, safe=False) for word in TURNING}
    start, end = head_height(made)[:10].mean(), head_height(made)[-10:].mean()
    assert start == pytest.approx(head_height(whole["sad"])[:10].mean(), abs=0.02)
    assert end == pytest.approx(head_height(whole["happy"])[-10:].mean(), abs=0.03)
    assert mien.check(mien.edit(walk, mien.mixed(TURNING))).passed
    assert [step.edit for step in made.history].count("foot_plant") == 1


def test_a_file_says_the_same() -> None:
    walk = samples.walk(seconds=5.0).motion
    one = mien.edit(walk, parse_recipe(FILE), safe=False)
    other = mien.edit(walk, Recipe("same", mien.mixed(TURNING).steps), safe=False)
    np.testing.assert_allclose(one.rotations, other.rotations, atol=1e-9)


def test_one_emotion_whole_is_its_preset() -> None:
    assert list(mien.mixed({"sad": 1.0}).steps) == pipeline.plan(mien.preset("sad"))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('emotion = "sda"', "'sad'"),
        ('emotion = "sad"\nhead = 3.0', "key beside emotion"),
        ('emotion = "sad"\nstrength = 3.0', "from 0 to 2"),
        ('emotion = "sad"\nparts = ["ears"]', "body part"),
        ("emotion = 3", "text"),
    ],
)
def test_slips_are_told(text: str, message: str) -> None:
    with pytest.raises(RecipeError, match=message):
        parse_recipe(f'version = 1\nname = "x"\n[[steps]]\n{text}\n')


def test_parts_and_span_limit_an_emotion_in_a_file() -> None:
    limited = parse_recipe(
        'version = 1\nname = "x"\n[[steps]]\nemotion = "sad"\n'
        'parts = ["head"]\nspan = [1.0, 2.0]\nease = 0.5\n'
    )
    posture = next(step for step in limited.steps if step.edit == "posture")
    assert (posture.parts, posture.span, posture.ease) == (("head",), (1.0, 2.0), 0.5)
