"""The table of features adds up as the paper says."""

from mien.analysis.laban_table import COMPONENTS, DERIVED, FEATURES, SELECTED


def test_the_counts_of_the_paper() -> None:
    assert [f.number for f in FEATURES] == list(range(1, 38))
    assert [d.number for d in DERIVED] == list(range(1, 122))
    assert [d.selected for d in SELECTED] == list(range(1, 32))


def test_numbers_that_the_print_shows_undamaged() -> None:
    """Table 1: basic feature, statistic, derived number."""
    printed = [
        (1, "max", 1), (4, "std", 15), (5, "mean", 20), (12, "mean", 48), (13, "max", 113), (14, "mean", 120),
        (16, "max", 50), (18, "mean", 58), (19, "std", 60), (20, "mean", 64), (21, "max", 65),
        (25, "std", 74), (26, "max", 75), (27, "max", 77), (29, "mean", 88), (30, "above_head", 89),
        (30, "below_chest", 91), (31, "max", 97), (32, "max", 101), (33, "std", 107), (34, "mean", 112),
        (35, "window", 92),
        (36, "max", 93), (37, "window", 121),
    ]  # fmt: skip
    found = {(d.feature.number, d.statistic): d.number for d in DERIVED}
    assert [(f, s, found[f, s]) for f, s, _ in printed] == printed


def test_the_selected_ones_of_the_print() -> None:
    printed = {1: 20, 2: 32, 3: 36, 4: 40, 5: 48, 7: 52, 12: 65, 17: 75, 18: 80, 20: 88, 21: 89, 23: 91}
    printed |= {24: 92, 25: 96, 26: 100, 29: 112, 30: 116, 31: 120}
    assert {d.selected: d.number for d in SELECTED if d.selected in printed} == printed


def test_components_and_names() -> None:
    counts = [sum(f.component == c for f in FEATURES) for c in COMPONENTS]
    assert counts == [14, 12, 8, 3]
    for names in ([f.name for f in FEATURES], [d.name for d in DERIVED]):
        assert len(set(names)) == len(names)
        assert all(name == name.lower() and name.isidentifier() for name in names)
    assert all(f.unit and f.definition for f in FEATURES)
