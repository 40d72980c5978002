"""The studio's edit for the command line and for Python: what is copied makes the same bytes."""

import shlex
from pathlib import Path

from ..curve import Varying
from ..emotion.recipe_text import format_recipe
from ..recipe import Recipe
from .messages import Copied, Stack
from .stack import active, varying

MARK = "END_OF_RECIPE"


def copied(clip: str, stack: Stack, recipe: Recipe) -> Copied:
    """Return the command and the lines of Python that do the recipe of a stack to a clip of that name."""
    return Copied(_short(clip, stack) or _long(clip, recipe), _python(clip, recipe))


def target(clip: str) -> str:
    """Return the name of the file that the edit of a clip is written to."""
    return f"{Path(clip).stem}_edited.bvh"


def _short(clip: str, stack: Stack) -> str:
    """Return the command with flags, where one emotion is all that is done; else nothing."""
    layers = active(stack)
    if len(layers) != 1 or layers[0].kind != "emotion":
        return ""
    (layer,) = layers
    if stack.strength != 1.0 and layer.strength != 1.0:
        return ""
    strength = varying(stack.strength if layer.strength == 1.0 else layer.strength)
    words = ["mien", "edit", clip, "--emotion", layer.name]
    words += [] if strength == 1.0 else ["--strength", _text(strength)]
    words += ["--parts", ",".join(layer.parts)] if layer.parts else []
    if layer.span:
        words += ["--span", f"{layer.span[0]!r},{layer.span[1]!r}", "--ease", repr(float(layer.ease))]
    words += [] if stack.foot_plant else ["--no-foot-plant"]
    words += [] if stack.safe else ["--no-safe"]
    return shlex.join([*words, "-o", target(clip)])


def _long(clip: str, recipe: Recipe) -> str:
    """Return the recipe as a file written by the shell, and the command that does it."""
    file = f"{Path(clip).stem}_edited.toml"
    command = shlex.join(["mien", "edit", clip, "--recipe", file, "-o", target(clip)])
    return f"cat > {shlex.quote(file)} <<'{MARK}'\n{format_recipe(recipe).rstrip()}\n{MARK}\n{command}"


def _python(clip: str, recipe: Recipe) -> str:
    steps = "".join(f"    {step!r},\n" for step in recipe.steps).replace("    Step(", "    mien.Step(")
    return (
        f"import mien\n\nclip = mien.load({clip!r})\nsteps = (\n{steps})\n"
        f"recipe = mien.Recipe({recipe.name!r}, steps, safe={recipe.safe})\n"
        f"mien.save(mien.edit(clip, recipe), {target(clip)!r})\n"
    )


def _text(strength: Varying) -> str:
    if isinstance(strength, tuple):
        return ",".join(f"{time!r}:{value!r}" for time, value in strength)
    return repr(float(strength))
