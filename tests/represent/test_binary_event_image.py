import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.represent.event_frame import binary_event_image
from texvent.sensor import SensorSize

from . import definitions
from .definitions import streams


def test_n_imagenet_has_on_first_and_scales_coordinates():
    events = EventStream([20, 639, 20], [0, 479, 0], [1, 2, 3], [1, 0, 1], SensorSize(640, 480))
    image = binary_event_image(events, size=(224, 224))
    assert image.dtype == np.float32
    assert image.shape == (2, 224, 224)
    # 20 · 224 / 640 is exactly 7; 639 and 479 scale to 223.65 and 223.53.
    assert np.argwhere(image).tolist() == [[0, 0, 7], [1, 223, 223]]
    assert image.max() == 1


@given(streams(), st.tuples(st.integers(1, 6), st.integers(1, 6)))
def test_it_equals_its_definition(events, size):
    expected = definitions.binary_event_image(events, size)
    np.testing.assert_array_equal(binary_event_image(events, size=size), expected)
    np.testing.assert_array_equal(
        binary_event_image(events), definitions.binary_event_image(events, events.size)
    )
