"""Measures of a motion and comparisons of two."""
