"""What is said while the work goes on, all of it on the standard error."""

from __future__ import annotations

import sys
from time import monotonic

_WIDTH = 30


def say(text: str) -> None:
    """A line of words."""
    print(text, file=sys.stderr, flush=True)


class Progress:
    """A bar on a terminal; elsewhere a line for each tenth."""

    def __init__(self, total: int) -> None:
        self._total = total
        self._done = 0
        self._begin = monotonic()
        self._tenths = 0
        self._is_terminal = sys.stderr.isatty()

    def step(self, words: str) -> None:
        """One more is done; ``words`` say what there is so far."""
        self._done += 1
        share = self._done / self._total
        if self._is_terminal:
            seconds = (monotonic() - self._begin) * (1 - share) / share
            full = int(_WIDTH * share)
            bar = "█" * full + "░" * (_WIDTH - full)
            print(f"\r{bar} {self._done}/{self._total} shards, {words}, {_time(seconds)} left \033[K", end="", file=sys.stderr, flush=True)
        elif int(10 * share) > self._tenths:
            self._tenths = int(10 * share)
            say(f"{self._done}/{self._total} shards, {words}")

    def close(self) -> None:
        """Leaves the line of the bar."""
        if self._is_terminal and self._done > 0:
            say("")


def _time(seconds: float) -> str:
    whole = round(seconds)
    return f"{whole} s" if whole < 60 else f"{whole // 60} min" if whole < 3600 else f"{whole // 3600} h {whole % 3600 // 60} min"
