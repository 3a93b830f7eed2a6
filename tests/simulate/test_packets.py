"""Order of the events of a packet."""

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent.simulate.packets import FrameInterval, UnsortedEvents, make_packet

KEY = np.uint64(0)
SIZE = SensorSize(3, 2)


@pytest.mark.parametrize(
    ("start_us", "stop_us"),
    [
        pytest.param(100, 200, id="short"),
        pytest.param(-50, 2**40, id="from before zero"),
    ],
)
def test_convention_ties_are_ordered_by_t_y_x_p_label(start_us, stop_us):
    middle, last = (start_us + stop_us) // 2, stop_us - 1
    pixel = np.array([5, 4, 2, 2, 2, 0, 3])
    t = np.array([middle] * 5 + [last, start_us])
    p = np.array([0, 1, 1, 1, 0, 1, 0], np.uint8)
    label = np.array([0, 0, 1, 0, 1, 1, 0], np.uint8)
    packet = make_packet(
        UnsortedEvents(pixel, t, p, label), FrameInterval(start_us, stop_us, KEY), SIZE
    )
    assert packet.t.tolist() == [start_us, *[middle] * 5, last]
    assert list(zip(packet.y, packet.x, packet.p, packet.label, strict=True)) == [
        (1, 0, 0, 0),
        (0, 2, 0, 1),
        (0, 2, 1, 0),
        (0, 2, 1, 1),
        (1, 1, 1, 0),
        (1, 2, 0, 0),
        (0, 0, 1, 1),
    ]


def test_the_last_pixel_of_the_largest_sensor_survives_packing():
    side, one = 65_535, np.ones(1, np.uint8)
    fired = UnsortedEvents(np.array([side * side - 1]), np.array([999_999]), one, one)
    packet = make_packet(fired, FrameInterval(0, 1_000_000, KEY), SensorSize(side, side))
    assert (packet.x[0], packet.y[0], packet.t[0]) == (65_534, 65_534, 999_999)
    assert (packet.p[0], packet.label[0]) == (1, 1)
