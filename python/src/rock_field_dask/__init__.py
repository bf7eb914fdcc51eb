"""Batches of rock-field scenes on a Dask cluster."""

from importlib.metadata import PackageNotFoundError, version

from .shards import ShardReport, run_shard

__all__ = ["ShardReport", "__version__", "run_shard"]

try:
    __version__ = version("rock-field-dask")
except PackageNotFoundError:  # Imported from the sources.
    __version__ = "0"
