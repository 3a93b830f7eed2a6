"""Shards stay open for many threads, and only some of them."""

import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

from texvent.dataset.loading import shard_files
from texvent.dataset.loading.shard_files import ShardFiles


@pytest.fixture
def threads_that_change_often():
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(interval)


def test_threads_open_and_close_the_same_shards(tmp_path, monkeypatch, threads_that_change_often):
    monkeypatch.setattr(shard_files, "MAX_OPEN", 2)
    names = [f"train-{shard}.tar" for shard in range(8)]
    for shard, name in enumerate(names):
        (tmp_path / name).write_bytes(bytes([shard]) * 8)
    files = ShardFiles(tmp_path, names)
    with ThreadPoolExecutor(8) as threads:
        read = list(threads.map(lambda k: files.read(k % 8, 2, 4), range(40_000)))
    assert read == [bytes([k % 8]) * 4 for k in range(40_000)]
    assert files._file.cache_info().currsize == 2
