"""Plots of events, against values by hand."""

from collections.abc import Iterator
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.view.plots import pixel_intervals

SIZE = SensorSize(4, 3)
EVENTS = EventStream.from_columns(
    [0, 0, 3, 0, 3], [0, 0, 2, 0, 2], [0, 10, 20, 110, 399], [1, 1, 0, 1, 0], size=SIZE
)
"""Pixel (0, 0): ON at 0, 10 and 110 µs; pixel (3, 2): OFF at 20 and 399 µs."""


@pytest.fixture(autouse=True)
def pyplot() -> Iterator[Any]:
    """matplotlib without a window; every figure is closed."""
    mpl.use("Agg")
    from matplotlib import pyplot

    yield pyplot
    pyplot.close("all")


def test_a_frame_shows_blue_where_on_and_red_where_off():
    ax = EVENTS.plot()
    (image,) = ax.images
    pixels = image.get_array()
    assert pixels.shape == (3, 4, 3)
    assert pixels[0, 0].tolist() == [0, 0, 255]
    assert pixels[1, 1].tolist() == [255, 255, 255]
    # √(2 events / a ceiling of 8) = 0.5: half of the way from white to red.
    faint = EVENTS.plot("frame", ceiling=8).images[0].get_array()
    assert faint[2, 3].tolist() == [255, 128, 128]


def test_rates_are_events_per_second_on_above_and_off_below():
    ax = EVENTS.plot("rate", bin_us=100)
    on, off = (stairs.get_data() for stairs in ax.patches)
    assert on.values.tolist() == [20_000, 10_000, 0, 0]
    assert off.values.tolist() == [-10_000, 0, 0, -10_000]
    assert on.edges == pytest.approx([0, 1e-4, 2e-4, 3e-4, 4e-4])


@pytest.mark.parametrize("bin_us", [1, 7, 90, 100, 150, 379, 1000])
def test_each_bin_of_a_rate_holds_the_events_between_its_edges(bin_us):
    on, off = (stairs.get_data() for stairs in EVENTS.plot("rate", bin_us=bin_us).patches)
    for drawn, polarity, sign in ((on, 1, 1), (off, 0, -1)):
        edges_us = np.rint(np.asarray(drawn.edges) * 1e6)
        counts, _ = np.histogram(EVENTS.t[EVENTS.p == polarity], edges_us)
        assert np.diff(edges_us).tolist() == [bin_us] * len(counts)
        assert drawn.values == pytest.approx(sign * counts * 1e6 / bin_us)


@pytest.mark.parametrize("last_us", [1, 99, 100, 150, 199, 380, 12_345])
def test_the_default_rate_has_at_most_a_hundred_bins_with_every_event(last_us):
    events = EventStream([0] * 5, [0] * 5, [0, 0, 1, 1, last_us], [1, 0, 1, 0, 1], SensorSize(1, 1))
    on, off = (stairs.get_data() for stairs in events.plot("rate").patches)
    width_s = on.edges[1] - on.edges[0]
    assert min(100, last_us + 1) / 2 < len(on.values) <= 100
    assert on.values.sum() * width_s == pytest.approx(3)
    assert off.values.sum() * width_s == pytest.approx(-2)


def test_intervals_are_between_events_of_one_pixel():
    assert sorted(pixel_intervals(EVENTS).tolist()) == [10, 100, 379]
    ax = EVENTS.plot("isi", bins=2)
    data = ax.patches[0].get_data()
    # Edges 10, √(10 · 379) = 61.6 and 379.
    assert data.values.tolist() == [1, 2]
    assert data.edges == pytest.approx([10, 3790**0.5, 379])
    assert ax.get_xscale() == "log"


def test_a_cloud_has_a_point_per_event_with_its_colour():
    ax = EVENTS.plot("cloud")
    (points,) = ax.collections
    t, x, y = points._offsets3d
    assert np.asarray(t).tolist() == pytest.approx([0, 1e-5, 2e-5, 11e-5, 39.9e-5])
    assert np.asarray(x).tolist() == [0, 0, 3, 0, 3]
    assert np.asarray(y).tolist() == [0, 0, 2, 0, 2]
    on, off = [0, 0, 1], [1, 0, 0]
    assert points._facecolors[:, :3].tolist() == [on, on, off, on, off]
    assert ax.get_zlim() == (3, 0)  # row 0 is at the top


def test_a_cloud_of_more_events_is_an_even_sample():
    ax = EVENTS.plot("cloud", max_events=2)
    t = np.asarray(ax.collections[0]._offsets3d[0]) * 1e6
    assert len(t) == 2
    assert set(t.round().astype(int)) < {0, 10, 20, 110, 399}
    assert ax.get_title() == "2 of 5 events"
