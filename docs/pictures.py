"""Make the pictures of the documentation: ``python docs/pictures.py``."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import mien
from mien import Motion, Step, render, samples

if TYPE_CHECKING:
    from PIL.Image import Image

HERE = Path(__file__).resolve().parent


def walk(*, fps: float = 60.0) -> Motion:
    """Return the walk that most pictures show: two seconds of it."""
    return mien.apply(samples.walk(fps=fps).motion, [Step("trim", {"end": 2.0})])


def done(motion: Motion, *steps: Step) -> Motion:
    """Return the motion after some steps, feet put back on the floor."""
    return mien.apply(motion, [*steps, Step("foot_plant")])


def path_length() -> "Image":
    """Shorter and longer paths."""
    calm = walk()
    rows = {f"mid {m:g}": done(calm, Step("path_length", {"mid": m})) for m in (0.4, 1.0, 1.5)}
    return render.compare(rows, against=calm)


def posture() -> "Image":
    """Head and trunk down; elbows and feet apart."""
    calm = walk()
    rows = {
        "head 25, trunk 10": done(calm, Step("posture", {"head": 25, "trunk": 10})),
        "arms 20, elbows 10, legs 4": done(calm, Step("posture", {"arms": 20, "elbows": 10, "legs": 4})),
    }
    return render.compare(rows, against=calm)


def timing() -> "Image":
    """Show two strokes of a wave: even, as it was, and rushed."""
    strokes = Step("trim", {"start": 1.2, "end": 2.4})
    wave = samples.wave().motion
    rows = {
        f"acceleration {a:g}": mien.apply(wave, [Step("timing", {"acceleration": a}), strokes])
        for a in (-0.8, 0.0, 0.8)
    }
    return render.compare(rows, poses=12, views=["front"])


def foot_plant() -> "Image":
    """Show one step with shorter paths, seen by a camera that stays: without and with the repair."""
    short = mien.apply(walk(), [Step("path_length", {"mid": 0.4})])
    step = Step("trim", {"start": 0.75, "end": 1.15})
    rows = {"without foot_plant": short, "with foot_plant": mien.apply(short, [Step("foot_plant")])}
    return below(
        *(
            render.strip(mien.apply(m, [step]), travel=True, views=["side"], poses=4, title=title)
            for title, m in rows.items()
        )
    )


def trim() -> "Image":
    """Show the first second."""
    calm = walk()
    return render.compare({"all": calm, "trimmed": mien.apply(calm, [Step("trim", {"end": 1.0})])})


def resample() -> "Image":
    """Sixty and twelve frames a second: the same poses."""
    calm = walk()
    slow = mien.apply(calm, [Step("resample", {"fps": 12})])
    return render.compare({"60 frames a second": calm, "12 frames a second": slow})


def mirror() -> "Image":
    """Show a wave and its mirror image."""
    wave = samples.wave().motion
    return render.compare({"wave": wave, "mirrored": mien.apply(wave, [Step("mirror")])}, views=["front"])


def in_place() -> "Image":
    """Show a walk from one camera, and the same in place."""
    calm = walk()
    still = mien.apply(calm, [Step("in_place")])
    return below(*(render.strip(m, travel=True, views=["side"], poses=5) for m in (calm, still)))


def presets() -> "Image":
    """Every emotion word, over the walk it was made from."""
    calm = walk()
    words = [name for name in mien.PRESETS if "/" not in name]
    columns = [words[i : i + 5] for i in range(0, len(words), 5)]
    made = [{w: mien.edit(calm, w) for w in column} for column in columns]
    return beside(*(render.compare(rows, against=calm, poses=3, width=1000) for rows in made))


def blend() -> "Image":
    """Two walks, what lies between and beyond, and the posture of one on the movement of the other."""
    clips = [samples.walk(seconds=3.0).motion, samples.tired_walk(seconds=4.0).motion]
    bands = {"low": [0.0, 1.0], "mid": [1.0, 0.0], "high": [1.0, 0.0]}
    rows = {f"{1 - w:g} calm, {w:g} tired": mien.blend(clips, [1 - w, w]) for w in (0.0, 0.5, 1.0, 1.3)}
    rows["posture tired, movement calm"] = mien.blend(clips, None, bands=bands)
    return render.compare(rows, views=["side"], poses=8)


def beside(*images: "Image") -> "Image":
    """Return pictures in one row."""
    from PIL import Image

    sheet = Image.new(
        "RGB", (sum(i.width for i in images), max(i.height for i in images)), images[0].getpixel((0, 0))
    )
    for number, image in enumerate(images):
        sheet.paste(image, (sum(i.width for i in images[:number]), 0))
    return sheet


def below(*images: "Image") -> "Image":
    """Return pictures in one column."""
    from PIL import Image

    sheet = Image.new(
        "RGB", (max(i.width for i in images), sum(i.height for i in images)), images[0].getpixel((0, 0))
    )
    for number, image in enumerate(images):
        sheet.paste(image, (0, sum(i.height for i in images[:number])))
    return sheet


PICTURES: Mapping[str, Callable[[], "Image"]] = {
    **{f"methods/{f.__name__}": f for f in (path_length, posture, timing, foot_plant)},
    **{f"methods/{f.__name__}": f for f in (trim, resample, mirror, in_place)},
    "presets": presets,
    "blend": blend,
}


def make_all(folder: Path) -> None:
    """Write every picture into a folder."""
    for name, make in PICTURES.items():
        file = folder / f"{name}.png"
        file.parent.mkdir(parents=True, exist_ok=True)
        make().save(file, optimize=True)


if __name__ == "__main__":
    make_all(HERE / "_static")
