"""Sensor names and sizes."""

import numpy as np
import pytest

from texvent.errors import ConfigError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.sensor import SENSORS, as_size, parse_sensor


@pytest.mark.parametrize(
    ("name", "size"),
    [
        ("dvs128", (128, 128)),
        ("davis240c", (240, 180)),
        ("DAVIS346", (346, 260)),
        ("gen3-vga", (640, 480)),
        ("gen4-hd", (1280, 720)),
        ("evk4", (1280, 720)),
        ("65535x1", (65535, 1)),
    ],
)
def test_sensors_are_known_by_name_or_by_size(name, size):
    assert parse_sensor(name) == size


@pytest.mark.parametrize("name", ["0x4", "65536x4", "davis345", "", "4x"])
def test_other_sensors_are_refused_with_what_is_allowed(name):
    with pytest.raises(ConfigError, match=r"allowed|must be 1..65535"):
        parse_sensor(name)


@pytest.mark.parametrize(
    "size",
    ["davis240c", "240x180", (240, 180), [240, 180], np.array([240, 180]), SENSORS["davis240c"]],
)
def test_a_size_is_taken_as_python_programs_have_it(size):
    assert as_size(size) == (240, 180)
    assert EventStream.empty(size).size == (240, 180)
    assert EventPackets([], size).size == (240, 180)


def test_every_sensor_names_its_source():
    assert all(sensor.source for sensor in SENSORS.values())
