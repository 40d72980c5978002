"""The commands, and what happens when one of them fails."""

import os
import sys
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from ..errors import MienError, sentence
from . import commands
from .help import Command
from .report import complain

# Commands that take flags of edits: which edits; none named means all.
FLAGS_OF = {"edit": (), "grid": ("posture",)}
HELP = {"help_option_names": ["-h", "--help"], "max_content_width": 120}


class Commands(TyperGroup):
    """The group of commands: turns every failure into one sentence and an exit code."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Find the command; some get their flags only now, as they need every edit imported."""
        name, command, rest = super().resolve_command(ctx, args)
        if name in FLAGS_OF:
            command = typer.main.get_command(_with_flags(name))
            command.name = name
        return name, command, rest

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the commands, each with the whole first paragraph of its help."""
        commands = [(name, self.get_command(ctx, name)) for name in self.list_commands(ctx)]
        with formatter.section("Commands"):
            formatter.write_dl(
                [(name, (found.help or "").split("\n\n")[0]) for name, found in commands if found]
            )

    def invoke(self, ctx: Any) -> Any:
        """Run the command."""
        try:
            return super().invoke(ctx)
        except BrokenPipeError:
            _close_stdout()  # whoever reads our output has read enough
            raise typer.Exit(0) from None
        except (MienError, OSError) as error:
            complain(sentence(error))
            raise typer.Exit(2) from None
        except KeyboardInterrupt:
            complain("interrupted")
            raise typer.Exit(130) from None
        except Exception as error:
            if isinstance(error, typer.Exit | typer.Abort) or hasattr(error, "exit_code"):
                raise  # typer's own: help was shown, or the arguments do not fit
            if os.environ.get("MIEN_DEBUG"):
                raise
            complain(sentence(error))
            raise typer.Exit(1) from None


def _with_flags(name: str) -> typer.Typer:
    from .flags import with_flags

    written = next(command for command in commands.COMMANDS if command.__name__ == name)
    alone = typer.Typer(add_completion=False, context_settings=HELP, rich_markup_mode=None)
    alone.command(cls=Command)(with_flags(written, edits=FLAGS_OF[name]))
    return alone


app = typer.Typer(
    name="mien",
    cls=Commands,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # its tables cut the names of options
    context_settings=HELP,
    help="Change what a captured human motion expresses: same skeleton, feet on the floor.",
    epilog="Start with: mien demo. Then: mien edit walk.bvh --emotion sad",
)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"mien {version('mien')}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    """Take the options that stand before the command."""


for _command in commands.ALL:
    app.command(cls=Command)(_command)


def run() -> None:
    """Run the command line; an interrupt while starting up ends quietly too."""
    try:
        app(windows_expand_args=False)  # patterns are expanded by each command, after its options
    except KeyboardInterrupt:
        complain("interrupted")
        sys.exit(130)


def _close_stdout() -> None:
    """Send what is still buffered nowhere, so that Python does not complain while it exits."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
