"""Edits: functions ``(motion, *, parameters) -> new motion``, one file an edit, and the pipeline."""
