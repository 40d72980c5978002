"""Pictures and films of motion: a mannequin seen from any side, without a graphics card."""

from .strip import compare, strip

__all__ = ["compare", "strip"]
