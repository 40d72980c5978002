"""The list of commands, in the order of the help."""

from collections.abc import Callable

from .edit import edit
from .signature import with_parameters

ALL: tuple[Callable[..., None], ...] = (with_parameters(edit),)
