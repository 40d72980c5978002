"""Where ``mien edit`` moves clips to: a word, a point, so much from where they are, or an example."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import MienError
from . import arguments as a

if TYPE_CHECKING:
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


def goal_of(asked: Asked, example: Path | None, neutral: Path | None) -> "Aim | Like | None":
    """Return what the options mean together; None where none is given."""
    point = asked.valence is not None or asked.arousal is not None
    given = [
        name
        for name, there in (
            ("--to", asked.to is not None),
            ("--valence and --arousal", point),
            ("--by", bool(asked.by)),
            ("--from-example", example is not None),
        )
        if there
    ]
    if len(given) > 1:
        raise MienError(f"{' and '.join(given)} all say where to move: give one")
    if neutral and not example:
        raise MienError("--example-neutral is what an example differs from: give --from-example too")
    if not given:
        if asked.start or asked.method != "recipe":
            raise MienError(
                "--start and --method say how to move: give --to, --by, --valence or --arousal too"
            )
        return None
    if example:
        return _example(example, neutral)
    return _aim(asked, point)


def _aim(asked: Asked, point: bool) -> "Aim":
    from ..emotion.toward import aim

    start = _numbers(asked.start, "--start") if "," in asked.start else asked.start or None
    if point:
        return aim(to=(asked.valence or 0.0, asked.arousal or 0.0), start=start, method=asked.method)
    if asked.by:
        return aim(by=_numbers(asked.by, "--by"), start=start, method=asked.method)
    return aim(to=asked.to, start=start, method=asked.method)


def _example(example: Path, neutral: Path | None) -> "Like":
    from ..emotion.toward import Like

    rest = a.opened(neutral, None, False, None) if neutral else None
    return Like(a.opened(example, None, False, None), rest, f"like {example.stem}")


def _numbers(text: str, flag: str) -> tuple[float, float]:
    try:
        valence, arousal = (float(value) for value in text.split(","))
    except ValueError:
        raise MienError(f"{flag} needs valence and arousal, such as +.3,0, got {text!r}") from None
    return valence, arousal
