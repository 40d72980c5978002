"""The studio's edit for the command line and for Python: what is copied makes the same bytes."""

import shlex
from collections.abc import Mapping
from pathlib import Path

from ..curve import Varying
from ..emotion.recipe_text import format_recipe
from ..kinematics.roles import format_map
from ..recipe import Recipe
from .messages import Copied, Stack
from .stack import active, varying

MARK = "END_OF_RECIPE"


def copied(clip: str, stack: Stack, recipe: Recipe, roles: Mapping[str, str], *, out: str = "") -> Copied:
    """Return the command and the lines of Python that do the recipe of a stack to a clip of that name.

    ``roles`` are those of its joints that a person named; the short command has a map file for them, the
    long one has them in the recipe. ``out`` is the file that they write; without it, CLIP_edited.bvh.
    """
    out = out or target(clip)
    out = f"./{out}" if out.startswith("-") else out
    command = _short(clip, stack, roles, out) or _long(clip, recipe, roles, out)
    return Copied(command, _python(clip, recipe, roles, out))


def target(clip: str) -> str:
    """Return the name of the file that the edit of a clip is written to."""
    return f"{Path(clip).stem}_edited.bvh"


def _short(clip: str, stack: Stack, roles: Mapping[str, str], out: str) -> str:
    """Return the command with flags, where one emotion is all that is done; else nothing."""
    layers = active(stack)
    if len(layers) != 1 or layers[0].kind != "emotion":
        return ""
    (layer,) = layers
    if stack.strength != 1.0 and layer.strength != 1.0:
        return ""
    strength = varying(stack.strength if layer.strength == 1.0 else layer.strength)
    file = f"{Path(clip).stem}_map.toml"
    words = ["mien", "edit", clip, *(["--map", file] if roles else []), "--emotion", layer.name]
    words += [] if strength == 1.0 else ["--strength", _text(strength)]
    words += ["--parts", ",".join(layer.parts)] if layer.parts else []
    if layer.span:
        words += ["--span", f"{layer.span[0]!r},{layer.span[1]!r}", "--ease", repr(float(layer.ease))]
    words += [] if stack.foot_plant else ["--no-foot-plant"]
    words += [] if stack.safe else ["--no-safe"]
    command = shlex.join([*words, "-o", out])
    return f"{_written(file, format_map(roles))}{command}" if roles else command


def _long(clip: str, recipe: Recipe, roles: Mapping[str, str], out: str) -> str:
    """Return the recipe as a file written by the shell, and the command that does it."""
    file = f"{Path(clip).stem}_edited.toml"
    command = shlex.join(["mien", "edit", clip, "--recipe", file, "-o", out])
    return f"{_written(file, recipe_text(recipe, roles))}{command}"


def recipe_text(recipe: Recipe, roles: Mapping[str, str]) -> str:
    """Return a recipe as a file, with the roles of the clip it is for, so that ``mien edit`` reads it so."""
    return format_recipe(recipe, provenance={"roles": dict(roles)} if roles else None)


def _written(file: str, text: str) -> str:
    """Return the lines of a shell that write a text to a file."""
    return f"cat > {shlex.quote(file)} <<'{MARK}'\n{text.rstrip()}\n{MARK}\n"


def _python(clip: str, recipe: Recipe, roles: Mapping[str, str], out: str) -> str:
    given = f", roles={dict(roles)!r}" if roles else ""
    steps = "".join(f"    {step!r},\n" for step in recipe.steps).replace("    Step(", "    mien.Step(")
    return (
        f"import mien\n\nclip = mien.load({clip!r}{given})\nsteps = (\n{steps})\n"
        f"recipe = mien.Recipe({recipe.name!r}, steps, safe={recipe.safe})\n"
        f"mien.save(mien.edit(clip, recipe), {out!r})\n"
    )


def _text(strength: Varying) -> str:
    if isinstance(strength, tuple):
        return ",".join(f"{time!r}:{value!r}" for time, value in strength)
    return repr(float(strength))
