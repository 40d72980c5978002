"""Edits: functions ``(motion, *, parameters) -> new motion``, one file an edit, and the pipeline.

Importing this package imports every file in it, so that each edit is in the registry.
"""

from importlib import import_module
from pkgutil import iter_modules

for _module in iter_modules(__path__):
    import_module(f"{__name__}.{_module.name}")
