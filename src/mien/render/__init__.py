"""Pictures and films of motion: a mannequin seen from any side, without a graphics card."""

from .animate import animate
from .disc import Dot, disc, disc_page
from .notebook import features_html, reading_html, strip_html
from .strip import compare, strip

__all__ = [
    "Dot",
    "animate",
    "compare",
    "disc",
    "disc_page",
    "features_html",
    "reading_html",
    "strip",
    "strip_html",
]
