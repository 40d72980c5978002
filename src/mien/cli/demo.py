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
    from ..emotion.resolve import edit
    from ..formats import save
    from ..render import strip
    from .inputs import refuse_existing
    from .render import save_picture

    label = emotion.replace("/", "-")
    clip, edited, picture = (out / name for name in ("walk.bvh", f"walk_{label}.bvh", f"walk_{label}.png"))
    walk = samples.walk().motion
    after = edit(walk, emotion, strength=strength)
    if not force:
        refuse_existing((edited, picture))
    out.mkdir(parents=True, exist_ok=True)
    save(walk, clip, force=True)
    save(after, edited, force=True)
    save_picture(strip(after, against=walk, title=f"walk: {emotion} (ghost: before)"), picture)
    changes = before_after(walk, after)
    if as_json:
        show_json(
            {"files": [str(f) for f in (clip, edited, picture)], "measures": [asdict(c) for c in changes]}
        )
        return
    show_changes(changes)
    typer.echo(f"\nbefore   {clip}\nafter    {edited}\npicture  {picture}")
    typer.echo(
        f"\nNow yours: mien edit your_clip.bvh --emotion {emotion}   (mien presets lists the emotions)"
    )
