"""mien edits what a captured human motion expresses.

>>> import mien
>>> walk = mien.load("walk.bvh")
>>> mien.save(mien.edit(walk, "sad", strength=0.8), "walk_sad.bvh")

Names are imported when they are first used, so that ``import mien`` costs next to nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from . import render as render
    from . import samples as samples
    from .analysis.checks.report import check as check
    from .analysis.compare import before_after as before_after
    from .analysis.compare import compare as compare
    from .analysis.laban import features as features
    from .emotion.files import read_recipe as read_recipe
    from .emotion.files import write_recipe as write_recipe
    from .emotion.mix import mixed as mixed
    from .emotion.model import load_model as load_model
    from .emotion.presets import PRESETS as PRESETS
    from .emotion.presets import preset as preset
    from .emotion.reading import read as read
    from .emotion.resolve import apply as apply
    from .emotion.resolve import edit as edit
    from .emotion.toward import like as like
    from .emotion.toward import toward as toward
    from .errors import BodyError as BodyError
    from .errors import FormatError as FormatError
    from .errors import MienError as MienError
    from .errors import RecipeError as RecipeError
    from .formats import load as load
    from .formats import save as save
    from .kinematics.body import Body as Body
    from .motion import Motion as Motion
    from .motion import Skeleton as Skeleton
    from .recipe import Recipe as Recipe
    from .recipe import Step as Step
    from .studio.widget import show as show
    from .styles.grid import Grid as Grid
    from .styles.grid import grid as grid
    from .styles.multitarget import blend as blend

    __version__: str

# Where each public name lives; "." is a module of the package itself.
_HOME = {
    "PRESETS": ".emotion.presets",
    "Body": ".kinematics.body",
    "BodyError": ".errors",
    "FormatError": ".errors",
    "Grid": ".styles.grid",
    "MienError": ".errors",
    "Motion": ".motion",
    "Recipe": ".recipe",
    "RecipeError": ".errors",
    "Skeleton": ".motion",
    "Step": ".recipe",
    "apply": ".emotion.resolve",
    "before_after": ".analysis.compare",
    "check": ".analysis.checks.report",
    "blend": ".styles.multitarget",
    "compare": ".analysis.compare",
    "edit": ".emotion.resolve",
    "features": ".analysis.laban",
    "grid": ".styles.grid",
    "load": ".formats",
    "mixed": ".emotion.mix",
    "preset": ".emotion.presets",
    "read": ".emotion.reading",
    "load_model": ".emotion.model",
    "read_recipe": ".emotion.files",
    "render": ".",
    "samples": ".",
    "save": ".formats",
    "show": ".studio.widget",
    "toward": ".emotion.toward",
    "like": ".emotion.toward",
    "write_recipe": ".emotion.files",
}

__all__ = ["__version__", *_HOME]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        value: Any = version(__name__)
    elif name in _HOME:
        home = _HOME[name]
        module = import_module(f".{name}" if home == "." else home, __name__)
        value = module if home == "." else getattr(module, name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
