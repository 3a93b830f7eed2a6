"""The network in float16, as on a GPU: its events lie within the band of docs/gpu.md."""

import numpy as np
import pytest

from texvent._registry import SIMULATORS
from texvent.config import InterpolateConfig
from texvent.events import EventStream
from texvent.frames import Frame, Video
from texvent.interpolate.rife.interpolator import RifeInterpolator

from .rife_files import save_published

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

PAIR_US, PAIRS, BETWEEN, HEIGHT, WIDTH = 40_000, 3, 4, 48, 64
MOST_CHANGED = 2e-3
"""Share of the events by which the counts of a pixel, polarity and pair may differ in all."""
MOST_LATE = 2e-3
"""Of a pair's duration: 99 of 100 events are as near as this, where those counts are equal."""


def moving_levels():
    """[PAIRS + 1, H, W] smooth noise that moves by 2 px per frame."""
    random = np.random.default_rng(2)
    wide = random.normal(0, 1, (HEIGHT, WIDTH + 2 * PAIRS))
    for axis in (0, 1, 0, 1):
        wide = np.mean([np.roll(wide, shift, axis) for shift in range(-2, 3)], axis=0)
    wide = np.clip(120 + 60 * wide / wide.std(), 0, 255).astype(np.uint8)
    return [wide[:, 2 * at : 2 * at + WIDTH] for at in range(PAIRS + 1)]


def events_of(interpolator, preset):
    kind = SIMULATORS.load("texvent")
    simulator, packets = kind(kind.presets[preset], seed=1), []
    frames = [Frame(one, at * PAIR_US) for at, one in enumerate(moving_levels())]
    for first, second in zip([None, *frames], frames, strict=False):
        if first is not None:
            steps = np.linspace(first.t_us, second.t_us, BETWEEN + 2)[1:-1].astype(int).tolist()
            packets += [simulator.step(one) for one in interpolator.between(first, second, steps)]
        packets.append(simulator.step(second))
    return EventStream.concat(packets)


def by_place(events):
    """Events in the order of pixel, polarity, pair and time; the first three as one number."""
    place = ((events.y.astype(np.int64) * WIDTH + events.x) * 2 + events.p) * PAIRS
    place += events.t // PAIR_US
    order = np.lexsort((events.t, place))
    return place[order], events.t[order]


@pytest.mark.parametrize("preset", ["paper", "accurate"])
@pytest.mark.parametrize("layout", ["4.0", "4.6", "4.25"])
def test_events_of_float16_lie_within_the_band_of_those_of_float32(layout, preset, tmp_path):
    from texvent.interpolate.rife import network

    shape = next(one for one in network.LAYOUTS if one.name == layout)
    weights = save_published(torch, shape, tmp_path / "rife.pkl")
    config = InterpolateConfig(interpolate="rife", interpolator_weights=weights)
    video = Video(np.stack(moving_levels()), [at * PAIR_US for at in range(PAIRS + 1)])
    exact, half = (RifeInterpolator(config, video) for _ in range(2))
    half._run = lambda *images: network.estimate_in_half(half._network, *images)
    (places, t_us), (half_places, half_t_us) = (
        by_place(events_of(one, preset)) for one in (exact, half)
    )
    assert len(places) > 2_000
    assert not np.array_equal(t_us, half_t_us)
    cells = 2 * HEIGHT * WIDTH * PAIRS
    counts, half_counts = (np.bincount(one, minlength=cells) for one in (places, half_places))
    assert np.abs(counts - half_counts).sum() <= MOST_CHANGED * len(places)
    is_equal = counts == half_counts
    late_us = np.abs(t_us[is_equal[places]] - half_t_us[is_equal[half_places]])
    assert np.quantile(late_us, 0.99) <= MOST_LATE * PAIR_US
