"""Synthetic clips written by us, with known truth: contacts, phases, joint angles, events."""

from collections.abc import Callable, Mapping

from .gait import tired_walk, turn, walk
from .sample import Sample
from .skeletons import RIGS

__all__ = ["SAMPLES", "SKELETONS", "Sample", "tired_walk", "turn", "walk"]

SAMPLES: Mapping[str, Callable[..., Sample]] = {f.__name__: f for f in (walk, tired_walk, turn)}
SKELETONS = tuple(RIGS)
