"""The tables of ``effect.py``, in Markdown."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from acted import NEUTRAL, STYLES
from clip_features import Feature
from recognisers import top
from rounds import Verdict


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print one."""
    print(f"| {' | '.join(head)} |\n| --- |{' ---: |' * (len(head) - 1)}")
    for row in rows:
        print(f"| {' | '.join(row)} |")
    print()


def hits(verdicts: Sequence[Verdict]) -> tuple[float, ...]:
    """Return how well something is known.

    The share known as intended when one of the 14 must be chosen; when "normal" may be chosen too; the mean
    probability of the intended, with "normal" among the answers; the share failing a check.
    """
    forced = [top(v.answer) == v.style for v in verdicts]
    free = [top(v.answer, neutral=True) == v.style for v in verdicts]
    chance = [v.answer[v.style] for v in verdicts]
    failed = [bool(v.failed) for v in verdicts]
    return tuple(float(np.mean(x)) for x in (forced, free, chance, failed))


def by_style(acted: Sequence[Verdict], methods: Mapping[str, Sequence[Verdict]]) -> None:
    """Print what is known of each style: acted, then by each method; below, the means."""
    head = ["style", *(["acted: top-1", "of 15", "p"] if acted else [])]
    for name in methods:
        head += [f"{name}: top-1", "of 15", "p", "fails a check"]
    rows, kept = [], {name: dict[str, tuple[float, ...]]() for name in methods}
    shown = {s: hits([v for v in acted if v.style == s]) for s in STYLES} if acted else {}
    for style in STYLES:
        row = [style, *(f"{x:.2f}" for x in shown[style][:3])] if acted else [style]
        for name, verdicts in methods.items():
            some = [v for v in verdicts if v.style == style and not v.near]
            if some:
                kept[name][style] = hits(some)
            row += [f"{x:.2f}" for x in kept[name][style]] if some else ["", "", "", ""]
        rows.append(row)
    for label, whole in (("mean of those it has", False), ("mean of the 14, 0 for those it has not", True)):
        row = [
            label,
            *([f"{np.mean([x[i] for x in shown.values()]):.2f}" for i in (0, 1, 2)] if acted else []),
        ]
        for name in methods:
            row += [f"{_mean(kept[name], i, whole and i < 3):.2f}" for i in range(4)]
        rows.append(row)
    table(head, rows)


def _mean(found: Mapping[str, tuple[float, ...]], at: int, whole: bool) -> float:
    return sum(x[at] for x in found.values()) / max(len(STYLES) if whole else len(found), 1)


def near(name: str, verdicts: Sequence[Verdict]) -> None:
    """Print how words that only come near to a style are read."""
    rows = []
    for style, word in dict.fromkeys((v.style, v.word) for v in verdicts if v.near):
        some = [v for v in verdicts if (v.style, v.word) == (style, word)]
        read = Counter(top(v.answer) for v in some).most_common(3)
        shown = ", ".join(f"{s} {n / len(some):.0%}" for s, n in read)
        rows.append([f"{word}, as {style}", *(f"{x:.2f}" for x in hits(some)), shown])
    if rows:
        print(f"Words of `{name}` that come near, not counted:\n")
        table(["word", "top-1", "of 15", "p", "fails a check", "read as"], rows)


def confusion(title: str, verdicts: Sequence[Verdict]) -> None:
    """Print which style is taken for which, in percent of each intended one."""
    styles = [s for s in STYLES if any(v.style == s for v in verdicts)]
    print(f"{title}: read as, of the 14 (% of each row); last, seen as unchanged\n")
    rows = []
    for style in styles:
        some = [v for v in verdicts if v.style == style and not v.near]
        read = Counter(top(v.answer) for v in some)
        read[NEUTRAL] = sum(top(v.answer, neutral=True) == NEUTRAL for v in some)
        shares = [100 * read[s] / len(some) for s in (*STYLES, NEUTRAL)]
        rows.append([style, *(f"{share:.0f}" if share else "" for share in shares)])
    table(["intended", *(s[:5] for s in (*STYLES, NEUTRAL))], rows)


def failures(methods: Mapping[str, Sequence[Verdict]]) -> None:
    """Print which checks of ``mien check`` fail, in percent of the edits."""
    counts = {name: Counter(f for v in some for f in v.failed) for name, some in methods.items()}
    names = sorted({f for count in counts.values() for f in count})
    if not names:
        print("No edit fails a check.\n")
        return
    rows = [[n, *(f"{100 * counts[m][n] / len(methods[m]):.1f}" for m in methods)] for n in names]
    table(["check, % of edits that fail it", *methods], rows)


# --- in words that people understand

SHOWN = (
    "head down",
    "chest down",
    "pelvis down",
    "trunk forward",
    "shoulders forward",
    "arm forward",
    "arm out",
    "elbow bend",
    "hand height",
    "shoulders up",
    "hip height",
    "knee bend",
    "knee out",
    "toes out",
    "feet apart",
    "head down: range",
    "head turned: range",
    "chest down: range",
    "trunk aside: range",
    "shoulders twisted: range",
    "pelvis turned: range",
    "pelvis tilted: range",
    "hip height: range",
    "arm forward: range",
    "arm out: range",
    "elbow bend: range",
    "thigh forward: range",
    "knee bend: range",
    "feet apart: range",
    "foot height: range",
    "duration",
    "travel",
    "hands: speed",
    "hands: tempo",
    "hands: jerk",
    "feet, from hips: speed",
    "feet, from hips: tempo",
    "feet: jerk",
    "head: speed",
    "head: tempo",
)


def said(value: float, feature: Feature) -> str:
    """Return a difference as people say it: a signed one in its unit, a ratio as a factor."""
    if feature.ratio:
        return f"×{np.exp(value):.2f}"
    return f"{value:+.0f}°" if feature.unit == "degrees" else f"{100 * value:+.0f}%"


def _spread(value: float, feature: Feature) -> str:
    if feature.ratio:
        return f"×/{np.exp(value):.2f}"
    return f"±{value:.0f}" if feature.unit == "degrees" else f"±{100 * value:.0f}"


def acted_table(
    shown: Mapping[str, Sequence[Mapping[str, float]]], features: Mapping[str, Feature], *, everything: bool
) -> None:
    """Print what the actors do in each style, mean and standard deviation over contents.

    Angles in degrees, lengths in percent of a leg, ranges and speeds as factors.
    """
    rows = []
    for name in sorted(features) if everything else SHOWN:
        row = [name]
        for style in STYLES:
            values = [d[name] for d in shown[style]]
            row.append(f"{said(np.mean(values), features[name])} {_spread(np.std(values), features[name])}")
        rows.append(row)
    table(["acted - neutral", *STYLES], rows)


def why(
    style: str, acted: Sequence[Verdict], edited: Sequence[Verdict], features: Mapping[str, Feature]
) -> None:
    """Print the features by which edits fall short of actors: what each costs in the style's logit."""
    names = sorted(features)
    a, e = ({n: np.mean([v.shown.get(n, 0.0) for v in some]) for n in names} for some in (acted, edited))
    weight = {n: np.mean([v.weights[n] for v in acted]) for n in names}
    spread = {n: np.std([v.shown.get(n, 0.0) for v in acted]) for n in names}
    lost = {n: weight[n] * (a[n] - e[n]) for n in names}
    print(f"{style}: acted {hits(acted)[0]:.2f}, edited {hits(edited)[0]:.2f}; read as ", end="")
    print(", ".join(f"{s} {n}" for s, n in Counter(top(v.answer) for v in edited).most_common(4)), "\n")
    rows = []
    for n in [*sorted(names, key=lambda n: -lost[n])[:12], *sorted(names, key=lambda n: lost[n])[:3]]:
        f = features[n]
        rows.append([n, f"{said(a[n], f)} {_spread(spread[n], f)}", said(e[n], f), f"{lost[n]:+.2f}"])
    table(["feature", "actors", "edits", "logit lost"], rows)
