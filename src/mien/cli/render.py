"""``mien render``: pictures, films and pages of clips."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import BodyError, MienError
from . import arguments as a
from .report import complain, located, note, progress

if TYPE_CHECKING:
    from PIL.Image import Image

    from ..motion import Motion

PICTURES, FILMS, PAGES = (".png",), (".gif", ".mp4"), (".html",)


def render(
    clips: a.Clips,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            help="A .png picture, a .gif or .mp4 film, an .html page that plays, or a folder for pictures.",
        ),
    ] = None,
    against: Annotated[
        Path | None, typer.Option(help="Another clip, such as the original, drawn as a ghost.")
    ] = None,
    views: Annotated[
        str, typer.Option(help="Seen from: front, side, left, right, back, three-quarter, top.")
    ] = "",
    poses: Annotated[int, typer.Option(min=1, max=60, help="Poses in a picture.")] = 8,
    width: Annotated[int, typer.Option(min=200, max=8000, help="Width of a picture in pixels.")] = 1600,
    travel: Annotated[
        bool, typer.Option("--travel", help="In a picture, leave poses where they are in the room.")
    ] = False,
    ghost: Annotated[
        bool, typer.Option("--ghost", help="In a film, show --against behind instead of beside.")
    ] = False,
    force: a.Force = False,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
) -> None:
    """Draw clips, with the original as a ghost: a strip of poses (PNG), a film (GIF, MP4) or a page (HTML).

    The page plays in any browser, without a network: turn the figure, step through frames, compare.

    mien render walk_sad.bvh --against walk.bvh -o walk_sad.png

    mien render walk_sad.bvh --against walk.bvh -o walk_sad.gif

    mien render walk_sad.bvh --against walk.bvh -o walk_sad.html
    """
    from .inputs import expand, outputs, refuse_existing

    found = expand(clips)
    suffix = out.suffix.lower() if out and out.suffix and not out.is_dir() else ".png"
    if suffix not in (*PICTURES, *FILMS, *PAGES):
        kinds = f"a picture is {PICTURES[0]}, a film {' or '.join(FILMS)}, a page {PAGES[0]}"
        raise MienError(f"{out}: {kinds}")
    targets = outputs(found, out, label="strip", suffix=suffix, doing="render")
    if not force:
        refuse_existing(targets)
    other = a.opened(against, fps, salvage, map_file) if against else None
    seen = [view.strip() for view in views.split(",") if view.strip()]
    failed = 0
    for clip, target in progress(zip(found, targets, strict=True), total=len(found), doing="drawing"):
        try:
            motion = a.opened(clip.path, fps, salvage, map_file)
        except MienError as error:
            complain(located(clip.path, str(error)))
            failed += 1
            continue
        _warn_of_sticks(clip.path, motion)
        target.parent.mkdir(parents=True, exist_ok=True)
        if suffix in FILMS:
            _film(motion, target, other, seen, ghost, force)
        elif suffix in PAGES:
            _page(motion, target, other)
        else:
            _strip(motion, target, other, seen or ["side", "front"], poses, width, travel)
        typer.echo(str(target))
    if failed:
        raise typer.Exit(2 if failed == len(found) else 1)


def _warn_of_sticks(path: Path, motion: "Motion") -> None:
    """Say why a figure is drawn as sticks, where no body is found."""
    from ..kinematics.body import Body

    try:
        Body.of(motion)
    except BodyError as error:
        why = str(error).splitlines()[0].split(". ")[0].rstrip(".")
        note(f"mien: note: {path} is drawn as sticks: {why} (a map file helps, given with --map)")


def _film(
    motion: "Motion", target: Path, other: "Motion | None", views: list[str], ghost: bool, force: bool
) -> None:
    from ..render import animate

    if len(views) > 1:
        raise MienError("a film shows one view, such as --views three-quarter")
    view = views[0] if views else "three-quarter"
    animate(motion, target, against=other, beside=not ghost, view=view, force=force)


def _strip(
    motion: "Motion",
    target: Path,
    other: "Motion | None",
    views: list[str],
    poses: int,
    width: int,
    travel: bool,
) -> None:
    from ..render import strip

    save_picture(strip(motion, against=other, poses=poses, views=views, width=width, travel=travel), target)


def _page(motion: "Motion", target: Path, other: "Motion | None") -> None:
    from ..formats import files
    from ..render import page

    files.write(target, page(motion, against=other, title=target.stem).encode())


def save_picture(picture: "Image", target: Path) -> None:
    """Write a picture as PNG, whole or not at all."""
    from io import BytesIO

    from ..formats import files

    data = BytesIO()
    picture.save(data, "PNG")
    files.write(target, data.getvalue())
