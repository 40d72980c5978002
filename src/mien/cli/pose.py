"""``mien pose``: a pose file from two stills."""

from pathlib import Path
from typing import Annotated

import typer

from ..errors import MienError
from . import arguments as a


def pose(
    neutral: Annotated[Path, typer.Argument(help="A still (or short clip) of the neutral stance.")],
    changed: Annotated[Path, typer.Argument(help="The same actor, standing as an emotion stands.")],
    out: Annotated[Path, typer.Option("--out", "-o", help="The pose file to write (.toml).")],
    force: a.Force = False,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
) -> None:
    """Make a pose file of how one still differs from another; then: mien edit --posture-pose FILE.

    mien pose neutral.bvh slumped.bvh -o slumped.toml
    """
    from ..formats import files
    from ..kinematics.poses import pose_between, write_pose
    from .inputs import STDOUT

    if out == STDOUT:
        raise MienError("a pose is written to a file; name one after -o")
    first, second = (a.opened(path, fps, salvage, map_file) for path in (neutral, changed))
    files.check_target(out, force=force)
    write_pose(out, pose_between(first, second))
    typer.echo(str(out))
