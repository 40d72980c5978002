"""Give a command parameters that are made while the program runs."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..errors import MienError, sentence
from .report import show_json

FLAGS = "flags"  # the parameter of a command that takes the values of the made ones
JSON = "as_json"  # the parameter of commands that can answer programs


def with_parameters(
    function: Callable[..., None],
    parameters: Sequence[inspect.Parameter] = (),
    collect: Callable[[Mapping[str, Any]], Any] = dict,
) -> Callable[..., None]:
    """Return ``function`` with more parameters in its signature.

    If it takes ``flags``, it gets their values there, passed through ``collect``. With ``--json`` an error
    that ends the command is also printed as JSON.
    """
    names = [p.name for p in parameters]
    written = inspect.signature(function).parameters
    own = [p for p in written.values() if p.name != FLAGS]

    def command(**given: Any) -> None:
        try:
            if FLAGS in written:
                given[FLAGS] = collect({name: given.pop(name) for name in names})
            function(**given)
        except (MienError, OSError) as error:
            if given.get(JSON):
                show_json({"error": sentence(error)})
            raise

    command.__name__, command.__doc__ = function.__name__, _unwrapped(inspect.getdoc(function) or "")
    command.__annotations__ = {p.name: p.annotation for p in (*own, *parameters)}
    command.__signature__ = inspect.Signature([*own, *parameters])  # type: ignore[attr-defined]
    return command


def _unwrapped(text: str) -> str:
    """Join the lines of each paragraph: the help is wrapped to the width of the terminal."""
    return "\n\n".join(" ".join(paragraph.split("\n")) for paragraph in text.split("\n\n"))
