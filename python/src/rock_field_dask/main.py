"""``rock-field-dask LIST --out DIR``: a batch of scenes on the cores of this machine, or on a Dask cluster."""

from __future__ import annotations

import argparse
import json
import math
import os
import signal
import sys
from collections.abc import Sequence
from types import FrameType

from . import __version__
from .cluster import LOST, opened, work
from .command import Stop, answer, find
from .progress import say
from .shards import ShardReport

EPILOG = """\
What follows two hyphens goes to rock-field batch: options of exports, or scenes instead of a list.

  rock-field-dask scenes.txt --out rocks
  rock-field-dask scenes.txt --out rocks --workers 8 -- --target blender
  rock-field-dask --out rocks --scheduler tcp://10.0.0.1:8786 -- --preset riverbed --seeds 1..100000

The same command again goes on where the last run ended: what is there and whole stays.
Workers of a cluster need this package and rock-field, and see LIST and DIR by the same paths.

exit codes: 0 everything is there; 1 something could not be made; 2 the command line is wrong; 3 the manifest cannot be written;
            4 the scheduler is unreachable or was lost; 130 Ctrl-C; 143 SIGTERM. What was finished stays, whatever the code.
"""

#: Items of a shard, where --shards does not say otherwise: enough that starting the command line does not count, few enough to lose with a worker.
_PER_SHARD = 64

_MOST_TOLD = 10


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    made = argparse.ArgumentParser(
        prog="rock-field-dask",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    made.add_argument("list", metavar="LIST", nargs="?", help="a file with a link, or parameters as JSON, on each line")
    made.add_argument("--out", "-o", metavar="DIR", required=True, help="the folder of the batch")
    made.add_argument("--shards", metavar="N", type=_count, help=f"into how many tasks the batch is split (default: {_PER_SHARD} scenes in each)")
    made.add_argument("--workers", metavar="N", type=_count, help="workers of the local cluster (default: one for each core with 2 GB of memory)")
    made.add_argument("--scheduler", metavar="ADDRESS", help="a Dask scheduler, tcp://HOST:8786 (default: a cluster on this machine, at 127.0.0.1)")
    made.add_argument("--rock-field", metavar="CMD", default="rock-field", help="the command line of rock-field (default: that on PATH)")
    made.add_argument("--retries", metavar="N", type=_number, default=3, help="how often a shard is tried again that was killed (default: 3)")
    made.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    return made


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    cut = given.index("--") if "--" in given else len(given)
    options = parser().parse_args(given[:cut])
    signal.signal(signal.SIGTERM, _terminated)
    try:
        return _run(options, given[cut + 1 :])
    except Stop as stop:
        if str(stop):
            say(f"rock-field-dask: {stop}")
        return stop.code
    except KeyboardInterrupt:
        say("rock-field-dask: stopped. What was finished stays; the same command goes on from there.")
        return 130


def _run(options: argparse.Namespace, others: list[str]) -> int:
    if options.list == "-":
        raise Stop(2, "workers cannot read the standard input: write the list to a file")
    if options.scheduler and options.workers:
        raise Stop(2, "--workers is for a cluster on this machine, and --scheduler names another: leave one of them out")
    if options.list is None and not others:
        raise Stop(2, "which scenes? Name a list, or write scenes after two hyphens: -- --preset riverbed --seeds 1..1000")
    program = find(options.rock_field)
    out = os.path.abspath(options.out)
    scenes = [os.path.abspath(options.list)] if options.list else []
    # Everything is checked before a worker is started.
    plan = answer([*program, "batch", "plan", *scenes, "--out", out, *others])
    items = int(str(plan["items"]))
    with opened(options.scheduler, options.workers, options.retries) as client:
        workers = len(client.scheduler_info(n_workers=-1)["workers"])
        shards = options.shards or max(1, min(items, max(4 * workers, math.ceil(items / _PER_SHARD))))
        say(f"{items} scenes in {shards} shards on {workers or 'no'} workers; dashboard: {client.dashboard_link}")
        if workers == 0:
            say("The scheduler has no workers yet; the work begins with the first.")
        command = [*program, "batch", *scenes, "--out", out, "--jobs", "1", "--json", *others]
        reports, given_up = work(client, command, shards, options.retries)
    _tell(reports, given_up)
    if given_up or any(report.refused for report in reports):
        return 1
    merged = answer([*program, "batch", "merge", out, "--json"])
    counts = {key: sum(getattr(report, key) for report in reports) for key in ("made", "skipped")}
    print(json.dumps({**merged, **counts}), flush=True)
    return 0


def _tell(reports: list[ShardReport], given_up: dict[int, str]) -> None:
    """What went wrong, in words."""
    words = [f"shard {shard} was given up: {reason}" for shard, reason in sorted(given_up.items())]
    words += [f"shard {report.shard} was refused: {report.refused}" for report in reports if report.refused]
    for report in reports:
        for item in report.failed:
            error = item.get("error")
            message = error.get("message") if isinstance(error, dict) else error
            words.append(f"scene {item.get('index')} could not be made: {message}")
    for line in words[:_MOST_TOLD]:
        say(line)
    if len(words) > _MOST_TOLD:
        say(f"… and {len(words) - _MOST_TOLD} others")


def _count(text: str) -> int:
    number = _number(text)
    if number == 0:
        raise argparse.ArgumentTypeError("there must be at least 1")
    return number


def _number(text: str) -> int:
    if not text.isascii() or not text.isdigit() or int(text) > 1_000_000:
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number up to 1000000")
    return int(text)


def _terminated(_signal: int, _frame: FrameType | None) -> None:
    raise Stop(143, "stopped by SIGTERM. What was finished stays; the same command goes on from there.")


__all__ = ["LOST", "main", "parser"]
