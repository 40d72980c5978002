"""Arguments that several commands share."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from ..motion import Motion

Clips = Annotated[
    list[str],
    typer.Argument(help="Clips, folders, or patterns such as 'takes/*.bvh'.", show_default=False),
]
Clip = Annotated[Path, typer.Argument(help="A clip.", show_default=False)]
Out = Annotated[Path | None, typer.Option("--out", "-o", help="The file, or the folder, to write to.")]
Force = Annotated[bool, typer.Option("--force", "-f", help="Overwrite files that exist.")]
DryRun = Annotated[bool, typer.Option("--dry-run", "-n", help="Say what would be done, and do nothing.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON for programs.")]
Fps = Annotated[float | None, typer.Option(help="Frames a second, where the clip's own rate is wrong.")]
Salvage = Annotated[bool, typer.Option("--salvage", help="Take what is whole from a damaged clip.")]
Jobs = Annotated[
    int, typer.Option("--jobs", "-j", min=0, help="Processes to share the clips; 0 takes every core.")
]
Neutral = Annotated[
    Path | None,
    typer.Option(
        help="A clip of the same person, best of the same action, to read the difference from; with --labels "
        "the label of such clips.",
    ),
]
Labels = Annotated[
    str,
    typer.Option(
        help="How each clip finds its own neutral one, of the same content and performer: a table (.csv) or "
        "a pattern for file names, as for mien learn.",
    ),
]
Model = Annotated[
    Path | None, typer.Option(help="A model that mien learn wrote, in place of the shipped one.")
]
MapFile = Annotated[
    Path | None,
    typer.Option("--map", help="A map file, for joints that are not found: which joint is the knee."),
]


def opened(path: Path, fps: float | None, salvage: bool, map_file: Path | None) -> "Motion":
    """Return the motion of a clip, read as the options say; errors begin with the path as it was given."""
    from ..batch import opened as read
    from ..errors import FormatError, MienError
    from .inputs import existing
    from .report import located

    body = read_map(map_file)
    try:
        return read(existing(path), body=body, fps=fps, salvage=salvage)
    except MienError as error:
        raise FormatError(located(path, str(error))) from None


def opened_body(path: Path, map_file: Path | None) -> "Motion":
    """Return the motion of a clip to learn the manner of; the map file counts where its joints are there.

    Raises ``MienError`` that names the clip where it has no body.
    """
    motion = opened(path, None, False, None)
    if map_file and set(read_map(map_file).values()) <= {*motion.skeleton.names, ""}:
        motion = opened(path, None, False, map_file)
    return with_body(path, motion)


def with_body(path: Path, motion: "Motion") -> "Motion":
    """Return the motion of a clip; raise ``BodyError``, which names the clip, where it has no body."""
    from ..errors import BodyError, MienError
    from ..kinematics.body import Body
    from .report import located

    try:
        Body.of(motion)
    except MienError as error:
        raise BodyError(located(path, str(error))) from None
    return motion


def read_map(path: Path | None) -> dict[str, str]:
    """Return the roles of a map file; none without one."""
    from ..kinematics.roles import read_map as read
    from .inputs import existing

    return read(existing(path)) if path else {}
