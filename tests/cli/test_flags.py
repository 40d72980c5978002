from collections.abc import Callable
from dataclasses import replace

import pytest
from typer.testing import Result

from mien.cli.flags import compose, describe, flag_name
from mien.edits.order import ORDER
from mien.edits.registry import EDITS
from mien.recipe import Step

SAD = (
    Step("path_length", {"mid": 0.6}),
    Step("path_length", {"mid": 0.8}, parts=("arms",)),
    Step("posture", {"head": 25.0, "trunk": 5.0}),
    Step("foot_plant"),
)


def edits(steps: tuple[Step, ...]) -> list[str]:
    return [step.edit for step in steps]


def test_every_parameter_of_every_edit_has_a_flag_with_its_range_and_default(
    run: Callable[..., Result], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "300")
    shown = run("edit", "--help").stdout
    unwrapped = "".join(shown.split())
    for edit in EDITS.values():
        for parameter in edit.parameters.values():
            assert f"  {flag_name(edit.name, parameter.name)} " in shown
            assert "".join(describe(parameter).split()) in unwrapped


def test_an_edit_that_works_as_it_is_has_a_flag_of_its_own(run: Callable[..., Result]) -> None:
    shown = run("edit", "--help").stdout
    assert " --mirror " in shown
    assert " --in-place " in shown
    for name in ("posture", "path_length", "trim", "resample", "displacement", "tremor", "waveshape"):
        assert f" {flag_name(name)} " not in shown, f"{name} needs a value to do something"


def test_flags_alone_make_steps_in_the_right_order_with_the_feet_put_back() -> None:
    flags = {name: {} for name in ("posture", "in_place", "timing", "trim", "path_length", "mirror")}
    wanted = ["trim", "mirror", "path_length", "timing", "posture", "foot_plant", "in_place"]
    assert edits(compose((), flags, foot_plant=True)) == wanted
    assert edits(compose((), flags, foot_plant=False)) == [n for n in wanted if n != "foot_plant"]


def test_what_is_added_to_a_movement_comes_after_what_shapes_it() -> None:
    flags = {name: {} for name in ("tremor", "posture", "displacement", "timing", "waveshape", "path_length")}
    wanted = ["path_length", "waveshape", "timing", "posture", "displacement", "tremor"]
    assert edits(compose((), flags, foot_plant=False)) == wanted


def test_no_feet_are_put_back_when_no_pose_is_edited() -> None:
    assert edits(compose((), {"mirror": {}, "trim": {"start": 1.0}}, foot_plant=True)) == ["trim", "mirror"]


def test_a_flag_changes_every_step_of_its_edit_in_the_recipe() -> None:
    made = compose(SAD, {"posture": {"head": 10.0}, "path_length": {"mid": 0.9}}, foot_plant=True)
    assert edits(made) == edits(SAD)
    assert made[0].parameters == {"mid": 0.9}
    assert made[1] == replace(SAD[1], parameters={"mid": 0.9})
    assert made[2].parameters == {"head": 10.0, "trunk": 5.0}


def test_a_flag_of_another_edit_adds_a_step_at_its_place() -> None:
    made = compose(SAD, {"timing": {}, "trim": {}, "in_place": {}}, foot_plant=True)
    assert edits(made) == [
        "trim",
        "path_length",
        "path_length",
        "timing",
        "posture",
        "foot_plant",
        "in_place",
    ]


def test_a_recipe_without_repair_gets_none_unless_asked() -> None:
    bare = SAD[:3]
    assert compose(bare, {}, foot_plant=None) == bare
    assert edits(compose(bare, {}, foot_plant=True))[-1] == "foot_plant"
    assert edits(compose(SAD, {}, foot_plant=False)) == edits(bare)
    assert edits(compose(SAD, {}, foot_plant=True)).count("foot_plant") == 1


def test_the_order_names_edits_that_exist() -> None:
    assert set(ORDER) <= set(EDITS)
