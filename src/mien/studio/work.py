"""What is being worked out for which page, and whether anybody still waits for it."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from threading import Event, Lock
from time import monotonic

from ..errors import MienError
from ..typing import Progress
from .messages import WorkInfo


class StoppedError(MienError):
    """Nobody waits for it any more."""


class Works:
    """What is being worked out: told by the threads that do it, asked for by those that answer pages."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._all: dict[object, tuple[str, WorkInfo, float]] = {}

    def of(self, client: str) -> list[WorkInfo]:
        """Return what is being worked out for a page, the oldest first."""
        with self._lock:
            found = [(info, since) for owner, info, since in self._all.values() if owner == client]
        return [replace(info, seconds=round(monotonic() - since, 2)) for info, since in found]

    @contextmanager
    def begun(self, client: str, kind: str, *, gone: Event | None = None) -> Iterator[Progress]:
        """Note a work until it ends; yields who is to be told how it goes on.

        Who is told raises ``StoppedError`` once ``gone`` is set, so that the work ends there.
        """
        key, since = object(), monotonic()

        def tell(what: str, share: float | None) -> None:
            if gone is not None and gone.is_set():
                raise StoppedError("nobody waits for this any more")
            with self._lock:
                self._all[key] = client, WorkInfo(kind, what, share, 0.0), since

        tell("waiting for the work before it", None)
        try:
            yield tell
        finally:
            with self._lock:
                self._all.pop(key, None)
