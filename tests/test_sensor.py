"""Sensor names and sizes."""

import pytest

from texvent.errors import ConfigError
from texvent.sensor import SENSORS, parse_sensor


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


def test_every_sensor_names_its_source():
    assert all(sensor.source for sensor in SENSORS.values())
