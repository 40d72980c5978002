"""How the documentation is built: ``python -m sphinx docs docs/_build``.

The pictures are made by the program while building (pictures.py), so they always show what it does.
"""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

project = "mien"
author = "The mien developers"
copyright = "2026, the mien developers"
version = release = version_of("mien")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.viewcode"]
myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 3
suppress_warnings = ["myst.xref_missing"]  # links to source files lead out of the documentation
exclude_patterns = ["_build"]
nitpicky = False

autodoc_typehints = "description"
autodoc_member_order = "bysource"

html_theme = "furo"
html_title = f"mien {version}"
html_static_path = ["_static"]


def without_builtin_text(
    app: object, what: str, name: str, obj: object, options: object, lines: list
) -> None:
    """Drop what Python says of every dict and tuple; the page says what this one holds."""
    if what == "data":
        lines.clear()


def setup(app: object) -> None:
    """Make the pictures before the pages that show them."""
    from pictures import make_all

    app.connect("autodoc-process-docstring", without_builtin_text)
    make_all(HERE / "_static")
