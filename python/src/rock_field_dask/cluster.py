"""The shards of a batch as tasks of a Dask cluster."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from uuid import uuid4

import dask
from dask.system import CPU_COUNT
from distributed import Client, Future, LocalCluster, as_completed
from distributed.scheduler import KilledWorker
from distributed.system import MEMORY_LIMIT

from .command import Stop
from .progress import Progress
from .shards import ShardReport, run_shard

#: Exit code of a cluster that is not there, or not any more.
LOST = 4

_CONNECT_S = 10

#: Of each worker, bytes.
_MEMORY = 2 << 30


@contextmanager
def opened(scheduler: str | None, workers: int | None, retries: int) -> Iterator[Client]:
    """A client of the scheduler, or of a cluster of this machine that ends with it.

    :raises Stop: where nobody answers.
    """
    _silence()
    if scheduler is not None:
        with _client(scheduler) as client:
            yield client
        return
    count = workers or max(1, min(CPU_COUNT, MEMORY_LIMIT // _MEMORY))
    # A killed worker counts as a try of the shards that it had.
    with dask.config.set({"distributed.scheduler.allowed-failures": retries}):
        cluster = LocalCluster(
            n_workers=count,
            threads_per_worker=1,
            processes=True,
            host="127.0.0.1",
            dashboard_address="127.0.0.1:0",
            silence_logs=logging.CRITICAL,
        )
        with cluster, Client(cluster) as client:
            yield client


def _silence() -> None:
    """What goes wrong is said in words by this program; each part of Dask has a level of its own."""
    for name in [*logging.root.manager.loggerDict]:
        if name == "distributed" or name.startswith("distributed."):
            logging.getLogger(name).setLevel(logging.CRITICAL)


def _client(address: str) -> Client:
    try:
        return Client(address, timeout=_CONNECT_S)
    except (OSError, ValueError, TimeoutError) as error:
        raise Stop(LOST, f"there is no scheduler at {address} ({error}). Nothing was begun.") from error


def work(client: Client, command: Sequence[str], shards: int, retries: int) -> tuple[list[ShardReport], dict[int, str]]:
    """Does all shards. Returns what became of each, and for those that failed to the end, why.

    :raises Stop: where the scheduler is lost. What was finished stays.
    """
    # Of this run alone: the scheduler may be doing other batches, or this one for somebody else.
    token = uuid4().hex
    futures = client.map(
        run_shard,
        [list(command)] * shards,
        range(shards),
        [shards] * shards,
        key=[f"rock-field-shard-{token}-{shard}" for shard in range(shards)],
        retries=retries,
    )
    numbers = {future.key: shard for shard, future in enumerate(futures)}
    reports: list[ShardReport] = []
    given_up: dict[int, str] = {}
    progress = Progress(shards)
    try:
        for future in as_completed(futures):
            if future.status == "finished":
                reports.append(future.result())
            elif future.status == "error":
                given_up[numbers[future.key]] = _reason(future)
            else:
                raise Stop(LOST, "the scheduler was lost. What was finished stays; the same command goes on from there.")
            progress.step(_so_far(reports))
    except KeyboardInterrupt:
        client.cancel(futures, force=True)
        raise
    finally:
        progress.close()
    return sorted(reports, key=lambda report: report.shard), given_up


def _reason(future: Future[ShardReport]) -> str:
    error = future.exception()
    if isinstance(error, KilledWorker):
        times = error.allowed_failures + 1
        return f"{times} workers died while they had it, perhaps for want of memory; use fewer workers or smaller scenes"
    return str(error) or type(error).__name__


def _so_far(reports: Sequence[ShardReport]) -> str:
    counts = [
        (sum(report.made for report in reports), "made"),
        (sum(report.skipped for report in reports), "there already"),
        (sum(len(report.failed) for report in reports), "failed"),
    ]
    return ", ".join(f"{count} {word}" for count, word in counts if count > 0 or word == "made")
