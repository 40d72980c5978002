"""Learn a model of emotion from labelled clips, and say how good it is on contents it has not seen.

A content is what somebody does (walk, wave); a take is one clip of a content in one emotion. Takes are
compared with the neutral take of the same content and performer. Scores leave out one content at a time: all
of its takes are read by a model that has seen none of them, not even to find scales and components.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..analysis.laban import features
from ..analysis.laban_table import DERIVED
from ..analysis.manner import Manner, body_beside, difference, usual_manner
from ..analysis.manner_features import manner_features
from ..errors import MienError
from ..kinematics.body import Body
from ..motion import Motion
from ..signal.discriminant import Discriminant, discriminate
from ..signal.radial import near
from ..typing import Array, Integers
from .circumplex import ORIGIN, Point, quadrant
from .cluster_tables import Seen, learn_tables
from .model import NEUTRAL, EmotionModel, Laban, Manners
from .selection import select

VARIANCE = 0.95  # that the main components keep (Aristidou et al. 2017)
SHRINKAGE, SHRINKAGE_ALONE = 0.3, 0.5
COMMON = 3  # labels of a performer from which on what they share is told from what they are
# Who compares two clips expects a change: the logarithm of how much rarer none is. Without it, small changes
# and those of other bodies are read as none.
UNCHANGED, HALFWAY = -4.0, 0.5
LEAST_SCALE = 0.1  # of numbers of manner: what varies less is not looked at more closely
LEAST = 5  # selected features: where fewer pass, those that the paper selected are taken
PRINTED = tuple(d.number - 1 for d in sorted(DERIVED, key=lambda d: d.selected) if d.selected)


@dataclass(frozen=True, eq=False)
class Take:
    """One labelled clip in numbers.

    ``change`` (F,) of manner against its neutral take, all 0 for that itself; ``manner`` by itself;
    ``derived`` (121,) Laban features; what is ``seen`` of it frame by frame, and of its neutral take.
    """

    label: str
    content: str
    performer: str
    change: Array
    manner: Manner
    derived: Array
    seen: Seen
    seen_neutral: Seen


def measure_takes(clips: Iterable[tuple[Motion, str, str, str]]) -> list[Take]:
    """Return the takes of clips given as ``(motion, label, content, performer)``, some labelled ``neutral``.

    All takes of a content and performer are measured with the body of their neutral take: a bowed take would
    hide its own bow. Those without a neutral take are left out. Raises ``MienError`` where none is left,
    ``BodyError`` where no body is found.
    """
    groups: dict[tuple[str, str], list[tuple[Motion, str]]] = {}
    for motion, label, content, performer in clips:
        groups.setdefault((content, performer), []).append((motion, label))
    takes = []
    for (content, performer), some in groups.items():
        rest = next((motion for motion, label in some if label == NEUTRAL), None)
        if rest is None:
            continue
        body = Body.of(rest)
        manner, still = Manner.of(rest, body=body), Seen.of(rest, body=body)
        for motion, label in some:
            own = body_beside(body, rest, motion)
            change = manner_features(difference(manner, Manner.of(motion, body=own)))
            derived = features(motion, body=own).clip
            seen = still if motion is rest else Seen.of(motion, body=own)
            takes.append(Take(label, content, performer, change, Manner.of(motion), derived, seen, still))
    if len({take.label for take in takes} - {NEUTRAL}) < 2:
        raise MienError(
            "to learn takes two or more labels besides the neutral one, with a neutral take of the same "
            "content and performer for each; --neutral names that label"
        )
    return takes


def learn(takes: Sequence[Take], places: Mapping[str, Point], *, card: Mapping[str, Any]) -> EmotionModel:
    """Return the model that takes teach; ``places`` label -> point, of labels that stand on the circumplex.

    Labels without a place are told apart, but say nothing about valence and arousal.
    """
    known = {
        NEUTRAL: ORIGIN,
        **{k: v for k, v in places.items() if any(t.label == k for t in takes)},
    }
    changes = without_common(takes, common_changes(takes))
    rest = usual_manner([take.manner for take in takes if take.label == NEUTRAL])
    alone = np.array([manner_features(difference(rest, take.manner)) for take in takes])
    return EmotionModel(
        card=dict(card),
        places=known,
        change=_manners(changes, takes, centred=False),
        rest=rest,
        alone=_manners(alone, takes, centred=True),
        laban=_learn_laban(takes, known),
        clusters=learn_tables(takes, tuple(known), neutral=NEUTRAL),
    )


def _manners(values: Array, takes: Sequence[Take], *, centred: bool) -> Manners:
    """Return what tells labels apart in numbers of manner (N, F), ``centred`` at their mean or at 0."""
    acted = values[[take.label != NEUTRAL for take in takes]]
    middle = values.mean(axis=0) if centred else np.zeros(values.shape[1])
    scale = np.maximum(np.sqrt(np.mean((acted - middle) ** 2, axis=0)), LEAST_SCALE)
    found = Manners(middle, scale, Discriminant((), np.zeros((0, 0)), np.zeros(0)))
    labels = [take.label for take in takes]
    shrinkage = SHRINKAGE_ALONE if centred else SHRINKAGE
    planes = discriminate(found.scaled(values), labels, shrinkage=shrinkage)
    if not centred:
        other = np.array([name != NEUTRAL for name in planes.names])
        # No change at all stays neutral, however near to it a label is.
        rarer = max(UNCHANGED, HALFWAY * float(planes.offsets[other].max()))
        planes = replace(planes, offsets=planes.offsets + np.where(other, 0.0, rarer))
    return replace(found, planes=planes)


def common_changes(takes: Sequence[Take]) -> dict[str, Array]:
    """Return performer -> what all acted takes have in common against the neutral ones (F,).

    That is no emotion but another day, other markers or another mood of the neutral takes; it would make
    every clip of anybody else look neutral. Nothing for a performer with fewer than three labels.
    """
    acted: dict[str, list[Take]] = {}
    for take in takes:
        if take.label != NEUTRAL:
            acted.setdefault(take.performer, []).append(take)
    return {
        performer: np.mean([take.change for take in some], axis=0)
        for performer, some in acted.items()
        if len({take.label for take in some}) >= COMMON
    }


def without_common(takes: Sequence[Take], common: Mapping[str, Array]) -> Array:
    """Return the changes (N, F) of takes without what is common to the acted ones of their performer."""
    return np.array(
        [t.change if t.label == NEUTRAL else t.change - common.get(t.performer, 0.0) for t in takes]
    )


def scores(takes: Sequence[Take], places: Mapping[str, Point]) -> dict[str, float]:
    """Return how well takes of contents left out are read, as shares of takes.

    ``change``, ``alone`` and ``laban`` are the three readings; ``top-1`` of all labels (``chance`` is that of
    guessing), ``quadrant`` and mean ``distance`` on the disc of the labels with a place. ``acted`` leaves out
    the neutral takes, whose change is nothing. Raises ``MienError`` for takes of one content only.
    """
    if len({take.content for take in takes}) < 2:
        raise MienError("how well contents are read that were not seen needs takes of two or more contents")
    hits: dict[str, list[float]] = {}

    def note(name: str, value: float) -> None:
        """Keep how well one take was read."""
        hits.setdefault(name, []).append(float(value))

    for content in sorted({take.content for take in takes}):
        seen, left = ([t for t in takes if (t.content == content) is out] for out in (False, True))
        model = learn(seen, places, card={})
        for take, numbers in zip(left, without_common(left, common_changes(seen)), strict=True):
            change = model.change.probabilities(numbers)
            alone = model.alone.probabilities(manner_features(difference(model.rest, take.manner)))
            acted = take.label != NEUTRAL
            for name, found in (("change", change), ("alone", alone)):
                note(f"{name} top-1", next(iter(found)) == take.label)
                if acted:
                    note(f"{name} top-1, acted", next(iter(found)) == take.label)
            if acted and take.label in places:
                points = model.place(change), model.place(alone), model.laban.place(take.derived)
                for name, point in zip(("change", "alone", "laban"), points, strict=True):
                    note(f"{name} quadrant", quadrant(*point) == quadrant(*places[take.label]))
                    note(f"{name} distance", np.hypot(*np.subtract(point, places[take.label])))
    found = {name: round(float(np.mean(values)), 3) for name, values in hits.items()}
    return {"takes": len(takes), "chance": round(1.0 / len({take.label for take in takes}), 3), **found}


def _learn_laban(takes: Sequence[Take], places: Mapping[str, Point]) -> Laban:
    """Return the reading of Laban features (equation 1): ridge, with Gaussians around the labels' means."""
    placed = [take for take in takes if take.label in places]
    derived = np.array([take.derived for take in placed])
    low, high = derived.min(axis=0), derived.max(axis=0)
    chosen = _selected(placed, low, high)
    x = (derived[:, chosen] - low[chosen]) / np.maximum(high[chosen] - low[chosen], 1e-9)
    mean = x.mean(axis=0)
    _, s, vt = np.linalg.svd(x - mean, full_matrices=False)
    kept = int(np.searchsorted(np.cumsum(s**2) / np.sum(s**2), VARIANCE)) + 1
    turned = (x - mean) @ vt[:kept].T
    labels = [take.label for take in placed]
    centres = np.array([turned[[label == name for label in labels]].mean(axis=0) for name in places])
    surface = near(turned, np.array([places[label] for label in labels]), centres)
    return Laban(tuple(chosen.tolist()), low[chosen], high[chosen], mean, vt[:kept], surface)


def _selected(takes: Sequence[Take], low: Array, high: Array) -> Integers:
    """Return the indices of the features to use: those that pass the rule, or the paper's where few do.

    Performers and contents stand for the paper's performers.
    """
    groups = sorted({(take.performer, take.content) for take in takes})
    labels = sorted({take.label for take in takes})
    table = {(take.performer, take.content, take.label): take.derived for take in takes}
    whole = [g for g in groups if all((*g, label) in table for label in labels)]
    if whole:
        means = np.array([[table[(*g, label)] for label in labels] for g in whole])
        found = select((means - low) / np.maximum(high - low, 1e-9))
        if len(found) >= LEAST:
            return found
    return np.array(PRINTED)
