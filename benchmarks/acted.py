"""The takes that the recognisers learn from, and neutral clips of other sets: read from ``MIEN_DATA``.

Actors did the same content in 14 styles and neutrally (Bandai Namco Research Motion Dataset, CC BY-NC 4.0:
what is learned from it here stays here).
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import mien

DATA = Path(os.environ.get("MIEN_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))
NEUTRAL = "normal"
STYLES = (
    "active",
    "angry",
    "childish",
    "chimpira",
    "feminine",
    "giant",
    "happy",
    "masculinity",
    "musical",
    "not-confident",
    "old",
    "proud",
    "sad",
    "tired",
)

# The second set's words for the same ideas; its "youthful" is none of the first's.
SAME = {
    "active": "active",
    "elderly": "old",
    "exhausted": "tired",
    "feminine": "feminine",
    "masculine": "masculinity",
    NEUTRAL: NEUTRAL,
}
# Contents so alike that, by ``--strict``, none is held out without the other.
KIN = {"walk-left": "walk", "wave-right-hand": "bye"}

# Neutral takes of other people on other skeletons: file -> seconds from where to where.
CMU = ("02_01", "05_01", "07_01", "10_04", "12_01", "09_01", "09_03", "10_01", "13_09")
IDLES = ("000_genuine", "007_genuine", "001_acted", "007_acted")
INPUTS = {
    "cmu": {f"cmu_daz/{name}": (0.0, 8.0) for name in CMU},
    "xia": {"xia/neutral_01_000": (0.0, 8.0), "xia/neutral_16_000": (0.0, 8.0)},
    "reactidle": {f"reactidle/{name}": (2.0, 14.0) for name in IDLES},
}
# Contents that nobody acted in styles: unseen by every recogniser and every method.
ALONE = ("call", "dance-short", "kick", "punch", "respond", "slash")
INPUTS["unseen"] = {f"bandai1/dataset-1_{name}_normal_001": (0.0, 8.0) for name in ALONE}


@dataclass(frozen=True)
class Take:
    """One clip: ``path``, what is done in it, in which style, of which set.

    ``span`` in seconds, if it is cut; ``neutral``, the neutral clip of an acted one.
    """

    path: Path
    content: str
    style: str
    source: str
    span: tuple[float, float] | None = None
    neutral: Path | None = None

    def load(self) -> mien.Motion:
        """Read it; of a CMU clip without its first frame, which is no movement but a T-pose."""
        motion = mien.load(self.path, salvage=True)
        if self.span is None:
            return motion
        first = max(round(self.span[0] * motion.fps), 1 if self.source == "cmu" else 0)
        return motion[first : round(self.span[1] * motion.fps)]


def takes() -> list[Take]:
    """Return every take of a content that was acted in styles, the neutral ones with them."""
    out = []
    for path in sorted(DATA.glob("bandai[12]/*.bvh")):
        source, content, word, _ = path.stem.split("_")
        style = word if source.endswith("1") else SAME.get(word)
        if style is not None and content not in ALONE:
            found = sorted(path.parent.glob(f"{source}_{content}_{NEUTRAL}_*.bvh"))
            out.append(Take(path, content, style, source, neutral=None if style == NEUTRAL else found[0]))
    if not out:
        raise SystemExit(f"no acted clips in {DATA}: MIEN_DATA must name a folder with bandai1 and bandai2")
    return out


def inputs(names: Sequence[str]) -> list[Take]:
    """Return the neutral clips of other sets."""
    return [
        Take(DATA / f"{name}.bvh", name, NEUTRAL, source, span)
        for source in names
        for name, span in INPUTS[source].items()
        if (DATA / f"{name}.bvh").exists()
    ]


def pairs(found: Sequence[Take]) -> list[tuple[Take, Take]]:
    """Return each acted take with the neutral one of the same set and content."""
    neutral = {(t.source, t.content): t for t in found if t.style == NEUTRAL}
    return [(t, neutral[t.source, t.content]) for t in found if t.style != NEUTRAL]


def held_out(content: str, *, strict: bool) -> str:
    """Return the name under which a content is held out."""
    return KIN.get(content, content) if strict else content
