"""Rows by Dask: on a cluster of this machine's processors, or on one that is there already."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from itertools import islice
from typing import Any

from dask.distributed import Client, Future, LocalCluster, as_completed

from ..engine import EngineError
from ..errors import UserError
from . import measure
from .settings import Job

SECONDS_TO_CONNECT = 10
AHEAD = 4  # jobs a worker that are handed out: none waits for work, and no million of them wait at the scheduler


@contextmanager
def client(scheduler: str, workers: int) -> Iterator[Client]:
    """A client of the scheduler at an address; without one, of a cluster here."""
    for name in ("distributed", "asyncio", "tornado"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    if scheduler:
        with _existing(scheduler) as connected:
            yield connected
        return
    measure.prepare()
    quiet = {"dashboard_address": None, "silence_logs": logging.CRITICAL}
    with LocalCluster(n_workers=workers, threads_per_worker=1, **quiet) as cluster, Client(cluster) as connected:
        yield connected


@contextmanager
def _existing(address: str) -> Iterator[Client]:
    try:
        connected = Client(address, timeout=SECONDS_TO_CONNECT)
    except (OSError, ValueError, TypeError):
        raise UserError(f"--scheduler {address}: no Dask scheduler answers there") from None
    with connected:
        if not connected.scheduler_info()["workers"]:
            raise UserError(f"--scheduler {address}: it has no workers")
        builds = connected.run(_probe()).values()
        if not all(builds):
            raise UserError(f"--scheduler {address}: its workers do not find cairn_tools: start them with "
                            "PYTHONPATH=CLONE/tools")  # fmt: skip
        others = [build for build in builds if build != measure.build()]
        if others:
            raise UserError(f"--scheduler {address}: its workers have another engine, build {others[0]}, "
                            f"not {measure.build()}")  # fmt: skip
        yield connected


def rows(connected: Client, jobs: list[Job], seconds: float) -> Iterator[measure.Row]:
    """The rows as they are done, in any order."""
    threads = sum(worker["nthreads"] for worker in connected.scheduler_info()["workers"].values())
    waiting = iter(jobs)

    row = _row()

    def submitted(count: int) -> list[Future]:
        return [connected.submit(row, asdict(job), seconds, pure=False) for job in islice(waiting, count)]

    running = as_completed(submitted(AHEAD * max(threads, 1)), with_results=True, raise_errors=False)
    for future, result in running:
        if future.status != "finished":
            raise EngineError(f"a row did not end: {future.exception()}")
        running.update(submitted(1))
        yield result


# A scheduler unpacks what it hands on and need not know cairn_tools: functions within functions travel as they are, and
# take what Python has itself.


def _probe() -> Callable[[], str]:
    def probe() -> str:
        try:
            from cairn_tools.sweep import measure
        except ImportError:
            return ""
        return measure.prepare()

    return probe


def _row() -> Callable[[dict[str, Any], float], measure.Row]:
    def row(job: dict[str, Any], seconds: float) -> measure.Row:
        from cairn_tools.sweep import measure, settings

        return measure.row(settings.Job(**{**job, "settings": settings.Settings(**job["settings"])}), seconds)

    return row


def default_workers() -> int:
    return os.cpu_count() or 1
