"""Presets of the `physical` pixel model: the model's own, and one for each camera."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from texvent.simulate.physical.cameras.constants import CAMERAS, Constant
from texvent.simulate.physical.config import PhysicalConfig

NOT_OF_A_CAMERA = (
    "gamma", "initial_phase", "noise_resets", "sensor_seed", "threshold_map",
    "readout_filters", "bias_camera", "bias",
)  # fmt: skip
"""Options that are no constants of a camera: they belong to the frames, the run or the model."""


def camera_table(name: str) -> tuple[Constant, ...]:
    """Every constant of a camera's preset, in the order of the options, with its source.

    What has no source has the model's default and the basis "unmeasured".

    Example:
        >>> {one.option: one.value for one in camera_table("evk4")}["contrast_threshold"]
        0.2231
        >>> {one.option: one.basis for one in camera_table("evk4")}["cutoff_hz"]
        'unmeasured'
    """
    known = {one.option: one for one in CAMERAS[name].constants}
    defaults = dataclasses.asdict(PhysicalConfig())
    return tuple(
        known.get(option) or Constant(option, default, "unmeasured", "")
        for option, default in defaults.items()
        if option not in NOT_OF_A_CAMERA
    )


def _camera_preset(name: str) -> PhysicalConfig:
    values: dict[str, Any] = {one.option: one.value for one in CAMERAS[name].constants}
    return PhysicalConfig(**values, bias_camera=CAMERAS[name].biases)


PRESETS: Mapping[str, PhysicalConfig] = {
    "default": PhysicalConfig(),
    **{name: _camera_preset(name) for name in CAMERAS},
    # What `texvent calibrate` found on slider_depth of the Event-Camera Dataset: one specimen at
    # its biases, frames interpolated by flow. Unmeasured: mismatch and refractory period.
    "davis240c-ecd": PhysicalConfig(
        contrast_threshold=0.49,
        on_off_ratio=1.45,
        balance=8.0,
        cutoff_hz=500.0,
        leak_rate_hz=0.06,
        noise_curve="1:2.6 3.5:0.020 7.5:0.019 15:0.0075 25:0.0089 37.5:0.0077 57.5:0.0006",
        noise_scale=1.0,
        noise_on_fraction=0.5,
    ),
    "clean": PhysicalConfig(
        contrast_threshold=0.2,
        threshold_sigma=0.0,
        cutoff_hz=0.0,
        refractory_period_us=0,
        leak_rate_hz=0.0,
        noise_scale=0.0,
    ),
}
"""Name → options. "clean" is an ideal sensor: linear light, exact crossings, nothing else."""
