"""Two recognisers of acted style, of different kinds on different features, in place of people.

Both see what a clip has that the same body's neutral clip has not (``clip_features.difference``), and answer
with a probability for each style, or for "normal": nothing changed. ``a`` draws planes between the styles
(linear discriminant analysis with shrinkage) in posture, range and speed; ``b`` weighs how near the examples
are (ridge regression with a Gaussian kernel) in distances and spectra. Their settings were chosen by how well
they know acted takes of contents held out, before any edit was shown to them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np
from acted import NEUTRAL
from sklearn.discriminant_analysis import LinearDiscriminantAnalysis
from sklearn.kernel_ridge import KernelRidge

from mien.typing import Array

Difference = Mapping[str, float]

SHRINKAGE = 0.4  # of the covariance towards the mean variance
RIDGE, WIDTH, SHARP = 0.1, 1.0, 8.0  # of the kernel: penalty, inverse width over features, scores to logits


def _filled(differences: Sequence[Difference], names: Sequence[str]) -> Array:
    """Return rows of numbers; what a skeleton has no joint for has not changed."""
    return np.array([[d.get(name, 0.0) for name in names] for d in differences])


def _scale(x: Array, visible: Sequence[float]) -> Array:
    """Return the usual size of each feature, and no less than what can be seen."""
    return np.maximum(np.sqrt(np.mean(x * x, axis=0)), visible)


@dataclass
class Planes:
    """Recogniser ``a``."""

    family = "readable"
    names: tuple[str, ...] = ()
    scale: Array = field(default_factory=lambda: np.ones(1))
    model: Any = None

    def fit(self, differences: Sequence[Difference], styles: Sequence[str], visible: Difference) -> Self:
        """Learn from acted differences; ``visible`` says from which size on they can be seen."""
        self.names = tuple(sorted(differences[0]))
        x = _filled(differences, self.names)
        self.scale = _scale(x, [visible[name] for name in self.names])
        self.model = LinearDiscriminantAnalysis(solver="lsqr", shrinkage=SHRINKAGE, priors=_even(styles))
        self.model.fit(x / self.scale, np.array(styles))
        return self

    def judge(self, differences: Sequence[Difference]) -> list[dict[str, float]]:
        """Return the probability of each style for each difference."""
        found = self.model.predict_proba(_filled(differences, self.names) / self.scale)
        return [dict(zip(self.model.classes_.tolist(), row.tolist(), strict=True)) for row in found]

    def weights(self, style: str) -> dict[str, float]:
        """Return what one unit of each feature adds to the logit of a style over that of the others."""
        rows = self.model.coef_ - self.model.coef_.mean(axis=0)
        row = rows[list(self.model.classes_).index(style)] / self.scale
        return dict(zip(self.names, row.tolist(), strict=True))


@dataclass
class Kernel:
    """Recogniser ``b``."""

    family = "geometry"
    names: tuple[str, ...] = ()
    scale: Array = field(default_factory=lambda: np.ones(1))
    styles: tuple[str, ...] = ()
    model: Any = None

    def fit(self, differences: Sequence[Difference], styles: Sequence[str], visible: Difference) -> Self:
        """Learn from acted differences; ``visible`` says from which size on they can be seen."""
        self.names, self.styles = tuple(sorted(differences[0])), tuple(sorted(set(styles)))
        x = _filled(differences, self.names)
        self.scale = _scale(x, [visible[name] for name in self.names])
        wanted = np.array([[float(s == one) for one in self.styles] for s in styles])
        self.model = KernelRidge(alpha=RIDGE, kernel="rbf", gamma=WIDTH / len(self.names))
        self.model.fit(np.tanh(x / self.scale), wanted - wanted.mean(axis=0))
        return self

    def judge(self, differences: Sequence[Difference]) -> list[dict[str, float]]:
        """Return the probability of each style for each difference."""
        x = np.tanh(_filled(differences, self.names) / self.scale)
        logits = SHARP * np.asarray(self.model.predict(x))
        odds = np.exp(logits - logits.max(axis=1, keepdims=True))
        return [dict(zip(self.styles, (row / row.sum()).tolist(), strict=True)) for row in odds]


RECOGNISERS: Mapping[str, type[Planes] | type[Kernel]] = {"a": Planes, "b": Kernel}


def _even(styles: Sequence[str]) -> Array:
    count = len(set(styles))
    return np.full(count, 1.0 / count)


def top(answer: Mapping[str, float], *, neutral: bool = False) -> str:
    """Return the style that is most likely: a forced choice, unless it may be "normal" (``neutral``)."""
    return max((s for s in answer if neutral or s != NEUTRAL), key=lambda style: answer[style])


def self_test() -> None:
    """See that both recognisers tell differences of known truth, and nothing from something."""
    random = np.random.default_rng(5)
    names = [f"feature {i}" for i in range(30)]
    truth = {style: random.normal(size=30) for style in ("one", "two", "three")} | {NEUTRAL: np.zeros(30)}

    def example(style: str, strength: float = 1.0) -> Difference:
        noise = random.normal(size=30) * (0.1 if style == NEUTRAL else 0.4)
        return dict(zip(names, (strength * truth[style] + noise).tolist(), strict=True))

    styles = [style for style in truth for _ in range(6)]
    for name, kind in RECOGNISERS.items():
        recogniser = kind().fit([example(s) for s in styles], styles, dict.fromkeys(names, 0.1))
        shown = [example(s, 1.2) for s in styles]
        right = [top(p, neutral=True) == s for p, s in zip(recogniser.judge(shown), styles, strict=True)]
        assert np.mean(right) > 0.9, (name, np.mean(right))
        assert all(abs(sum(p.values()) - 1.0) < 1e-9 for p in recogniser.judge(shown))
        assert top(recogniser.judge([dict.fromkeys(names, 0.0)])[0], neutral=True) == NEUTRAL, name
        weak = recogniser.judge([{}])[0]
        assert top(weak, neutral=True) == NEUTRAL, "what is missing has not changed"
        print(f"recogniser {name}: {np.mean(right):.2f} of synthetic differences known, chance 0.25")


if __name__ == "__main__":
    self_test()
