"""Help that is as wide as the terminal: a heading for each group of options, no name ever cut."""

from typing import Any

from typer.core import TyperCommand


class Command(TyperCommand):
    """A command whose help lists the options in groups, named ``heading`` or ``heading: what it is``."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments and options, each group under its heading."""
        groups: dict[str, list[tuple[str, str]]] = {}
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            usual = "Arguments" if parameter.param_type_name == "argument" else "Options"
            if record:
                heading = getattr(parameter, "rich_help_panel", None) or usual
                groups.setdefault(heading, []).append(record)
        for group, records in groups.items():
            heading, _, about = group.partition(": ")
            with formatter.section(heading):
                if about:
                    formatter.write_text(about)
                formatter.write_dl(records)
