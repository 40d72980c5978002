"""A page (HTML) that plays motions in any browser: one file that holds them and its viewer, and asks no server."""

import json
from base64 import b64encode
from functools import cache
from html import escape
from importlib.resources import files

from ..errors import MienError
from ..motion import Motion
from .figure import Figure
from .wire import encode

PLACE = '<script type="application/json" id="mien-clips">[]</script>'
TITLE = "<title>mien</title>"
BUILD = "npm ci && npm run build"


def page(motion: Motion, *, against: Motion | None = None, title: str = "") -> str:
    """Return a page that shows ``motion``, and ``against``, its original, as a ghost, beside it or wiped over.

    The page needs no network and may be opened from the disk. Raises ``MienError`` where the viewer was not
    built, as in a source tree without its front end.
    """
    text = _viewer()
    other = Figure.of(against) if against else None
    clips = [("edited", motion, encode(motion, motion.name, like=_like(motion, other)))]
    if against:
        clips.insert(0, ("original", against, encode(against, against.name)))
    enclosed = [
        {"role": role, "name": one.name, "data": b64encode(data).decode("ascii")} for role, one, data in clips
    ]
    inside = json.dumps(enclosed).replace("<", "\\u003c")  # no text may end the script
    named = f"<title>{escape(title or motion.name or 'mien')}</title>"
    return text.replace(PLACE, PLACE.replace("[]", inside)).replace(TITLE, named)


def _like(motion: Motion, other: Figure | None) -> Figure | None:
    """Return the figure whose body and floor a motion shares: that of the motion it was made from."""
    return other if other and Figure.of(motion).made_from(other) else None


@cache
def _viewer() -> str:
    """Return the built page, without clips."""
    file = files("mien").joinpath("studio", "static", "viewer.html")
    if not file.is_file():
        raise MienError(
            f"the viewer was not built: run `{BUILD}` in the folder frontend of mien's source (needs Node.js "
            "20 or newer); packages of mien that are published have it inside"
        )
    text = file.read_text(encoding="utf-8")
    if PLACE not in text or TITLE not in text:
        raise MienError(f"the viewer in {file} is of another version: build it again with `{BUILD}`")
    return text
