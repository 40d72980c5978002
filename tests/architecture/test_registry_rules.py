"""One registry of edits: every file in edits/ is one edit, with a test, a page and a line in METHODS.md."""

from math import inf
from pathlib import Path

import pytest

import mien.edits  # noqa: F401  (registers every edit)
from mien.edits.registry import EDITS
from mien.kinematics import body

ROOT = Path(__file__).resolve().parents[2]
SHARED = {"__init__", "keyed", "order", "parameters", "pipeline", "registry"}
FILES = sorted(p.stem for p in (ROOT / "src" / "mien" / "edits").glob("*.py") if p.stem not in SHARED)


@pytest.mark.parametrize("name", FILES)
def test_a_file_registers_exactly_the_edit_it_is_named_after(name: str) -> None:
    here = [e.name for e in EDITS.values() if e.run.__module__ == f"mien.edits.{name}"]
    assert here == [name], (
        f"edits/{name}.py must hold one function `{name}` under @edit and no other edit; "
        "what is no edit belongs into kinematics or signal"
    )


def test_every_registered_edit_has_its_file() -> None:
    assert set(EDITS) == set(FILES)


@pytest.mark.parametrize("name", FILES)
def test_an_edit_has_a_test_file_of_its_name(name: str) -> None:
    file = ROOT / "tests" / "edits" / f"test_{name}.py"
    assert file.is_file(), f"write {file.relative_to(ROOT)}"


@pytest.mark.parametrize("name", sorted(EDITS))
def test_what_an_edit_says_of_itself(name: str) -> None:
    edit = EDITS[name]
    assert edit.paper or edit.equation, f"{name}: @edit says the paper or, where there is none, the equation"
    assert edit.summary.endswith("."), f"{name}: the docstring starts with one sentence"
    assert edit.kind in ("pose", "rhythm", "time", "repair")


@pytest.mark.parametrize("name", sorted(EDITS))
def test_parameters_describe_themselves(name: str) -> None:
    for parameter in EDITS[name].parameters.values():
        where, about = f"{name}: {parameter.name}", parameter.about
        assert about.doc, f"{where}: Param needs a one-line description"
        if parameter.kind not in (float, int):
            assert about.neutral is None, f"{where}: only numbers follow strength"
            continue
        assert about.low is not None, f"{where}: give the lowest value that makes sense (Param low=)"
        high = inf if about.high is None else about.high
        assert about.neutral is None or high < inf, (
            f"{where}: follows strength, so give its highest value (high=)"
        )
        for value in (parameter.default, about.neutral):
            assert value is None or about.low <= value <= high, f"{where}: {value} is out of range"


@pytest.mark.parametrize("name", sorted(EDITS))
def test_a_pose_edit_follows_strength(name: str) -> None:
    edit = EDITS[name]
    if edit.kind in ("pose", "rhythm"):
        assert any(p.about.neutral is not None for p in edit.parameters.values()), (
            f"{name}: no parameter has Param(neutral=...), so strength would change nothing"
        )


def test_defaults_pass_their_own_checks() -> None:
    for edit in EDITS.values():
        given = {n: p.default for n, p in edit.parameters.items()}
        assert edit.complete(given) == given, f"{edit.name}: a default is not of its parameter's own type"


def test_body_part_names_and_roles_do_not_clash() -> None:
    """``--parts head`` must mean one thing; a name that is both must be the same joints."""
    both = set(body.PARTS) & set(body.ROLES)
    assert both <= {"head"}
