import contextlib
import json
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.edits.pipeline import check
from mien.edits.registry import EDITS, Parameter
from mien.emotion.files import parse_recipe, read_recipe, write_recipe
from mien.emotion.recipe_text import format_recipe
from mien.errors import RecipeError
from mien.kinematics.body import PARTS, ROLES
from mien.recipe import Recipe, Step

WRITTEN = """
version = 1
name = "sad"
description = "shorter paths, head down"
evidence = "works"

[sources]
head = "Someone 2001, table 2"

[[steps]]
edit = "path_length"
mid = 0.6
parts = ["arms", "left_wrist"]

[[steps]]
edit = "posture"
head = 25
strength = 1.5
span = [0.5, 2]
ease = 0.1
"""


def test_a_file_as_a_person_writes_it() -> None:
    assert parse_recipe(WRITTEN) == Recipe(
        name="sad",
        description="shorter paths, head down",
        evidence="works",
        sources={"head": "Someone 2001, table 2"},
        steps=(
            Step("path_length", {"mid": 0.6}, parts=("arms", "left_wrist")),
            Step("posture", {"head": 25.0}, strength=1.5, span=(0.5, 2.0), ease=0.1),
        ),
    )


def test_what_is_written_reads_like_the_format_says() -> None:
    text = format_recipe(parse_recipe(WRITTEN))
    assert text.count("[[steps]]") == 2
    assert 'edit = "path_length"\nmid = 0.6\nparts = [\n    "arms",\n    "left_wrist",\n]\n' in text
    assert "strength = 1.0" not in text, "what stands at its default is left out"


def values(parameter: Parameter) -> st.SearchStrategy:
    about = parameter.about
    if parameter.choices and parameter.kind is tuple:
        return st.lists(st.sampled_from(parameter.choices), max_size=3).map(tuple)
    if parameter.choices:
        return st.sampled_from(parameter.choices)
    low, high = about.low if about.low is not None else -1e9, about.high if about.high is not None else 1e9
    if parameter.kind is float:
        return st.floats(low, high)
    if parameter.kind is int:
        return st.integers(int(low), int(high))
    return st.booleans() if parameter.kind is bool else st.text(max_size=20)


@st.composite
def steps(draw: st.DrawFn) -> Step:
    edit = EDITS[draw(st.sampled_from(sorted(EDITS)))]
    names = draw(st.lists(st.sampled_from(sorted(edit.parameters)), unique=True)) if edit.parameters else []
    times = st.floats(0, 1e3, allow_subnormal=False)
    span = draw(st.none() | st.tuples(times, times).filter(lambda s: s[0] < s[1]))
    return Step(
        edit.name,
        {name: draw(values(edit.parameters[name])) for name in names},
        strength=draw(st.floats(0, 2)),
        parts=tuple(draw(st.lists(st.sampled_from([*PARTS, *ROLES]), max_size=3))),
        span=span,
        ease=draw(st.floats(0, 10)),
    )


text = st.text(st.characters(codec="utf-8"), max_size=30)
recipes = st.builds(
    Recipe,
    name=text,
    steps=st.lists(steps(), max_size=4).map(tuple),
    description=text,
    evidence=text,
    sources=st.dictionaries(text, text, max_size=3),
)


@settings(max_examples=150, deadline=None)
@given(recipe=recipes, kind=st.sampled_from(["toml", "json"]))
def test_round_trip_is_exact(recipe: Recipe, kind: str) -> None:
    again = parse_recipe(format_recipe(recipe, kind=kind), kind=kind)
    assert again == recipe
    assert [repr(s) for s in again.steps] == [repr(s) for s in recipe.steps], "types and order too"


@pytest.mark.parametrize("name", ["r.toml", "r.json", "r.JSON"])
def test_files_on_disk(tmp_path: Path, name: str) -> None:
    recipe = parse_recipe(WRITTEN)
    write_recipe(recipe, tmp_path / name)
    assert read_recipe(tmp_path / name) == recipe
    assert b"\r" not in (tmp_path / name).read_bytes()
    if name.endswith("json"):
        assert json.loads((tmp_path / name).read_text())["steps"][0]["mid"] == 0.6


def test_a_file_with_byte_order_mark_and_windows_lines(tmp_path: Path) -> None:
    path = tmp_path / "r.toml"
    path.write_bytes(b"\xef\xbb\xbf" + WRITTEN.replace("\n", "\r\n").encode())
    assert read_recipe(path) == parse_recipe(WRITTEN)


def test_provenance_is_carried_but_is_not_part_of_the_recipe() -> None:
    recipe = parse_recipe(WRITTEN)
    text = format_recipe(recipe, provenance={"input": "walk.bvh", "mien": "0.1.0"})
    assert 'input = "walk.bvh"' in text
    assert parse_recipe(text) == recipe


def head(body: str) -> str:
    return f'version = 1\nname = "x"\n{body}'


STEP = "[[steps]]\n"
WRONG = {
    "not TOML": ("version = = 1", ["r.toml", "TOML", "line 1"]),
    "no version": ('name = "x"', ["version = 1"]),
    "another version": ('version = 2\nname = "x"', ["version is 2", "version 1"]),
    "version that is true": ('version = true\nname = "x"', ["True"]),
    "no name": ("version = 1", ["name", "text", "nothing"]),
    "unknown key": (head("step = []"), ["'step'", "did you mean 'steps'"]),
    "steps no list": (head("steps = 3"), ["steps", "list", "3"]),
    "sources no text": (head("[sources]\na = 3"), ["sources.a", "text", "3"]),
    "no edit": (head(STEP + "mid = 1"), ["step 1", "names no edit"]),
    "unknown edit": (head(STEP + 'edit = "postur"'), ["step 1", "'postur'", "did you mean 'posture'"]),
    "unknown parameter": (
        head(STEP + 'edit = "posture"\n' + STEP + 'edit = "posture"\nhaed = 3'),
        ["step 2", "posture", "'haed'", "did you mean 'head'"],
    ),
    "misspelt key of a step": (
        head(STEP + 'edit = "posture"\nstrenght = 0.5'),
        ["step 1", "posture", "did you mean 'strength'", "ease", "parts", "span"],
    ),
    "pose file": ("[turns]\nhead = [25, 0, 0]", ["pose file", "--posture-pose"]),
    "out of range": (head(STEP + 'edit = "posture"\nhead = 999'), ["step 1", "head", "degrees", "999"]),
    "wrong type": (head(STEP + 'edit = "posture"\nhead = "low"'), ["head", "number", "low"]),
    "strength": (head(STEP + 'edit = "posture"\nstrength = 3'), ["strength", "0 to 2", "3"]),
    "strength no number": (head(STEP + 'edit = "posture"\nstrength = true'), ["strength", "number"]),
    "unknown part": (head(STEP + 'edit = "posture"\nparts = ["arm"]'), ["'arm'", "did you mean 'arms'"]),
    "part no text": (head(STEP + 'edit = "posture"\nparts = [["arms"]]'), ["body part"]),
    "parts no list": (head(STEP + 'edit = "posture"\nparts = "arms"'), ["parts", "list", "'arms'"]),
    "span backwards": (head(STEP + 'edit = "posture"\nspan = [2, 1]'), ["span", "end after it starts"]),
    "span of one": (head(STEP + 'edit = "posture"\nspan = [2]'), ["span", "start, end"]),
    "span of words": (head(STEP + 'edit = "posture"\nspan = ["a", 1]'), ["span", "number", "'a'"]),
    "not finite": (head(STEP + 'edit = "posture"\nhead = nan'), ["head", "nan"]),
    "step no table": (head("steps = [3]"), ["step 1", "table"]),
}


@pytest.mark.parametrize("case", WRONG)
def test_errors_say_file_step_what_and_nearest(tmp_path: Path, case: str) -> None:
    content, expected = WRONG[case]
    path = tmp_path / "r.toml"
    path.write_text(content)
    with pytest.raises(RecipeError) as error:
        read_recipe(path)
    for words in ["r.toml", *expected]:
        assert words in str(error.value)


@pytest.mark.parametrize(
    "content",
    [
        "[" * 100_000,
        "{}",
        "[]",
        "3",
        '{"version": 1, "name": "x", "steps": [{"edit": "posture", "head": 1e999}]}',
        '{"version": 1, "name": "x", "steps": [{"edit": "posture", "ease": 1' + "0" * 400 + "}]}",
        '{"version": 1, "name": "x", "steps": [{"edit": "posture", "head": 1' + "0" * 400 + "}]}",
        '{"version": 1, "name": "x", "steps": [{"edit": "posture", "head": null}]}',
    ],
)
def test_hostile_json_is_refused(content: str) -> None:
    with pytest.raises(RecipeError):
        parse_recipe(content, kind="json")


def test_missing_folder_and_binary_files(tmp_path: Path) -> None:
    with pytest.raises(RecipeError, match=r"none\.toml: there is no such file"):
        read_recipe(tmp_path / "none.toml")
    with pytest.raises(RecipeError, match="cannot be read"):
        read_recipe(tmp_path)
    (tmp_path / "b.toml").write_bytes(bytes(range(256)))
    with pytest.raises(RecipeError, match="is not text"):
        read_recipe(tmp_path / "b.toml")


anything = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | text,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(text, inner, max_size=3),
)


@settings(max_examples=200, deadline=None)
@given(value=anything, key=st.sampled_from(["version", "name", "description", "steps", "sources"]))
def test_any_value_of_a_recipe_raises_nothing_but_recipe_errors(value: object, key: str) -> None:
    table = {"version": 1, "name": "x", "steps": [{"edit": "posture"}], key: value}
    with contextlib.suppress(RecipeError):
        parse_recipe(json.dumps(table), kind="json")


KEYS = [("posture", key) for key in ("edit", "strength", "parts", "span", "ease")]
KEYS += [(edit.name, name) for edit in EDITS.values() for name in edit.parameters]


@settings(max_examples=400, deadline=None)
@given(value=anything, key=st.sampled_from(KEYS))
def test_any_value_of_a_step_raises_nothing_but_recipe_errors(value: object, key: tuple[str, str]) -> None:
    table = {"version": 1, "name": "x", "steps": [{"edit": key[0], key[1]: value}]}
    with contextlib.suppress(RecipeError):
        parse_recipe(json.dumps(table), kind="json")


def test_no_parameter_bears_a_name_that_a_step_needs() -> None:
    taken = {"edit", "strength", "parts", "span", "ease"}
    for edit in EDITS.values():
        assert not taken & set(edit.parameters), f"{edit.name}: rename the parameter"


def test_a_step_that_was_filled_in_reads_back_filled_in() -> None:
    for name in EDITS:
        full = check(Step(name))
        recipe = Recipe("all", (full,))
        again = parse_recipe(format_recipe(recipe))
        assert replace(again, steps=tuple(map(check, again.steps))) == recipe
