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
    """Return two columns of two words each; the walk they are made from is the ghost."""
    walk = mien.apply(samples.walk().motion, [mien.Step("trim", {"end": 2.0})])
    columns = [
        render.compare({w: mien.edit(walk, w) for w in words}, against=walk, poses=3, width=800)
        for words in (WORDS[:2], WORDS[2:])
    ]
    sheet = Image.new("RGB", (1600, max(c.height for c in columns)), columns[0].getpixel((0, 0)))
    for number, column in enumerate(columns):
        sheet.paste(column, (800 * number, 0))
    return sheet


if __name__ == "__main__":
    picture().quantize(128).save(TARGET, optimize=True)
    print(f"wrote {TARGET.relative_to(ROOT)}, {TARGET.stat().st_size / 1000:.0f} kB")
