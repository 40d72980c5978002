"""Write the studio's keys into its documentation: ``python scripts/studio_keys.py``.

Keys come from ``keymap.ts``, what they do from where the commands have their names, so that the page cannot
say anything else than the studio does.
"""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "frontend" / "src" / "studio"
PAGE = ROOT / "docs" / "studio.md"
MARKS = "<!-- keys -->\n", "<!-- /keys -->"
SHOWN = {"ArrowRight": "→", "ArrowLeft": "←", "ArrowUp": "↑", "ArrowDown": "↓", "|": "\\|"}


def names() -> dict[str, str]:
    """Return command -> what it does, in the words of the menus."""
    commands, view = ((SOURCE / f"{name}.ts").read_text(encoding="utf-8") for name in ("commands", "view"))
    plain = {}
    for entry in re.split(r'\bid: "', commands)[1:]:
        general = re.search(r'general: "([^"]+)"', entry)
        name = re.search(r'name: "([^"]+)"', entry)
        if found := general or name:
            plain[entry.split('"')[0]] = found[1]
    play = re.findall(r'play\("([\w-]+)", "([^"]+)"', commands)
    toggles = re.findall(r'toggle: "(\w+)",\s+label: "([^"]+)",\s+hint:\s+"([^"]+)"', view)
    return {**plain, **dict(play), **{name: f"{label}: {hint}" for name, label, hint in toggles}}


def table() -> str:
    """Return the table as Markdown."""
    keymap = (SOURCE / "keymap.ts").read_text(encoding="utf-8")
    known = names()
    rows = []
    for command, keys in re.findall(r'{ command: "([\w-]+)", keys: \[([^\]]*(?:"\]"[^\]]*)?)\] }', keymap):
        shown = re.findall(r'"([^"]+)"', keys)
        for sign, instead in SHOWN.items():
            shown = [key.replace(sign, instead) for key in shown]
        rows.append(f"| {', '.join(f'`{key}`' for key in shown)} | {known[command]} |")
    return "\n".join(["| keys | what they do |", "| --- | --- |", *rows]) + "\n"


def written() -> str:
    """Return the page with the table in its place."""
    before, rest = PAGE.read_text(encoding="utf-8").split(MARKS[0])
    return before + MARKS[0] + table() + MARKS[1] + rest.split(MARKS[1])[1]


if __name__ == "__main__":
    PAGE.write_text(written(), encoding="utf-8")
