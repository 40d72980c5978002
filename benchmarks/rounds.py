"""Who learns from what and is judged on what, so that nobody is asked about what he has seen."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from acted import NEUTRAL, Take, held_out
from clip_features import difference, visible
from looks import Job, Look
from methods import METHODS, Method, Pairs
from recognisers import RECOGNISERS, Difference, Kernel, Planes

Recogniser = Planes | Kernel


@dataclass(frozen=True)
class Round:
    """The recogniser learns from the acted ``pairs``, a method that learns from ``contents``."""

    pairs: tuple[tuple[Take, Take], ...]
    contents: tuple[str, ...]
    acted: tuple[tuple[Take, Take], ...]
    neutral: tuple[Take, ...]


@dataclass
class Verdict:
    """What was intended, what the recogniser answered, and what it was shown.

    ``near``: the ``word`` asked for only comes near to the style.
    """

    style: str
    word: str
    take: Take
    answer: Mapping[str, float]
    shown: Difference
    weights: Mapping[str, float] = field(default_factory=dict)
    failed: tuple[str, ...] = ()
    near: bool = False


def rounds(pairs: Pairs, neutral: Sequence[Take], *, learns: bool, shared: bool, strict: bool) -> list[Round]:
    """Return the rounds that judge ``neutral`` takes: each content in turn is held out of all learning.

    Neutral takes of other sets are judged by a recogniser that learned from every content. If the method
    learns too, it has one half of the contents and the recogniser the other, and then the other way round;
    or, ``shared``, both have all that are not held out.
    """
    known = {held_out(t.content, strict=strict) for t, _ in pairs}
    out = []
    for name in sorted({_name(take, strict) for take in neutral}):
        judged = tuple(t for t in neutral if _name(t, strict) == name)
        contents = sorted(known - {name})
        halves = [contents[::2], contents[1::2]]
        plans = [halves, halves[::-1]] if learns and not shared else [[contents, contents if learns else []]]
        for mine, theirs in plans:
            out.append(
                Round(
                    tuple(p for p in pairs if held_out(p[0].content, strict=strict) in mine),
                    tuple(
                        sorted({t.content for t, _ in pairs if held_out(t.content, strict=strict) in theirs})
                    ),
                    tuple(p for p in pairs if held_out(p[0].content, strict=strict) == name),
                    judged,
                )
            )
    return out


def _name(take: Take, strict: bool) -> str:
    """Return the content as it is held out, or one name for everything that nobody acted."""
    return held_out(take.content, strict=strict) if take.source.startswith("dataset-") else "other sets"


def jobs(found: Sequence[Round], name: str, asks: Sequence[tuple[str, str]]) -> list[Job]:
    """Return the edits to be made, and every take that is needed."""
    out = []
    for one in found:
        out += [Job(take) for pair in one.pairs + one.acted for take in pair] + [Job(t) for t in one.neutral]
        out += [_edit(name, take, word, one) for take in one.neutral for _, word in asks]
    return out


def _edit(name: str, take: Take, word: str, one: Round) -> Job:
    return Job(take, name, word, one.contents if METHODS[name].learn else ())


def taught(kind: str, pairs: Pairs, looks: Mapping[Job, Look]) -> Recogniser:
    """Return a recogniser that learned from acted takes, and from neutral ones that nothing was changed."""
    recogniser = RECOGNISERS[kind]()
    family = recogniser.family
    shown = [difference(looks[Job(a)].whole[family], looks[Job(n)].whole[family]) for a, n in pairs]
    styles = [take.style for take, _ in pairs]
    for take in sorted({n for _, n in pairs}, key=lambda t: str(t.path)):
        look = looks[Job(take)]
        for cut in (look.whole, *look.cuts):
            shown.append(difference(cut[family], look.whole[family]))
            styles.append(NEUTRAL)
    return recogniser.fit(shown, styles, visible(looks[Job(pairs[0][1])].whole[family]))


def judge(
    found: Sequence[Round], name: str, method: Method, kind: str, looks: Mapping[Job, Look], *, near: bool
) -> tuple[list[Verdict], list[Verdict]]:
    """Return the verdicts on acted takes and on edits, all by the same recognisers."""
    acted, edited = [], []
    for one in found:
        recogniser = taught(kind, one.pairs, looks)
        acted += _verdicts(recogniser, [(t.style, "", Job(t), n) for t, n in one.acted], looks)
        asked = [(s, w, _edit(name, t, w, one), t) for t in one.neutral for s, w in method.asks(near=near)]
        edited += _verdicts(recogniser, asked, looks, method.words)
    return acted, edited


def _verdicts(
    recogniser: Recogniser,
    asked: Sequence[tuple[str, str, Job, Take]],
    looks: Mapping[Job, Look],
    words: Mapping[str, str] | None = None,
) -> list[Verdict]:
    shown = [
        difference(looks[job].whole.get(recogniser.family, {}), looks[Job(take)].whole[recogniser.family])
        for _, _, job, take in asked
    ]
    answers = recogniser.judge(shown) if shown else []
    return [
        Verdict(
            style,
            word,
            take,
            answer,
            seen,
            _weights(recogniser, style),
            looks[job].failed,
            bool(word) and word != (words or {}).get(style),
        )
        for (style, word, job, take), answer, seen in zip(asked, answers, shown, strict=True)
    ]


def _weights(recogniser: Recogniser, style: str) -> Mapping[str, float]:
    return recogniser.weights(style) if isinstance(recogniser, Planes) else {}
