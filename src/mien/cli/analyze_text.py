"""What a person reads about clips: what they express and why, and their features side by side."""

from collections.abc import Sequence

import typer

from ..analysis.effort import EFFORT
from ..analysis.laban_table import COMPONENTS, SELECTED
from ..batch import Analysis
from .analyze_tables import effort_of, features_of
from .report import show_table

SHORT = 0.5  # seconds; in less nobody has moved to and fro
GUESSED = "against how people usually move: a guess, --neutral makes it sure"


def tell_reading(analysis: Analysis) -> None:
    """Print what a clip expresses, and why."""
    found = analysis.reading
    if found is None:
        return
    how = f"against {analysis.neutral}" if analysis.neutral else GUESSED
    typer.echo(f"{analysis.source}, {how}")
    if analysis.duration < SHORT:
        typer.echo(f"  only {analysis.duration:.2f} s long: too short to say how somebody moves")
    for line in found.lines():
        typer.echo(f"  {line}")


def tell_features(good: Sequence[Analysis]) -> None:
    """Print the selected features, and the Effort factors, of a few clips beside each other."""
    rows: list[tuple[str, ...]] = []
    for component in COMPONENTS:
        rows.append((component.upper(), "", *[""] * len(good)))
        for d in (d for d in SELECTED if d.feature.component == component):
            values = [_short(features_of(analysis)[d.name]) for analysis in good]
            rows.append((f"  {d.name.replace('_', ' ')}", d.feature.unit, *values))
        rows.append(("", "", *[""] * len(good)))
    rows.append(("EFFORT OF THE WHOLE BODY", "", *[""] * len(good)))
    for name, (said, unit) in EFFORT.items():
        rows.append((f"  {name}: {said}", unit, *[_short(effort_of(analysis)[name]) for analysis in good]))
    show_table(("feature", "unit", *[analysis.source.name for analysis in good]), rows, numbers=2)


def _short(value: float) -> str:
    """Return a number with three digits that count."""
    return f"{value:.3g}" if abs(value) < 1000.0 else f"{value:.0f}"
