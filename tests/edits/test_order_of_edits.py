"""The usual order of edits: every edit has its place, steps of several recipes merge into one."""

from mien.edits.order import ORDER, insert, merged, rank
from mien.edits.registry import EDITS
from mien.recipe import Step


def test_every_edit_has_a_place() -> None:
    assert set(ORDER) <= set(EDITS)
    assert sorted(EDITS, key=rank)[-1] == "in_place"
    assert rank("posture") < rank("tempo") < rank("foot_plant")


def test_a_step_is_inserted_before_what_comes_later() -> None:
    steps = [Step("path_length"), Step("foot_plant")]
    insert(steps, Step("posture"))
    assert [step.edit for step in steps] == ["path_length", "posture", "foot_plant"]


def test_recipes_merge_in_order_with_each_repair_once() -> None:
    one = [Step("posture", {"head": 10.0}), Step("tempo", {"rate": 0.8}), Step("foot_plant")]
    other = [Step("path_length", {"mid": 1.2}), Step("posture", {"head": -5.0}), Step("foot_plant")]
    made = merged([one, other])
    assert [step.edit for step in made] == ["path_length", "posture", "posture", "tempo", "foot_plant"]
    assert [step.parameters["head"] for step in made[1:3]] == [10.0, -5.0]
