"""The list of commands, in the order of the help."""

from collections.abc import Callable

from .analyze import analyze
from .blend import blend
from .check import check
from .demo import demo
from .diff import diff
from .doctor import doctor
from .edit import edit
from .find import find
from .grid import grid
from .info import info
from .learn import learn
from .pose import pose
from .presets import presets
from .render import render
from .signature import with_parameters
from .studio import studio

COMMANDS: tuple[Callable[..., None], ...] = (
    demo,
    info,
    edit,
    grid,
    blend,
    presets,
    analyze,
    find,
    learn,
    diff,
    check,
    render,
    studio,
    pose,
    doctor,
)
ALL = tuple(with_parameters(command) for command in COMMANDS)
