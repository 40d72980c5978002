"""Documents say what the code does: METHODS.md and its pages, the list of public names, the presets."""

import importlib
import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

import mien
from mien import samples
from mien.edits.pipeline import apply
from mien.edits.registry import EDITS
from mien.recipe import Step

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
# Packages whose __all__ is the public interface, and those whose modules are namespaces of functions.
INTERFACES = ("mien", "mien.render", "mien.samples")
NAMESPACES = ("rotations", "signal", "kinematics", "edits", "analysis", "emotion", "styles")


@pytest.fixture(scope="module")
def generator(script: Callable[[str], ModuleType]) -> ModuleType:
    """The script that writes the generated documents."""
    return script("methods")


def text(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def test_generated_documents_are_current(generator: ModuleType) -> None:
    stale = generator.stale()
    assert not stale, f"{', '.join(stale)} out of date: run `{generator.COMMAND}` and commit what it wrote"


@pytest.mark.parametrize("name", sorted(EDITS))
def test_the_example_of_an_edit_can_be_done(generator: ModuleType, name: str) -> None:
    parameters = generator.example(EDITS[name])
    done = apply(samples.walk(seconds=1.0, fps=30.0).motion, [Step(name, parameters)])
    assert done.history[-1].edit == name
    assert done.history[-1].parameters.items() >= parameters.items()


@pytest.mark.parametrize("name", sorted(EDITS))
def test_every_edit_has_a_page_that_a_person_wrote(name: str) -> None:
    file = DOCS / "methods" / f"{name}.md"
    assert file.is_file(), f"write {file.relative_to(ROOT)}, then run `python scripts/methods.py`"
    page = file.read_text(encoding="utf-8")
    for part in (
        "**To the motion.**",
        "**To the viewer.**",
        "## When to use it",
        f"_static/methods/{name}.png",
    ):
        assert part in page, f"{file.relative_to(ROOT)} lacks {part!r}"


def test_every_page_is_of_an_edit() -> None:
    pages = {p.stem for p in (DOCS / "methods").glob("*.md")}
    assert pages - {"index"} == set(EDITS), "a page without its edit, or an edit without its page"


def documented() -> list[str]:
    """Return the dotted names that the reference pages describe."""
    pages = "".join(page.read_text(encoding="utf-8") for page in (DOCS / "api").glob("*.md"))
    return re.findall(r"\.\. auto\w+:: (mien[\w.]*)", pages)


def public() -> set[str]:
    """Return the dotted names that are public: by ``__all__``, or as a module of a namespace."""
    names = set()
    for package in INTERFACES:
        names |= {f"{package}.{name}" for name in importlib.import_module(package).__all__}
    for package in NAMESPACES:
        folder = ROOT / "src" / "mien" / package
        stems = {p.stem for p in folder.glob("*.py")} | {p.parent.name for p in folder.glob("*/__init__.py")}
        names |= {f"mien.{package}.{stem}" for stem in stems if not stem.startswith("_")}
        inner = [p for p in folder.glob("*/*.py") if not p.stem.startswith("_")]
        names |= {f"mien.{package}.{p.parent.name}.{p.stem}" for p in inner}
    return names - {"mien.__version__", "mien.render", "mien.samples"}


def test_every_public_name_is_in_the_reference_and_the_other_way_round() -> None:
    described = set(documented())
    missing, gone = sorted(public() - described), sorted(described - public())
    assert not missing, f"add these to a page in docs/api: {missing}"
    assert not gone, f"these are in docs/api but not public any more: {gone}"


def test_no_name_is_described_twice() -> None:
    twice = sorted(name for name in set(documented()) if documented().count(name) > 1)
    assert not twice, f"leave one description of each in docs/api: {twice}"


@pytest.mark.parametrize("package", INTERFACES)
def test_all_resolves(package: str) -> None:
    module = importlib.import_module(package)
    assert len(set(module.__all__)) == len(module.__all__)
    for name in module.__all__:
        assert getattr(module, name) is not None


@pytest.mark.parametrize("file", ["README.md", "docs/presets.md"])
def test_every_emotion_word_is_listed(file: str) -> None:
    words = {name for name in mien.PRESETS if "/" not in name}
    missing = sorted(w for w in words if f"`{w}`" not in text(file))
    assert not missing, f"add {missing} to {file}"


def test_the_readme_picture_is_small_and_made_by_a_script() -> None:
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text("README.md"))
    assert len(pictures) == 1
    assert (ROOT / pictures[0]).stat().st_size < 300_000
    assert Path(pictures[0]).name in "".join(
        p.read_text(encoding="utf-8") for p in (ROOT / "scripts").glob("*.py")
    )


def test_the_pictures_of_the_studio_are_small_and_made_by_a_script() -> None:
    named = {Path(name).stem for name in re.findall(r"!\[[^\]]+\]\((studio/[^)]+)\)", text("docs/studio.md"))}
    made = re.findall(r'^    "(\w+)": \(', text("scripts/studio_pictures.py"), re.MULTILINE)
    there = list((DOCS / "studio").glob("*.png"))
    assert named == set(made) == {path.stem for path in there}
    assert sum(path.stat().st_size for path in there) < 1_000_000


def test_the_keys_of_the_studio_are_current() -> None:
    spec = importlib.util.spec_from_file_location("studio_keys", ROOT / "scripts" / "studio_keys.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    assert script.written() == text("docs/studio.md"), "run `python scripts/studio_keys.py`"
    assert script.table().count("\n") > 40


def test_links_between_documents_lead_somewhere() -> None:
    pages = [*ROOT.glob("*.md"), *DOCS.rglob("*.md")]
    dead = [
        f"{page.relative_to(ROOT)} -> {link}"
        for page in pages
        for link in re.findall(r"\]\((?!https?:|#|mailto:)([^)#\s]+)", page.read_text(encoding="utf-8"))
        if "_static" not in link and not (page.parent / link).exists()
    ]
    assert not dead, f"links that lead nowhere: {dead}"


def test_the_version_is_the_same_everywhere() -> None:
    version = re.search(r'^version = "(.+)"', text("pyproject.toml"), re.MULTILINE).group(1)
    assert f"\nversion: {version}\n" in text("CITATION.cff")
    assert f"## [{version}]" in text("CHANGELOG.md") or "## [Unreleased]" in text("CHANGELOG.md")
