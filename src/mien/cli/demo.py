"""``mien demo``: the main job, on a clip that comes with mien."""

from pathlib import Path
from typing import Annotated

import typer

from . import arguments as a
from .diff import show_changes
from .report import show_json


def demo(
    out: Annotated[Path, typer.Option("--out", "-o", help="The folder to write to.")] = Path("mien-demo"),
    emotion: Annotated[str, typer.Option("--emotion", "-e", help="The emotion to show.")] = "sad",
    strength: Annotated[float, typer.Option(min=0, max=2, help="How much of it.")] = 1.0,
    force: a.Force = False,
    as_json: a.Json = False,
) -> None:
    """Turn a walk that comes with mien sad; write it before and after, and a picture of both."""
    from dataclasses import asdict

    from .. import samples
    from ..analysis.compare import before_after
    from ..batch import Job, edited, provenance
    from ..emotion.files import sidecar_of
    from ..emotion.resolve import resolve
    from ..formats import files, save
    from ..render import strip
    from .inputs import label, refuse_existing
    from .render import save_picture

    recipe = resolve(emotion)
    name = label(recipe.name, strength, (), None)
    clip, target, picture = (out / file for file in ("walk.bvh", f"walk_{name}.bvh", f"walk_{name}.png"))
    files.check_folder(out)
    if not force:
        refuse_existing((target, picture))
    out.mkdir(parents=True, exist_ok=True)
    save(samples.walk().motion, clip, force=True)
    job = Job(clip, target, recipe, strength=strength)
    walk, after = edited(job)
    save(after, target, force=True)
    files.write(sidecar_of(target), provenance(job, after).encode())
    save_picture(strip(after, against=walk, title=f"walk: {emotion} (ghost: before)"), picture)
    changes = before_after(walk, after)
    if as_json:
        show_json(
            {"files": [str(f) for f in (clip, target, picture)], "measures": [asdict(c) for c in changes]}
        )
        return
    show_changes(changes)
    typer.echo(f"\nbefore   {clip}\nafter    {target}\npicture  {picture}")
    typer.echo(
        f"\nNow yours: mien edit your_clip.bvh --emotion {emotion}   (mien presets lists the emotions)"
    )
