"""Signals over time, as plain arrays."""
