"""Who may import whom. The plan stands in LAYERS; a failure says what to do about it."""

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "mien"

# Each room may import the rooms of the lines above its own, never its neighbours on the same line.
LAYERS = (
    ("errors", "typing"),
    ("curve",),
    ("recipe",),
    ("rotations",),
    ("signal",),
    ("motion",),
    ("kinematics",),
    ("formats", "edits", "analysis"),
    ("emotion", "styles"),
    ("render", "samples"),
    ("batch",),
    ("studio",),
    ("cli",),
    ("__main__",),
)
# Rooms that know arrays only: no Motion, no Skeleton, no steps.
ARRAYS_ONLY = ("rotations", "signal")
# A notebook asks the object itself for its picture, so these look up, when asked, by the front door.
DISPLAY = {("motion", ""), ("emotion.reading", ""), ("analysis.laban", "")}
# Files of edits/ that are not an edit themselves; every edit may import these and no other.
SHARED = ("__init__", "keyed", "order", "parameters", "pipeline", "registry")
LEVEL = {room: number for number, line in enumerate(LAYERS) for room in line}


def modules(source: Path = SOURCE) -> dict[str, Path]:
    """Dotted name below mien -> file; a package is named without ``__init__``."""
    found = {}
    for file in sorted(source.rglob("*.py")):
        parts = list(file.relative_to(source).with_suffix("").parts)
        if parts[-1] == "__init__":
            parts.pop()
        found[".".join(parts)] = file
    return found


def imports(name: str, file: Path, known: dict[str, Path]) -> Iterator[tuple[str, int]]:
    """Yield (dotted name of a module of mien, line) for every import, wherever it stands in the file."""
    package = name.split(".") if file.stem == "__init__" else name.split(".")[:-1]
    package = [p for p in package if p]
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            bases = [n.name.split(".")[1:] for n in node.names if n.name.split(".")[0] == "mien"]
            targets = [(base, None) for base in bases]
        elif isinstance(node, ast.ImportFrom) and (node.level or (node.module or "").split(".")[0] == "mien"):
            words = (node.module or "").split(".") if node.module else []
            base = package[: len(package) - node.level + 1] + words if node.level else words[1:]
            targets = [(base, n.name) for n in node.names]
        else:
            continue
        for base, last in targets:
            inner = ".".join([*base, last]) if last else ".".join(base)
            yield (inner if inner in known else ".".join(base)), node.lineno


def import_map(source: Path = SOURCE) -> list[tuple[str, str, str]]:
    """Return (importer, imported, place) for all modules of mien except its front door."""
    known = modules(source)
    return [
        (name, target, f"{file.relative_to(source.parent)}:{line}")
        for name, file in known.items()
        if name  # mien/__init__.py names the public objects and imports them when they are asked for
        for target, line in imports(name, file, known)
    ]


def room(name: str) -> str:
    return name.split(".")[0]


def layer_faults(pairs: list[tuple[str, str, str]]) -> list[str]:
    """Return one sentence with the repair for every import that goes against LAYERS."""
    faults = []
    for here, there, place in pairs:
        a, b = room(here), room(there)
        if a == b or (here, there) in DISPLAY:
            continue
        if b == "":
            faults.append(f"{place}: imports the front door `mien`; import from the module that has the name")
        elif b in ("cli", "__main__") and a != "__main__":
            faults.append(f"{place}: nothing imports the command line; move what is needed down a layer")
        elif a in ARRAYS_ONLY and b in ("motion", "recipe"):
            faults.append(f"{place}: {a} knows arrays only; pass the arrays, or move this to kinematics")
        elif LEVEL[b] == LEVEL[a]:
            faults.append(
                f"{place}: {a} and {b} are neighbours and never import each other; "
                f"move what both need to {' or '.join(LAYERS[LEVEL[a] - 1])}"
            )
        elif LEVEL[b] > LEVEL[a]:
            faults.append(
                f"{place}: {a} stands below {b}; move the shared part down, or the caller up to {b} or above"
            )
    return faults


def cycle(pairs: list[tuple[str, str, str]]) -> list[str]:
    """Return the modules of one import cycle, or nothing."""
    edges: dict[str, set[str]] = {}
    for here, there, _ in pairs:
        if here != there:
            edges.setdefault(here, set()).add(there)
    done: set[str] = set()

    def visit(name: str, path: list[str]) -> list[str]:
        if name in path:
            return [*path[path.index(name) :], name]
        if name in done:
            return []
        for next_ in sorted(edges.get(name, ())):
            if found := visit(next_, [*path, name]):
                return found
        done.add(name)
        return []

    for name in sorted(edges):
        if found := visit(name, []):
            return found
    return []


def edit_faults(pairs: list[tuple[str, str, str]]) -> list[str]:
    """Return one sentence for every import of one edit by another."""
    return [
        f"{place}: an edit never imports another edit; put what both need into kinematics or signal"
        for here, there, place in pairs
        if room(here) == "edits" == room(there)
        and here.split(".")[1:2] not in ([], *([s] for s in SHARED))
        and there.split(".")[1:2] not in (here.split(".")[1:2], *([s] for s in SHARED))
    ]


def test_every_room_has_its_place() -> None:
    rooms = {room(name) for name in modules() if name}
    assert rooms <= set(LEVEL), (
        f"{sorted(rooms - set(LEVEL))} stand in no layer: add them to LAYERS in {Path(__file__).name}, "
        "above what they import and below what imports them, and say so in the commit"
    )


def test_imports_follow_the_layers() -> None:
    faults = layer_faults(import_map())
    assert not faults, "\n".join(faults)


def test_no_module_imports_itself_through_others() -> None:
    found = cycle(import_map())
    assert not found, f"import cycle {' -> '.join(found)}: move what they share into a module below both"


def test_no_edit_imports_another_edit() -> None:
    faults = edit_faults(import_map())
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize(
    ("files", "fault"),
    [
        ({"edits/sad.py": "from ..formats import load"}, "neighbours"),
        ({"edits/sad.py": "def f():\n    from ..formats import load"}, "neighbours"),
        ({"rotations/q.py": "from ..motion import Motion"}, "arrays only"),
        ({"kinematics/fk.py": "from .. import edits"}, "stands below"),
        ({"kinematics/fk.py": "import mien.edits.sad"}, "stands below"),
        ({"kinematics/fk.py": "from mien.edits import sad"}, "stands below"),
        ({"render/strip.py": "from ..cli import main"}, "nothing imports the command line"),
        ({"render/strip.py": "from .. import load"}, "front door"),
        ({"edits/sad.py": "from .tired import tired"}, "another edit"),
        ({"edits/sad.py": "from . import tired"}, "another edit"),
        ({"kinematics/ik.py": "from .fk import fk", "kinematics/fk.py": "from .ik import ik"}, "cycle"),
    ],
)
def test_a_wrong_import_is_found(tmp_path: Path, files: dict[str, str], fault: str) -> None:
    """The rules above would catch each of these."""
    source = tmp_path / "mien"
    for path in ("", "formats/", "edits/", "rotations/", "kinematics/", "render/", "cli/"):
        (source / path).mkdir(exist_ok=True)
        (source / path / "__init__.py").touch()
    for path in ("edits/sad.py", "edits/tired.py", "edits/registry.py", "motion.py", "kinematics/fk.py"):
        (source / path).touch()
    (source / "edits/tired.py").write_text("from .registry import edit\nfrom ..motion import Motion\n")
    assert not [
        *layer_faults(import_map(source)),
        *edit_faults(import_map(source)),
        *cycle(import_map(source)),
    ]
    for path, text in files.items():
        (source / path).write_text(text)
    pairs = import_map(source)
    ring = cycle(pairs)
    found = [*layer_faults(pairs), *edit_faults(pairs), *(["cycle"] if ring else [])]
    assert any(fault in f for f in found), found


def loaded_after(statement: str) -> set[str]:
    """Return the top-level packages that a fresh Python has loaded after a statement."""
    code = f"{statement}\nimport sys\nprint(*sorted({{m.split('.')[0] for m in sys.modules}}))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def test_importing_mien_loads_nothing_heavy() -> None:
    heavy = {"numpy", "scipy", "typer", "rich", "PIL", "av", "torch"}
    assert not loaded_after("import mien") & heavy, "import the public name lazily, as mien/__init__.py does"


def test_importing_every_module_loads_neither_torch_nor_an_extra() -> None:
    names = [f"mien.{name}" for name in modules() if name and name != "__main__"]
    loaded = loaded_after(f"import importlib\nfor name in {names!r}: importlib.import_module(name)")
    unwanted = loaded & {"torch", "av", "matplotlib", "pandas", "pytest", "hypothesis"}
    assert not unwanted, f"{sorted(unwanted)}: import inside the one function that needs it"
