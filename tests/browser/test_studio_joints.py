"""A clip whose joints say nothing: they are named by hand, and it is a clip like any other from then on."""

import re
from pathlib import Path
from typing import Any

from mien import edit, load
from mien.formats import bvh
from mien.motion import Motion

from .driving import Studio, V, numbers
from .test_studio_axe import AXE, violations

Nameless = tuple[Motion, dict[str, str]]


def label(role: str) -> re.Pattern[str]:
    return re.compile(f"^{role.replace('_', ' ')}", re.IGNORECASE)


def choose(dialog: Any, roles: dict[str, str]) -> None:
    for role, joint in roles.items():
        dialog.get_by_role("combobox", name=label(role)).select_option(joint)


def test_joints_are_named(studio: Studio, nameless: Nameless, tmp_path: Path) -> None:
    motion, roles = nameless
    file = tmp_path / "nameless.bvh"
    file.write_bytes(bvh.render(motion))
    studio.expected += ("status of 422",)
    studio.open(file)
    assert (
        "This clip can only be looked at"
        in studio.page.get_by_role("complementary", name="Edit").inner_text()
    )
    studio.button("Name its joints…").click()
    dialog = studio.page.get_by_role("dialog")
    boxes = dialog.get_by_role("combobox")
    assert boxes.first.get_by_role("option").nth(1).inner_text() == "j00"
    assert boxes.count() == 21
    if AXE.exists():
        assert violations(studio, "dialog") == []

    choose(dialog, {role: joint for role, joint in roles.items() if role != "left_knee"})
    assert studio.page.evaluate(f"[{V}.names, {V}.selected]") == [True, roles["right_toe"]]
    dialog.get_by_role("button", name="Apply").click()
    dialog.get_by_role("alert").get_by_text("Choose a joint for left knee: no body is without.").wait_for()
    choose(dialog, {"left_knee": roles["right_knee"]})
    dialog.get_by_role("button", name="Apply").click()
    dialog.get_by_role("alert").get_by_text("are both the joint 'j19'").wait_for()
    choose(dialog, {"left_knee": roles["left_knee"]})
    dialog.get_by_role("button", name="Apply").click()
    dialog.wait_for(state="hidden")
    studio.settle()
    assert studio.page.evaluate(f"[{V}.names, {V}.selected]") == [False, None]

    studio.mood("sad")
    given = studio.export()
    after = edit(load(file, roles=roles), "sad")
    assert given == bvh.render(after)
    assert numbers(given).shape != numbers(file.read_bytes()).shape, "it is slower"

    studio.page.reload()
    studio.settle()
    assert studio.layers() == ["Sad"]
    assert not studio.button("Name its joints…").is_visible()
    assert studio.page.get_by_role("tab", name=re.compile("^Checks")).inner_text() != "Checks", (
        "it is checked"
    )

    edited = tmp_path / "edited.bvh"
    edited.write_bytes(given)
    studio.open(edited)
    assert studio.moods.get_by_role("button", name="sad", exact=True).is_enabled(), "named alike"


def test_joints_that_were_found_can_be_corrected_and_be_found_again(walking: Studio) -> None:
    def named() -> str:
        walking.button("Edit").click()
        walking.page.get_by_role("menuitem", name="Name its joints…").click()
        neck = walking.page.get_by_role("dialog").get_by_role("combobox", name=label("neck"))
        neck.get_by_role("option").nth(1).wait_for(state="attached")
        return str(neck.input_value())

    dialog = walking.page.get_by_role("dialog")
    assert named() == "Neck"
    tall = dialog.locator("fieldset.left label, fieldset.right label").evaluate_all(
        "all => all.map(one => one.firstElementChild.getClientRects().length)"
    )
    assert tall == [1] * 16, "none is broken into lines"
    arm = dialog.get_by_role("combobox", name=label("left_elbow"))
    assert arm.locator("option:checked").evaluate("one => one.text") == "LeftForeArm", "not cut by its depth"
    assert arm.get_by_role("option", name="RightForeArm").evaluate("one => one.label").startswith("\u00a0")
    choose(dialog, {"neck": ""})
    dialog.get_by_role("button", name="Apply").click()
    dialog.wait_for(state="hidden")
    walking.settle()
    assert named() == ""
    dialog.get_by_role("button", name="As found").click()
    dialog.wait_for(state="hidden")
    walking.settle()
    assert named() == "Neck"
    walking.close_dialog()
