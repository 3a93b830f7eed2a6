"""Figures of `texvent info`, of packets against those of the whole."""

import itertools

import numpy as np
import pytest

from texvent.cli.event_files.info import describe_events
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.sensor import SensorSize


@pytest.mark.parametrize("first_us", [-500_000, 0, 700])
@pytest.mark.parametrize("cuts", [(), (1, 60), (99,)])
def test_the_figures_are_those_of_all_packets_together(first_us, cuts):
    t = first_us + np.arange(100) * 20_000
    events = EventStream.from_columns(t * 0, t * 0, t, t * 0 + 1, size=SensorSize(4, 3))
    edges = (0, *cuts, 100)
    packets = (events[a:b] for a, b in itertools.pairwise(edges))
    facts = describe_events(EventPackets(packets, events.size, {}))
    assert (facts["events"], facts["on_share"]) == (100, 1.0)
    assert (facts["first_us"], facts["last_us"]) == (first_us, first_us + 1_980_000)
    assert (facts["seconds"], facts["events_per_second"]) == (1.98, 51)
