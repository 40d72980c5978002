"""Where ``mien edit`` moves clips to: a word, a point, so much from where they are, or an example."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import MienError
from . import arguments as a
from .report import note

if TYPE_CHECKING:
    from ..emotion.circumplex import Point
    from ..emotion.toward import Aim, Like


@dataclass(frozen=True)
class Asked:
    """The options that say a place, as they were given."""

    to: str | None
    valence: float | None
    arousal: float | None
    by: str
    start: str
    method: str
    model: Path | None = None

    @property
    def point(self) -> bool:
        """Whether a place was given by its numbers."""
        return self.valence is not None or self.arousal is not None


def goal_of(
    asked: Asked, example: Path | None, neutral: Path | None, *, map_file: Path | None = None
) -> "Aim | Like | None":
    """Return what the options mean together; None where none is given."""
    given = [
        name
        for name, there in (
            ("--to", asked.to is not None),
            ("--valence and --arousal", asked.point),
            ("--by", bool(asked.by)),
            ("--from-example", example is not None),
        )
        if there
    ]
    if len(given) > 1:
        raise MienError(f"{' and '.join(given)} all say where to move: give one")
    if neutral and not example:
        raise MienError("--example-neutral is what an example differs from: give --from-example too")
    if not given or example:
        if asked.start or asked.method != "recipe" or asked.model:
            raise MienError(
                "--start, --method and --model say how to move: give --to, --by, --valence or --arousal too"
            )
        return _example(example, neutral, map_file) if example else None
    return _aim(asked)


def _aim(asked: Asked) -> "Aim":
    """Return where to, with a name that tells it from other ways and other starts."""
    from ..emotion.circumplex import ORIGIN
    from ..emotion.model import load_model
    from ..emotion.toward import aim

    start = _numbers(asked.start, "--start") if "," in asked.start else asked.start or None
    if asked.by:
        by = _numbers(asked.by, "--by")
        found, name = aim(by=by, start=start, method=asked.method), f"by{_signed(*by)}"
    else:
        to = _wanted(asked)
        found = aim(to=to, start=start, method=asked.method)
        name = found.name if isinstance(to, str) else f"at{_signed(*found.to)}"
    words = [name]
    if found.start != ORIGIN:
        words.append("from-" + (start if isinstance(start, str) else _signed(*found.start)))
    words += [found.method] if found.method != "recipe" else []
    model = load_model(asked.model) if asked.model else None
    return replace(found, name="_".join(words), model=model)


def _wanted(asked: Asked) -> "str | Point":
    """Return the word or the point to move to; says so where a point has to be drawn in."""
    from ..emotion.circumplex import Point, clamp, words
    from ..emotion.presets import PRESETS

    if asked.point:
        point = Point(asked.valence or 0.0, asked.arousal or 0.0)
    elif asked.to is None or "," not in asked.to:
        word = asked.to or ""
        if word in PRESETS and word not in words():
            raise MienError(f"--to: {word!r} has no place on the disc, but is a preset: --emotion {word}")
        return word
    else:
        point = Point(*_numbers(asked.to, "--to"))
    if not all(abs(value) <= 1.0 for value in point):
        raise MienError(f"valence and arousal are from -1 to 1, got {point.valence:g} and {point.arousal:g}")
    inside = clamp(*point)
    if inside != point:
        note(
            f"mien: note: valence {point.valence:g} with arousal {point.arousal:g} is beyond the disc: "
            f"drawn in to {inside.valence:+.2f}, {inside.arousal:+.2f}"
        )
    return inside


def _signed(valence: float, arousal: float) -> str:
    """Return a point as part of a file's name: ``+0.3-0.1``."""
    return f"{round(valence, 2) + 0.0:+g}{round(arousal, 2) + 0.0:+g}"


def _example(example: Path, neutral: Path | None, map_file: Path | None) -> "Like":
    from ..emotion.toward import Like

    rest = a.opened_body(neutral, map_file) if neutral else None
    return Like(a.opened_body(example, map_file), rest, f"like {example.stem}")


def _numbers(text: str, flag: str) -> tuple[float, float]:
    try:
        valence, arousal = (float(value) for value in text.split(","))
    except ValueError:
        raise MienError(f"{flag} needs valence and arousal, such as +.3,0, got {text!r}") from None
    return valence, arousal
