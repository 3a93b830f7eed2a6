"""EventStream: what always holds, and one clear error where it would not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.events import NOISE, SIGNAL, EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(8, 6)


def stream(t, *, x=None, y=None, p=None, label=None, size=SIZE):
    n = len(t)
    return EventStream(
        np.asarray(x if x is not None else [1] * n, dtype=np.int64),
        np.asarray(y if y is not None else [2] * n, dtype=np.int64),
        np.asarray(t, dtype=np.int64),
        np.asarray(p if p is not None else [1] * n, dtype=np.int64),
        size,
        {},
        None if label is None else np.asarray(label),
    )


def test_convention_columns_have_the_documented_types():
    events = stream([5, 9], p=[0, 1], label=[SIGNAL, NOISE])
    kinds = {name: column.dtype for name, column in events.columns().items()}
    assert kinds == {"x": "u2", "y": "u2", "t": "i8", "p": "u1", "label": "u1"}


def test_convention_polarity_is_minus_one_for_off_and_plus_one_for_on():
    events = stream([1, 2, 3], p=[0, 1, 0])
    assert events.polarity.tolist() == [-1, 1, -1]
    assert events.polarity.dtype == np.int8


def test_convention_arrays_are_read_only_and_the_callers_stay_writable():
    t = np.array([1, 2], dtype=np.int64)
    events = EventStream(
        np.zeros(2, np.uint16), np.zeros(2, np.uint16), t, np.ones(2, np.uint8), SIZE
    )
    with pytest.raises(ValueError, match="read-only"):
        events.t[0] = 7
    t[1] = 3
    assert t.flags.writeable


def test_sorted_events_of_one_time_keep_their_order():
    t, x = np.random.default_rng(0).integers(0, 9, 1000), np.arange(1000)
    size = SensorSize(1000, 1)
    events = EventStream.from_columns(x=x, y=0 * x, t=t, p=x % 2, size=size, sort=True)
    assert [*zip(events.t, events.x, strict=True)] == sorted(zip(t, x, strict=True))


def test_convention_no_events_is_an_empty_stream():
    nothing = EventStream.empty(SIZE)
    assert len(nothing) == 0
    assert nothing.time_range is None
    assert nothing.between(0, 10**12).equals(nothing)


@given(st.lists(st.integers(0, 2**40), max_size=60), st.integers(0, 2**40), st.integers(0, 2**40))
def test_cutting_and_concatenating_changes_nothing(times, first, second):
    events = stream(sorted(times))
    low, high = sorted((first, second))
    parts = [events.cut(0, low), events.cut(low, high), events.cut(high, 2**41)]
    assert EventStream.concat(parts).equals(events)


def test_labels_survive_cutting_concatenation_and_masks():
    events = stream([1, 2, 3], label=[0, 1, 0])
    again = EventStream.concat([EventStream.empty(SIZE), events[:1], events[1:]])
    assert again.equals(events)
    assert events[events.label == NOISE].t.tolist() == [2]
    assert events.without_label().label is None


def test_ids_of_objects_survive_cutting_concatenation_and_masks():
    events = stream([1, 2, 3]).with_ids(np.array([7, 0, 7]), np.array([2, 0, 2]))
    assert {name: column.dtype.str[1:] for name, column in events.columns().items()} == {
        **{"x": "u2", "y": "u2", "t": "i8", "p": "u1"},
        **{"instance": "u2", "class_id": "u2"},
    }
    assert events[events.instance == 7].t.tolist() == [1, 3]
    assert EventStream.concat([events[:1], events[1:]]).equals(events)
    assert EventStream.concat([events, stream([9])]).instance is None
    assert events.without_label().class_id.tolist() == [2, 0, 2]
    assert events != events.with_ids(None, None)
    with pytest.raises(InputError, match=r"instance runs up to 65536; it must be 0\.\.65535"):
        events.with_ids(np.array([0, 1, 65536]), None)


def test_a_missing_label_in_one_packet_leaves_the_whole_unlabelled():
    mixed = EventStream.concat([stream([1], label=[0]), stream([2])])
    assert mixed.label is None


def test_packets_collect_into_one_stream_with_the_metadata():
    packets = EventPackets(iter([stream([1]), stream([2, 3])]), SIZE, {"seed": 3})
    whole = packets.collect()
    assert whole.t.tolist() == [1, 2, 3]
    assert whole.metadata == {"seed": 3}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x": [8]}, "x runs from 8 to 8; a 8x6 sensor allows 0..7"),
        ({"y": [-1]}, "y runs from -1"),
        ({"p": [-1]}, "must be 0 .OFF. or 1 .ON.*p > 0"),
        ({"label": [2]}, "must be 0 .signal. or 1 .noise."),
        ({"label": [0, 1]}, "label must hold 1 integers"),
    ],
)
def test_wrong_values_fail_with_the_value_and_what_is_allowed(change, message):
    with pytest.raises(InputError, match=message):
        stream([1], **change)


def test_unequal_lengths_and_fractional_coordinates_are_refused():
    zeros = np.zeros(2, np.int64)
    with pytest.raises(InputError, match="equally long"):
        EventStream(zeros, zeros, zeros, zeros[:1], SIZE)
    with pytest.raises(InputError, match="nothing to concatenate; give at least one"):
        EventStream.concat([])
    with pytest.raises(InputError, match="cannot concatenate sensors of 8x6 and 8x7"):
        EventStream.concat([stream([1]), EventStream.empty(SensorSize(8, 7))])
    with pytest.raises(InputError, match=r"chooses no events \(boolean index did not match"):
        stream([1, 2])[np.ones(3, bool)]
    with pytest.raises(InputError, match="x must hold integers; got float64"):
        EventStream(zeros + 0.5, zeros, zeros, zeros, SIZE)


def test_streams_are_equal_by_size_and_events():
    events = stream([1, 2], label=[0, 1])
    assert events == stream([1, 2], label=[0, 1]).with_metadata({"seed": 3})
    assert events.equals(stream([1, 2], label=[0, 1]))
    for other in (stream([1, 3], label=[0, 1]), stream([1, 2], label=[1, 1]), stream([1, 2]), [1]):
        assert events != other
    assert EventStream.empty((3, 2)) != EventStream.empty((2, 3))
