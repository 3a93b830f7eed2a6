"""Shards made on a Ray cluster: a task for each shard of events, actors for those of videos."""

from __future__ import annotations

import contextlib
import gc
import importlib
import os
import signal
import socket
import time
from collections import Counter, deque
from collections.abc import Callable, Mapping
from importlib import metadata
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent._version import full_version
from texvent.batch.runner import ENDING_ALL
from texvent.dataset.generation.engines import Outcome, Task, outcome_of, run_task
from texvent.dataset.generation.recipe import VIDEOS, Shard, load_recipe_once
from texvent.dataset.generation.shards import ShardRecord
from texvent.errors import ConfigError, MissingDependencyError, TexventError, one_line, shown
from texvent.runtime.threads import THREADS_VARIABLE

ATTEMPTS = 5
"""Attempts at a shard whose process or node dies."""
MEMORY_RETRIES = 8
"""Attempts at a shard that Ray ended for want of memory; the pauses double from 1 s."""
AHEAD = 2
"""Shards at work or waiting, per CPU or per actor: none of them waits for the driver."""
RESOURCES_S = 5.0
"""Seconds for which the size of the cluster is cached."""
PATIENCE_S = 10.0
"""Seconds that running shards get to clean up when the run is stopped."""
GIGABYTE = 10**9
DECIDING = ("numpy", "numba", "opencv-python-headless")
"""Packages that may change events, beside texvent."""


class RayEngine:
    """Tasks of one CPU for events. Actors for videos: one per GPU, else on half of the CPUs.

    An actor keeps its process, and with it the model. Where a node is lost, Ray makes its shards of
    events again on another one, and the engine those of videos.
    """

    def __init__(
        self, address: str, *, workers: int | None = None, memory_gb: float | None = None
    ) -> None:
        """Connect to a cluster.

        Args:
            address: host:port; "auto": the cluster of this machine; "local": one for this run.
            workers: CPUs of a "local" one; None: all.
            memory_gb: memory that a shard of events reserves on its node, GB.

        Raises:
            MissingDependencyError: Ray is not installed.
            ConfigError: there is no such cluster, or no node has so much memory.
        """
        self._ray = connect(address, workers)
        memory = {} if memory_gb is None else {"memory": round(memory_gb * GIGABYTE)}
        self._actors: dict[int, Any] = {}
        self._loads = Counter[int]()
        self._proven: set[int] = set()
        self._started = 0
        self._deaths = Counter[Task]()
        self._running: dict[Any, tuple[Task, int | None]] = {}
        self._ready: deque[Any] = deque()
        self._resources: tuple[float, Mapping[str, float]] = (-RESOURCES_S, {})
        self._versions = package_versions()
        self._has_gpus = self._count("GPU") > 0
        make_on_node, video_worker = _code_for_nodes()
        self._make = self._ray.remote(num_cpus=1, max_retries=ATTEMPTS - 1, **memory)(make_on_node)
        self._video_worker = video_worker
        try:
            self._check_memory(memory_gb)
        except ConfigError:
            self.close()
            raise

    def capacity(self, *, videos: bool) -> int:
        """Two per actor, or per CPU of the cluster as it is now."""
        return AHEAD * (self._actor_count() if videos else max(1, self._count("CPU")))

    def submit(self, task: Task) -> None:
        """Have a shard made."""
        shard = task.shard
        words = (str(task.folder), shard.variant, shard.split, shard.number, task.retry_failed)
        if shard.variant != VIDEOS:
            self._running[self._make.remote(self._versions, words)] = (task, None)
            return
        number = self._idlest_actor()
        self._loads[number] += 1
        reference = self._actors[number].make.remote(self._versions, words)
        self._running[reference] = (task, number)

    def next(self) -> Outcome:
        """The next outcome.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all shards would meet.
        """
        while True:
            reference = self._next_ready()
            task, number = self._running.pop(reference)
            if number in self._actors:
                self._loads[number] -= 1
            try:
                result = self._ray.get(reference)
            except self._ray.exceptions.RayTaskError as error:
                raise error.cause from None
            except self._ray.exceptions.RayError as error:
                self._deaths[task] += 1
                if number is not None and self._deaths[task] < ATTEMPTS:
                    self._drop_actor(number)
                    self.submit(task)
                    continue
                return Outcome(task, failure=self._why(error))
            break
        if number is not None:
            self._proven.add(number)
        if isinstance(result, str):
            raise MissingDependencyError(result)
        if isinstance(result, TexventError):
            raise result
        outcome: Outcome = result
        return outcome

    def _next_ready(self) -> Any:
        """Reference to a result, or to an error; waits for one."""
        if not any(self._loads.values()):
            self._release_actors()
        while not self._ready:
            done, others = self._ray.wait(list(self._running), timeout=RESOURCES_S)
            if not done:
                self._drop_surplus()
                continue
            more = self._ray.wait(others, num_returns=len(others), timeout=0)[0] if others else []
            self._ready.extend((*done, *more))
        return self._ready.popleft()

    def _why(self, error: Exception) -> str:
        if isinstance(error, self._ray.exceptions.OutOfMemoryError):
            return "Ray ended it again and again for want of memory; reserve more: --ray-memory-gb"
        name = type(error).__name__
        return f"its process or node died {ATTEMPTS} times ({name}); see Ray's logs"

    def close(self) -> None:
        """Drop what is at work, let it clean up, and leave the cluster."""
        references = [one for one, (_, number) in self._running.items() if number is None]
        for reference in references:
            self._ray.cancel(reference)
        self._release_actors()
        if references:
            self._ray.wait(references, num_returns=len(references), timeout=PATIENCE_S)
        self._running.clear()
        # Where another thread frees a reference while Ray shuts down, Ray ends the process.
        gc.collect()
        self._ray.shutdown()

    def _count(self, resource: str) -> int:
        """Amount of a resource on all nodes together."""
        read_at, known = self._resources
        if time.monotonic() - read_at > RESOURCES_S:
            known = self._ray.cluster_resources()
            self._resources = (time.monotonic(), known)
        return int(known.get(resource, 0))

    def _actor_count(self) -> int:
        return max(1, self._count("GPU") if self._has_gpus else self._count("CPU") // 2)

    def _idlest_actor(self) -> int:
        """Number of the actor with the fewest shards; a new one if there may be more."""
        idlest = min(self._actors, key=lambda number: self._loads[number], default=None)
        if idlest is not None and (
            self._loads[idlest] == 0 or len(self._actors) >= self._actor_count()
        ):
            return idlest
        needs = {"num_gpus": 1, "num_cpus": 0} if self._has_gpus else {"num_cpus": 1}
        self._started += 1
        self._actors[self._started] = self._ray.remote(**needs)(self._video_worker).remote()
        return self._started

    def _drop_actor(self, number: int) -> None:
        if number in self._actors:
            self._ray.kill(self._actors.pop(number))
            del self._loads[number]

    def _drop_surplus(self) -> None:
        """Drop actors that wait for a GPU which is lost; others make their shards."""
        waiting = [number for number in self._actors if number not in self._proven]
        for number in waiting[: max(0, len(self._actors) - self._actor_count())]:
            self._drop_actor(number)

    def _release_actors(self) -> None:
        """End the actors: what they hold goes to the tasks."""
        for number in list(self._actors):
            self._drop_actor(number)

    def _check_memory(self, wanted_gb: float | None) -> None:
        nodes = [node for node in self._ray.nodes() if node["Alive"]]
        most = max((node["Resources"].get("memory", 0.0) for node in nodes), default=0.0)
        if wanted_gb is not None and wanted_gb * GIGABYTE > most:
            raise ConfigError(
                f"ray_memory_gb is {wanted_gb:g}, and no node of the cluster offers more than "
                f"{most / GIGABYTE:.1f} GB; ask for less"
            )


def connect(address: str, workers: int | None = None) -> Any:
    """The module `ray`, connected to a cluster.

    Raises:
        MissingDependencyError: Ray is not installed.
        ConfigError: there is no such cluster, or its Ray or Python is another version.
    """
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    os.environ.setdefault("RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO", "0")
    os.environ.setdefault("RAY_task_oom_retries", str(MEMORY_RETRIES))  # for ever, by default
    if address != "local" and _has_token():
        os.environ.setdefault("RAY_AUTH_MODE", "token")
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


def _has_token() -> bool:
    """True if Ray finds a token; `ray start` then makes a cluster that asks for it."""
    places = (os.environ.get("RAY_AUTH_TOKEN_PATH"), "~/.ray/auth_token")
    return bool(os.environ.get("RAY_AUTH_TOKEN")) or any(
        Path(place).expanduser().is_file() for place in places if place
    )


def package_versions() -> dict[str, str]:
    """Versions of texvent and of installed packages that may change events."""
    versions = {"texvent": full_version()}
    for name in DECIDING:
        with contextlib.suppress(metadata.PackageNotFoundError):
            versions[name] = metadata.version(name)
    return versions


def make_here(words: tuple[str, str, str, int, bool]) -> Outcome | TexventError:
    """Make a shard on a node: its outcome, or what all shards would meet there."""
    folder, variant, split, number, retry_failed = words
    task = Task(Path(folder), Shard(variant, split, number), retry_failed)

    def run(task: Task) -> ShardRecord:
        return run_task(task)

    try:
        if task.folder.is_dir():
            try:
                load_recipe_once(task.folder)
            except TexventError as error:
                raise ConfigError(str(error)) from error
        return outcome_of(task, run)
    except ENDING_ALL as error:
        return type(error)(f"node {socket.gethostname()}: {error}")


def _code_for_nodes() -> tuple[Callable[..., Any], type]:
    """A function and an actor that need nothing of texvent before they say that it is missing.

    Ray sends the code of what is defined inside a function; what a module defines, nodes import.
    """
    module, version_module = __name__, full_version.__module__

    def make_on_node(versions: Mapping[str, str], words: tuple[Any, ...]) -> Any:
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
        return code.make_here(words) if code is not None else None

    class VideoWorker:
        def make(self, versions: Mapping[str, str], words: tuple[Any, ...]) -> Any:
            return make_on_node(versions, words)

    return make_on_node, VideoWorker
