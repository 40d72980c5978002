"""Pictures and films of motion without a graphics card, and pages that play it in a browser."""

from .animate import animate
from .disc import Dot, disc, disc_page
from .notebook import features_html, reading_html, strip_html
from .page import page
from .strip import compare, strip

__all__ = [
    "Dot",
    "animate",
    "compare",
    "disc",
    "disc_page",
    "features_html",
    "page",
    "reading_html",
    "strip",
    "strip_html",
]
