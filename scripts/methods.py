"""Write what documents say of edits, presets and checks, from the registry and the preset files.

METHODS.md, the facts in docs/methods/*.md, the tables of emotion words in README.md and docs/presets.md, that
of the checks in docs/checks.md, that of the Laban features in docs/laban.md, the card of the shipped model
and the emotion words of both tables in docs/emotion.md.
``python scripts/methods.py`` writes them; with ``--check`` it only says which are out of date. Change the
edit or the preset, then run this.
"""

import sys
from pathlib import Path
from shlex import quote

import mien.edits
from mien.analysis.checks.report import CHECKS
from mien.analysis.laban_table import COMPONENTS, FEATURES, Feature
from mien.cli.flags import flag_name
from mien.edits.registry import EDITS, Edit, Parameter
from mien.emotion.circumplex import TABLES, source
from mien.emotion.circumplex import words as placed_words
from mien.emotion.model import shipped_model
from mien.emotion.presets import PRESETS, preset

ROOT = Path(__file__).resolve().parents[1]
COMMAND = "python scripts/methods.py"
BEGIN = f"<!-- from the registry; written by `{COMMAND}`, not by hand -->"
END = "<!-- end of the generated part -->"
KINDS = {
    "pose": "changes poses frame by frame: follows strength, body parts and time spans",
    "rhythm": "changes when the whole body does things: follows strength and time spans, not body parts",
    "time": "changes frames or the whole clip: strength, parts and spans do not apply",
    "repair": "mends the whole clip, given the motion before the edits",
}
# Values that show an edit; without a line here the first parameter goes a quarter of the way up.
SHOWN = {
    "resample": {"fps": 30},
    "trim": {"start": 0.5, "end": 2.0},
    "path_length": {"mid": 1.5},
    "waveshape": {"small": 0.4},
    "sway": {"hips_tilt": 2.0},
    "bounce": {"gain": 2.0},
    "displacement": {"keys": "0.5 none | 1 head 25 0 0 | 2 none"},
    "tremor": {"amount": 2.0},
    "nervous": {"paths": 0.8, "rhythm": 0.15},
    "restore": {"amount": 0.5},
    "control_points": {"pelvis": 0.95, "torso": 0.6},
    "tempo": {"rate": 1.2, "travel": "speed"},
}


def example(edit: Edit) -> dict[str, object]:
    """Return parameters that show what the edit does."""
    if edit.name in SHOWN:
        return dict(SHOWN[edit.name])
    for name, p in edit.parameters.items():
        low, high = p.about.neutral, p.about.high
        if low is not None and high is not None:
            return {name: float(f"{low + 0.25 * (high - low):.2g}")}
    return {}


def command(edit: Edit) -> str:
    """Return a command line that does the example."""
    given = {flag_name(edit.name, name): quote(_plain(value)) for name, value in example(edit).items()}
    flags = [f"{flag} {value}" for flag, value in given.items()]
    own = flag_name(edit.name)
    if not flags and edit.kind == "repair":
        return f"mien edit walk.bvh --emotion sad   # {edit.name} follows the edits of a preset"
    return f"mien edit walk.bvh {' '.join(flags) or own}"


def call(edit: Edit) -> str:
    """Return a line of Python that does the example."""
    given = {n: f'"{v}"' if isinstance(v, str) else _plain(v) for n, v in example(edit).items()}
    values = ", ".join(f'"{name}": {value}' for name, value in given.items())
    return f'mien.apply(walk, [mien.Step("{edit.name}", {{{values}}})])'


def _plain(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value).lower()


def parameter_table(edit: Edit) -> list[str]:
    """Return the lines of a table of parameters, or the sentence that there are none."""
    if not edit.parameters:
        return ["It has no parameters."]
    head = ["| parameter | what it does | range | default | neutral |", "| --- | --- | --- | --- | --- |"]
    return head + [_row(edit, p) for p in edit.parameters.values()]


def _row(edit: Edit, p: Parameter) -> str:
    low, high = ("" if v is None else f"{v:g}" for v in (p.about.low, p.about.high))
    span = f"{low} to {high}" if low and high else f"from {low}" if low else ""
    limits = " or ".join(f"`{c}`" for c in p.choices) or f"{span} {p.about.unit}".strip()
    default = "" if p.default is None else _plain(p.default) or "none"
    default = ", ".join(p.default) if isinstance(p.default, tuple) else default
    neutral = "" if p.about.neutral is None else f"{p.about.neutral:g}"
    about = _cell(p.doc)
    return f"| `{p.name}`<br>`{flag_name(edit.name, p.name)}` | {about} | {limits} | {default} | {neutral} |"


def facts(edit: Edit, *, up: str) -> list[str]:
    """Return the table of what is known of an edit; ``up`` is the way to the project's root."""
    name = edit.name
    rows = {
        "kind": f"`{edit.kind}`: {KINDS[edit.kind]}",
        "paper": edit.paper or "none: plain geometry",
        "equation": f"`{edit.equation}`" if edit.equation else "none",
        "deviations": edit.deviations or "none",
        "command": f"`{command(edit)}`",
        "Python": f"`{call(edit)}`",
        "function": f"[`mien.edits.{name}.{name}`]({up}src/mien/edits/{name}.py)",
        "tests": f"[`tests/edits/test_{name}.py`]({up}tests/edits/test_{name}.py), and `tests/laws`",
    }
    lines = (f"| {key} | {_cell(value)} |" for key, value in rows.items())
    return ["| | |", "| --- | --- |", *lines]


def _cell(text: str) -> str:
    """Return text as one cell of a table: one line, no bars, code in single backticks."""
    return " ".join(text.replace("|", "\\|").replace("``", "`").split())


def methods() -> str:
    """Return the text of METHODS.md."""
    lines = [
        "# Methods",
        "",
        BEGIN,
        "",
        "What every edit does, where it comes from, and how it differs from its source. "
        "What it looks like, and when to use it, is in `docs/methods`.",
        "",
    ]
    for name in sorted(EDITS):
        edit = EDITS[name]
        lines += [
            f"## [{name}](docs/methods/{name}.md)",
            "",
            _cell(edit.summary),
            "",
            *facts(edit, up=""),
            "",
        ]
        lines += [*parameter_table(edit), ""]
    return "\n".join(lines)


def words(*, own: bool) -> list[str]:
    """Return a table of mien's own presets, or of those of the thesis."""
    names = [name for name in PRESETS if ("/" not in name) == own]
    rows = [f"| `{name}` | {_cell(preset(name).description)} |" for name in names]
    return ["| emotion | what it does |", "| --- | --- |", *rows]


def evidence() -> list[str]:
    """Return the tables of all presets with what is known of how viewers read them."""
    lines = []
    for title, own in (("## Emotion words", True), ("## The thesis's own", False)):
        lines += [title, "", "| emotion | what it does | evidence |", "| --- | --- | --- |"]
        for recipe, name in ((preset(n), n) for n in PRESETS if ("/" not in n) == own):
            lines.append(f"| `{name}` | {_cell(recipe.description)} | {_cell(recipe.evidence)} |")
        lines.append("")
    return lines[:-1]


def checks() -> list[str]:
    """Return the table of all checks with what they allow."""
    head = [
        "| check | what is measured | an edit may have | a capture by itself |",
        "| --- | --- | --- | --- |",
    ]
    rows = []
    for c in CHECKS.values():
        unit = f" {c.unit}".rstrip()
        source = {0.0: "", 1.0: "the source's value + "}.get(
            c.factor, f"{c.factor:g} x the source's value + "
        )
        when = "on average" if c.overall else f"for {c.lasting:g} s" if c.lasting else "in any frame"
        alone = (
            "not judged" if c.needs_source else f"up to {c.limit:g}{unit} but for {c.share:.0%} of its frames"
        )
        alone = f"up to {c.limit:g}{unit} on average" if c.overall and not c.needs_source else alone
        what = f"{c.label}{',' if unit else ''}{unit}"
        rows.append(f"| `{c.name}` | {what} | {source}{c.tolerance:g}{unit}, {when} | {alone} |")
    return head + rows


def laban() -> list[str]:
    """Return the tables of the Laban features, one for each component."""
    lines = []
    for component in COMPONENTS:
        lines += [f"## {component}", "", "| f | feature | what it is | unit | derived |"]
        lines += ["| --- | --- | --- | --- | --- |"]
        lines += [_laban_row(f) for f in FEATURES if f.component == component]
        lines.append("")
    return ["Of the derived features, the **selected** ones are bold.", "", *lines[:-1]]


def _laban_row(feature: Feature) -> str:
    derived = [
        f"{f'**{name}**' if name in feature.selected else name} {feature.first + i}"
        for i, name in enumerate(feature.statistics)
    ]
    shown = ", ".join(derived).replace("_", " ")
    about = _cell(feature.definition)
    return f"| {feature.number} | `{feature.name}` | {about} | {feature.unit} | {shown} |"


SCORES = "scores on contents left out"
SAID = {
    "top-1": "share of takes whose label is the likeliest",
    "top-1, acted": "the same, without the neutral takes",
    "quadrant": "share of takes in the right quadrant, of labels with a place",
    "distance": "mean distance on the disc, of labels with a place",
}


def emotion() -> list[str]:
    """Return the card of the shipped model, and where the emotion words stand in both tables."""
    card = dict(shipped_model().card)
    scores = card.pop(SCORES)
    lines = ["## The shipped model", "", "| | |", "| --- | --- |"]
    for key, value in card.items():
        lines.append(f"| {key} | {_cell(', '.join(value) if isinstance(value, list) else str(value))} |")
    places = (f"{label} {v:+.2f} {a:+.2f}" for label, (v, a) in shipped_model().places.items())
    lines += [f"| places of labels | {', '.join(places)} |", ""]
    lines += [f"Its scores on contents left out (guessing one of the labels: {scores['chance']:g}):", ""]
    lines += ["| score | change | alone | laban |", "| --- | --- | --- | --- |"]
    for name, said in SAID.items():
        values = (scores.get(f"{reading} {name}") for reading in ("change", "alone", "laban"))
        lines.append(f"| {said} | {' | '.join('' if v is None else f'{v:g}' for v in values)} |")
    return [*lines, "", "## Where the words stand", "", *_word_table()]


def _word_table() -> list[str]:
    known = {table: placed_words(table=table) for table in TABLES}
    lines = [f"- **{table}**: {_cell(source(table=table))}" for table in TABLES]
    lines += ["", "Valence and arousal of every word; `mien` uses the first table.", ""]
    lines += [f"| word | {' | '.join(TABLES)} |", "| --- | --- | --- |"]
    for word in sorted({word for places in known.values() for word in places}):
        found = (known[table].get(word) for table in TABLES)
        shown = ("" if p is None else f"{p.valence:+.2f} {p.arousal:+.2f}" for p in found)
        lines.append(f"| {word} | {' | '.join(shown)} |")
    return lines


def filled(written: str, made: list[str]) -> str:
    """Return a document with the part between the marks brought up to date; without marks, added."""
    block = "\n".join([BEGIN, "", *made, "", END])
    before, found, rest = written.partition(BEGIN)
    if not found:
        return f"{written.rstrip()}\n\n{block}\n"
    return before + block + rest.partition(END)[2]


def texts() -> dict[Path, str]:
    """Return every generated file and what it should hold."""
    made = {ROOT / "README.md": words(own=True), ROOT / "docs" / "presets.md": evidence()}
    made[ROOT / "docs" / "checks.md"] = checks()
    made[ROOT / "docs" / "laban.md"] = laban()
    made[ROOT / "docs" / "emotion.md"] = emotion()
    for name, edit in EDITS.items():
        made[ROOT / "docs" / "methods" / f"{name}.md"] = [
            *facts(edit, up="../../"),
            "",
            *parameter_table(edit),
        ]
    out = {ROOT / "METHODS.md": methods()}
    for file, lines in made.items():
        out[file] = filled(file.read_text(encoding="utf-8") if file.exists() else f"# {file.stem}", lines)
    return out


def stale() -> list[str]:
    """Return the names of generated files that do not hold what they should."""
    return [
        str(file.relative_to(ROOT))
        for file, text in texts().items()
        if not file.exists() or file.read_text(encoding="utf-8") != text
    ]


def main() -> None:
    """Write the files, or with ``--check`` exit with 1 when one is out of date."""
    old = stale()
    if "--check" in sys.argv[1:]:
        sys.exit(f"out of date: {', '.join(old)}; run `{COMMAND}`" if old else 0)
    for file, text in texts().items():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    print("\n".join(f"wrote {name}" for name in old) or f"up to date: {mien.edits.__name__}")


if __name__ == "__main__":
    main()
