"""What is known of each camera, value by value, with its source.

A camera's preset holds these values. Every option that is not listed keeps the model's default and
counts as unmeasured; `camera_table` says so option by option.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from texvent.simulate.physical.noise_curve import DAVIS346_NOISE

Basis = Literal["data sheet", "paper", "software", "measured here", "unmeasured"]
"""Where a value comes from; unmeasured is the model's default."""


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
class Camera:
    """A camera, or the sensor in it."""

    description: str
    biases: str
    """Which biases it has; see `biases.BIASES`."""
    constants: tuple[Constant, ...]
    """The values that have a source."""


EVT_CLOCK = Constant(
    "clock_step_us", 1, "data sheet", "Prophesee, encoding formats: EVT times are in µs"
)
VOLTMETER = "Lin et al., DVS-Voltmeter, ECCV 2022, fitted to recordings: "
MICROSECOND_CLOCK = Constant(
    "clock_step_us", 1, "data sheet", "iniVation, specifications of the DAVIS346: 1 µs"
)

CAMERAS: Mapping[str, Camera] = {
    "evk4": Camera(
        "Prophesee EVK4 (Sony IMX636)",
        "imx636",
        (
            Constant(
                "contrast_threshold",
                round(math.log(1.25), 4),
                "data sheet",
                "nominal contrast threshold 25 % (Prophesee, EVK4); contrast is (Lmax - Lmin) / "
                "Lmin (Prophesee, Event-based vision sensor characteristics), so ln 1.25",
            ),
            Constant("on_off_ratio", 1.0, "data sheet", "one threshold is stated for ON and OFF"),
            EVT_CLOCK,
            Constant(
                "rate_limit_window_us",
                200,
                "software",
                "OpenEB 5.1, gen41_erc.cpp: reference period of the event rate controller",
            ),
        ),
    ),
    "genx320": Camera(
        "Prophesee GenX320",
        "genx320",
        (
            EVT_CLOCK,
            Constant(
                "rate_limit_window_us",
                100,
                "software",
                "OpenEB 5.1, genx320_erc.h: reference period of the event rate controller",
            ),
        ),
    ),
    "gen3.1": Camera("Prophesee Gen3.1 VGA (PPS3MVCD)", "gen3.1", (EVT_CLOCK,)),
    "dvxplorer": Camera(
        "iniVation DVXplorer (Samsung S5K231Y)",
        "dvxplorer",
        (
            Constant(
                "arbiter",
                "scan",
                "measured here",
                "two recordings of 320×240: columns come by one after the other, whatever the load",
            ),
            Constant(
                "scan_period_ns",
                197_150,
                "measured here",
                "the same; dv-processing states 5,000 Hz by default (VARIABLE_5000)",
            ),
        ),
    ),
    "davis346": Camera(
        "iniVation DAVIS346",
        "davis346",
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
            MICROSECOND_CLOCK,
        ),
    ),
    "davis240c": Camera(
        "iniLabs DAVIS240C",
        "davis240c",
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


def constants_for_biases(biases: str | None) -> tuple[Constant, ...]:
    """The sourced values of the camera with these biases; none for no camera."""
    return next((one.constants for one in CAMERAS.values() if one.biases == biases), ())
