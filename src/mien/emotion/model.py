"""A model of emotion, learned from acted clips: numbers in, places on the disc out, and a card of its origin.

Three readings are learned from the same clips. **Change**: what differs in manner from the person's neutral
clip, told apart by linear discriminants; people agree more on change than on labels (Förger and Takala 2015),
and so do models. **Alone**: what differs from how people usually are, for want of such a clip. **Laban**:
Laban features of the clip alone, through radial basis functions (Aristidou et al. 2017).
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from ..analysis.laban_table import DERIVED
from ..analysis.manner import Manner, difference
from ..analysis.manner_features import FEATURES, manner_features
from ..errors import MienError
from ..signal.discriminant import Discriminant
from ..signal.radial import Radial
from ..typing import Array
from .circumplex import Point, clamp
from .cluster_tables import ClusterTables

VERSION = 2
SHIPPED = "bandai"
NEUTRAL = "neutral"
CLIP = (-0.25, 1.25)  # how far new clips may go beyond the [0, 1] of the training clips
MOST = 3.0  # times what is usual
TINY, MOST_NUMBER = 1e-6, 1e9  # sizes and numbers of a model are between these
QUALITIES = ("swing", "rate", "sharpness")
LABAN = ("low", "high", "mean", "components")
SURFACE = ("centres", "constant", "linear", "radial")


@dataclass(frozen=True, eq=False)
class Manners:
    """Numbers of manner (F,) to probabilities of labels: centred at ``middle``, scaled, then told apart."""

    middle: Array
    scale: Array
    planes: Discriminant

    def scaled(self, manner: Array) -> Array:
        """Return numbers of manner (..., F) in units of what is usual, the unusual held back."""
        return np.clip((manner - self.middle) / self.scale, -MOST, MOST)

    def probabilities(self, manner: Array) -> dict[str, float]:
        """Return label -> probability for numbers of manner (F,), the likeliest first."""
        values = np.exp(self.planes.log_probabilities(self.scaled(manner)))
        found = dict(zip(self.planes.names, values.tolist(), strict=True))
        return dict(sorted(found.items(), key=lambda item: -item[1]))

    def pulls(self, manner: Array, label: str) -> Array:
        """Return how much each number (F,) speaks for a label."""
        return self.planes.pulls(self.scaled(manner), label)


@dataclass(frozen=True, eq=False)
class Laban:
    """Laban features to a place: scaled, selected, turned to main components, and through radial functions.

    ``selected`` (S,) indices into the derived features, their ``low`` and ``high`` (S,) in the training
    clips, ``mean`` (S,) and ``components`` (C, S) of their main components, ``surface`` from (C,) to (2,).
    """

    selected: tuple[int, ...]
    low: Array
    high: Array
    mean: Array
    components: Array
    surface: Radial

    def scaled(self, derived: Array) -> Array:
        """Return the selected of derived features (..., 121) in [0, 1], new clips a little beyond."""
        span = np.maximum(self.high - self.low, 1e-9)
        found: Array = np.clip((derived[..., list(self.selected)] - self.low) / span, *CLIP)
        return found

    def place(self, derived: Array) -> Point:
        """Return where a clip with derived features (121,) stands."""
        valence, arousal = self.surface((self.scaled(derived) - self.mean) @ self.components.T)
        return clamp(float(valence), float(arousal))


@dataclass(frozen=True, eq=False)
class EmotionModel:
    """What is learned: ``card`` (source, licence, scores), the three readings, and how features change.

    ``places`` label -> its point, of labels that stand on the circumplex. ``change`` reads changes of manner
    from a neutral clip, ``alone`` those from ``rest``, the usual manner. ``clusters`` is what labels change
    in each cluster of poses, for the way back from a place to a motion.
    """

    card: Mapping[str, Any]
    places: Mapping[str, Point]
    change: Manners
    rest: Manner
    alone: Manners
    laban: Laban
    clusters: ClusterTables

    def __repr__(self) -> str:
        labels = ", ".join(self.change.planes.names)
        return f"EmotionModel({self.card.get('takes', 'some')} takes: {labels})"

    def place(self, probabilities: Mapping[str, float]) -> Point:
        """Return the mean place of the labels that have one, by their probabilities."""
        weights = np.array([probabilities[label] for label in self.places])
        points = np.array(list(self.places.values()))
        valence, arousal = (weights @ points) / max(float(weights.sum()), 1e-9)
        return clamp(float(valence), float(arousal))


def load_model(source: str | Path) -> EmotionModel:
    """Return the model in a file that ``mien learn`` wrote, or a shipped one by its name, ``"bandai"``.

    Raises ``MienError`` for a file that is not there or is no model.
    """
    if source == SHIPPED:
        return shipped_model()
    try:
        text = Path(source).read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not text"
        raise MienError(
            f"{source!s:.200}: cannot be read as a model: {reason}; give a file of mien learn, or {SHIPPED!r}"
        ) from None
    return _read(text, str(source))


@cache
def shipped_model() -> EmotionModel:
    """Return the model that comes with mien."""
    text = files(__package__).joinpath("models", f"{SHIPPED}.json").read_text(encoding="utf-8")
    return _read(text, f"model {SHIPPED}")


def format_model(model: EmotionModel) -> str:
    """Return the text that ``load_model`` reads back: JSON, numbers with six digits."""
    laban, rest = model.laban, model.rest
    data = {
        "version": VERSION,
        "card": dict(model.card),
        "places": {label: list(place) for label, place in model.places.items()},
        "change": _manners(model.change),
        "rest": {
            "pose": {segment: _plain(q) for segment, q in rest.pose.items()},
            "hips_height": round(rest.hips_height, 6),
            **{key: {k: round(v, 6) for k, v in getattr(rest, key).items()} for key in QUALITIES},
        },
        "alone": _manners(model.alone),
        "laban": {
            "selected": list(laban.selected),
            **{key: _plain(getattr(laban, key)) for key in LABAN},
            "surface": {
                "sigma": round(laban.surface.sigma, 6),
                "ridge": laban.surface.ridge,
                **{key: _plain(getattr(laban.surface, key)) for key in SURFACE},
            },
        },
        "clusters": model.clusters.as_data(),
    }
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")) + "\n"


def _manners(manners: Manners) -> dict[str, Any]:
    return {
        "middle": _plain(manners.middle),
        "scale": _plain(manners.scale),
        "names": list(manners.planes.names),
        "weights": _plain(manners.planes.weights),
        "offsets": _plain(manners.planes.offsets),
    }


def _read(text: str, where: str) -> EmotionModel:
    try:
        data = json.loads(text)
        version = data["version"]
        if version == VERSION:
            return _tried(_parsed(data))
        why = f"version {version!r:.40} where this mien reads {VERSION}"
    except (KeyError, TypeError, ValueError, IndexError, AttributeError, ArithmeticError) as error:
        why = str(error) if isinstance(error, MienError) else f"{type(error).__name__}: {error!s:.100}"
    except RecursionError:
        why = "nested too deep"
    raise MienError(f"{where}: is no model of emotion that mien learn wrote ({' '.join(why.split())})")


def _parsed(data: dict[str, Any]) -> EmotionModel:
    return EmotionModel(
        card=dict(data["card"]),
        places={label: clamp(*map(_number, place)) for label, place in data["places"].items()},
        change=_read_manners(data["change"]),
        rest=_read_rest(data["rest"]),
        alone=_read_manners(data["alone"]),
        laban=_read_laban(data["laban"]),
        clusters=ClusterTables.from_data(data["clusters"]),
    )


def _tried(model: EmotionModel) -> EmotionModel:
    """Return the model after using everything once: what does not fit together shows."""
    nothing = manner_features(difference(model.rest, model.rest))
    model.place(model.change.probabilities(nothing))
    model.place(model.alone.probabilities(nothing))
    model.laban.place(np.zeros(len(DERIVED)))
    return model


def _read_manners(data: dict[str, Any]) -> Manners:
    names, count = tuple(data["names"]), len(FEATURES)
    if len(set(names)) < max(len(names), 2) or not all(isinstance(name, str) for name in names):
        raise MienError("labels must be two or more different names")
    planes = Discriminant(
        names, _array(data["weights"], len(names), count), _array(data["offsets"], len(names))
    )
    return Manners(_array(data["middle"], count), _array(data["scale"], count, least=TINY), planes)


def _read_rest(data: dict[str, Any]) -> Manner:
    pose = {segment: _array(q, 4) for segment, q in data["pose"].items()}
    if not all(abs(float(q @ q) - 1.0) < 1e-3 for q in pose.values()):
        raise MienError("rotations must be unit quaternions")
    sizes = {key: {k: _number(v, least=TINY) for k, v in data[key].items()} for key in QUALITIES}
    return Manner(pose, _number(data["hips_height"]), **sizes)


def _read_laban(data: dict[str, Any]) -> Laban:
    about, selected = data["surface"], tuple(int(i) for i in data["selected"])
    if not all(0 <= i < len(DERIVED) for i in selected):
        raise MienError(f"selected features must be 0 to {len(DERIVED) - 1}")
    sigma, ridge = _number(about["sigma"], least=TINY), _number(about["ridge"], least=0.0)
    surface = Radial("gaussian", sigma=sigma, ridge=ridge, **{key: _array(about[key]) for key in SURFACE})
    return Laban(selected, surface=surface, **{key: _array(data[key]) for key in LABAN})


def _number(value: Any, *, least: float = -MOST_NUMBER) -> float:
    """Return a number of a file; raise ``MienError`` for one that is not finite, or out of reason."""
    found = float(value)
    if not least <= found <= MOST_NUMBER:
        raise MienError(f"{value!r:.40} is out of range")
    return found


def _array(values: Any, *shape: int, least: float = -MOST_NUMBER) -> Array:
    found: Array = np.array(values, float)
    if shape and found.shape != shape:
        raise MienError(f"{shape} numbers are expected, not {found.shape}")
    if not ((found >= least) & (found <= MOST_NUMBER)).all():
        raise MienError("a number is out of range")
    return found


def _plain(values: Array) -> Any:
    return np.round(np.asarray(values, float), 6).tolist()
