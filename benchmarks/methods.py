"""What is judged by ``effect.py``: the methods that make a style out of a neutral clip.

A new method is one line in ``METHODS``.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import crude
import learned
from acted import STYLES, Take

import mien
from mien.emotion import search
from mien.emotion.presets import PRESETS, preset

Edit = Callable[[mien.Motion, str], mien.Motion]
Pairs = Sequence[tuple[Take, Take]]

# Style of the actors -> presets that plainly mean the same; the first that exists is judged.
WORDS: Mapping[str, tuple[str, ...]] = {
    "active": ("active", "excited"),
    "angry": ("angry",),
    "childish": ("childish",),
    "chimpira": ("chimpira", "swaggering"),
    "feminine": ("feminine",),
    "giant": ("giant",),
    "happy": ("happy",),
    "masculinity": ("masculine",),
    "musical": ("musical",),
    "not-confident": ("not-confident", "timid"),
    "old": ("old",),
    "proud": ("proud",),
    "sad": ("sad",),
    "tired": ("tired",),
}
# Presets that only come near to a style: judged with ``--near``, never counted.
NEAR: Mapping[str, tuple[str, ...]] = {
    "not-confident": ("weak", "afraid", "nervous"),
    "proud": ("confident",),
    "masculinity": ("strong",),
    "active": ("happy",),
}


@dataclass(frozen=True)
class Method:
    """One way to edit.

    ``words`` style -> what to ask for, of the styles it can do; ``edit`` (motion, word) -> motion. One that
    learns has ``learn`` instead: from (acted take, neutral take) pairs to its ``edit``; it then never sees
    contents that its recogniser learns from.
    """

    words: Mapping[str, str]
    edit: Edit | None = None
    learn: Callable[[Pairs], Edit] | None = None
    near: Mapping[str, tuple[str, ...]] | None = None

    def asks(self, *, near: bool) -> list[tuple[str, str]]:
        """Return (style, word) for everything to be judged."""
        more = self.near if near and self.near else {}
        return list(self.words.items()) + [(style, word) for style in more for word in more[style]]


def bare(motion: mien.Motion, word: str) -> mien.Motion:
    """Return an edit that nothing was taken back of, whatever the checks say."""
    return mien.edit(motion, word, safe=False)


def presets(prefix: str = "", edit: Edit = mien.edit) -> Method:
    """Return mien's presets whose names start with a prefix, for the styles they plainly mean."""
    found = {
        style: next((prefix + word for word in words if prefix + word in PRESETS), "")
        for style, words in WORDS.items()
    }
    near = {s: tuple(prefix + w for w in words if prefix + w in PRESETS) for s, words in NEAR.items()}
    return Method({style: word for style, word in found.items() if word}, edit, near=near)


def searched(motion: mien.Motion, word: str) -> mien.Motion:
    """Return an edit by the recipe of a preset, as strong as the clip needs to show it."""
    return mien.edit(motion, search.searched(motion, preset(word)))


def stronger(motion: mien.Motion, word: str) -> mien.Motion:
    """Return an edit by a preset at 1.3 times its strength, whatever the clip."""
    return mien.edit(motion, word, strength=1.3)


def nothing(motion: mien.Motion, word: str) -> mien.Motion:
    """Return the clip itself: what a recogniser says of it is what chance gives."""
    return motion


# Styles whose words stand on the disc.
PLACED = {"active": "excited", **{word: word for word in ("angry", "happy", "sad", "tired")}}


def moved(motion: mien.Motion, word: str, *, method: str) -> mien.Motion:
    """Return the motion moved to a word of the disc."""
    return mien.toward(motion, to=word, method=method)


METHODS: dict[str, Method] = {
    "s0": presets("s0/"),
    "default": presets(),
    "search": presets(edit=searched),
    "default-stronger": presets(edit=stronger),
    "default-bare": presets(edit=bare),
    "crude": Method({style: style for style in STYLES}, learn=crude.learn),
    "crude-bare": Method({style: style for style in STYLES}, learn=partial(crude.learn, keep_safe=False)),
    "learned": Method({style: style for style in STYLES}, learn=learned.learn),
    "rules": Method(PLACED, partial(moved, method="rules")),
    "joint": Method(PLACED, partial(moved, method="joint")),
    "learned-stronger": Method({style: style for style in STYLES}, learn=partial(learned.learn, amount=1.3)),
    "learned-bare": Method({style: style for style in STYLES}, learn=partial(learned.learn, safe=False)),
    "learned-unfitted": Method(
        {style: style for style in STYLES}, learn=partial(learned.learn, safe=False, fit=False)
    ),
    "nothing": Method({style: style for style in STYLES}, nothing),
}
