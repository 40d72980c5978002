"""A page (HTML) that plays motions in any browser: one file with them and their viewer, and no server."""

import json
from base64 import b64encode
from functools import cache
from html import escape
from pathlib import Path

from ..errors import MienError
from ..motion import Motion
from .figure import Figure
from .wire import encode

PLACE = '<script type="application/json" id="mien-clips">[]</script>'
TITLE = "<title>mien</title>"
BUILD = "npm ci && npm run build"


def page(motion: Motion, *, against: Motion | None = None, title: str = "") -> str:
    """Return a page that plays ``motion``, and ``against``, its original: as a ghost, beside, or by a wipe.

    The page needs no network and may be opened from the disk. Raises ``MienError`` where the viewer was not
    built, as in a source tree without its front end.
    """
    text = _viewer()
    other = Figure.of(against) if against else None
    clips = [_enclosed("original", against, encode(against, against.name))] if against else []
    clips.append(_enclosed("edited", motion, encode(motion, motion.name, like=likeness(motion, other))))
    inside = json.dumps(clips).replace("<", "\\u003c")  # no text may end the script
    named = f"<title>{escape(title or motion.name or 'mien')}</title>"
    return text.replace(PLACE, PLACE.replace("[]", inside)).replace(TITLE, named)


def likeness(motion: Motion, other: Figure | None) -> Figure | None:
    """Return the figure whose body and floor a motion shares: that of the motion it was made from."""
    return other if other and Figure.of(motion).made_from(other) else None


def _enclosed(role: str, motion: Motion, data: bytes) -> dict[str, str]:
    return {"role": role, "name": motion.name, "data": b64encode(data).decode("ascii")}


@cache
def _viewer() -> str:
    """Return the built page, without clips."""
    file = built("viewer.html")
    text = file.read_text(encoding="utf-8")
    if PLACE not in text or TITLE not in text:
        raise MienError(f"the viewer in {file} is of another version: build it again with `{BUILD}`")
    return text


def built(name: str) -> Path:
    """Return a file of the built front end; raises ``MienError`` that says how to build it."""
    file = Path(__file__).resolve().parents[1] / "studio" / "static" / name
    if not file.is_file():
        raise MienError(
            f"{name} was not built: run `{BUILD}` in the folder frontend of mien's source (needs Node.js 20 "
            "or newer); published packages of mien have it inside"
        )
    return file
