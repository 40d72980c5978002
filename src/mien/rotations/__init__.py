"""Rotations as plain arrays."""
