"""What a motion expresses, and why: its place on the circumplex, the likeliest labels, their reasons."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..analysis.manner import Manner, change_between, difference
from ..analysis.manner_features import FEATURES, manner_features
from ..errors import MienError
from ..motion import Motion, require_motion
from ..typing import Array
from .circumplex import QUADRANTS, Point, described, nearest, quadrant
from .model import NEUTRAL, EmotionModel, shipped_model

REASONS = 6
LIKELY, RARE = 4, 0.02  # labels to name, and the probability below which none is
CLEAR = 0.25  # of what is usual: smaller changes are no reason
SEEN = 0.3  # 3 degrees, a tenth of a movement, 1 % of a leg: what nobody sees is no reason either
HARDLY = 0.5  # share of what is read: with less of it on the disc, the place says little


@dataclass(frozen=True)
class Reason:
    """One thing that speaks for a reading: what it is, how much, as a person says it, and how strongly."""

    what: str
    how_much: str
    pull: float

    def __str__(self) -> str:
        return f"{self.what} {self.how_much}"


@dataclass(frozen=True, eq=False)
class Reading:
    """What a motion expresses.

    ``place`` on the disc, ``labels`` with their probabilities, the likeliest first, ``why`` the first of
    them, the strongest reason first. ``against`` says with what it was compared: ``neutral``, the person's
    own clip, or ``usual``, how people usually are, which is a guess. ``manner`` (F,) is what differs from
    that, in units of what is usual: a point in the space where manners are compared. ``placed`` is the share
    of the labels' probabilities that has a place on the disc: ``place`` is the mean of that share only.
    """

    place: Point
    labels: Mapping[str, float]
    why: tuple[Reason, ...]
    against: str
    manner: Array = field(repr=False)
    placed: float = 1.0

    def __str__(self) -> str:
        return "\n".join(self.lines())

    def _repr_html_(self) -> str:
        """Return the disc, the labels and the reasons for notebooks; the front door knows who draws them."""
        import mien

        return mien.render.reading_html(self)

    @property
    def words(self) -> tuple[str, ...]:
        """The three emotion words nearest to the place."""
        return tuple(word for word, _ in nearest(*self.place)[:3])

    @property
    def quadrant(self) -> str:
        """The quadrant in words, or ``neutral`` near the centre."""
        found = quadrant(*self.place)
        return QUADRANTS[found] if found else NEUTRAL

    @property
    def hardly_placed(self) -> bool:
        """Whether most of what it is like has no place on the disc, so that ``place`` says little."""
        return self.placed < HARDLY

    def lines(self) -> list[str]:
        """Return everything in words, for a person."""
        valence, arousal = self.place
        first = next(iter(self.labels))
        said = [f"valence {valence:+.2f}, arousal {arousal:+.2f}: {described(valence, arousal)}"]
        if self.hardly_placed:
            said[0] += f" (of {100.0 * self.placed:.0f} % only: {first!r} has no place on the disc)"
        said.append(f"nearest words: {', '.join(self.words)}")
        likely = [f"{label} {100.0 * p:.0f} %" for label, p in list(self.labels.items())[:LIKELY] if p > RARE]
        said.append(f"acted like: {', '.join(likely)}")
        return [*said, *([f"because: {'; '.join(map(str, self.why))}"] if self.why else [])]

    def as_data(self) -> dict[str, Any]:
        """Return everything as plain data, for JSON."""
        return {
            "valence": round(self.place.valence, 3),
            "arousal": round(self.place.arousal, 3),
            "quadrant": self.quadrant,
            "words": list(self.words),
            "labels": {label: round(p, 4) for label, p in self.labels.items()},
            "placed": round(self.placed, 4),
            "against": self.against,
            "why": [{"what": r.what, "how_much": r.how_much, "pull": round(r.pull, 3)} for r in self.why],
        }


def read(motion: Motion, *, neutral: Motion | None = None, model: EmotionModel | None = None) -> Reading:
    """Return what a motion expresses.

    ``neutral`` is a clip of the same person, best of the same action: the reading is then of what differs,
    which is much surer. Without it an edited motion is compared with what it was made from, which has gone
    through its changes of tempo too, so that they do not count; any other with how people usually are.
    A still before the action, such as a T-pose that is left by a jump, does not count.
    ``model`` is a learned one (``load_model``), else the shipped one. Raises ``BodyError`` where no body is
    found.

    >>> from mien import samples
    >>> walk = samples.walk(seconds=4.0).motion
    >>> read(mien.edit(walk, "sad")).quadrant
    'mild and unpleasant'
    """
    if not isinstance(model, EmotionModel | None):
        raise MienError(f"model: give a learned model (mien.load_model reads one), not {model!r:.60}")
    model, motion = model or shipped_model(), require_motion(motion)
    before = motion.reference if neutral is None else require_motion(neutral)
    if before is None:
        numbers = manner_features(difference(model.rest, Manner.of(motion)))
        manners = model.alone
    else:
        numbers = manner_features(change_between(before, motion))
        manners = model.change
    labels = manners.probabilities(numbers)
    first = next(iter(labels))
    unusual, pulls = manners.scaled(numbers), manners.pulls(numbers, first)
    off = numbers - manners.middle
    clear = (pulls > 0.0) & (abs(unusual) > CLEAR) & (abs(off) > SEEN)
    order = [i for i in (-pulls).argsort() if clear[i]][:REASONS]
    said = [(*FEATURES[i].said(float(off[i])), float(pulls[i])) for i in order]
    why = tuple(Reason(what, how_much, pull) for what, how_much, pull in said)
    against = "usual" if before is None else "neutral"
    placed = min(float(sum(labels[label] for label in model.places)), 1.0)
    return Reading(model.place(labels), labels, why, against, unusual, placed)
