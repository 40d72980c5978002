"""Does it work? Recognisers in place of people judge actors' clips and mien's edits of neutral clips.

Run: python benchmarks/effect.py [--method s0,default] [--recogniser a,b] [--input acted,cmu,xia,reactidle]
     python benchmarks/effect.py --acted           what actors do in each style, in degrees and factors
     python benchmarks/effect.py --why sad,angry   by which features the edits fall short of the actors

As in figures 33 to 36 of the thesis (Förger 2011), with recognisers instead of viewers. Each content (walk,
run, bow, ...) in turn is held out: a recogniser learns, from the other contents, what actors have that
their neutral takes have not; then it judges (a) the actors' takes of the content held out, (b) edits of its
neutral takes. Clips of other sets and skeletons, and of contents nobody acted ("unseen"), are judged by a
recogniser that learned from all contents. Answers are one of 14 styles or "normal", so chance is 0.07. The
clips are those of ``MIEN_DATA``; what was computed is kept in the system's temporary folder. ``--contents``
limits what is judged, shown and explained, so that presets can be worked on with some contents and judged
on others.
"""

import argparse
import os
import sys
import time

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):  # one process a core, and no more threads than that
    os.environ.setdefault(_name, "1")

import clip_features  # noqa: E402
import effect_tables as tables  # noqa: E402
import numpy as np  # noqa: E402
import recognisers  # noqa: E402
from acted import INPUTS, NEUTRAL, STYLES, Take, inputs, pairs, takes  # noqa: E402
from clip_features import Feature, difference  # noqa: E402
from looks import Features, Job, Look, look_at  # noqa: E402
from methods import METHODS, Pairs  # noqa: E402
from rounds import Verdict, jobs, judge, rounds  # noqa: E402


def judged(
    options: argparse.Namespace, kind: str, learned: Pairs, neutral: list[Take]
) -> tuple[list[Verdict], dict[str, list[Verdict]]]:
    """Return the verdicts of a recogniser on the actors and on each method."""
    acted: list[Verdict] = []
    edited = {}
    for name in options.method:
        method = METHODS[name]
        learns = method.learn is not None
        plan = rounds(learned, neutral, learns=learns, shared=options.shared, strict=options.strict)
        looks = look_at(jobs(plan, name, method.asks(near=options.near)), learned)
        shown, edited[name] = judge(plan, name, method, kind, looks, near=options.near)
        if learns and not options.shared and shown:
            known = np.mean([tables.hits([v for v in shown if v.style == s])[0] for s in STYLES])
            print(
                f"Sharing the contents with `{name}`, recogniser {kind} knows {known:.2f} of the actors'.\n"
            )
        else:
            acted = acted or shown
    return acted, edited


def report(options: argparse.Namespace, learned: Pairs, source: str, neutral: list[Take]) -> None:
    """Print the tables of one kind of input."""
    for kind in options.recogniser:
        print(f"## Recogniser {kind}, edits of {len(neutral)} neutral clips: {source}\n")
        acted, edited = judged(options, kind, learned, neutral)
        tables.by_style(acted, edited)
        if options.confusion:
            for name, verdicts in (({"acted": acted} if acted else {}) | edited).items():
                tables.confusion(name, verdicts)
        for name, verdicts in edited.items():
            tables.near(name, verdicts)
    tables.failures(edited)


def what_actors_do(options: argparse.Namespace, learned: Pairs) -> None:
    """Print the table of acted differences."""
    looks = look_at([Job(t) for pair in learned for t in pair], learned)
    some = [(a, n) for a, n in learned if not options.contents or a.content in options.contents]
    shown: dict[str, list[dict[str, float]]] = {style: [] for style in STYLES}
    for take, neutral in some:
        found = difference(_readable(looks, take), _readable(looks, neutral))
        found["duration"] = float(np.log(looks[Job(take)].seconds / looks[Job(neutral)].seconds))
        shown[take.style].append(found)
    features = {name: feature for name, (_, feature) in _readable(looks, learned[0][1]).items()}
    features["duration"] = Feature("s", ratio=True)
    contents = sorted({a.content for a, _ in some})
    print(f"What actors change from neutral: mean and standard deviation over {', '.join(contents)}.")
    print("Angles in degrees; lengths in % of a leg; ranges, speeds, jerk and tempo as factors.\n")
    tables.acted_table(shown, features, everything=options.all)


def _readable(looks: dict[Job, Look], take: Take) -> Features:
    return looks[Job(take)].whole["readable"]


def explain(options: argparse.Namespace, learned: Pairs, neutral: list[Take]) -> None:
    """Print why edits are not known, by recogniser a."""
    acted, edited = judged(options, "a", learned, neutral)
    looks = look_at([Job(learned[0][1])], learned)
    features = {name: feature for name, (_, feature) in _readable(looks, learned[0][1]).items()}
    for name, verdicts in edited.items():
        for style in options.why:
            mine = [v for v in verdicts if v.style == style]
            if mine:
                print(f"## `{name}` asked for {mine[0].word}\n")
                tables.why(style, [v for v in acted if v.style == style], mine, features)
            else:
                print(f"`{name}` has no {style}\n")


def parsed() -> argparse.Namespace:
    """Return the options."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    many = {"type": lambda text: text.split(",")}
    parser.add_argument("--method", **many, default=["s0", "default"], help=", ".join(METHODS))
    parser.add_argument("--recogniser", **many, default=["a", "b"], help="a, b")
    parser.add_argument("--input", **many, default=["acted"], help=f"acted, {', '.join(INPUTS)}")
    parser.add_argument("--contents", **many, default=[], help="only these: walk, run, bow, ...")
    parser.add_argument("--strict", action="store_true", help="hold out with a content those much like it")
    parser.add_argument(
        "--shared", action="store_true", help="recogniser and method learn from the same takes"
    )
    parser.add_argument("--near", action="store_true", help="judge also words that only come near to a style")
    parser.add_argument(
        "--no-confusion", dest="confusion", action="store_false", help="no confusion matrices"
    )
    parser.add_argument("--quick", action="store_true", help="recogniser a, three contents, no matrices")
    parser.add_argument("--acted", action="store_true", help="print what actors do instead")
    parser.add_argument("--all", action="store_true", help="every feature in that table")
    parser.add_argument("--why", **many, default=[], help="styles to explain, or all")
    parser.add_argument("--self-test", action="store_true", help="try the recognisers on what is known")
    options = parser.parse_args()
    for given, known in ((options.method, METHODS), (options.recogniser, recognisers.RECOGNISERS)):
        if wrong := [name for name in given if name not in known]:
            parser.error(f"{', '.join(wrong)}: there is only {', '.join(known)}")
    if wrong := [name for name in options.input if name != "acted" and name not in INPUTS]:
        parser.error(f"{', '.join(wrong)}: there is only acted, {', '.join(INPUTS)}")
    if options.quick:
        options.recogniser, options.confusion = options.recogniser[:1], False
        options.contents = options.contents or ["walk", "bow", "guide"]
    options.why = list(STYLES) if options.why == ["all"] else options.why
    return options


def main() -> None:
    """Run it."""
    options = parsed()
    start = time.perf_counter()
    if options.self_test:
        clip_features.self_test()
        recognisers.self_test()
        return
    everything = takes()
    learned = pairs(everything)
    if options.acted:
        what_actors_do(options, learned)
        return
    neutral = [t for t in everything if t.style == NEUTRAL]
    neutral = [t for t in neutral if not options.contents or t.content in options.contents]
    if options.why:
        explain(options, learned, neutral)
        return
    for source in options.input:
        report(options, learned, source, neutral if source == "acted" else inputs([source]))
    print(f"{time.perf_counter() - start:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
