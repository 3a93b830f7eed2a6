from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.represent.event_frame import binary_event_image, count_events, event_frame
from texvent.sensor import SensorSize

from . import definitions
from .definitions import streams

SIZE = SensorSize(3, 2)
# Pixel (0, 0): two ON. (1, 0): ON and OFF. (2, 1): one OFF.
EVENTS = EventStream.from_columns(
    [0, 0, 1, 1, 2], [0, 0, 0, 0, 1], [1, 2, 3, 4, 5], [1, 1, 1, 0, 0], size=SIZE
)


@pytest.mark.parametrize(
    ("kind", "dtype", "expected"),
    [
        ("signed", np.int32, [[2, 0, 0], [0, 0, -1]]),
        ("binary", np.uint8, [[1, 1, 0], [0, 0, 1]]),
        ("polarity", np.float32, [[1.0, 0.5, 0.5], [0.5, 0.5, 0.0]]),
        ("count", np.int32, [[[0, 1, 0], [0, 0, 1]], [[2, 1, 0], [0, 0, 0]]]),
    ],
)
def test_each_kind_matches_its_definition_by_hand(
    kind: str, dtype: type, expected: list[list[float]]
) -> None:
    frame = event_frame(EVENTS, kind)
    assert frame.dtype == dtype
    assert frame.tolist() == expected


@given(st.lists(st.tuples(st.integers(0, 2), st.integers(0, 1), st.integers(0, 1)), max_size=40))
def test_counting_agrees_with_counting_one_by_one(rows: list[tuple[int, int, int]]) -> None:
    expected = np.zeros((2, 2, 3), dtype=int)
    for x, y, p in rows:
        expected[p, y, x] += 1
    x, y, p = ([row[index] for row in rows] for index in range(3))
    events = EventStream.from_columns(x, y, list(range(len(rows))), p, size=SIZE)
    np.testing.assert_array_equal(count_events(events), expected)
    np.testing.assert_array_equal(event_frame(events), expected[1] - expected[0])


def test_n_imagenet_has_on_first_and_scales_coordinates():
    events = EventStream([20, 639, 20], [0, 479, 0], [1, 2, 3], [1, 0, 1], SensorSize(640, 480))
    image = binary_event_image(events, size=(224, 224))
    assert image.dtype == np.float32
    assert image.shape == (2, 224, 224)
    # 20 · 224 / 640 is exactly 7; 639 and 479 scale to 223.65 and 223.53.
    assert np.argwhere(image).tolist() == [[0, 0, 7], [1, 223, 223]]
    assert image.max() == 1


@given(streams(), st.tuples(st.integers(1, 6), st.integers(1, 6)))
def test_a_binary_image_equals_its_definition(events, size):
    expected = definitions.binary_event_image(events, size)
    np.testing.assert_array_equal(binary_event_image(events, size=size), expected)
    np.testing.assert_array_equal(
        binary_event_image(events), definitions.binary_event_image(events, events.size)
    )
