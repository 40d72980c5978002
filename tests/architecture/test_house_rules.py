"""Rules of the house that a machine can check: sizes, signatures, errors, texts."""

import ast
import re
import statistics
import tokenize
from collections.abc import Iterator
from io import StringIO
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "mien"
FILES = sorted(SOURCE.rglob("*.py"))
LONGEST_FILE = 450
LONGEST_FUNCTION = 60
# What may be raised: mien's own kinds, and what Python or the command line's library ask for.
RAISED = {"MienError", "FormatError", "BodyError", "RecipeError"}
RAISED_WHERE = {
    "edits/parameters.py": {"TypeError"},  # a wrongly written edit, found when it is imported
    "__init__.py": {"AttributeError"},  # what a module's __getattr__ must raise
    "studio/session.py": {"SupersededError"},  # what tells the page that its newer request counts
    "studio/work.py": {"StoppedError"},  # what ends a work that nobody waits for
    "cli/": {"Exit", "BadParameter", "UsageError", "SystemExit", "Abort"},
}

Function = ast.FunctionDef | ast.AsyncFunctionDef


def name_of(file: Path) -> str:
    return file.relative_to(SOURCE).as_posix()


def functions(file: Path) -> Iterator[tuple[str, Function]]:
    """Yield (place, function) for every function of a file, methods and inner ones too."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, Function):
            yield f"{name_of(file)}:{node.lineno} {node.name}", node


def public(file: Path) -> Iterator[tuple[str, Function]]:
    """Yield (place, function) for the public functions of a module and methods of its public classes."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    owners = [tree, *(n for n in tree.body if isinstance(n, ast.ClassDef) and not n.name.startswith("_"))]
    for owner in owners:
        for node in owner.body:
            if isinstance(node, Function) and not node.name.startswith("_"):
                yield f"{name_of(file)}:{node.lineno} {node.name}", node


def code_lines(file: Path) -> set[int]:
    """Return the numbers of the lines that hold code: no comments, blank lines or docstrings."""
    text = file.read_text(encoding="utf-8")
    skip = {
        tokenize.COMMENT,
        tokenize.NL,
        tokenize.NEWLINE,
        tokenize.INDENT,
        tokenize.DEDENT,
        tokenize.ENDMARKER,
    }
    lines: set[int] = set()
    for token in tokenize.generate_tokens(StringIO(text).readline):
        if token.type not in skip:
            lines |= set(range(token.start[0], token.end[0] + 1))
    for node in ast.walk(ast.parse(text)):
        if (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and isinstance(node.value.value, str)
        ):
            lines -= set(range(node.lineno, node.end_lineno + 1))
    return lines


@pytest.fixture(scope="module")
def sizes() -> dict[str, int]:
    """Code lines of every function."""
    out = {}
    for file in FILES:
        lines = code_lines(file)
        for place, node in functions(file):
            out[place] = len(lines & set(range(node.lineno, node.end_lineno + 1)))
    return out


def test_files_are_short() -> None:
    long = {
        name_of(f): n for f in FILES if (n := len(f.read_text(encoding="utf-8").splitlines())) > LONGEST_FILE
    }
    assert not long, f"more than {LONGEST_FILE} lines; move one idea into its own file: {long}"


def test_functions_are_short(sizes: dict[str, int]) -> None:
    long = {place: n for place, n in sizes.items() if n > LONGEST_FUNCTION}
    assert not long, f"more than {LONGEST_FUNCTION} code lines; name its parts as functions: {long}"


def test_most_functions_are_very_short(sizes: dict[str, int]) -> None:
    counts = sorted(sizes.values())
    longest = sorted(sizes, key=sizes.__getitem__)[-10:]
    assert statistics.median(counts) <= 8, (
        f"half of all functions should have at most 8 code lines: {longest}"
    )
    assert counts[int(0.95 * len(counts))] <= 35, f"95 of 100 should have at most 35 code lines: {longest}"


def test_every_module_and_public_function_says_what_it_does() -> None:
    silent = [name_of(f) for f in FILES if not ast.get_docstring(ast.parse(f.read_text(encoding="utf-8")))]
    silent += [place for f in FILES for place, node in public(f) if not ast.get_docstring(node)]
    assert not silent, f"no docstring: write one sentence, then shapes, units, range and errors: {silent}"


def test_options_are_keyword_only() -> None:
    """What has a default is an option; ``save(motion, path, True)`` says nothing to a reader."""
    loose = [
        f"{place}({node.args.args[-1].arg})"
        for f in FILES
        if not name_of(f).startswith("cli/")  # there the signature is made for the command line
        for place, node in public(f)
        if node.args.defaults
    ]
    assert not loose, f"put a bare * before the first parameter that has a default: {loose}"


def makers() -> set[str]:
    """Names of functions that say, in their return annotation, that they make one of mien's errors."""
    return {
        node.name
        for file in FILES
        for _, node in functions(file)
        if isinstance(node.returns, ast.Name) and node.returns.id in RAISED
    }


def raised(file: Path) -> Iterator[tuple[str, str]]:
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            function = node.exc.func
            name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "?")
            yield f"{name_of(file)}:{node.lineno} {name}", name


def test_only_mien_errors_are_raised() -> None:
    wrong, allowed = [], RAISED | makers()
    for file in FILES:
        extra = {n for where, names in RAISED_WHERE.items() if name_of(file).startswith(where) for n in names}
        wrong += [place for place, name in raised(file) if name not in allowed | extra]
    assert not wrong, f"raise MienError or one of its kinds, saying what, where and what to do: {wrong}"


def test_nothing_is_asserted_in_the_library() -> None:
    found = [
        f"{name_of(f)}:{node.lineno}"
        for f in FILES
        for node in ast.walk(ast.parse(f.read_text(encoding="utf-8")))
        if isinstance(node, ast.Assert)
    ]
    assert not found, f"python -O removes asserts: raise a MienError instead: {found}"


def texts() -> Iterator[Path]:
    """Yield every text file of the project, of whatever kind."""
    kinds = {".py", ".md", ".toml", ".cff", ".sh", ".yml", ".yaml", ".json", ".txt", ""}
    skip = {".git", ".venv", "dist", "build", "_build", "_static", "__pycache__", "node_modules"}
    for path in sorted(ROOT.rglob("*")):
        parts = path.relative_to(ROOT).parts
        hidden = any(p in skip or (p.startswith(".") and p != ".ci") or p.endswith("_cache") for p in parts)
        if path.is_file() and path.suffix in kinds and not hidden:
            yield path


# Written so that this file does not find itself.
FORBIDDEN = {
    r"\b(TO" + r"DO|FIX" + r"ME|XX" + r"X)\b": "do it now, or write it into an issue",
    r"NotImplemented" + r"Error": "leave out what is not there yet",
    r"(?<![\w.])/(wo" + r"rk|ro" + r"ot|home/\w+|Users/\w+|t" + r"mp)(/|\b)": "no path of one machine",
    r"METHODS " + r"[A-Z]\d": "METHODS.md has no such section: name the paper, or say it in words",
    r"breakpoint\(\)|pdb\.set_" + r"trace": "left over from a search for a bug",
}


@pytest.mark.parametrize(
    "pattern", FORBIDDEN, ids=["unfinished", "not there", "machine path", "dead reference", "debugger"]
)
def test_nothing_of_the_workshop_is_left_lying_about(pattern: str) -> None:
    found = []
    for file in texts():
        for number, line in enumerate(file.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
            if re.search(pattern, line):
                found.append(f"{file.relative_to(ROOT)}:{number}: {line.strip()[:80]}")
    assert not found, f"{FORBIDDEN[pattern]}:\n" + "\n".join(found)
