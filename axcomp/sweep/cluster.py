"""Tasks on Dask, some at a time, their results as they come."""

from __future__ import annotations

import logging
import os
import uuid
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from itertools import islice
from typing import Any, TypeVar, cast

import dask
from distributed import Client, Future, LocalCluster, WorkerPlugin, as_completed, get_worker

T = TypeVar("T")

TIMEOUT = 15.0
"""s that a scheduler has to answer."""
TRIES_OF_A_KILLER = 1
"""Workers that a task may take with it before it counts as failed, on a cluster of our own."""

_SETTINGS = {
    "distributed.scheduler.allowed-failures": TRIES_OF_A_KILLER,
    "distributed.admin.tick.limit": "1h",
    "distributed.worker.daemon": True,
}


class ClusterError(OSError):
    """No cluster to work on; the message says why."""


def completed(
    task: Callable[[Any, T], Any], common: Any, items: list[T], scheduler: str | None = None, workers: int | None = None
) -> Iterator[tuple[T, Any, BaseException | None]]:
    """Yield (item, result, exception) of ``task(common, item)`` in the order in which they end.

    The workers can import the task; ``common`` is sent to each of them once. ``scheduler``: address of a Dask
    scheduler; None: ``workers`` of our own on this machine, one for each processor if that is None too.

    Raises
    ------
    ClusterError
        If the scheduler does not answer, or has no workers.
    """
    quiet = {"dashboard_address": ":0", "silence_logs": logging.CRITICAL}
    with dask.config.set(_SETTINGS), ExitStack() as opened:
        if scheduler is None:
            count = min(workers or os.cpu_count() or 1, len(items))
            cluster = opened.enter_context(LocalCluster(n_workers=count, threads_per_worker=1, **quiet))
            client = opened.enter_context(Client(cluster))
        else:
            client = opened.enter_context(_connected(scheduler))
        yield from _completed(client, task, common, items)


class _Common(WorkerPlugin):
    """Keeps what all tasks have in common on every worker, those included that come later in place of others."""

    def __init__(self, value: Any) -> None:
        self.value = value


def _with_common(task: Callable[[Any, T], Any], name: str, item: T) -> Any:
    return task(cast("_Common", get_worker().plugins[name]).value, item)


def _connected(scheduler: str) -> Client:
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    try:
        client = Client(scheduler, timeout=TIMEOUT)
    except (OSError, ValueError, TimeoutError) as error:
        raise ClusterError(f"the scheduler {scheduler} does not answer: {error}") from None
    if not client.nthreads():
        client.close()
        raise ClusterError(f"the scheduler {scheduler} has no workers")
    return client


def _completed(
    client: Client, task: Callable[[Any, T], Any], common: Any, items: list[T]
) -> Iterator[tuple[T, Any, BaseException | None]]:
    """Keep as many tasks under way as there are threads: a worker that dies then takes one task with it."""
    name = f"axcomp-{uuid.uuid4()}"
    client.register_plugin(_Common(common), name=name)
    waiting = iter(items)
    under_way: dict[Future[Any], T] = {}
    ended = as_completed()

    def submit(count: int) -> None:
        for item in islice(waiting, count):
            future = client.submit(_with_common, task, name, item, pure=False)
            under_way[future] = item
            ended.add(future)

    submit(max(1, sum(client.nthreads().values())))
    for future in ended:
        item = under_way.pop(future)
        result, error = None, None
        try:
            result = future.result()
        except Exception as raised:
            error = raised
        submit(1)
        yield item, result, error
        future.release()
    client.unregister_worker_plugin(name)
