"""The command line of rock-field, on this machine."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import subprocess
from collections.abc import Sequence


class Stop(Exception):
    """Ends the program with words for people and an exit code."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


def find(command: str) -> list[str]:
    """``rock-field``, or something like ``node /path/to/cli.js``, with the program's whole path.

    :raises Stop: where there is no such program.
    """
    # On Windows a backslash is part of a path.
    program, *arguments = shlex.split(command, posix=os.name != "nt") or [""]
    found = shutil.which(program.strip('"'))
    if found is None:
        raise Stop(2, f"there is no program {program!r}: install it with npm install --global rock-field, or say where it is with --rock-field")
    return [found, *arguments]


def answer(command: Sequence[str]) -> dict[str, object]:
    """Runs the command line, and returns the last line that it answers; what it says on the way is seen.

    :raises Stop: with its exit code, where it fails.
    """
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, encoding="utf-8")
    except OSError as error:
        raise Stop(2, f"{command[0]} could not be started: {error.strerror}") from error
    if done.returncode != 0:
        # It has said why.
        raise Stop(done.returncode if done.returncode > 0 else 1, "")
    try:
        last: dict[str, object] = json.loads(done.stdout.strip().splitlines()[-1])
    except (ValueError, IndexError):
        raise Stop(2, f"{' '.join(command[:2])} did not answer with JSON: is it the rock-field of this version?") from None
    return last
