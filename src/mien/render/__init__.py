"""Pictures and films of motion: a mannequin seen from any side, without a graphics card."""

from .animate import animate
from .notebook import strip_html
from .strip import compare, strip

__all__ = ["animate", "compare", "strip", "strip_html"]
