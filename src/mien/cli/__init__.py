"""The command line: ``mien COMMAND ...``.

Data goes to stdout, everything else to stderr. Exit codes: 0 done, 1 some inputs failed, 2 bad usage
or input, 130 interrupted. ``MIEN_DEBUG=1`` shows the traceback of an unexpected error.
"""


def main() -> None:
    """Run the command line with the arguments of the process."""
    from .app import run

    run()
