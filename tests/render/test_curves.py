"""Small curves on a page: where they are and what they show."""

import numpy as np
import pytest

from mien.errors import MienError
from mien.render.curves import GROUP, HEAD, LINE, MARGIN, PANEL, PLOT, SCALE, Curve, curves


def line(image) -> np.ndarray:
    """The pixels that are nearer to the curve's colour than to anything else."""
    away = np.abs(np.asarray(image).astype(int) - np.array(LINE)).sum(axis=-1)
    return away < 60


def panel(image, row: int = 0) -> np.ndarray:
    top = HEAD + GROUP + row * PANEL + 16
    return line(image)[top : top + PLOT]


def test_a_rising_line_rises_through_its_panel() -> None:
    t = np.linspace(0.0, 2.0, 50)
    image = curves(t, {"One": [Curve("rise", "m", t)]}, width=400, columns=1)
    drawn = panel(image)
    rows, columns = np.nonzero(drawn)
    assert columns.min() == pytest.approx(MARGIN + SCALE, abs=2)
    assert rows[columns < columns.min() + 3].mean() > 0.9 * PLOT
    assert rows[columns > columns.max() - 3].mean() < 0.1 * PLOT


def test_what_does_not_change_is_a_line_in_the_middle() -> None:
    for frames in (1, 2, 30):
        image = curves(
            np.arange(frames) / 30.0, {"One": [Curve("flat", "m", np.full(frames, 7.0))]}, width=400
        )
        rows, _ = np.nonzero(panel(image))
        assert len(rows) > 0
        assert abs(rows.mean() - PLOT / 2) < 2


def test_groups_begin_new_rows() -> None:
    t = np.arange(10.0)
    groups = {"A": [Curve(str(i), "", t) for i in range(5)], "B": [Curve("b", "", t)]}
    image = curves(t, groups, width=800, columns=4)
    assert image.size == (800, HEAD + 2 * GROUP + 3 * PANEL + MARGIN)


def test_a_page_that_is_too_narrow() -> None:
    with pytest.raises(MienError, match="at least 256 pixels"):
        curves(np.arange(2.0), {}, width=100)
