"""An edit that cannot break a body: edit, check, repair, and where that is not enough, less of the edit.

What counts is ``mien check`` against the motion before the edits. The steps that make an edit safe are plain
steps of its history: ``repair``, then ``restore`` for the parts and times that still need it, by thirds, and
``foot_plant`` where legs were restored. So a history replays without looking again.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from ..analysis.checks.report import Report, compare_scenes, measured
from ..analysis.checks.scene import Scene
from ..curve import evaluate, is_curve
from ..edits import pipeline
from ..kinematics.contacts import spans
from ..motion import Motion
from ..recipe import Step
from ..typing import Array, Mask, Progress, untold

LIMBS = ("head", "torso", "left_arm", "right_arm", "left_leg", "right_leg")
THIRD = 1.0 / 3.0
AROUND = 0.1  # seconds before and after a failure in which the original comes back too; more in each round
# Of forces: what brings the original back too quickly needs forces itself.
AROUND_FORCES: Mapping[str, float] = dict.fromkeys(("balance", "torque", "ground", "flight"), 0.4)
RAMP = 0.3  # seconds from the edit to the original and back
RAMP_BODY = 0.8  # of trunk and legs, whose weight needs forces
ROUNDS = 12
TOLD = 3  # stretches of time that are told one by one
LAST = "last resort"
# What a name in a finding belongs to. A leg alone cannot be restored: hips and feet say where it is.
ARM = ("hand", "wrist", "forearm", "upper_arm", "elbow", "shoulder", "clavicle")
HEAD = ("head", "neck")


def safe(motion: Motion, *, progress: Progress = untold) -> Motion:
    """Return an edited motion that no check finds worse than its original, beyond what a check allows.

    A motion that passes, or has no edits, comes back as it is. Else its history has the steps that were
    needed (``mended`` tells them). ``progress`` is told each check and round of mending before it begins; how
    many rounds there will be nobody knows. Raises ``BodyError`` where no body is found.
    """
    if motion.reference is None or not motion.history:
        return motion
    return _Search(motion, motion.reference, progress).run()


def mended(motion: Motion) -> tuple[str, ...]:
    """Return in words how much of an edit was taken back to keep the body whole, and why."""
    said = []
    for step in motion.history:
        if step.edit != "restore" or not step.parameters["why"]:
            continue
        if step.parameters["why"] == LAST:
            said.append(f"the whole body: {100 * step.parameters['amount']:.0f} % of the original all along")
        elif is_curve(step.parameters["amount"]):
            curve = step.parameters["amount"]
            most = max(amount for _, amount in curve)
            what = "the whole body" if set(step.parts) >= set(LIMBS) else " and ".join(step.parts)
            said.append(
                f"{what.replace('_', ' ')}: up to {100 * most:.0f} % of the original {_when(curve)} "
                f"({step.parameters['why']})"
            )
    if said and _share(motion) > 0.5:
        said.append("most of this edit was taken back; --no-safe keeps it, with what breaks")
    return tuple(said)


def _when(curve: Sequence[tuple[float, float]]) -> str:
    """Say when a curve of (seconds, amount) is above 0: the first stretches, and how many more."""
    times, amounts = np.array(curve).T
    ends = [(times[max(a - 1, 0)], times[min(b, len(times) - 1)]) for a, b in spans(amounts > 0.0)]
    told = ", ".join(f"{start:.1f} to {stop:.1f}" for start, stop in ends[:TOLD])
    return f"at {told} s" + (f" and {len(ends) - TOLD} more times" if len(ends) > TOLD else "")


def _share(motion: Motion) -> float:
    """Return how much of the original came back, mean over limbs and time."""
    steps = (s for s in motion.history if s.edit == "restore" and s.parameters["why"])
    return sum(
        float(np.mean(evaluate(s.parameters["amount"], motion.times))) * len(s.parts or LIMBS) / len(LIMBS)
        for s in steps
    )


class _Search:
    """What is looked for and what is known of it: how much of the original each limb needs, and when."""

    def __init__(self, motion: Motion, original: Motion, progress: Progress) -> None:
        self.motion = self.base = motion
        self.original, self.progress = original, progress
        progress("checking the original", 0.0)
        self.source = Scene.of(original)
        self.known = measured(self.source)
        self.plants = [Step(s.edit, s.parameters) for s in motion.history if s.edit == "foot_plant"][-1:]
        self.amounts = {limb: np.zeros(len(motion)) for limb in LIMBS}
        self.why: dict[str, set[str]] = {limb: set() for limb in LIMBS}

    def run(self) -> Motion:
        """Return the safe motion."""
        self.progress("checking", 0.4)
        report = self.check(self.motion)
        if not report.failed:
            return self.motion
        self.progress("mending", None)
        self.base = pipeline.apply(self.motion, [Step("repair")])
        if severity(self.check(self.base)) > severity(report):
            self.base = self.motion
        for turn in range(ROUNDS):
            self.progress(f"mending, round {turn + 1}", None)
            out = self.restored()
            report = self.check(out)
            if not report.failed:
                return out
            self.more(report, turn + 1)
        return self.reverted()

    def reverted(self) -> Motion:
        """Return the motion reverted as a whole, by as little as it can be: the last resort."""
        for share in (THIRD, 2.0 * THIRD):
            back = Step("restore", {"amount": share, "travel": True, "why": LAST})
            out = pipeline.apply(self.motion, [back, *self.plants])
            if not self.check(out).failed:
                return out
        return pipeline.apply(self.motion, [Step("restore", {"amount": 1.0, "travel": True, "why": LAST})])

    def check(self, motion: Motion) -> Report:
        """Return what is wrong; feet that slide or sink only count where they were put back on the floor."""
        names = [n for n in self.known if self.plants or n not in ("foot_slide", "floor")]
        scene = Scene.of(motion, source=self.source)
        return compare_scenes(scene, self.source, only=names, known=self.known)

    def restored(self) -> Motion:
        """Return the motion with so much of the original as is known to be needed."""
        groups: dict[bytes, list[str]] = {}
        for limb, amount in self.amounts.items():
            if amount.any():
                groups.setdefault(amount.tobytes(), []).append(limb)
        steps = []
        for limbs in groups.values():
            why = ", ".join(sorted(set().union(*(self.why[limb] for limb in limbs))))
            ramp = RAMP_BODY if "torso" in limbs else RAMP
            curve = _keys(self.amounts[limbs[0]], self.motion, ramp)
            steps.append(Step("restore", {"amount": curve, "why": why}, parts=tuple(limbs)))
        if self.plants and any({"torso", "left_leg", "right_leg"} & set(step.parts) for step in steps):
            steps += self.plants
        return pipeline.apply(self.base, steps) if steps else self.base

    def more(self, report: Report, turn: int) -> None:
        """Ask for a third more of the original where a check fails; of all limbs once its own are used."""
        add = {limb: np.zeros(len(self.motion), bool) for limb in LIMBS}
        start = len(self.motion) - len(report.times)
        for finding in (f for f in report.findings if not f.passed):
            around = AROUND_FORCES.get(finding.check.name, AROUND) * turn
            reach = round(around / self.motion.frame_time)
            for name, over in zip(finding.parts, finding.over.T, strict=True):
                bad = _wider(np.concatenate([np.zeros(start, bool), over > 0.0]), reach)
                own = limbs_of(name)
                used = np.min([self.amounts[limb] for limb in own], axis=0) > 1.0 - 1e-9
                for limb in LIMBS:
                    here = bad if limb in own else np.logical_and(bad, used)
                    add[limb] |= here
                    self.why[limb] |= {finding.check.name} if here.any() else set()
        for limb, more in add.items():
            self.amounts[limb] = np.minimum(self.amounts[limb] + THIRD * more, 1.0)


def severity(report: Report) -> float:
    """Return how wrong a motion is in all: what is too much, in tolerances, summed over parts and time."""
    failed = (f for f in report.findings if not f.passed)
    return float(sum(np.maximum(f.over, 0.0).sum() / f.check.tolerance for f in failed))


def limbs_of(name: str) -> tuple[str, ...]:
    """Return the limbs to restore for a part that a check names; of pairs, those of both."""
    found: dict[str, None] = {}
    for one in name.split("-"):
        plain = one.removeprefix("left_").removeprefix("right_")
        side = one[: -len(plain)] if plain != one else ""
        if plain in HEAD:
            found["head"] = None
        elif plain in ARM:
            found[f"{side}arm"] = None
        elif plain in ("chest", "belly", "spine"):
            found["torso"] = None
        elif plain == "place":
            found |= dict.fromkeys(LIMBS)
        else:  # of a leg or a foot
            found |= dict.fromkeys(("torso", "left_leg", "right_leg"))
    arms = {limb: None for limb in found if limb.endswith("arm")}
    # An arm in the trunk is the arm's: the trunk comes back when that is not enough.
    return tuple(arms if arms and "-" in name else found)


def _wider(mask: Mask, frames: int) -> Mask:
    from scipy.ndimage import maximum_filter1d

    return maximum_filter1d(mask, 2 * frames + 1, mode="nearest")


def _keys(amount: Array, motion: Motion, ramp: float) -> tuple[tuple[float, float], ...]:
    """Return the curve over ``amount`` (T,), with ramps to both sides, as ``(seconds, amount)``."""
    frames = np.arange(len(amount))
    slope = motion.frame_time / ramp
    up = np.maximum.accumulate(amount + slope * frames) - slope * frames
    down = np.maximum.accumulate((amount - slope * frames)[::-1])[::-1] + slope * frames
    ramped = np.maximum(np.maximum(up, down), 0.0)
    corner = np.ones(len(ramped), bool)
    corner[1:-1] = np.abs(np.diff(ramped, n=2)) > 1e-9
    return tuple(
        (round(float(motion.times[i]), 4), round(float(ramped[i]), 4)) for i in np.flatnonzero(corner)
    )
