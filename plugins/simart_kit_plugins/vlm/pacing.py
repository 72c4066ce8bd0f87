"""No more requests a minute than a server wants."""

from __future__ import annotations

import threading
import time


class Pace:
    """Keeps requests apart in time; threads may share one."""

    def __init__(self, rate: float) -> None:
        """At most `rate` requests a minute; 0 for any number."""
        self._gap = 60.0 / rate if rate > 0 else 0.0
        self._next = 0.0
        self._lock = threading.Lock()

    def wait(self) -> None:
        """Return when it is this request's turn."""
        with self._lock:
            now = time.monotonic()
            turn = max(now, self._next)
            self._next = turn + self._gap
        if turn > now:
            time.sleep(turn - now)
