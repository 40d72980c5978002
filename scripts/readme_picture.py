"""Make the one picture that is kept in the repository: ``python scripts/readme_picture.py``.

One walk, four emotion words: what the README shows. It is written with few colours to stay small.
"""

from pathlib import Path

from PIL import Image

import mien
from mien import render, samples

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "docs" / "walk.png"
WORDS = ("sad", "afraid", "strong", "proud")


def picture() -> Image.Image:
    """Return one row for each word; the walk they are made from is the ghost."""
    walk = mien.apply(samples.walk().motion, [mien.Step("trim", {"end": 2.0})])
    rows = {word: mien.edit(walk, word) for word in WORDS}
    return render.compare(rows, against=walk, poses=6, width=1400)


if __name__ == "__main__":
    picture().quantize(128).save(TARGET, optimize=True)
    print(f"wrote {TARGET.relative_to(ROOT)}, {TARGET.stat().st_size / 1000:.0f} kB")
