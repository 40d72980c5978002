"""The viewer in a notebook: an anywidget that holds one motion, or two, and needs no server."""

from functools import cache
from typing import Any

from ..errors import MienError
from ..motion import Motion, require_motion
from ..render.figure import Figure
from ..render.page import built, likeness
from ..render.wire import encode


def show(motion: Motion, *, against: Motion | None = None, height: int = 480, low: bool = False) -> Any:
    """Return a view of a motion for a notebook, to turn, play and step through.

    ``against`` is its original, shown as a ghost, beside it or wiped over; ``height`` is in pixels; ``low``
    draws without shadows, for machines without a graphics card. Needs ``pip install 'mien[notebook]'``.
    Raises ``MienError`` without it, and where the front end was not built.
    """
    motion = require_motion(motion)
    kind = _widget()
    other = Figure.of(against) if against else None
    return kind(
        edited=encode(motion, motion.name, like=likeness(motion, other)),
        original=encode(against, against.name) if against else b"",
        height=height,
        quality="low" if low else "high",
    )


@cache
def _widget() -> Any:
    """Return the class of the widget; made when first asked for, because anywidget is an extra."""
    try:
        import anywidget
        import traitlets
    except ImportError:
        raise MienError("a view in a notebook needs anywidget: pip install 'mien[notebook]'") from None

    class Show(anywidget.AnyWidget):
        """A motion, and what it was made from, as the page gets them."""

        _esm = built("widget.js")
        original = traitlets.Bytes(b"").tag(sync=True)
        edited = traitlets.Bytes(b"").tag(sync=True)
        height = traitlets.Int(480).tag(sync=True)
        quality = traitlets.Unicode("high").tag(sync=True)

    return Show
