"""What a worker of the cluster does: one shard of a batch, by the command line of rock-field.

The functions stand in a module, so that a worker imports them once; it needs this package and the command line, and sees the list and the folder
by the same paths as the machine that asks.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field

#: Exit codes of ``rock-field batch`` after which another try would end in the same way: all is there, an item cannot be made, the request is wrong.
_FINAL = {0, 1, 2}

#: Characters kept of what the command line says of its end.
_MOST_WORDS = 4000


class ShardDied(RuntimeError):
    """The command line was killed, or could not write. Another try may succeed, so the task is one that Dask repeats."""


@dataclass
class ShardReport:
    """What became of a shard."""

    shard: int
    made: int = 0
    skipped: int = 0
    #: The lines of JSON of the items that could not be made.
    failed: list[dict[str, object]] = field(default_factory=list)
    #: Why nothing was begun; empty where it was.
    refused: str = ""


def run_shard(command: Sequence[str], shard: int, shards: int) -> ShardReport:
    """Makes the items of a shard that are not there yet.

    :param command: ``rock-field batch`` with all of its arguments but ``--shard``.
    :raises ShardDied: where another try may do better.
    """
    report = ShardReport(shard)
    with tempfile.TemporaryFile() as words:
        try:
            process = subprocess.Popen(
                [*command, "--shard", f"{shard}/{shards}"],
                stdin=subprocess.DEVNULL,
                # A pipe: when this worker is killed, the command line finds it closed, and ends too.
                stdout=subprocess.PIPE,
                stderr=words,
                text=True,
                encoding="utf-8",
            )
        except OSError as error:
            raise ShardDied(f"{command[0]} could not be started: {error.strerror}") from error
        assert process.stdout is not None
        with process.stdout as lines:
            for line in lines:
                _count(report, line)
        code = process.wait()
        words.seek(0)
        said = words.read().decode("utf-8", "replace").strip()[-_MOST_WORDS:]
    if code not in _FINAL:
        raise ShardDied(said or _ending(code))
    if code == 2 or (code == 1 and not report.failed):
        report.refused = said or _ending(code)
    return report


def _count(report: ShardReport, line: str) -> None:
    try:
        item = json.loads(line)
    except ValueError:  # The last line of a process that was killed.
        return
    status = item.get("status") if isinstance(item, dict) else None
    if status == "made":
        report.made += 1
    elif status == "skipped":
        report.skipped += 1
    elif status == "failed":
        report.failed.append(item)


def _ending(code: int) -> str:
    return f"the command line was killed by signal {-code}" if code < 0 else f"the command line ended with exit code {code}"
