"""From a place to a recipe: towards sad low and slow, towards happy high; joint is no worse than rules."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mien
from mien import samples
from mien.emotion.circumplex import Point, point
from mien.emotion.control_features import NUMBERS
from mien.emotion.joint_fitting import drifted, joint, objective
from mien.emotion.model import EmotionModel, shipped_model
from mien.emotion.rule_curves import at_times, in_time
from mien.emotion.rule_fitting import HIGH, LOW, sequential
from mien.emotion.rule_wish import Wish
from mien.emotion.synthesis import METHODS, synthesise
from mien.emotion.wishes import wanted
from mien.kinematics.body import Body
from mien.kinematics.landmarks import landmarks
from mien.motion import Motion

SAD, HAPPY, ANGRY, RELAXED = (point(word) for word in ("sad", "happy", "angry", "relaxed"))
# Clips of each kind of skeleton that was captured or exported.
REAL = (
    "bandai1/dataset-1_walk_normal_001.bvh",
    "bandai1/dataset-1_bye_normal_001.bvh",
    "bandai2/dataset-2_walk_normal_024.bvh",
    "cmu_daz/02_01.bvh",
    "cmu_daz/05_02.bvh",
)
FOLDERS = ("cmu_mb_misc", "cmu_iclone100j", "xia", "reactidle", "exporters")


@pytest.fixture(scope="module")
def toy() -> EmotionModel:
    """A model whose emotions are clear: up is high, quick and wide, down is low, slow and close."""
    base = shipped_model()
    tables, change = base.clusters, np.zeros(len(NUMBERS))
    for number, value in {4: 0.01, 20: 0.01, 2: 0.02, 3: 0.02, 1: 0.04}.items():
        change[NUMBERS.index(number)] = value
    change[[NUMBERS.index(number) for number in (7, 8, 9, 10, 11, 24)]] = 0.15
    corners = {"happy": (0.8, 0.5), "sad": (-0.8, -0.5), "angry": (-0.5, 0.6), "relaxed": (0.5, -0.6)}
    places = {"neutral": Point(0.0, 0.0), **{k: Point(*p) for k, p in corners.items()}}
    changes = {k: np.tile((p[0] + p[1]) * change, (len(tables.rest), 1)) for k, p in places.items()}
    return replace(base, places=places, clusters=replace(tables, changes=changes))


def heights(motion: Motion) -> dict[str, float]:
    """Mean heights in heights of the body: of the pelvis, the head over it, and both hands."""
    body = Body.of(motion)
    found = landmarks(motion, body)
    up = {name: float((found[name] @ body.up).mean() / body.height) for name in ("pelvis", "head")}
    hands = np.mean([(found[f"{side}_hand"] @ body.up).mean() for side in ("left", "right")]) / body.height
    return {"pelvis": up["pelvis"], "torso": up["head"] - up["pelvis"], "hands": float(hands)}


@pytest.mark.parametrize("method", METHODS)
def test_where_the_motion_is_already_there_is_nothing_to_do(method: str) -> None:
    walk = samples.walk(seconds=2.0).motion
    recipe = synthesise(walk, SAD, start=SAD, method=method)
    assert recipe.steps == ()
    assert mien.edit(walk, recipe).rotations is walk.rotations


@pytest.mark.parametrize("method", METHODS)
def test_sad_is_lower_and_slower_than_happy(method: str, toy: EmotionModel) -> None:
    walk = samples.walk(seconds=4.0).motion
    before = heights(walk)
    recipes = {word: synthesise(walk, point(word), method=method, model=toy) for word in ("sad", "happy")}
    sad, happy = (heights(mien.apply(walk, recipe)) for recipe in recipes.values())
    for what in ("pelvis", "torso"):
        assert sad[what] < before[what] < happy[what] + 1e-3, what
        assert sad[what] < happy[what], what
    rates = {w: next(s.parameters["rate"] for s in r.steps if s.edit == "tempo") for w, r in recipes.items()}
    assert rates["sad"] < 1.0 < rates["happy"]


@pytest.mark.parametrize("method", METHODS)
def test_so_it_is_with_the_shipped_model(method: str) -> None:
    walk = samples.walk(seconds=4.0).motion
    before = heights(walk)
    recipe = synthesise(walk, SAD, method=method)
    sad = heights(mien.apply(walk, recipe))
    assert sad["torso"] < before["torso"] - 0.01  # its actors hardly lower the pelvis
    assert next(s.parameters["rate"] for s in recipe.steps if s.edit == "tempo") < 1.0
    happy = heights(mien.apply(walk, synthesise(walk, HAPPY, method=method)))
    assert happy["torso"] > sad["torso"]
    assert happy["hands"] > sad["hands"]
    assert happy["pelvis"] > sad["pelvis"] - 1e-3  # legs that are straight lift no pelvis


@pytest.mark.parametrize("place", [SAD, HAPPY, ANGRY, RELAXED, Point(0.0, -0.9), Point(0.3, 0.0)])
@pytest.mark.parametrize("name", ["walk", "wave", "jump"])
def test_joint_is_never_worse_than_the_rules(name: str, place: Point) -> None:
    model, motion = shipped_model(), samples.SAMPLES[name]().motion
    wish = Wish.of(motion, wanted(model, place))
    rules = sequential(wish)
    both = joint(wish, rules)
    assert objective(wish, both) <= objective(wish, rules)
    for found in (rules, both):
        assert ((found.pose >= LOW) & (found.pose <= HIGH)).all()
    curves = in_time(wish.stays, both.pose)
    drift = drifted(wish, lambda times: at_times(curves, times))
    assert drift.after <= drift.before
    assert ((drift.values >= LOW - 1e-9) & (drift.values <= HIGH + 1e-9)).all()


def test_joint_sees_what_a_body_cannot_do(toy: EmotionModel) -> None:
    """Legs are no longer than they are: the rules ask for a pelvis above them, the joint search sees it."""
    walk = samples.walk(seconds=3.0).motion
    wish = Wish.of(walk, wanted(toy, HAPPY))
    rules = sequential(wish)
    assert objective(wish, joint(wish, rules)) < 0.99 * objective(wish, rules)


@pytest.mark.parametrize("method", METHODS)
def test_it_replays_follows_strength_and_writes_itself(method: str, tmp_path: Path) -> None:
    walk = samples.walk(seconds=3.0).motion
    recipe = synthesise(walk, ANGRY, method=method)
    done = mien.edit(walk, recipe)
    again = mien.apply(walk, done.history)
    assert again.rotations.tobytes() == done.rotations.tobytes()
    assert mien.apply(walk, recipe, strength=0.0) is walk
    mien.write_recipe(recipe, tmp_path / "angry.toml")
    assert mien.read_recipe(tmp_path / "angry.toml").steps == recipe.steps
    assert synthesise(walk, ANGRY, method=method) == recipe


def test_the_way_from_sad_is_longer_than_from_the_middle() -> None:
    walk = samples.walk(seconds=3.0).motion
    far, near = (synthesise(walk, HAPPY, start=start) for start in (SAD, Point(0.0, 0.0)))
    tempo = [next(s.parameters["rate"] for s in r.steps if s.edit == "tempo") for r in (far, near)]
    assert tempo[0] > tempo[1]


def test_frame_rates_and_units_matter_little() -> None:
    one = samples.walk(seconds=4.0, fps=30.0, unit="m").motion
    other = samples.walk(seconds=4.0, fps=120.0, unit="inch").motion
    model = shipped_model()
    found = [sequential(Wish.of(m, wanted(model, SAD))).vector for m in (one, other)]
    np.testing.assert_allclose(*found, atol=0.08)


def test_what_cannot_be_asked_is_refused() -> None:
    walk = samples.walk(seconds=1.0).motion
    with pytest.raises(mien.MienError, match="joint"):
        synthesise(walk, SAD, method="joined")
    model = shipped_model()
    with pytest.raises(mien.MienError, match="4 or more"):
        synthesise(walk, SAD, model=replace(model, places={"neutral": Point(0.0, 0.0)}))
    with pytest.raises(mien.MienError, match="give a Motion"):
        synthesise("walk.bvh", SAD)


@pytest.mark.parametrize("frames", [1, 2, 7])
@pytest.mark.parametrize("method", METHODS)
def test_very_short_clips(frames: int, method: str) -> None:
    motion = samples.walk(seconds=1.0).motion[:frames]
    done = mien.apply(motion, synthesise(motion, HAPPY, method=method))
    assert np.isfinite(done.rotations).all()


def sound(motion: Motion, place: Point, method: str) -> None:
    """Something is done: no NaN, bones as long as they were, and feet that slide no more than they did."""
    recipe = synthesise(motion, place, method=method)
    done = mien.apply(motion, recipe)
    assert np.isfinite(done.rotations).all()
    assert np.isfinite(done.translations).all()
    assert not (len(done) == len(motion) and np.allclose(done.rotations, motion.rotations, atol=1e-3))
    failed = mien.check(done).failed
    assert not {"foot_slide", "floor", "bones"} & set(failed), failed


@pytest.mark.parametrize("path", REAL)
@pytest.mark.parametrize("method", METHODS)
def test_real_clips(path: str, method: str, data: Path) -> None:
    sound(mien.load(data / path), HAPPY if "walk" in path else SAD, method)


@pytest.mark.parametrize("folder", FOLDERS)
def test_other_skeletons(folder: str, data: Path) -> None:
    tried = 0
    for path in sorted((data / folder).glob("*.bvh"))[:4]:
        try:
            motion = mien.load(path)
            Body.of(motion)
        except mien.MienError:
            continue
        motion = motion[: round(8.0 / motion.frame_time)]
        sound(motion, SAD, "rules")
        sound(motion, HAPPY, "joint")
        tried += 1
    assert tried
