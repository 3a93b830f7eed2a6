"""Cameras: every constant has a source, and the preset is those constants."""

import dataclasses

import pytest

from texvent.sensor import SENSORS
from texvent.simulation.physical.cameras import CAMERAS, PRESETS
from texvent.simulation.physical.config import PhysicalConfig


@pytest.mark.parametrize("name", CAMERAS)
def test_a_preset_is_the_constants_that_have_a_source(name: str) -> None:
    camera = CAMERAS[name]
    assert SENSORS[name].description.split()[0] in camera.description
    assert all(len(one.reference) > 20 for one in camera.constants)
    values = {one.option: one.value for one in camera.constants}
    assert PRESETS[name] == dataclasses.replace(PhysicalConfig(), **values)
