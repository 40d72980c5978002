"""The presets are complete, sourced, faithful to figure 29, unlike each other, and keep the feet."""

from importlib.resources import files

import numpy as np
import pytest

import mien
from mien import samples
from mien.emotion.presets import OWN, PRESETS, S0, preset
from mien.errors import RecipeError
from mien.kinematics.body import Body
from mien.kinematics.contacts import detect, slides
from mien.kinematics.fk import world

WORDS = (
    "afraid angry excited feminine happy masculine relaxed sad strong tired weak confident nervous "
    "energetic-sad proud childish giant musical old swaggering timid"
)


def steps(name):
    """Edit -> parameters; parts of a step in its key."""
    return {(s.edit, *s.parts): dict(s.parameters) for s in preset(name).steps}


def test_every_word_has_a_recipe_and_every_recipe_file_is_listed():
    assert set(OWN) == set(WORDS.split())
    folder = files("mien.emotion") / "recipes"
    found = {p.name[:-5] for p in folder.iterdir() if p.name.endswith(".toml")}
    found |= {f"s0/{p.name[:-5]}" for p in (folder / "s0").iterdir() if p.name.endswith(".toml")}
    assert found == set(PRESETS)
    assert all(preset(name).name == name for name in PRESETS)


# Parameters that are no numbers.
CHOICES = {"method", "amount", "where", "limbs", "travel", "mode"}


@pytest.mark.parametrize("name", PRESETS)
def test_every_number_has_a_source_and_the_evidence_is_told(name):
    recipe = preset(name)
    assert recipe.evidence
    assert recipe.description
    given = {key for step in recipe.steps for key in step.parameters} - CHOICES
    posture = {"head", "arms", "legs", "pose"} if "posture" in recipe.sources else set()
    covered = set(recipe.sources) | posture
    assert given - covered == set()


# Figure 29 of the thesis: path length, acceleration, posture. None: the figure does not mention it.
FIGURE_29 = {
    "afraid": (0.6, None, ("arms_legs_in", 0.5)),
    "angry": (1.4, 0.8, None),
    "energetic-sad": (1.4, None, ("head_down", 1.0)),
    "excited": (1.5, 0.3, None),
    "feminine": (None, None, ("arms_legs_in", 1.0)),
    "happy": (None, None, None),
    "relaxed": (None, -0.8, None),
    "sad": (0.6, None, ("head_down", 1.0)),
    "strong": (1.4, None, ("elbows_out", 1.0)),
    "tired": (0.3, None, ("head_down", 0.4)),
    "weak": (0.3, None, ("arms_legs_in", 0.5)),
}


@pytest.mark.parametrize("name", FIGURE_29)
def test_the_thesis_recipes_are_those_of_its_figure(name):
    path, acceleration, pose = FIGURE_29[name]
    given = steps(f"s0/{name}")
    assert given.get(("path_length",), {}).get("mid") == path
    assert given.get(("timing",), {}).get("acceleration") == acceleration
    held = given.get(("posture",), {})
    assert (held["pose"], held["amount"]) == pose if pose else not held
    assert held.get("method", "additive") == "additive", "the thesis adds direction vectors"


def test_masculine_is_the_reverse_of_feminine_with_feet_a_little_apart():
    assert set(S0) == {*FIGURE_29, "masculine"}
    held = steps("s0/masculine")[("posture",)]
    assert held["arms"] > 0
    assert 0 < held["legs"] < 0.5 * held["arms"]


def measures(motion):
    """What an eye sees: head, trunk and elbow angles, hand swing, hand and foot spread, hips height."""
    body = Body.of(motion)
    positions = world(motion)[1]
    p = {role: positions[:, joint] for role, joint in body.roles.items()}
    up, leg = body.up, body.leg_length
    trunk = p["neck"] - p["hips"]
    hands = [p[f"{s}_wrist"] - p["hips"] for s in ("left", "right")]
    side = p["left_shoulder"] - p["right_shoulder"]
    side /= np.linalg.norm(side, axis=1)[:, None]
    spread = np.einsum("ti,ti->t", hands[0] - hands[1], side).mean() / leg
    facing = np.cross(side, up)
    return np.array(
        [
            np.arctan2(np.einsum("ti,ti->t", trunk, facing), trunk @ up).mean(),
            np.std(np.einsum("ti,ti->t", hands[0], facing)) / leg,
            spread,
            np.einsum("ti,ti->t", p["left_elbow"] - p["right_elbow"], side).mean() / leg,
            (p["head"] @ up).mean() / leg,
            np.linalg.norm(p["left_wrist"] - p["left_shoulder"], axis=1).mean() / leg,
            np.linalg.norm(positions[-1, body.roles["hips"]] - positions[0, body.roles["hips"]]) / leg,
            np.einsum("ti,ti->t", p["head"] - p["neck"], facing).mean() / leg,
        ]
    )


def test_no_two_words_look_the_same():
    walk = samples.walk(seconds=3.0, fps=30.0).motion
    seen = {name: measures(mien.edit(walk, name)) for name in OWN}
    scale = np.std(list(seen.values()), axis=0)
    for a in OWN:
        for b in OWN:
            if a < b:
                assert np.abs((seen[a] - seen[b]) / scale).max() > 0.5, f"{a} looks like {b}"


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("clip", ["walk", "jump"])
def test_feet_stay_under_every_preset(name, clip):
    motion = samples.SAMPLES[clip](fps=30.0, unit="m").motion
    body = Body.of(motion)
    out = mien.edit(motion, name)
    before = out.reference or motion  # the same moments, where the tempo changed
    contacts = detect(before, body=body)
    assert (slides(out, contacts, body) - slides(before, contacts, body)).max() < 0.002


@pytest.mark.parametrize("name", OWN)
def test_strength_is_continuous_and_grows(name):
    walk = samples.walk(seconds=1.5, fps=30.0).motion
    hips = Body.of(walk).roles["hips"]

    def moved(strength):
        out = mien.edit(walk, name, strength=strength, safe=False)
        mine, its = (world(m)[1] - world(m)[1][:, [hips]] for m in (out, out.reference or walk))
        return float(np.linalg.norm(mine - its, axis=2).mean())

    effect = [moved(s) for s in (0.0, 0.001, 0.25, 0.5, 1.0, 1.5)]
    assert effect[0] == 0.0
    assert effect[1] < 0.01 * effect[4]
    assert np.all(np.diff(effect) > 0)


def test_an_unknown_word_is_answered_with_the_nearest():
    with pytest.raises(RecipeError, match="did you mean 'sad'"):
        preset("saad")
