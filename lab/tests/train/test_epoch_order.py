"""Epochs: every sample once, in the same order everywhere, another in each; decay of the rate."""

import numpy as np
import pytest

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


@pytest.mark.parametrize("epochs", [1, 2, 7, 30])
def test_a_cosine_decay_falls_from_1_to_what_is_0_after_the_last_epoch(epochs):
    one = Schedule(epochs=epochs, decay="cosine")
    found = [one.factor(epoch) for epoch in range(epochs + 1)]
    assert (found[0], found[-1]) == (1.0, 0.0)
    assert all(np.diff(found) < 0.0)
    np.testing.assert_allclose(np.add(found, found[::-1]), 1.0)  # half a cosine is odd there
    assert {Schedule(epochs=epochs).factor(epoch) for epoch in range(epochs)} == {1.0}
