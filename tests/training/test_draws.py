"""Draws of clips: each number is a chance of its own within its range, of seed and number alone."""

from dataclasses import replace

import numpy as np
import pytest

from texvent.training.draws import ClipRanges, PhysicalRanges, draw_clip, order_of_pass

COUNT = 500
BROAD = {
    "v2v": ClipRanges(mismatch=(0.01, 0.2), refractory_us=(10, 900)),
    "physical": PhysicalRanges(),
}
"""Ranges of which none is a point."""


def draws_of(ranges, seed=3, count=COUNT):
    """Name -> [count] numbers of so many clips."""
    drawn = [draw_clip(ranges, seed, number, 2) for number in range(count)]
    numbers = np.array([one.numbers for one in drawn])
    found = dict(zip(ranges.drawn, numbers[:, 2:].T, strict=False))
    found |= {"threshold": numbers[:, :2].min(axis=1), "on": numbers[:, 0] > numbers[:, 1]}
    found["ratio"] = numbers[:, :2].max(axis=1) / found["threshold"]
    found |= {name: [getattr(one, name) for one in drawn] for name in ("is_flipped", "speed")}
    found |= zip(("first", "row", "column"), np.array([one.place for one in drawn]).T, strict=True)
    return {name: np.array(one, float) for name, one in found.items()}


@pytest.mark.parametrize("name", BROAD)
def test_each_number_is_spread_over_its_range_whatever_the_others_are(name):
    found = draws_of(BROAD[name])
    for one, values in found.items():
        low, high = getattr(BROAD[name], one, (0.0, 1.0)) if one != "speed" else (0.0, 1.0)
        assert low <= values.min() < values.max() <= high
        shares = (values - low) / (high - low)
        assert shares.mean() == pytest.approx(0.5, abs=4 * 0.5 / COUNT**0.5), one
        assert shares.min() < 0.02, one
        assert shares.max() > 0.98, one
    together = np.abs(np.corrcoef([*found.values()])) - np.eye(len(found))
    assert together.max() < 4.5 / COUNT**0.5
    other = draws_of(BROAD[name], seed=4)
    assert all((other[one] != values).any() for one, values in found.items())


@pytest.mark.parametrize("name", BROAD)
def test_a_range_decides_its_own_number_alone(name):
    whole = draws_of(BROAD[name], count=30)
    for one in ("threshold", "ratio", *BROAD[name].drawn):
        low, high = getattr(BROAD[name], one)
        narrow = draws_of(replace(BROAD[name], **{one: (low, (low + high) / 2)}), count=30)
        for other, values in narrow.items():
            wanted = (low + whole[other]) / 2 if other == one else whole[other]
            np.testing.assert_allclose(values, wanted, rtol=1e-9, err_msg=f"{one}, {other}")


@pytest.mark.parametrize("begins", [0.0, 0.1, 0.6, 1.0])
@pytest.mark.parametrize("goes_on", [0.0, 0.5, 0.98])
def test_a_pause_begins_and_goes_on_as_often_as_is_said(begins, goes_on):
    ranges = ClipRanges(pause=(begins, goes_on))
    long = [draw_clip(ranges, 1, number, 400).is_paused for number in range(25)]
    for was, wanted in ((False, begins), (True, goes_on)):
        after = [one[1:][one[:-1] == was] for one in long]
        first = [one[:1] for one in long] if not was else []
        seen = np.concatenate([*after, *first])
        if len(seen) > 50:
            spread = (wanted * (1 - wanted) / len(seen)) ** 0.5
            assert seen.mean() == pytest.approx(wanted, abs=4.5 * spread + 1e-9)
    short = draw_clip(ranges, 1, 7, 30).is_paused
    np.testing.assert_array_equal(short, long[7][:30])


@pytest.mark.parametrize("count", [1, 2, 50, 70_000])
def test_each_pass_shows_every_source_once_in_an_order_of_its_own(count):
    orders = [order_of_pass(seed, number, count) for seed in (0, 1) for number in range(4)]
    for one in orders:
        np.testing.assert_array_equal(np.sort(one), np.arange(count))
    np.testing.assert_array_equal(orders[1], order_of_pass(0, 1, count))
    if count >= 50:
        assert len({tuple(one) for one in orders}) == len(orders)
