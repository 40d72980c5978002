"""No violation of the rules of WCAG that a machine can check, in every state of the page, dark and light."""

from collections.abc import Callable
from pathlib import Path

import pytest

from .driving import Server, Studio, told

AXE = Path(__file__).resolve().parents[2] / "frontend" / "node_modules" / "axe-core" / "axe.min.js"
pytestmark = pytest.mark.skipif(not AXE.exists(), reason="axe-core is not installed (in frontend: npm ci)")


def violations(studio: Studio, inside: str = "body") -> list[str]:
    """Return what axe finds inside of an element."""
    studio.settle()
    if not studio.page.evaluate("'axe' in window"):
        studio.page.evaluate(AXE.read_text(encoding="utf-8"))
    found = studio.page.evaluate("inside => axe.run(inside)", inside)
    assert len(found["passes"]) > 4, "it has looked at something"
    return told(found["violations"])


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_axe(visit: Callable[..., Studio], server: Server, clips: Path, theme: str) -> None:
    studio = visit(server, color_scheme=theme)
    studio.expected += ("status of 422",)
    found = {"empty": violations(studio)}

    studio.open(clips / "walk.bvh")
    found["open"] = violations(studio)
    studio.mood("sad")
    studio.add("Posture")
    studio.button("Add a key at the playhead").click()
    studio.page.get_by_text("Words", exact=True).click()
    found["editing, mood"] = violations(studio)
    studio.tab("Body")
    found["body"] = violations(studio, "aside:last-of-type")
    studio.type("Overall, typed", "2")
    studio.tab("Checks")
    found["checks"] = violations(studio, "aside:last-of-type")
    for mode in ("Side by side", "Wipe"):
        studio.page.get_by_text(mode, exact=True).click()
        found[mode] = violations(studio, "main")
    broken = clips / "broken.bvh"
    broken.write_text("HIERARCHY\n", encoding="utf-8")
    studio.open(broken)
    found["messages"] = violations(studio, "[aria-label=Messages]")
    studio.button("File").click()
    found["menu"] = violations(studio, "header")
    studio.press("Escape")
    for dialog, key in (("export", "Control+e"), ("keys", "?"), ("palette", "Control+k")):
        studio.press(key)
        found[dialog] = violations(studio, "dialog")
        studio.close_dialog()
    studio.button("Help").click()
    studio.page.get_by_role("menuitem", name="First steps").click()
    found["help"] = violations(studio, "dialog")
    assert {state: lines for state, lines in found.items() if lines} == {}
    assert len(found) == 13


def test_focus_is_seen_everywhere(walking: Studio) -> None:
    """Tab goes through all controls, and each shows that it has the focus."""
    walking.mood("sad")
    names = []
    for _ in range(250):
        walking.press("Tab")
        here = walking.page.evaluate(
            """() => {
              const here = document.activeElement;
              if (here === document.body || here.dataset.seen) return null;
              here.dataset.seen = "yes";
              const ring = one => one && getComputedStyle(one).outlineStyle !== "none";
              const shown = ring(here) || ring(here.closest("label")) || ring(here.closest(".field"))
                || ring(here.parentElement) || here.closest(".pad")?.querySelector("svg .focus");
              const name = here.ariaLabel || here.labels?.[0]?.innerText || here.innerText
                || document.getElementById(here.getAttribute("aria-labelledby"))?.innerText || "";
              return [name.trim(), Boolean(shown), here.outerHTML.slice(0, 160)];
            }"""
        )
        if here is None:
            break
        names.append(here[0])
        assert here[0], f"no name: {here[2]}"
        assert here[1], f"no focus to be seen: {here[2]}"
    assert len(names) > 70
