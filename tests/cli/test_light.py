"""What a start of the program imports: each module here costs a user time at every call."""

import subprocess
import sys

import pytest

import mien

SHOW = "import sys; print(' '.join(m for m in sys.modules if '.' not in m))"


def modules(code: str) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\n{SHOW}"], capture_output=True, text=True, check=True
    )
    return set(done.stdout.splitlines()[-1].split())


def test_import_mien_imports_no_array_library() -> None:
    assert not modules("import mien") & {"numpy", "scipy", "typer", "rich", "PIL"}


@pytest.mark.parametrize("arguments", [["--help"], ["edit", "--help"], ["--version"]])
def test_help_imports_no_scipy_and_no_pictures(arguments: list[str]) -> None:
    quiet = "import contextlib\nfrom mien.cli.app import app\nwith contextlib.suppress(SystemExit):\n"
    code = f"{quiet}  app({arguments})"
    found = modules(code)
    assert not found & {"scipy", "PIL", "av"}
    if arguments != ["edit", "--help"]:
        assert "numpy" not in found


def test_every_public_name_is_there() -> None:
    for name in mien.__all__:
        assert getattr(mien, name) is not None
    assert set(mien.__all__) <= set(dir(mien))
    assert not hasattr(mien, "no_such_name")


def test_type_checkers_see_the_same_names() -> None:
    import ast
    from pathlib import Path

    tree = ast.parse(Path(mien.__file__).read_text(encoding="utf-8"))
    block = next(n for n in tree.body if isinstance(n, ast.If))
    seen = {alias.asname for n in block.body if isinstance(n, ast.ImportFrom) for alias in n.names}
    assert {*seen, "__version__"} == set(mien.__all__)
