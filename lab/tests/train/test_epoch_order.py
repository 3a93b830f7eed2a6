"""Epochs: every sample once, the same order everywhere, another in each; what a training allows."""

import dataclasses
import re

import numpy as np
import pytest

from texvent.errors import ConfigError
from texvent_lab.train import schedule
from texvent_lab.train.classification import config as classification
from texvent_lab.train.reconstruction import config as reconstruction
from texvent_lab.train.reconstruction import sequences
from texvent_lab.train.schedule import Schedule, epoch_order


def test_orders_differ_by_epoch_and_seed_and_are_pinned():
    orders = [
        epoch_order(100, seed=seed, epoch=epoch).tolist() for seed in range(4) for epoch in range(4)
    ]
    assert len({tuple(one) for one in orders}) == 16
    assert all(sorted(one) == list(range(100)) for one in orders)
    # Runs that are taken up again on another machine or version find the same order.
    assert orders[4][:8] == [75, 76, 42, 49, 21, 39, 68, 73]


def test_every_place_is_as_likely():
    first = [epoch_order(4, seed=7, epoch=e)[0] for e in range(4000)]
    counts = np.bincount(first, minlength=4)
    # Four places, 4000 draws: sd 27; five of them.
    assert np.abs(counts - 1000).max() < 137


@pytest.mark.parametrize("epochs", [1, 2, 7, 15])
def test_a_decay_begins_at_the_whole_rate_and_would_reach_0_after_the_last_epoch(epochs):
    factors = [Schedule(epochs=epochs, decay="cosine").factor(e) for e in range(epochs + 1)]
    assert (factors[0], factors[-1]) == (1.0, pytest.approx(0))
    assert np.array(factors) + factors[::-1] == pytest.approx(1)
    assert all(np.diff(factors) < 0)
    assert {Schedule(epochs=epochs).factor(e) for e in range(epochs)} == {1.0}


TABLES = [one for module in (schedule, classification, reconstruction, sequences)
          for one in vars(module).values() if dataclasses.is_dataclass(one)
          and one.__module__ == module.__name__ and "__post_init__" in vars(one)]  # fmt: skip


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.__name__)
def test_no_number_of_a_training_is_negative_and_none_is_no_number(table):
    for field in dataclasses.fields(table):
        if re.match(r"(int|float)\b", str(field.type)):
            for value in (-1, float("nan")):
                with pytest.raises(ConfigError, match=field.name):
                    table(**{field.name: value})
