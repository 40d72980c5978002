"""Pictures of what was found in clips: features over time, and clips on the disc of emotion words."""

import os
from collections.abc import Sequence
from pathlib import Path

from ..analysis.laban_table import FEATURES
from ..batch import Analysis
from ..formats import files
from ..render.curves import Curve, curves
from ..render.disc import Dot, disc, disc_page
from .analyze_tables import features_of
from .render import save_picture


def draw_features(analysis: Analysis, target: Path) -> None:
    """Write a picture of the features of one clip over time."""
    found = features_of(analysis)
    columns = zip(FEATURES, found.frames.T, strict=True)
    panels = [(f.component, Curve(f.name.replace("_", " "), f.unit, values)) for f, values in columns]
    groups = {name: [curve for group, curve in panels if group == name] for name, _ in panels}
    target.parent.mkdir(parents=True, exist_ok=True)
    save_picture(curves(found.times, groups, title=analysis.source.name), target)


def draw_disc(good: Sequence[Analysis], target: Path) -> None:
    """Write the place of each clip on the disc, as a page or a picture, as the name says."""
    read = zip(_short_names([analysis.source for analysis in good]), good, strict=True)
    dots = [Dot.of(name, analysis.reading) for name, analysis in read if analysis.reading]
    target.parent.mkdir(parents=True, exist_ok=True)
    if target.suffix.lower() == ".png":
        save_picture(disc(dots), target)
    else:
        files.write(target, disc_page(dots).encode(errors="replace"))


def _short_names(paths: Sequence[Path]) -> list[str]:
    """Return the names of clips below the folder that all lie in."""
    whole = [path.resolve() for path in paths]
    try:
        top = os.path.commonpath([path.parent for path in whole])
    except ValueError:  # on different drives
        return [str(path) for path in paths]
    return [path.relative_to(top).as_posix() for path in whole]
