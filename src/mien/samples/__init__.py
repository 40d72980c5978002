"""Synthetic clips written by us, with known truth: contacts, phases, joint angles, events.

``SAMPLES`` maps each name to its function; all take ``seconds`` and the form: ``fps`` (default 60),
``skeleton`` (one of ``SKELETONS``, default "standard22"), ``unit`` ("m", "dm", "cm", "mm", "inch",
"foot"; default "cm"), ``up`` ("y" or "z"), ``heading`` (radians to the left about up). The same
continuous motion is sampled whatever the frame rate.
"""

from collections.abc import Callable, Mapping

from .dancing import dance
from .fixtures import pendulum, spin
from .gait import tired_walk, turn, walk
from .gestures import knock, punch, still, wave
from .jumping import jump
from .sample import Sample
from .skeletons import RIGS

__all__ = [
    "SAMPLES",
    "SKELETONS",
    "Sample",
    "dance",
    "jump",
    "knock",
    "pendulum",
    "punch",
    "spin",
    "still",
    "tired_walk",
    "turn",
    "walk",
    "wave",
]

SAMPLES: Mapping[str, Callable[..., Sample]] = {
    f.__name__: f for f in (walk, tired_walk, turn, still, knock, wave, punch, jump, dance, pendulum, spin)
}
SKELETONS = tuple(RIGS)
