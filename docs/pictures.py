"""Make the pictures of the documentation: ``python docs/pictures.py``."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import mien
from mien import Motion, Step, render, samples
from mien.styles.grid import NINE

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


def control_points() -> "Image":
    """Low, bent and close; hands far from the body."""
    calm = walk()
    places = ("head", "chest", "pelvis")
    hands = {c: {f"{s}_{p}": c for s in ("left", "right") for p in places} for c in (0.7, 1.4)}
    rows = {
        "pelvis 0.93, torso 0.4, hands 0.7": done(
            calm, Step("control_points", {"pelvis": 0.93, "torso": 0.4, **hands[0.7]})
        ),
        "hands 1.4": done(calm, Step("control_points", hands[1.4])),
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


def impacts() -> "Image":
    """Show a foot that comes down, and a knock, softer and harder than they were."""
    clips = ((samples.walk(), {"start": 1.3, "end": 1.7}), (samples.knock(), {"start": 1.25, "end": 1.55}))
    return below(
        *(
            render.compare(
                {
                    f"at impacts, acceleration {a:g}": mien.apply(
                        clip.motion,
                        [Step("timing", {"acceleration": a, "where": "impacts"}), Step("trim", cut)],
                    )
                    for a in (-1.0, 1.0)
                },
                against=mien.apply(clip.motion, [Step("trim", cut)]),
                poses=9,
                views=["side"],
            )
            for clip, cut in clips
        )
    )


def waveshape() -> "Image":
    """Small movement less, small movement more, and a limit."""
    calm = walk()
    rows = {
        "small 0.3": done(calm, Step("waveshape", {"small": 0.3})),
        "small 1.8, large 0.6": done(calm, Step("waveshape", {"small": 1.8, "large": 0.6})),
        "limit 20": done(calm, Step("waveshape", {"limit": 20})),
    }
    return render.compare(rows, against=calm)


def sway() -> "Image":
    """Show a walk whose hips sway more, and one whose shoulders do."""
    calm = walk()
    rows = {
        "hips tilt 2.5": done(calm, Step("sway", {"hips_tilt": 2.5})),
        "shoulders tilt and turn 2.5": done(
            calm, Step("sway", {"shoulders_tilt": 2.5, "shoulders_turn": 2.5})
        ),
    }
    return render.compare(rows, against=calm, views=["front"], poses=10)


def bounce() -> "Image":
    """Show a walk that glides, one that bounces, and somebody who waves and bounces."""
    calm, wave = walk(), samples.wave().motion
    rows = {f"gain {gain:g}": done(calm, Step("bounce", {"gain": gain})) for gain in (0.0, 2.5)}
    waving = {"beat 0.03": done(wave, Step("bounce", {"beat": 0.03}))}
    return below(
        render.compare(rows, against=calm, poses=10, views=["side"]),
        render.compare(waving, against=wave, poses=10, views=["side"]),
    )


def displacement() -> "Image":
    """Show a walk in which the walker glances down, then lifts a hand and looks at it."""
    calm = walk()
    hand = "left_shoulder -40 0 10; left_elbow -75 0 0; neck 8 15 0; head 8 15 0"
    keys = f"0.2 none | 0.6 neck 15 0 0; head 20 0 0 | 1 none | 1.4 {hand} | 1.6 {hand} | 2 none"
    return render.compare(
        {"head down, then a hand up": done(calm, Step("displacement", {"keys": keys}))}, against=calm, poses=8
    )


def tremor() -> "Image":
    """Show a fifth of a second: hands and head shake, hips and legs do not."""
    step = Step("trim", {"start": 0.4, "end": 0.6})
    still = samples.still().motion
    rows = {f"amount {a:g}": mien.apply(still, [Step("tremor", {"amount": a}), step]) for a in (3.0, 8.0)}
    return render.compare(rows, against=mien.apply(still, [step]), poses=6, views=["front"])


def nervous() -> "Image":
    """Show a walk of six seconds whose paths wander, against the even one."""
    calm = samples.walk(seconds=6.0).motion
    steps = [Step("nervous", {"paths": 1.0}), Step("foot_plant")]
    return render.compare(
        {"paths 1": mien.apply(calm, steps)}, against=calm, poses=18, width=1600, views=["side"]
    )


def tempo() -> "Image":
    """Show quick and slow steps at one speed over the ground, against the walk shown at that rate."""
    rows = {}
    for rate in (1.3, 0.8):
        steps = Step("tempo", {"rate": rate, "travel": "speed"})
        rows[f"rate {rate:g}, travel speed"] = mien.apply(walk(), [steps])
    return render.compare(rows, against=walk(), poses=9, views=["side"])


def repair() -> "Image":
    """Show forearms inside the belly, and pushed out of it."""
    calm = samples.still(seconds=3.0).motion
    pose = "left_elbow -80 0 0; left_shoulder 0 -65 0; right_elbow -70 0 0; right_shoulder 0 60 0"
    broken = mien.apply(calm, [Step("displacement", {"keys": f"0 none | 1 {pose} | 2 {pose} | 3 none"})])
    return render.compare({"broken": broken, "mended": mien.apply(broken, [Step("repair")])}, poses=7)


def restore() -> "Image":
    """Show a sad walk whose head is restored for a second."""
    sad = mien.edit(walk(), "sad", safe=False)
    up = Step("restore", {"amount": ((0.5, 0.0), (0.8, 1.0), (1.6, 1.0), (1.9, 0.0))}, parts=("head",))
    return render.compare({"sad": sad, "head restored": mien.apply(sad, [up])}, poses=8, views=["side"])


def grid() -> "Image":
    """Show two strokes of a wave at the corners of the square and in its centre."""
    strokes = Step("trim", {"start": 1.2, "end": 2.4})
    wave = samples.wave().motion
    rows = {
        f"path {p}, timing {q}": mien.apply(wave, [Step("grid", {"path": p, "timing": q}), strokes])
        for p, q in ((0, 2), (2, 2), (1, 1), (0, 0), (2, 0))
    }
    return render.compare(rows, poses=12, views=["front"])


def square() -> "Image":
    """Show one walk at the nine points of the square, as they stand in the thesis's figure."""
    calm = walk()
    made = mien.grid(calm)
    columns = [
        {
            f"{c.letter} ({c.path}, {c.timing}): {c.title}": made.at(c.path, c.timing)
            for c in NINE
            if c.path == p
        }
        for p in range(3)
    ]
    return beside(
        *(render.compare(rows, against=calm, poses=4, width=760, views=["side"]) for rows in columns)
    )


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


def disc() -> "Image":
    """Eight points of the disc: a walk, a wave and a dance moved there, over what they were made from."""
    rim = {
        "valence +": (0.7, 0.0),
        "both +": (0.5, 0.5),
        "arousal +": (0.0, 0.7),
        "unpleasant, intense": (-0.5, 0.5),
        "valence -": (-0.7, 0.0),
        "both -": (-0.5, -0.5),
        "arousal -": (0.0, -0.7),
        "pleasant, calm": (0.5, -0.5),
    }
    sheets = []
    for calm in (walk(), samples.wave().motion, samples.dance(seconds=4.0).motion):
        rows = {name: mien.toward(calm, to=place) for name, place in rim.items()}
        sheets.append(render.compare(rows, against=calm, poses=4, width=800))
    return beside(*sheets)


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
    **{f"methods/{f.__name__}": f for f in (waveshape, nervous, tempo, displacement, tremor, control_points)},
    **{f"methods/{f.__name__}": f for f in (path_length, posture, timing, impacts, grid, foot_plant)},
    **{f"methods/{f.__name__}": f for f in (sway, bounce)},
    **{f"methods/{f.__name__}": f for f in (repair, restore, trim, resample, mirror, in_place)},
    "presets": presets,
    "disc": disc,
    "grid": square,
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
