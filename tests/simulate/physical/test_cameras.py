"""Cameras: every constant has a source or says that it has none."""

from __future__ import annotations

import dataclasses

import pytest

from texvent.sensor import SENSORS
from texvent.simulate.physical.cameras import CAMERAS, NOT_OF_A_CAMERA, PRESETS, camera_table
from texvent.simulate.physical.config import PhysicalConfig


@pytest.mark.parametrize("name", CAMERAS)
def test_every_constant_of_a_camera_has_a_source_or_is_unmeasured(name: str) -> None:
    table = {one.option: one for one in camera_table(name)}
    fields = {field.name for field in dataclasses.fields(PhysicalConfig)}
    assert set(table) | set(NOT_OF_A_CAMERA) == fields
    for option, constant in table.items():
        assert getattr(PRESETS[name], option) == constant.value
        if constant.basis == "unmeasured":
            assert constant.value == getattr(PhysicalConfig(), option)
        else:
            assert len(constant.reference) > 20
    # Whatever the preset changes is in the table, so nothing has slipped in beside it.
    changed = {
        one for one in fields if getattr(PRESETS[name], one) != getattr(PhysicalConfig(), one)
    }
    assert changed <= {one.option for one in CAMERAS[name].constants}


def test_every_camera_is_a_sensor_of_that_name() -> None:
    for name, camera in CAMERAS.items():
        assert SENSORS[name].description.split()[0] in camera.description
