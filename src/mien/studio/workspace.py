"""Where the studio keeps what is open, so that a reload or a restart finds it again: a folder of its own.

``clips/HASH.bvh`` are the files as they came in, ``clips.json`` says which are open and what they are called,
``roles.json`` has the roles of joints that a person named, ``project.json`` is the last state of the page,
``token`` is what the page shows to be let in.
"""

import json
import os
import re
import secrets
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..errors import BodyError, FormatError
from ..formats import files
from ..kinematics.roles import known_roles

HASH = re.compile(r"[0-9a-f]{64}")
LONGEST_NAME = 120


@dataclass(frozen=True)
class Workspace:
    """A folder that the studio may write to."""

    folder: Path

    def token(self) -> str:
        """Return the secret that pages show; made the first time, readable by this user only."""
        path = self.folder / "token"
        try:
            found = path.read_text(encoding="ascii").strip()
            if len(found) >= 32:
                return found
        except (OSError, UnicodeDecodeError):
            pass
        made = secrets.token_urlsafe(32)
        self._make(self.folder)
        files.write(path, made.encode())
        path.chmod(0o600)
        return made

    def keep(self, name: str, data: bytes) -> str:
        """Keep the bytes of a clip and open it under a name; returns its id, the SHA-256 of the bytes."""
        identity = sha256(data).hexdigest()
        self._make(self.folder / "clips")
        path = self.path(identity)
        if not path.exists():
            files.write(path, data)
        self._write("clips.json", {**self.names(), identity: plain_name(name)})
        return identity

    def forget(self, identity: str) -> None:
        """Close a clip and remove its bytes."""
        names = self.names()
        if names.pop(identity, None) is not None:
            self._write("clips.json", names)
            self.path(identity).unlink(missing_ok=True)

    def path(self, identity: str) -> Path:
        """Return the file of a clip; raises ``FormatError`` for what is no id."""
        if not HASH.fullmatch(identity):
            raise FormatError(f"{identity:.80} is no clip of this studio")
        return self.folder / "clips" / f"{identity}.bvh"

    def names(self) -> dict[str, str]:
        """Return id -> name of the clips that are open and whose bytes are there."""
        found = self._read("clips.json")
        names = found if isinstance(found, dict) else {}
        return {
            identity: plain_name(str(name))
            for identity, name in names.items()
            if HASH.fullmatch(identity) and self.path(identity).is_file()
        }

    def roles(self, identity: str) -> dict[str, str]:
        """Return which joint of a clip plays which role, as somebody said; empty where nobody did."""
        found = self._read("roles.json")
        try:
            return known_roles(found.get(identity, {}) if isinstance(found, dict) else {}, "roles")
        except BodyError:
            return {}  # not ours

    def keep_roles(self, identity: str, roles: Mapping[str, str]) -> None:
        """Keep the roles of a clip's joints; they stay when it is closed, for when it comes back."""
        self.path(identity)
        found = self._read("roles.json")
        others = {k: v for k, v in found.items() if k != identity} if isinstance(found, dict) else {}
        self._write("roles.json", others | ({identity: dict(roles)} if roles else {}))

    def project(self) -> Any:
        """Return the last state of the page as plain data, or None."""
        return self._read("project.json")

    def keep_project(self, project: Any) -> None:
        """Keep the state of the page."""
        self._write("project.json", project)

    def _read(self, name: str) -> Any:
        try:
            return json.loads((self.folder / name).read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            return None  # nothing there yet, or not ours: the page begins anew

    def _write(self, name: str, data: Any) -> None:
        self._make(self.folder)
        files.write(self.folder / name, json.dumps(data, ensure_ascii=False).encode())

    def _make(self, folder: Path) -> None:
        try:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        except OSError as error:
            raise FormatError(f"{folder}: cannot be made ({error.strerror or error})") from None


def usual_folder() -> Path:
    """Return where the studio keeps things unless told otherwise: ``MIEN_STUDIO``, or this user's data."""
    from platformdirs import user_data_path

    own = os.environ.get("MIEN_STUDIO")
    return Path(own) if own else user_data_path("mien", appauthor=False) / "studio"


def plain_name(name: str) -> str:
    """Return the last part of a file name without what no file name should have; never a path."""
    last = re.split(r"[/\\]", name)[-1]
    kept = "".join(sign for sign in last if sign.isprintable() and sign not in '<>:"|?*').strip(". ")
    stem, dot, suffix = kept.rpartition(".")
    known = dot and suffix.lower() == "bvh" and stem
    return f"{(stem if known else kept)[:LONGEST_NAME] or 'clip'}.bvh"
