"""What the studio gives as files: the edited clip, its recipe, a picture, a film."""

import tempfile
from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

from ..errors import MienError
from ..formats import bvh
from ..kinematics.body import Body
from ..kinematics.roles import format_map
from ..motion import Motion
from ..recipe import Recipe
from ..typing import Progress, untold
from .copied import recipe_text
from .messages import Value

TYPES = {
    "bvh": "text/plain; charset=utf-8",
    "recipe": "application/toml",
    "map": "application/toml",
    "png": "image/png",
    "gif": "image/gif",
    "mp4": "video/mp4",
    "html": "text/html; charset=utf-8",
}
ENDS = {"recipe": "_edited.toml", "map": "_map.toml"}
FILMS = ("gif", "mp4")
MOST_PIXELS = 8000


def export(
    kind: str,
    before: Motion,
    after: Motion,
    recipe: Recipe,
    options: Mapping[str, Value],
    *,
    progress: Progress = untold,
) -> bytes:
    """Return the bytes of a file of a kind (``TYPES``); raises ``MienError`` where there is none such.

    ``progress`` is told before each picture of a film.
    """
    if kind in FILMS:
        return _film(kind, before, after, options, progress)
    if kind not in MAKERS:
        raise MienError(f"there is no export as {kind}; there are {', '.join([*MAKERS, *FILMS])}")
    return MAKERS[kind](before, after, recipe, options)


def file_name(clip: str, kind: str) -> str:
    """Return what a file of a kind is called that is made of a clip."""
    return f"{Path(clip).stem}{ENDS.get(kind, f'_edited.{kind}')}"


def _bvh(before: Motion, after: Motion, recipe: Recipe, options: Mapping[str, Value]) -> bytes:
    return bvh.render(after)


def _recipe(before: Motion, after: Motion, recipe: Recipe, options: Mapping[str, Value]) -> bytes:
    return recipe_text(recipe, before.skeleton.roles).encode()


def _map(before: Motion, after: Motion, recipe: Recipe, options: Mapping[str, Value]) -> bytes:
    """Return a map file of the roles as they are, named or found."""
    body, names = Body.of(before), before.skeleton.names
    found = {role: names[joint] for role, joint in body.roles.items()}
    return format_map(dict(before.skeleton.roles) | found).encode()


def _png(before: Motion, after: Motion, recipe: Recipe, options: Mapping[str, Value]) -> bytes:
    from ..render import strip

    against = before if options.get("ghost", True) else None
    width = _whole(options, "width", 1600, 200, MOST_PIXELS)
    picture = strip(after, against=against, poses=_whole(options, "poses", 8, 1, 60), width=width)
    data = BytesIO()
    picture.save(data, "PNG")
    return data.getvalue()


def _html(before: Motion, after: Motion, recipe: Recipe, options: Mapping[str, Value]) -> bytes:
    from ..render import page

    return page(after, against=before if options.get("beside", True) else None).encode()


def _film(
    kind: str, before: Motion, after: Motion, options: Mapping[str, Value], progress: Progress
) -> bytes:
    from ..render import animate

    against = before if options.get("beside", True) else None
    size = _whole(options, "height", 480, 120, 1080)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"film.{kind}"
        return animate(after, path, against=against, size=size, progress=progress).read_bytes()


def _whole(options: Mapping[str, Value], name: str, usual: int, low: int, high: int) -> int:
    value: Any = options.get(name, usual)
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise MienError(f"{name} must be a number from {low} to {high}, got {value!r:.40}")
    return int(value)


MAKERS: Mapping[str, Callable[..., bytes]] = {
    "bvh": _bvh,
    "recipe": _recipe,
    "map": _map,
    "png": _png,
    "html": _html,
}
