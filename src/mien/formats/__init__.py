"""Files in and out: ``load`` and ``save``, one module a format."""
