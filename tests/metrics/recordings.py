"""Small event streams for the tests of metrics."""

from hypothesis import strategies as st
from tests.represent import definitions

from texvent.events import EventStream
from texvent.sensor import SensorSize

SMALL = SensorSize(13, 12)
TOY = SensorSize(64, 64)


def one_event(x=0, y=0, t=1000, p=1, *, count=1):
    """The toy recording: 64×64, by default one ON event at (0, 0), 1 ms."""
    return EventStream([x] * count, [y] * count, [t] * count, [p] * count, TOY)


def random_events(seed, count=400, size=SMALL, duration_us=200_000):
    return definitions.random_events(seed, count, size, duration_us)


def one_beat(events, period_us=41_667):
    """The same events, all at the ends of frames at 24 fps."""
    t = -(-events.t // period_us) * period_us
    return EventStream(events.x, events.y, t, events.p, events.size)


@st.composite
def streams(draw, least=0):
    """Short streams in which pixels and times often coincide."""
    count = draw(st.integers(least, 12))
    column = st.lists(st.integers(0, 3), min_size=count, max_size=count)
    times = st.lists(st.integers(0, 120_000), min_size=count, max_size=count)
    bits = st.lists(st.integers(0, 1), min_size=count, max_size=count)
    return EventStream.from_columns(
        draw(column), draw(column), sorted(draw(times)), draw(bits), size=SMALL
    )
