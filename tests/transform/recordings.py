"""Small recordings for the tests of transformations, whole and cut into packets."""

import itertools
from collections.abc import Iterable

from hypothesis import strategies as st

from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(8, 6)
ROWS = st.lists(
    st.tuples(st.integers(0, 7), st.integers(0, 5), st.integers(0, 20), st.integers(0, 1)),
    max_size=40,
)
Rows = list[tuple[int, int, int, int]]


def stream(rows: Rows, size: SensorSize = SIZE) -> EventStream:
    """Events of (x, y, t, p), in time order; those of one µs in the order given."""
    ordered = sorted(rows, key=lambda row: row[2])
    x, y, t, p = (list(column) for column in zip(*ordered, strict=True)) if rows else ([],) * 4
    return EventStream.from_columns(x, y, t, p, size=size, metadata={"seed": 1})


@st.composite
def streams(draw: st.DrawFn) -> EventStream:
    """Events in time order on a sensor of 8x6."""
    return stream(draw(ROWS))


CUTS = st.lists(st.integers(0, 40), max_size=5)


def packets(events: EventStream, cuts: Iterable[int] = ()) -> EventPackets:
    """The same events in packets."""
    bounds = [0, *sorted(min(cut, len(events)) for cut in cuts), len(events)]
    parts = [events[a:b] for a, b in itertools.pairwise(bounds)]
    return EventPackets(parts, events.size, events.metadata)


def rows_of(events: EventStream | EventPackets) -> Rows:
    """(x, y, t, p) of every event."""
    if isinstance(events, EventPackets):
        events = events.collect()
    columns = (events.x, events.y, events.t, events.p)
    return list(zip(*(column.tolist() for column in columns), strict=True))
