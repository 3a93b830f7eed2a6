"""Batches are drawn by epoch and sample; what a worker process refuses is said in one line."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from texvent.errors import InputError


@pytest.fixture
def batches(torch) -> Any:
    from texvent_lab.train.task import Batches

    return Batches


def draw(number: int, chance: np.random.Generator) -> Mapping[str, Any]:
    return {"number": float(number), "drawn": chance.random()}


def test_order_and_chance_are_those_of_the_epoch_and_the_sample(batches) -> None:
    batches = batches(make=draw, count=8, batch_size=3, seed=1)
    first, again, second = (
        [pair for batch in batches.epoch(epoch) for pair in zip(*batch.values(), strict=True)]
        for epoch in (0, 0, 1)
    )
    assert len(batches) == 3
    assert first == again
    assert len({drawn for _, drawn in first + second}) == 16
    assert [number for number, _ in first] != [number for number, _ in second]
    assert sorted(number for number, _ in second) == list(range(8))
    for number, drawn in first:
        assert drawn == np.random.default_rng((1, 1, 0, int(number))).random()


def refuse(number: int, chance: np.random.Generator) -> Mapping[str, Any]:
    raise InputError(f"sample {number} is bad: give another")


@pytest.mark.parametrize("workers", [0, pytest.param(1, marks=pytest.mark.torch)])
def test_an_error_is_the_same_from_this_process_and_from_a_worker(batches, workers: int) -> None:
    if workers:
        pytest.importorskip("torch.multiprocessing")
    batches = batches(make=refuse, count=1, batch_size=1, seed=0, workers=workers)
    with pytest.raises(InputError) as caught:
        next(batches.epoch(0))
    assert str(caught.value) == "sample 0 is bad: give another"
