"""Processes that die take one shard with them, which is made again; only the guilty is given up."""

from __future__ import annotations

import contextlib
import os
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

from tests.dataset.generation.small_sets import clips_recipe, digests, make
from texvent.dataset.generation.status import log_path

from texvent.batch.engines import ATTEMPTS, ProcessEngine
from texvent.dataset.generation.make import ShardTask, find_work, make_shards, remove_dead_parts
from texvent.dataset.generation.recipe import Shard

SLOW = {"paper": {"seeds": 60}}
"""A shard takes long enough to be found at work."""


def test_a_shard_that_takes_its_process_down_harms_no_other(tmp_path: Path) -> None:
    recipe, folder = clips_recipe(tmp_path, variants=SLOW), tmp_path / "out"
    recipe.begin(folder)
    guilty = Shard("paper", "train", 1)
    with killing_whatever_has_open(log_path(folder, guilty)) as killed:
        work = make(recipe, folder, ProcessEngine(2))
    assert len(killed) == ATTEMPTS
    assert list(work.failures) == [guilty]
    assert f"its process died {ATTEMPTS} times" in work.failures[guilty]
    assert len(work.complete) == 2
    make(recipe, folder, ProcessEngine(2))
    remove_dead_parts(recipe, folder)
    make(recipe, tmp_path / "wanted")
    assert digests(folder) == digests(tmp_path / "wanted")
    assert not list(folder.rglob(".texvent-*"))


def test_an_idle_process_that_was_killed_is_replaced(tmp_path: Path) -> None:
    recipe, folder = clips_recipe(tmp_path), tmp_path / "out"
    recipe.begin(folder)
    first, second = list(recipe.shards("esim"))[:2]
    with closing(ProcessEngine(1)) as engine:
        engine.submit(ShardTask(folder, first))
        assert engine.next().failure is None
        for pid in descendants(os.getpid()):
            if is_worker(pid):
                os.kill(pid, signal.SIGKILL)
        engine.submit(ShardTask(folder, second))
        assert engine.next().failure is None


def test_no_more_processes_than_asked_for(tmp_path: Path) -> None:
    recipe, folder = clips_recipe(tmp_path), tmp_path / "out"
    recipe.begin(folder)
    most = 0

    def count(outcome: object) -> None:
        nonlocal most
        most = max(most, sum(map(is_worker, descendants(os.getpid()))))

    with closing(ProcessEngine(2)) as engine:
        make_shards(find_work(recipe, folder), engine, count)
    assert most == 2


def descendants(pid: int) -> list[int]:
    """Process ids below a process, from /proc."""
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            words = entry.read_text().rpartition(")")[2].split()
            if words[0] != "Z":
                children.setdefault(int(words[1]), []).append(int(entry.parent.name))
    found, todo = [], [pid]
    while todo:
        below = children.get(todo.pop(), [])
        found += below
        todo += below
    return found


def is_worker(pid: int) -> bool:
    try:
        return b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return False


@contextlib.contextmanager
def killing_whatever_has_open(path: Path) -> Iterator[list[int]]:
    """Kill every process below this one that has a file open, as one that needs too much memory."""
    killed, done = list[int](), threading.Event()

    def watch() -> None:
        while not done.is_set():
            for pid in descendants(os.getpid()):
                with contextlib.suppress(OSError):
                    opened = [os.readlink(one) for one in Path(f"/proc/{pid}/fd").iterdir()]
                    if str(path) in opened and pid not in killed:
                        os.kill(pid, signal.SIGKILL)
                        killed.append(pid)
            time.sleep(0.005)

    thread = threading.Thread(target=watch)
    thread.start()
    try:
        yield killed
    finally:
        done.set()
        thread.join()
