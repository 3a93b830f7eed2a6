"""Cameras that people have: their constants with sources, and the presets made of them.

An option that is not listed for a camera keeps the model's default: it is unmeasured.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from texvent.simulation.physical.config import DAVIS346_NOISE, PhysicalConfig

Basis = Literal["data sheet", "paper", "measured here"]
"""Origin of a value."""


@dataclass(frozen=True)
class Constant:
    """One value of one camera."""

    option: str
    """Name of the option of `PhysicalConfig`."""
    value: float | str
    basis: Basis
    reference: str
    """The publication, document or file that states it, and how it is read."""


@dataclass(frozen=True)
class CameraProfile:
    """Constants of a camera, or of the sensor in it, with their sources."""

    description: str
    constants: tuple[Constant, ...]
    """The values that have a source."""


VOLTMETER = "Lin et al., DVS-Voltmeter, ECCV 2022, fitted to recordings: "

CAMERAS: Mapping[str, CameraProfile] = {
    "dvs128": CameraProfile(
        "iniLabs DVS128",
        (
            Constant(
                "threshold_sigma",
                0.021,
                "paper",
                "Lichtsteiner et al., JSSC 2008: 2.1 % contrast mismatch between pixels",
            ),
            Constant(
                "noise_curve",
                "1:0.3 100:0.3",
                "measured here",
                "1,176 frames of 100 ms in room light, of eduardoborgesgouveia/"
                "widow_x_neuromorphic_rotulation",
            ),
            Constant("noise_scale", 1.0, "measured here", "the rate is this camera's own"),
            Constant(
                "noise_on_fraction",
                0.4,
                "measured here",
                "resting pixels of the same frames, where the bare table is",
            ),
        ),
    ),
    "evk4": CameraProfile(
        "Prophesee EVK4 (Sony IMX636)",
        (
            Constant(
                "contrast_threshold",
                round(math.log(1.25), 4),
                "data sheet",
                "nominal contrast threshold 25 % (Prophesee, EVK4); contrast is (Lmax - Lmin) / "
                "Lmin (Prophesee, Event-based vision sensor characteristics), so ln 1.25",
            ),
            Constant("on_off_ratio", 1.0, "data sheet", "one threshold is stated for ON and OFF"),
        ),
    ),
    "genx320": CameraProfile("Prophesee GenX320", ()),
    "gen3.1": CameraProfile("Prophesee Gen3.1 VGA (PPS3MVCD)", ()),
    "dvxplorer": CameraProfile(
        "iniVation DVXplorer (Samsung S5K231Y)",
        (
            Constant(
                "scan_period_ns",
                197_150,
                "measured here",
                "two recordings of 320×240: columns come by one after the other, whatever the "
                "load; dv-processing states 5,000 Hz by default (VARIABLE_5000)",
            ),
        ),
    ),
    "davis346": CameraProfile(
        "iniVation DAVIS346",
        (
            Constant("contrast_threshold", 0.19, "paper", VOLTMETER + "1 / k1 of DVS346"),
            Constant("balance", 20.0, "paper", VOLTMETER + "k2 of DVS346"),
            Constant(
                "leak_rate_hz",
                0.0025,
                "measured here",
                "77,469 resting pixels of a street by day: only ON, at any intensity",
            ),
            Constant(
                "noise_curve",
                DAVIS346_NOISE,
                "measured here",
                "static pixels of a DAVIS346 in dim light, events per pixel and second by level",
            ),
            Constant(
                "noise_scale",
                0.2,
                "measured here",
                "between that and the street by day, whose resting pixels fire no OFF event",
            ),
            Constant(
                "noise_on_fraction", 0.53, "measured here", "0.51 to 0.56 on the same recordings"
            ),
        ),
    ),
    "davis240c": CameraProfile(
        "iniLabs DAVIS240C",
        (
            Constant("contrast_threshold", 0.226, "paper", VOLTMETER + "1 / k1 of DVS240"),
            Constant("balance", 23.0, "paper", VOLTMETER + "k2 of DVS240"),
            Constant(
                "threshold_sigma",
                0.035,
                "paper",
                "Brandli et al., JSSC 2014: 3.5 % contrast matching between pixels",
            ),
        ),
    ),
}
"""Preset → what is known of the camera."""


def _camera_preset(name: str) -> PhysicalConfig:
    values: dict[str, Any] = {one.option: one.value for one in CAMERAS[name].constants}
    return PhysicalConfig(**values)


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
