"""Shards made on a Ray cluster: a task for each, which Ray runs again where a node is lost."""

from __future__ import annotations

import contextlib
import gc
import importlib
import os
import pickle
import signal
import socket
from collections import deque
from collections.abc import Callable, Mapping
from importlib import metadata
from typing import Any

from texvent._require import require
from texvent._version import full_version
from texvent.errors import ConfigError, MissingDependencyError, TexventError, one_line, shown
from texvent.runtime.threads import THREADS_VARIABLE
from texvent.runtime.work.engines import ENDING_ALL, Outcome, Task, attempt

ATTEMPTS = 5
"""Attempts at a shard whose process or node dies."""
MEMORY_RETRIES = 8
"""Attempts at a shard that Ray ended for want of memory; the pauses double from 1 s."""
MOST_SUBMITTED = 2_000
"""Shards that Ray knows of at once: it looks through all of them for each that ends."""
PATIENCE_S = 10.0
"""Seconds that running shards get to clean up when the run is stopped."""
DECIDING = ("numpy", "numba", "opencv-python-headless")
"""Packages that may change events, beside texvent."""


class RayEngine:
    """Tasks of one CPU; those of videos have a GPU each, where the cluster has any.

    A worker process keeps its model from task to task.
    """

    def __init__(self, address: str, *, workers: int | None = None) -> None:
        """Connect to a cluster.

        Args:
            address: host:port; "auto": the cluster of this machine; "local": one for this run.
            workers: CPUs of a "local" one; None: all.

        Raises:
            MissingDependencyError: Ray is not installed.
            ConfigError: there is no such cluster.
        """
        self._ray = connect(address, workers)
        self._running: dict[Any, Task] = {}
        self._waiting = deque[Task]()
        self._versions = package_versions()
        has_gpus = self._ray.cluster_resources().get("GPU", 0) > 0
        of_videos = {"num_gpus": 1, "num_cpus": 0} if has_gpus else {"num_cpus": 1}
        function = _code_for_nodes()
        self._make = {
            is_video: self._ray.remote(max_retries=ATTEMPTS - 1, max_calls=0, **needs)(function)
            for is_video, needs in ((True, of_videos), (False, {"num_cpus": 1}))
        }

    def submit(self, task: Task) -> None:
        """Have a shard made."""
        self._waiting.append(task)
        while self._waiting and len(self._running) < MOST_SUBMITTED:
            first = self._waiting.popleft()
            make = self._make[first.is_video]
            self._running[make.remote(self._versions, pickle.dumps(first))] = first

    def next(self) -> Outcome:
        """The next outcome.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all shards would meet.
        """
        (reference,), _ = self._ray.wait(list(self._running))
        task = self._running.pop(reference)
        if self._waiting:
            self.submit(self._waiting.popleft())
        try:
            result = self._ray.get(reference)
        except self._ray.exceptions.RayTaskError as error:
            raise error.cause from None
        except self._ray.exceptions.RayError as error:
            return Outcome(task, failure=self._why(error))
        if isinstance(result, str):
            raise MissingDependencyError(result)
        if isinstance(result, TexventError):
            raise result
        outcome: Outcome = result
        return outcome

    def _why(self, error: Exception) -> str:
        if isinstance(error, self._ray.exceptions.OutOfMemoryError):
            return "Ray ended it again and again for want of memory; use fewer CPUs per node"
        name = type(error).__name__
        return f"its process or node died {ATTEMPTS} times ({name}); see Ray's logs"

    def close(self) -> None:
        """Drop what is at work, let it clean up, and leave the cluster."""
        references = list(self._running)
        for reference in references:
            self._ray.cancel(reference)
        if references:
            self._ray.wait(references, num_returns=len(references), timeout=PATIENCE_S)
        self._running.clear()
        references.clear()
        # Where another thread frees a reference while Ray shuts down, Ray ends the process.
        gc.collect()
        self._ray.shutdown()


def connect(address: str, workers: int | None = None) -> Any:
    """The module `ray`, connected to a cluster.

    Raises:
        MissingDependencyError: Ray is not installed.
        ConfigError: there is no such cluster, or its Ray or Python is another version.
    """
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    os.environ.setdefault("RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO", "0")
    os.environ.setdefault("RAY_task_oom_retries", str(MEMORY_RETRIES))  # for ever, by default
    ray = require("ray", extra="ray")
    _knock(address)
    own = {"num_cpus": workers, "include_dashboard": False} if address == "local" else {}
    on_stop = signal.getsignal(signal.SIGTERM)
    try:
        ray.init(address=address, log_to_driver=False, logging_level="ERROR", **own)
    except (OSError, RuntimeError, ValueError, TimeoutError) as error:
        raise ConfigError(
            f"cannot use the Ray cluster {shown(address)}: {one_line(error)}; start one with "
            "`ray start --head`, or name it as host:port"
        ) from error
    finally:
        # Ray puts its own handler there, which ends the process at once.
        if callable(on_stop):
            signal.signal(signal.SIGTERM, on_stop)
    return ray


def _knock(address: str) -> None:
    """Refuse an address where nothing answers, which Ray would try for minutes."""
    host, colon, port = address.rpartition(":")
    if not (colon and port.isdecimal() and "/" not in host):
        return
    try:
        socket.create_connection((host.strip("[]"), int(port)), PATIENCE_S).close()
    except (OSError, OverflowError) as error:
        raise ConfigError(
            f"no Ray cluster answers at {shown(address)} ({one_line(error)}); `ray start --head` "
            "says the address of a cluster, and `ray status` whether it runs"
        ) from error


def package_versions() -> dict[str, str]:
    """Versions of texvent and of installed packages that may change events."""
    versions = {"texvent": full_version()}
    for name in DECIDING:
        with contextlib.suppress(metadata.PackageNotFoundError):
            versions[name] = metadata.version(name)
    return versions


def make_here(pickled: bytes) -> Outcome | TexventError:
    """Make a shard on a node: its outcome, or what all shards would meet there."""
    try:
        return attempt(pickle.loads(pickled))
    except ENDING_ALL as error:
        return type(error)(f"node {socket.gethostname()}: {error}")


def _code_for_nodes() -> Callable[..., Any]:
    """A function that needs nothing of texvent before it finds that it is missing.

    Ray sends the code of what is defined inside a function; what a module defines, nodes import.
    """
    module, version_module = __name__, full_version.__module__

    def make_on_node(versions: Mapping[str, str], pickled: bytes) -> Any:
        os.environ[THREADS_VARIABLE] = "1"
        try:
            version = importlib.import_module(version_module).full_version()
            code = importlib.import_module(module) if version == versions["texvent"] else None
        except ImportError as error:
            return (
                f"node {socket.gethostname()} has no texvent {versions['texvent']} ({error}); "
                "install it on every node"
            )
        found = {"texvent": version} if code is None else code.package_versions()
        other = [name for name in versions if found.get(name) != versions[name]]
        if other:
            return (
                f"node {socket.gethostname()} has {other[0]} {found.get(other[0])}, and this "
                f"machine {versions[other[0]]}; events may differ: install the same on every node"
            )
        return code.make_here(pickled) if code is not None else None

    return make_on_node
