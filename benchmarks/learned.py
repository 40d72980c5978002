"""The learned method: of each style the mean change of manner in acted takes, done by mien's own edits."""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from functools import partial

from acted import Take

import mien
from mien.analysis.manner import Change, change_between, mean_change
from mien.emotion.example import as_recipe, fitted


def learn(
    pairs: Sequence[tuple[Take, Take]], *, safe: bool = True, fit: bool = True, amount: float = 1.0
) -> Callable[[mien.Motion, str], mien.Motion]:
    """Return what edits a motion into a style, from (acted, neutral) takes."""
    found: dict[str, list[Change]] = defaultdict(list)
    for acted, neutral in pairs:
        found[acted.style].append(change_between(neutral.load(), acted.load()))
    changes = {style: mean_change(some).symmetric() * amount for style, some in found.items()}
    return partial(_edit, changes=changes, safe=safe, fit=fit)


def _edit(
    motion: mien.Motion, style: str, *, changes: Mapping[str, Change], safe: bool, fit: bool
) -> mien.Motion:
    change = changes[style]
    recipe = fitted(motion, change, name=style) if fit else as_recipe(change, name=style)
    return mien.edit(motion, recipe, safe=safe)
