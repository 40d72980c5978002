"""The square of nine variants of one motion: made once, then any point of it in an instant.

Path length one way, timing the other, posture last (Förger 2011, section 3.6). A point is what the edit
``grid`` makes, to the same bytes, so its history replays; here the slow part is done once.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ..edits import pipeline
from ..edits.grid import square
from ..edits.registry import EDITS
from ..errors import MienError
from ..kinematics.lead_in import lead_in, with_lead_in, without_lead_in
from ..kinematics.square import Mode, Square
from ..motion import Motion, require_motion
from ..recipe import Recipe, Step
from ..typing import Array


@dataclass(frozen=True)
class Corner:
    """One of the nine: its letter in the thesis's figure 28, where it stands, and what it is called."""

    letter: str
    path: int
    timing: int
    name: str
    title: str


NINE = (
    Corner("A", 0, 2, "short-even", "short paths, constant speed"),
    Corner("B", 1, 2, "even", "constant speed"),
    Corner("C", 2, 2, "long-even", "long paths, constant speed"),
    Corner("D", 0, 1, "short", "short paths"),
    Corner("E", 1, 1, "original", "the original"),
    Corner("F", 2, 1, "long", "long paths"),
    Corner("G", 0, 0, "short-rushed", "short paths, added acceleration"),
    Corner("H", 1, 0, "rushed", "added acceleration"),
    Corner("I", 2, 0, "long-rushed", "long paths, added acceleration"),
)


@dataclass(frozen=True, eq=False)
class Grid:
    """The square of one motion; made by ``mien.grid``.

    ``motion`` is the centre; ``options`` are those of ``mien.grid``, as given or by default; ``still``
    frames at the start are no movement. ``path`` 0 is short, 1 the original's, 2 long; ``timing`` 0 is added
    acceleration, 1 the original's, 2 constant speed (the thesis's way round).

    >>> square = mien.grid(walk)
    >>> tired = square.at(0.2, 1.6, posture=mien.Step("posture", {"head": 10}))
    """

    motion: Motion
    options: Mapping[str, Any]
    square: Square
    still: int

    def __repr__(self) -> str:
        options = ", ".join(f"{name}={value!r}" for name, value in self.options.items())
        return f"Grid({self.motion!r}: {options})"

    def at(self, path: float, timing: float, *, posture: Recipe | Step | Iterable[Step] = ()) -> Motion:
        """Return the motion at a point, each coordinate from 0 to 2; (1, 1) is the original itself.

        ``posture`` is what is done last: steps such as ``posture``, and ``foot_plant`` after one that
        moves the legs. The history holds the step ``grid``, which makes the same bytes again.
        Raises ``RecipeError`` for a point outside and for steps that do not fit.
        """
        steps = [posture] if isinstance(posture, Step) else posture
        return pipeline.apply(self._at(path, timing), steps)

    def nine(self) -> dict[str, Motion]:
        """Return the nine motions by their letters in the thesis, A to I; E is the original."""
        return {corner.letter: self.at(corner.path, corner.timing) for corner in NINE}

    def frame(self, index: int, path: float, timing: float) -> tuple[Array, Array]:
        """Return the rotations (J, 4) and translations (J, 3) of one frame at a point, for real time.

        The same numbers as in ``at``, in about one and a half milliseconds. Raises ``MienError`` for a
        frame that the motion does not have.
        """
        if not 0 <= index < len(self.motion):
            raise MienError(f"the motion has frames 0 to {len(self.motion) - 1}, not {index}")
        self._values(path, timing)
        if path == timing == 1.0:
            return self.motion.rotations[index], self.motion.translations[index]
        if index < self.still:
            motion = self._at(path, timing)
            return motion.rotations[index], motion.translations[index]
        return self.square.frame(index, path, timing)

    def _values(self, path: float, timing: float) -> dict[str, Any]:
        """Return all parameters of the step that makes a point."""
        return EDITS["grid"].complete({"path": path, "timing": timing, **self.options})

    def _at(self, path: float, timing: float) -> Motion:
        values = self._values(path, timing)
        if path == timing == 1.0:
            return self.motion
        point = self.square.point(values["path"], values["timing"])
        motion = self.motion.with_(rotations=point.rotations, translations=point.translations)
        return with_lead_in(motion, self.motion, self.still).with_(
            reference=self.motion.reference or self.motion,
            history=(*self.motion.history, Step("grid", values)),
        )


def grid(
    motion: Motion,
    *,
    short: float = 0.3,
    long: float = 1.5,
    acceleration: float = 1.0,
    rests: bool = True,
    mode: Mode = "timemap",
) -> Grid:
    """Return the square between short and long paths, added acceleration and constant speed.

    ``short`` and ``long`` are gains of ``path_length``, ``acceleration`` the amount of ``timing`` to both
    sides: with these the twelve recipes of the thesis lie inside. With ``rests`` single actions such as a
    knock rush, too. ``mode`` is ``timemap``, which keeps limbs on their paths, or ``bilinear``, the
    thesis's mean of four motions. It takes a tenth of a second for ten seconds of motion; a point then
    takes a hundredth. Raises ``BodyError`` where no body is found, ``RecipeError`` for options out of range.
    """
    require_motion(motion)
    given = {"short": short, "long": long, "acceleration": acceleration, "rests": rests, "mode": mode}
    known = EDITS["grid"].complete(given)
    options = {name: known[name] for name in given}
    # As for every edit of poses: a still at the start of the capture is no movement.
    reference = motion.reference or motion
    still = lead_in(reference) if len(reference) == len(motion) else 0
    made = square(without_lead_in(motion, still), **options)
    return Grid(motion, MappingProxyType(options), made, still)
