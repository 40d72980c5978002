"""The one registry of edits: a typed, keyword-only signature makes flag, slider, check and docs."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import wraps
from math import inf
from typing import Any, Literal

import numpy as np

from ..curve import Varying, evaluate
from ..errors import RecipeError, unknown
from ..kinematics.lead_in import lead_in, with_lead_in, without_lead_in
from ..motion import Motion
from ..recipe import Step
from ..typing import Array
from . import keyed
from .parameters import Param as Param
from .parameters import Parameter as Parameter
from .parameters import check_value, read_parameters

Kind = Literal["pose", "rhythm", "time", "repair"]


@dataclass(frozen=True)
class Edit:
    """A registered edit.

    ``kind`` says how it meets the rest of a recipe: a ``pose`` edit changes poses frame by frame and
    can be limited to parts and spans; a ``rhythm`` edit changes when things happen to the whole body: it
    follows strength and spans; a ``time`` edit changes frames or the whole clip; a ``repair`` is given the
    reference and always sees the whole clip. The last three kinds never have parts; ``rhythm`` and ``time``
    are done to the reference too.
    """

    name: str
    run: Callable[..., Motion]
    kind: Kind
    summary: str
    paper: str
    equation: str
    deviations: str
    parameters: Mapping[str, Parameter]
    asks: frozenset[str]

    @property
    def poses(self) -> bool:
        """Whether it changes poses, so that feet may have to be put back: some edits of rhythm do too."""
        return self.kind == "pose" or "only_time" in self.asks

    def perform(
        self,
        motion: Motion,
        values: Mapping[str, Any],
        *,
        strength: Varying = 1.0,
        within: Array | None = None,
        original: Motion | None = None,
        joints: Sequence[int] | None = None,
    ) -> Motion:
        """Run the edit with checked values at a strength, any of them curves over time.

        ``within`` (T,) is how much of a ``rhythm`` edit shows in each frame. ``original`` and ``joints`` are
        given to edits that ask for them.
        """
        changing = keyed.curves(values, self._numbers(), strength)
        if self.kind in ("rhythm", "time"):
            steady = within is None and not changing
            return self._retimed(
                motion,
                self.scaled(values, strength) if steady else self._by_frame(motion, values, strength, within),
            )
        if not changing:
            return self._perform(motion, self.scaled(values, strength), original, joints)
        if self._by_itself:
            return self._perform(motion, self._by_frame(motion, values, strength, None), original, joints)

        def render(now: Mapping[str, float]) -> Motion:
            """Return the motion edited with the numbers of one moment."""
            level = now.get(keyed.STRENGTH, strength)
            numbers = {name: now.get(name, value) for name, value in values.items()}
            return self._perform(motion, self.scaled(numbers, level), original, joints)

        return keyed.blended(motion, changing, render)

    def _perform(
        self,
        motion: Motion,
        values: Mapping[str, Any],
        original: Motion | None,
        joints: Sequence[int] | None,
    ) -> Motion:
        """Run an edit with plain numbers, giving it what it asks for and carrying the reference along.

        A still at the start of the capture, such as a T-pose, is no movement: poses are edited without it.
        """
        reference = motion.reference or motion
        if self.kind == "repair":
            edited = reference.rotations is not motion.rotations  # an unedited clip is its own reference
            before = original or (reference if edited else None)
            return self.run(motion, **values, original=before).with_(reference=reference)
        still = lead_in(reference) if len(reference) == len(motion) else 0
        more: dict[str, Any] = {"joints": joints} if "joints" in self.asks else {}
        more |= {"original": without_lead_in(reference, still)} if "original" in self.asks else {}
        after = self.run(without_lead_in(motion, still), **values, **more)
        return with_lead_in(after, motion, still).with_(reference=reference)

    def _retimed(self, motion: Motion, values: Mapping[str, Any]) -> Motion:
        """Run an edit of time on the motion and on its reference, so that their frames stay the same.

        An edit that asks for ``original`` gets the reference both times, and takes its times from there; one
        that asks for ``only_time`` is told to leave the reference's poses alone.
        """
        reference = motion.reference or motion
        given = {"original": reference} if "original" in self.asks else {}
        after = self.run(motion, **values, **given)
        if reference is motion and "only_time" not in self.asks:
            return after.with_(reference=after)
        alone = {"only_time": True} if "only_time" in self.asks else {}
        return after.with_(reference=self.run(reference, **values, **given, **alone))

    def complete(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """Return all parameters: those given, checked, and the defaults of the others."""
        for name in given:
            if name not in self.parameters:
                raise RecipeError(f"{self.name}: " + unknown("parameter", name, self.parameters))
        values = {
            name: check_value(self.name, p, given[name]) if name in given else p.default
            for name, p in self.parameters.items()
        }
        for name in keyed.curves(values, self._numbers(), 1.0):
            if self.kind in ("rhythm", "time") and not self.parameters[name].varies:
                raise RecipeError(f"{self.name}: {name} cannot change over time; give one number")
        return values

    def scaled(self, values: Mapping[str, Any], strength: Varying) -> dict[str, Any]:
        """Return ``values`` moved from neutral by ``strength``, within each parameter's range."""
        out = dict(values)
        for name, value in values.items():
            follows = self.parameters[name].about.neutral is not None and isinstance(value, int | float)
            if follows and strength != 1.0:
                out[name] = _moved(self.parameters[name], value, strength)
        return out

    def _by_frame(
        self, motion: Motion, values: Mapping[str, Any], strength: Varying, within: Array | None
    ) -> dict[str, Any]:
        """Return ``values`` at every frame (T,), moved from neutral by strength, where they vary."""
        share = evaluate(strength, motion.times) * (1.0 if within is None else within)
        out = dict(values)
        for name, p in self.parameters.items():
            if p.varies and p.about.neutral is not None:
                out[name] = _moved(p, evaluate(values.get(name, p.default), motion.times), share)
        return out

    @property
    def _by_itself(self) -> bool:
        """Whether the edit takes each of its numbers frame by frame, so that nothing need be blended."""
        return all(p.varies for p in self._numbers().values())

    def _numbers(self) -> dict[str, Parameter]:
        return {name: p for name, p in self.parameters.items() if p.kind is float}


def _moved(parameter: Parameter, value: Any, strength: Any) -> Any:
    """Return a value, or values, moved from neutral by ``strength``, within the parameter's range."""
    about = parameter.about
    low = -inf if about.low is None else about.low
    high = inf if about.high is None else about.high
    moved = np.clip(about.neutral + strength * (value - about.neutral), low, high)
    return moved if np.ndim(moved) else float(moved)


EDITS: dict[str, Edit] = {}


def edit(*, kind: Kind = "pose", paper: str, equation: str = "", deviations: str = "") -> Callable[..., Any]:
    """Register ``function(motion, *, parameters) -> Motion`` under its name.

    The registered function checks its parameters and appends one step to the motion's history. Some
    arguments are no parameters, and are given to a function that has them in its signature: ``original``,
    the motion to compare with (without it the motion before the first step of the history); ``joints`` of
    a pose edit that works joint by joint, the joints whose result is wanted (None: all); ``only_time`` of a
    rhythm edit that changes poses too: leave them as they are.
    """

    def register(function: Callable[..., Motion]) -> Callable[..., Motion]:
        """Return the function that checks its parameters and writes them into the history."""
        name = function.__name__
        doc = inspect.getdoc(function) or ""
        asks = frozenset(inspect.signature(function).parameters)
        known, summary = read_parameters(function), doc.split("\n")[0]
        found = Edit(name, function, kind, summary, paper, equation, deviations, known, asks)

        @wraps(function)
        def run(motion: Motion, **given: Any) -> Motion:
            original = given.pop("original", None) if kind == "repair" else None
            values = found.complete(given)
            after = found.perform(motion, values, original=original)
            return after.with_(history=(*motion.history, Step(name, values)))

        EDITS[name] = found
        return run

    return register
