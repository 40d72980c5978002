"""What a motion expresses, and why: its place on the circumplex, the likeliest labels, their reasons."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..analysis.manner import Manner, change_between, difference
from ..analysis.manner_features import FEATURES, manner_features
from ..motion import Motion, require_motion
from ..typing import Array
from .circumplex import QUADRANTS, Point, nearest, quadrant
from .model import NEUTRAL, EmotionModel, shipped_model

REASONS = 6
CLEAR = 0.25  # of what is usual: smaller changes are no reason


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
    that, in units of what is usual: a point in the space where manners are compared.
    """

    place: Point
    labels: Mapping[str, float]
    why: tuple[Reason, ...]
    against: str
    manner: Array = field(repr=False)

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

    def as_data(self) -> dict[str, Any]:
        """Return everything as plain data, for JSON."""
        return {
            "valence": round(self.place.valence, 3),
            "arousal": round(self.place.arousal, 3),
            "quadrant": self.quadrant,
            "words": list(self.words),
            "labels": {label: round(p, 4) for label, p in self.labels.items()},
            "against": self.against,
            "why": [{"what": r.what, "how_much": r.how_much, "pull": round(r.pull, 3)} for r in self.why],
        }


def read(motion: Motion, *, neutral: Motion | None = None, model: EmotionModel | None = None) -> Reading:
    """Return what a motion expresses.

    ``neutral`` is a clip of the same person, best of the same action: the reading is then of what differs,
    which is much surer. Without it an edited motion is compared with what it was made from, which has gone
    through its changes of tempo too, so that they do not count; any other with how people usually are.
    ``model`` is a learned one (``load_model``), else the shipped one. Raises ``BodyError`` where no body is
    found.

    >>> from mien import samples
    >>> walk = samples.walk(seconds=4.0).motion
    >>> read(mien.edit(walk, "sad")).quadrant
    'mild and unpleasant'
    """
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
    order = [i for i in (-pulls).argsort() if pulls[i] > 0.0 and abs(unusual[i]) > CLEAR][:REASONS]
    off = numbers - manners.middle
    why = tuple(Reason(FEATURES[i].label, FEATURES[i].said(float(off[i])), float(pulls[i])) for i in order)
    against = "usual" if before is None else "neutral"
    return Reading(model.place(labels), labels, why, against, unusual)
