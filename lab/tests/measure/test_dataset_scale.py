"""The simulated schedule of a cluster, against cases computed by hand."""

import pytest

from texvent_lab.measure.dataset_scale import simulate_schedule


def test_a_driver_that_costs_nothing_keeps_all_workers_busy() -> None:
    assert simulate_schedule([2.0], 0.0, workers=4, shards=40) == pytest.approx(1.0)


def test_one_worker_waits_for_the_first_shard_alone() -> None:
    # Its second shard waits at the worker before the first is done.
    assert simulate_schedule([1.0], 0.1, workers=1, shards=10) == pytest.approx(10 / 10.1)


def test_a_driver_slower_than_its_workers_sets_the_pace() -> None:
    # A shard of 1 s every 0.5 s keeps 2 of 10 workers busy.
    busy = simulate_schedule([1.0], 0.5, workers=10, shards=1000)
    assert busy == pytest.approx(0.2, rel=0.01)


def test_a_long_shard_at_the_end_is_waited_for() -> None:
    assert simulate_schedule([1.0], 0.0, workers=4, shards=5) == pytest.approx(5 / 8)
