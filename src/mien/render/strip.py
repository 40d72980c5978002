"""Pictures of a motion at a glance: poses from left to right, seen from several sides."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..errors import MienError
from ..kinematics.body import Body
from ..motion import Motion
from ..typing import Array, Integers
from .figure import Figure
from .sheet import GHOST, Panel, Row, Shot, sheet
from .solids import view_axes

if TYPE_CHECKING:
    from PIL.Image import Image


def strip(
    motion: Motion,
    *,
    against: Motion | None = None,
    poses: int = 8,
    views: Sequence[str] = ("side", "front"),
    width: int = 1600,
    travel: bool = False,
    title: str | None = None,
    colour: str | None = None,
    body: Body | None = None,
) -> "Image":
    """Return a picture of ``poses`` moments of a motion, evenly spaced in time, one row for each view.

    ``against`` (such as the motion before an edit) is drawn as a ghost behind, on the same floor
    point below the hips and at the same share of its own length. The original of ``motion`` is seen by
    the same camera, another clip from where it faces itself. ``views`` are among front, side (from the
    body's right, so that a walk goes to the right), left, right, back, three-quarter and top; the
    camera turns with the body. ``travel`` leaves the poses of both where they really are in the room,
    seen by one camera. ``colour`` (a name or ``#rrggbb``) makes a figure of one colour instead of blue
    on the left and orange on the right. ``body`` saves or overrides the search for one, in both motions.

    Raises ``MienError`` for an unknown view or fewer than one pose.
    """
    ghost = None if against is None else Figure.of(against, body=body, colour=GHOST)
    figure = Figure.of(motion, body=body, colour=colour, like=ghost)
    frames = pose_frames(len(motion), poses)
    make = _travelling if travel else _standing
    rows = [Row(view, make(figure, frames, ghost, view)) for view in _views(views)]
    notes = {_called(ghost, [figure]): GHOST} if ghost else {}
    return sheet(rows, width=width, title=motion.name if title is None else title, notes=notes)


def compare(
    motions: Mapping[str, Motion],
    *,
    against: Motion | None = None,
    poses: int = 5,
    views: Sequence[str] = ("side", "front"),
    width: int = 1600,
    title: str = "",
    colour: str | None = None,
) -> "Image":
    """Return a picture with one row for each labelled motion, the views side by side in the row.

    Options are those of ``strip``; ``against`` is ghosted in every row. Raises ``MienError`` when
    there is no motion, for an unknown view or for fewer than one pose.
    """
    if not motions:
        raise MienError("there is no motion to compare; give at least one, as {label: motion}")
    ghost = None if against is None else Figure.of(against, colour=GHOST)
    figures = {label: Figure.of(motion, colour=colour, like=ghost) for label, motion in motions.items()}
    rows = []
    for label, figure in figures.items():
        frames = pose_frames(len(figure.motion), poses)
        panels = [panel for view in _views(views) for panel in _standing(figure, frames, ghost, view)]
        rows.append(Row(label, panels))
    notes = {_called(ghost, list(figures.values())): GHOST} if ghost else {}
    return sheet(rows, width=width, title=title, notes=notes)


def pose_frames(count: int, poses: int) -> Integers:
    """Return the middle frame of each of ``poses`` equal parts of ``count`` frames, none twice.

    Middles, not ends: a clip may begin with a T-pose, and a loop ends where it began.
    """
    if poses < 1:
        raise MienError(f"a picture needs at least one pose, got {poses}")
    middles = (np.arange(poses) + 0.5) / poses * count - 0.5
    return np.unique(np.clip(np.rint(middles), 0, count - 1).astype(np.int64))


def _views(views: Sequence[str]) -> list[str]:
    names = [views] if isinstance(views, str) else list(views)
    if not names:
        raise MienError("a picture needs at least one view, such as 'side'")
    return names


def _called(ghost: Figure, figures: Sequence[Figure]) -> str:
    """Return what the picture calls the ghost."""
    if all(figure.made_from(ghost) for figure in figures):
        return "original"
    return ghost.motion.name or "another clip"


def _standing(figure: Figure, frames: Integers, ghost: Figure | None, view: str) -> list[Panel]:
    """Return one panel a pose, without the travel, seen as the body faces at that moment."""
    solids = figure.solids(frames)
    behind = _same_share(figure, frames, ghost) if ghost else frames
    shade = ghost.solids(behind) if ghost else None
    panels = []
    for k, frame in enumerate(frames):
        axes = view_axes(view, figure.up, figure.facing[frame])
        shots = [Shot(figure, solids, k, figure.ground[frame], axes)]
        if ghost and shade:
            if not figure.made_from(ghost):
                axes = view_axes(view, ghost.up, ghost.facing[behind[k]])
            shots.insert(0, Shot(ghost, shade, k, ghost.ground[behind[k]], axes, ghost=True))
        panels.append(Panel(shots, f"{frame * figure.motion.frame_time:.2f} s"))
    return panels


def _travelling(figure: Figure, frames: Integers, ghost: Figure | None, view: str) -> list[Panel]:
    """Return one panel with every pose where it is in the room, the far ones drawn first."""
    axes, origin = view_axes(view, figure.up, figure.mean_facing()), figure.ground[len(figure.ground) // 2]
    shots = _in_place(figure, frames, origin, axes, False)
    if ghost:
        # The figure's unit of length in the ghost's.
        unit = figure.metres / ghost.metres if figure.metres and ghost.metres else 1.0
        ghost = replace(ghost, size=unit * figure.size)
        behind = _same_share(figure, frames, ghost)
        shots = _in_place(ghost, behind, unit * origin, axes, True) + shots
    first, last = (figure.motion.frame_time * frames[i] for i in (0, -1))
    return [Panel(shots, f"{first:.2f} to {last:.2f} s")]


def _in_place(figure: Figure, frames: Integers, origin: Array, axes: Array, ghost: bool) -> list[Shot]:
    solids = figure.solids(frames)
    far_first = np.argsort(figure.ground[frames] @ axes[2], kind="stable")
    return [Shot(figure, solids, int(k), origin, axes, ghost=ghost) for k in far_first]


def _same_share(figure: Figure, frames: Integers, other: Figure) -> Integers:
    share = frames / max(len(figure.motion) - 1, 1)
    return np.rint(share * (len(other.motion) - 1)).astype(np.int64)
