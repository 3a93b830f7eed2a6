"""Event frames: which pixels fire, and how often."""

import numpy as np
import pytest

from texvent.simulate.texvent.event_frame import find_triggered_pixels, generate_event_frame

BRIGHTNESS = np.array([[0.0, 1.0], [-1.0, 0.25]])
REFERENCE = np.array([[0.0, 0.5], [0.0, 0.5]])


def test_crossings_of_a_two_by_two_case():
    """A change of exactly a threshold fires."""
    pixel, change = find_triggered_pixels(BRIGHTNESS, REFERENCE, 0.25)
    assert pixel.tolist() == [1, 2, 3]
    assert change.tolist() == [0.5, -1.0, -0.25]


@pytest.mark.parametrize(("multi_event", "number"), [(False, [1, 1, 1]), (True, [2, 4, 1])])
def test_a_pixel_fires_once_or_once_per_threshold(multi_event, number):
    frame = generate_event_frame(BRIGHTNESS, REFERENCE, threshold=0.25, multi_event=multi_event)
    assert frame.number.tolist() == number
