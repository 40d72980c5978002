"""Models as text: what is written is read back, and whatever is no model is one sentence."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mien
from mien import samples
from mien.analysis.laban_table import DERIVED
from mien.analysis.manner_features import FEATURES
from mien.emotion.circumplex import quadrant
from mien.emotion.model import format_model, load_model, shipped_model
from mien.errors import MienError


@pytest.fixture(scope="module")
def text() -> str:
    return format_model(shipped_model())


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("models") / "model.json"


def loaded(place: Path, text: str) -> Any:
    place.write_text(text, encoding="utf-8")
    return load_model(place)


def test_what_is_written_is_read_back(place: Path, text: str) -> None:
    one, other = shipped_model(), loaded(place, text)
    assert format_model(other) == text
    rng = np.random.default_rng(3)
    for numbers in rng.normal(size=(20, len(FEATURES))):
        for reading in ("change", "alone"):
            before = getattr(one, reading).probabilities(numbers)
            after = getattr(other, reading).probabilities(numbers)
            assert list(before) == list(after)
            assert before == after
            assert sum(after.values()) == pytest.approx(1.0)
            assert one.place(before) == other.place(after)
    for derived in rng.uniform(size=(20, len(DERIVED))):
        assert one.laban.place(derived) == other.laban.place(derived)


def test_a_learned_model_survives_six_digits() -> None:
    """The numbers of a model are rounded when it is written; what it says hardly changes."""
    model = shipped_model()
    rough = np.round(model.change.planes.weights, 4)
    numbers = np.random.default_rng(4).normal(size=len(FEATURES))
    x = model.change.scaled(numbers)
    np.testing.assert_allclose(rough @ x, model.change.planes.weights @ x, atol=1e-2)


def test_the_shipped_model_by_its_name() -> None:
    model = load_model("bandai")
    assert model is shipped_model()
    assert "CC BY-NC" in model.card["licence"]
    assert model.card["scores on contents left out"]["change top-1"] > 0.6
    assert set(model.places) <= set(model.change.planes.names) == set(model.alone.planes.names)
    assert set(model.clusters.changes) == set(model.places)


def test_labels_pull_the_way_they_are_told_apart() -> None:
    """The pulls of a label add up to its score above the mean score of all."""
    manners = shipped_model().change
    numbers = np.random.default_rng(5).normal(size=len(FEATURES))
    scores = manners.planes.weights @ manners.scaled(numbers)
    own = scores[manners.planes.names.index("sad")] - scores.mean()
    assert manners.pulls(numbers, "sad").sum() == pytest.approx(own)


def test_the_place_is_the_mean_of_the_labels_that_have_one() -> None:
    model = shipped_model()
    nothing = dict.fromkeys(model.change.planes.names, 0.0)
    assert model.place(nothing | {"sad": 1.0}) == pytest.approx(model.places["sad"])
    assert model.place(nothing | {"sad": 0.4, "old": 0.6}) == pytest.approx(model.places["sad"])
    assert model.place(nothing) == (0.0, 0.0)
    assert quadrant(*model.place(nothing | {"happy": 0.5, "active": 0.5})) == "Q2"


BROKEN = {
    "empty": "",
    "no JSON": "{not json",
    "a list": "[]",
    "a number": "7",
    "nothing in it": "{}",
    "another version": '{"version": 2}',
    "a version of words": '{"version": "\\n\\n1"}',
    "deep": "[" * 100_000,
    "long number": '{"version": ' + "9" * 5000 + "}",
    "half": None,
}


@pytest.mark.parametrize("what", BROKEN)
def test_what_is_no_model_is_one_sentence(place: Path, text: str, what: str) -> None:
    broken = BROKEN[what]
    with pytest.raises(MienError, match=r"model\.json: is no model of emotion that mien learn wrote") as said:
        loaded(place, text[: len(text) // 2] if broken is None else broken)
    assert len(str(said.value).splitlines()) == 1
    assert len(str(said.value)) < 400


HOSTILE = {
    "not finite": (("change", "weights", 0, 0), float("nan")),
    "infinite": (("alone", "middle", 0), float("inf")),
    "huge": (("change", "offsets", 0), 10**400),
    "no scale": (("change", "scale", 3), 0.0),
    "negative scale": (("alone", "scale", 3), -1.0),
    "too few": (("change", "offsets"), [1.0]),
    "labels twice": (("change", "names", 1), "active"),
    "labels of numbers": (("change", "names", 1), 4),
    "unknown label": (("places", "blue"), [0.0, 0.0]),
    "place of three": (("places", "sad"), [0.0, 0.0, 0.0]),
    "no places": (("places",), {}),
    "no unit rotation": (("rest", "pose", "head"), [1.0, 1.0, 1.0, 1.0]),
    "unknown segment": (("rest", "pose", "tail"), [0.0, 0.0, 0.0, 1.0]),
    "no swing": (("rest", "swing", "head"), 0.0),
    "negative rate": (("rest", "rate", "head"), -1.0),
    "a width of nothing": (("laban", "surface", "sigma"), 0.0),
    "feature out of range": (("laban", "selected", 0), 121),
    "feature from the end": (("laban", "selected", 0), -1),
    "components that do not fit": (("laban", "components"), [[1.0]]),
    "changes too short": (("clusters", "changes", "sad"), [1.0]),
    "no clusters": (("clusters", "heights"), []),
    "negative weights": (("clusters", "weights", 0, 0), -1.0),
    "card of words": (("card",), "good"),
}


def altered(text: str, path: tuple[Any, ...], value: Any) -> str:
    data = json.loads(text)
    inner = data
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    return json.dumps(data)


@pytest.mark.parametrize("what", HOSTILE)
def test_what_would_not_work_is_told_when_it_is_read(place: Path, text: str, what: str) -> None:
    with pytest.raises(MienError, match="is no model of emotion"):
        loaded(place, altered(text, *HOSTILE[what]))


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    for path in (tmp_path / "none.json", tmp_path, "a\0b"):
        with pytest.raises(MienError, match="cannot be read as a model"):
            load_model(path)
    (tmp_path / "bytes.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(MienError, match="it is not text"):
        load_model(tmp_path / "bytes.json")


def paths(data: Any, here: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Every place in a model; of long lists only the first two."""
    if isinstance(data, dict):
        inner = [p for key, value in data.items() for p in paths(value, (*here, key))]
    elif isinstance(data, list):
        inner = [p for i, value in enumerate(data[:2]) for p in paths(value, (*here, i))]
    else:
        inner = []
    return [*([here] if here else []), *inner]


PLACES = [p for p in paths(json.loads(format_model(shipped_model()))) if p[0] != "card"]
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=8,
)
WALK = samples.walk(seconds=1.0).motion
SAD = mien.edit(WALK, "sad")


def attempt(place: Path, text: str) -> tuple[Any, str]:
    """The model, or the sentence that says why it is none."""
    try:
        return loaded(place, text), ""
    except MienError as error:
        return None, str(error) or "no sentence\nat all"


@given(path=st.sampled_from(PLACES), value=VALUES)
def test_any_change_is_refused_or_works(place: Path, text: str, path: tuple[Any, ...], value: Any) -> None:
    """Whatever is written over one place of a model, it is one sentence or a model that reads clips."""
    model, said = attempt(place, altered(text, path, value))
    assert len(said.splitlines()) <= 1
    for motion in (WALK, SAD) if model else ():
        found = mien.read(motion, model=model)
        assert np.isfinite([*found.place, *found.labels.values()]).all()
        assert json.dumps(found.as_data(), allow_nan=False)


def test_a_model_is_told_in_one_line() -> None:
    assert len(repr(shipped_model())) < 250
    assert "happy" in repr(shipped_model())
