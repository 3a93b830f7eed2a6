"""LDATI: known events, their voxel grid, and the events inferred from it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.examples import examples

from texvent.simulation.packets import FrameInterval
from texvent.simulation.random.draws import frame_key
from texvent_lab.plug_ins.v2ce import sample_density, sample_events

PART_US = 1_000_000


def interval(parts, start_us=0, seed=0):
    return FrameInterval(start_us, start_us + parts * PART_US, frame_key(seed, 1))


def rows_of(events):
    """(pixel, p, t) of every event, sorted."""
    return sorted(zip(*(one.tolist() for one in (events.pixel, events.p, events.t)), strict=True))


@given(st.data())
@examples(50)
def test_lone_events_come_back_with_their_times_and_crowds_with_their_number(data):
    nodes = data.draw(st.integers(2, 12))
    number = data.draw(arrays(np.int64, (2, nodes - 1, 2, 2), elements=st.integers(0, 3)))
    off, part, y, x = (np.repeat(one, number[number > 0]) for one in np.nonzero(number))
    # What adds less than a millionth to its first node counts as the next sub-interval's.
    within = data.draw(arrays(np.int64, len(part), elements=st.integers(0, PART_US - 2)))
    voxel = np.zeros((2, nodes, 2, 2))
    np.add.at(voxel, (off, part, y, x), 1 - within / PART_US)
    np.add.at(voxel, (off, part + 1, y, x), within / PART_US)
    span = interval(nodes - 1, start_us=500)
    events = sample_events(voxel, span)
    pixel, p, t = y * 2 + x, 1 - off, 500 + part * PART_US + within
    assert [row[:2] for row in rows_of(events)] == sorted(zip(pixel, p, strict=True))
    assert ((events.t >= span.start_us) & (events.t < span.stop_us)).all()
    if (number <= 1).all():
        found, true = (np.array(sorted(zip(*one, strict=True))) for one in (
            (events.pixel, events.p, events.t), (pixel, p, t)))  # fmt: skip
        assert np.abs(found - true).max(initial=0) <= 2


def test_every_event_of_a_crowd_draws_for_itself():
    t = sample_events(np.full((2, 10, 3, 4), 3.0), interval(9)).t
    assert len(set((t % PART_US).tolist())) > 0.99 * len(t) > 500


@pytest.mark.parametrize(
    ("nodes", "counts"),
    [
        # Events at 0.75 and 1.5: 0.25 | 0.75 + 0.5 | 0.5. Node 1 alone would say two.
        ((0.25, 1.25, 0.5, 0), [1, 1, 0]),
        # A part of an event at the start is one; at the end it is none.
        ((0.1, 0, 0, 0), [1, 0, 0]),
        ((0, 0, 0, 0.9), [0, 0, 0]),
        ((0, 0, 0, 2.9), [0, 0, 2]),
    ],
)
def test_parts_of_events_are_settled_as_published(nodes, counts):
    events = sample_events(np.array([nodes, [0] * 4])[..., None, None], interval(3))
    assert np.bincount(events.t // PART_US, minlength=3).tolist() == counts


@pytest.mark.parametrize("slope", [-5.0, -2.0, -0.3, 0.0, 1e-9, 0.7, 2.0, 6.0])
def test_times_have_the_distribution_of_the_slope(slope):
    chance = (np.arange(20_000) + 0.5) / 20_000
    tau = sample_density(np.full(20_000, slope), chance)
    assert 0 <= tau.min() <= tau.max() <= 1
    assert (np.diff(tau) > 0).all()
    assert (1 - slope / 2) * tau + slope * tau**2 / 2 == pytest.approx(chance, abs=1e-9)


def test_crowds_lean_to_the_busier_neighbour():
    voxel = np.zeros((2, 4, 1, 1))
    voxel[0, :3, 0, 0] = 0, 400, 800  # slope 1 in the middle
    t = sample_events(voxel, interval(3)).t / PART_US
    middle, last = t[t < 2] - 1, t[t >= 2] - 2
    assert middle.mean() == pytest.approx(0.5 + 1 / 12, abs=4 * 0.29 / 20)
    assert last.mean() == pytest.approx(0.5, abs=4 * 0.29 / 28)


def test_a_pixel_draws_by_seed_and_place_alone():
    voxel = np.random.default_rng(4).uniform(0, 4, (2, 10, 6, 8))
    whole, again, other = (sample_events(voxel, interval(9, seed=seed)) for seed in (0, 0, 1))
    assert rows_of(whole) == rows_of(again) != rows_of(other)
    assert np.array_equal(np.bincount(whole.pixel), np.bincount(other.pixel))
    part = rows_of(sample_events(voxel[:, :, :4, :5], interval(9)))
    y, x = whole.pixel // 8, whole.pixel % 8
    inside = whole.take((y < 4) & (x < 5))
    inside = inside._replace(pixel=inside.pixel // 8 * 5 + inside.pixel % 8)
    assert rows_of(inside) == part
