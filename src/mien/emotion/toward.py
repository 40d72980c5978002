"""Move a motion to a place on the circumplex: to a word, to a point, or by so much from where it is.

The way is a recipe. ``recipe`` (the default) interpolates the presets over the disc (``palette``) and
searches how much of that this clip needs to show it (``search``): no data, a readable list of steps that can
be tuned by hand. ``plain`` is the same without the search. ``rules`` and ``joint`` are the synthesis of
Aristidou et al. (2017), which need a learned model (``synthesis``). What comes out can be read back
(``reading``).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, cast

import numpy as np

from ..analysis.manner import change_between
from ..errors import RecipeError, unknown
from ..motion import Motion, require_motion
from ..recipe import Recipe
from .circumplex import ORIGIN, Point, clamp, point
from .example import fitted
from .model import EmotionModel
from .palette import as_steps, recipe_at, settings_at
from .presets import OWN, preset
from .reading import read
from .resolve import Strength, edit
from .search import stronger, times_for

Method = Literal["recipe", "plain", "rules", "joint"]
METHODS = ("recipe", "plain", "rules", "joint")
REACH = 0.8  # how far from the centre words are: a clear change is that of such a place, nearer is less


@dataclass(frozen=True)
class Aim:
    """Where to: the place ``to``, from ``start``, in which way, and what it is called.

    ``model`` is a learned one, for the ways that need it and for what is ``reached``; else the shipped one.
    """

    to: Point
    start: Point = ORIGIN
    method: Method = "recipe"
    name: str = "aimed"
    model: EmotionModel | None = None

    def recipe(self, motion: Motion) -> Recipe:
        """Return the recipe that moves a motion there; without steps where it is there already."""
        require_motion(motion)
        if self.to == self.start:
            return Recipe(self.name, (), safe=True)
        if self.method in ("rules", "joint"):
            from .synthesis import synthesise

            return synthesise(motion, self.to, start=self.start, method=self.method, model=self.model)
        whole = self._written()
        if self.method == "plain" or not whole.steps:
            return whole
        return stronger(whole, times_for(motion, self._far(whole)))

    def _written(self) -> Recipe:
        """Return the recipe whatever the clip: the preset of the word, or what is between the presets."""
        if self.start == ORIGIN and self.name in OWN:
            return preset(self.name)
        return Recipe(self.name, recipe_at(*self.to, start=self.start).steps, safe=True)

    def _far(self, whole: Recipe) -> Recipe:
        """Return the recipe as far from the start as words are, the same way: how clear it is, is seen there.

        So the search says the same for all places on one way from the start, and further stays more.
        """
        if self.start == ORIGIN and self.name in OWN:
            return whole
        numbers = settings_at(*self.to) - settings_at(*self.start)
        away = float(np.hypot(*np.subtract(self.to, self.start)))
        return replace(whole, steps=as_steps(numbers * (REACH / away)))

    def reached(self, before: Motion, after: Motion, *, model: EmotionModel | None = None) -> str:
        """Return in words what was asked for and what a learned model reads in the result."""
        found = read(after, neutral=before, model=model or self.model)
        valence, arousal = np.add(self.start, found.place)
        away = float(np.hypot(self.to.valence - valence, self.to.arousal - arousal))
        first = next(iter(found.labels))
        like = first if self.start == ORIGIN else f"the change is like {first}"
        return (
            f"asked for valence {self.to.valence:+.2f}, arousal {self.to.arousal:+.2f}; it reads as "
            f"{valence:+.2f}, {arousal:+.2f} ({like}), {away:.2f} away"
        )


@dataclass(frozen=True, eq=False)
class Like:
    """In the manner of an example: what ``example`` has that ``neutral``, or the clip itself, has not."""

    example: Motion
    neutral: Motion | None = None
    name: str = "example"

    def recipe(self, motion: Motion) -> Recipe:
        """Return the recipe that makes a motion differ from itself as the example from its neutral clip."""
        rest = self.neutral if self.neutral is not None else require_motion(motion)
        return fitted(motion, change_between(rest, require_motion(self.example)), name=self.name)


def aim(
    *,
    to: str | Point | Sequence[float] | None = None,
    by: Sequence[float] | None = None,
    start: str | Point | Sequence[float] | None = None,
    method: str = "recipe",
) -> Aim:
    """Return where to move: ``to`` a word or a point, or ``by`` so much from the ``start``.

    Points are valence and arousal. ``start`` is where the motion is now, a word or a point, the centre if it
    is not said. Raises ``RecipeError`` for a word that is not on the disc, a method that is not known, or
    neither ``to`` nor ``by``.

    >>> aim(to="sad").to, aim(by=(0.3, 0.0)).to
    (Point(valence=-0.648, arousal=-0.267), Point(valence=0.3, arousal=0.0))
    """
    if method not in METHODS:
        raise RecipeError(unknown("method", method, METHODS))
    here = _place(start) if start is not None else ORIGIN
    if by is not None and to is None:
        valence, arousal = _pair(by)
        place = clamp(here.valence + valence, here.arousal + arousal)
        return Aim(place, here, cast(Method, method), f"by {valence:g},{arousal:g}")
    if to is None or by is not None:
        both = ", not both" if by is not None else ""
        raise RecipeError(f"say where to: a word or a point (to=...), or by how much (by=...){both}")
    place = _place(to)
    name = to if isinstance(to, str) else f"at {place.valence:g},{place.arousal:g}"
    return Aim(place, here, cast(Method, method), name)


def toward(
    motion: Motion,
    *,
    to: str | Point | Sequence[float] | None = None,
    by: Sequence[float] | None = None,
    start: str | Point | Sequence[float] | None = None,
    method: str = "recipe",
    model: EmotionModel | None = None,
    strength: Strength = 1.0,
    safe: bool | None = None,
) -> Motion:
    """Return the motion moved to a place on the circumplex; arguments as in ``aim`` and ``edit``.

    ``strength`` 0 is the motion itself. ``model`` is a learned one, for ``method`` ``"rules"`` and
    ``"joint"``. Raises ``RecipeError`` for what is unknown, ``BodyError`` where no body is found.

    >>> mien.toward(walk, to="bored"), mien.toward(walk, to=(0.6, -0.2)), mien.toward(walk, by=(0.3, 0))
    """
    recipe = replace(aim(to=to, by=by, start=start, method=method), model=model).recipe(motion)
    return edit(motion, recipe, strength=strength, safe=safe)


def like(
    motion: Motion, example: Motion, *, neutral: Motion | None = None, strength: Strength = 1.0
) -> Motion:
    """Return the motion in the manner of an example, of anyone on any skeleton.

    What differs between ``example`` and ``neutral``, best one action of one person, is done to the motion
    (Amaya, Bruderlin & Calvert 1996); without ``neutral`` the motion itself is that. Raises ``BodyError``
    where no body is found.
    """
    return edit(motion, Like(example, neutral).recipe(motion), strength=strength)


def _place(where: str | Point | Sequence[float]) -> Point:
    return point(where) if isinstance(where, str) else clamp(*_pair(where))


def _pair(values: Sequence[float]) -> tuple[float, float]:
    try:
        valence, arousal = (float(value) for value in values)
    except (TypeError, ValueError):
        raise RecipeError(f"a point is two numbers, valence and arousal, not {values!r:.60}") from None
    if not (abs(valence) <= 2.0 and abs(arousal) <= 2.0):
        raise RecipeError(f"valence and arousal are from -1 to 1, got {valence:g} and {arousal:g}")
    return valence, arousal
