"""Biases of cameras, in the cameras' units: which there are, and which of them have a meaning.

A bias is a current or a voltage of the pixel's circuit. Only where a publication says what it does
to a threshold or to the refractory period it is taken; any other is refused, unless it has its
default value, with what to give instead.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from texvent._registry import suggest
from texvent.errors import ConfigError, shown
from texvent.simulate.physical.cameras.davis import (
    CURRENT_NAMES,
    parse_current,
    refractory_us,
    threshold,
)

INSTEAD_OF_THRESHOLD = "contrast_threshold and on_off_ratio"
INSTEAD_OF_HIGH_PASS = "residual_decay_hz (2π times the corner frequency)"
DEAD_TIME = "refractory_period_us, which I_Monitoring.get_pixel_dead_time of the camera's SDK reads"


@dataclass(frozen=True)
class Bias:
    """One bias whose effect is not published."""

    low: int
    """Lowest value that the camera's software recommends."""
    high: int
    default: int
    """The only value that is taken, because the preset's constants belong to it."""
    instead: str
    """Options to give instead."""


class BiasEffect(NamedTuple):
    """What biases do to a pixel; None is nothing."""

    threshold_on: float | None = None
    """ON threshold, log units."""
    threshold_off: float | None = None
    """OFF threshold, log units."""
    scale_on: float = 1.0
    """Factor on the preset's ON threshold."""
    scale_off: float = 1.0
    """Factor on the preset's OFF threshold."""
    refractory_us: int | None = None
    """Refractory period, µs."""


DIFF_GEN31, DIFF_ON_GEN31, DIFF_OFF_GEN31 = 299, 384, 221
"""Defaults of Gen3.1, mV (OpenEB 5.1, gen31_CD_standard.bias)."""
MAPPED = {
    "gen3.1": {"diff": (200, 400), "diff_on": (0, 1800), "diff_off": (0, 1800)},
}
"""Camera → biases with a published effect → range, in the camera's unit."""
UNMAPPED: Mapping[str, Mapping[str, Bias]] = {
    "imx636": {
        "diff_on": Bias(-85, 140, 0, INSTEAD_OF_THRESHOLD),
        "diff_off": Bias(-35, 190, 0, INSTEAD_OF_THRESHOLD),
        "diff": Bias(-25, 23, 0, INSTEAD_OF_THRESHOLD),
        "fo": Bias(-35, 55, 0, "cutoff_hz"),
        "hpf": Bias(0, 120, 0, INSTEAD_OF_HIGH_PASS),
        "refr": Bias(-20, 235, 0, DEAD_TIME),
    },
    "genx320": {
        "diff_on": Bias(24, 60, 25, INSTEAD_OF_THRESHOLD),
        "diff_off": Bias(19, 50, 28, INSTEAD_OF_THRESHOLD),
        "diff": Bias(41, 51, 51, INSTEAD_OF_THRESHOLD),
        "fo": Bias(19, 39, 34, "cutoff_hz"),
        "hpf": Bias(0, 127, 40, INSTEAD_OF_HIGH_PASS),
        "refr": Bias(0, 127, 10, DEAD_TIME),
    },
    "gen3.1": {
        "fo": Bias(1250, 1800, 1477, "cutoff_hz"),
        "hpf": Bias(900, 1800, 1499, INSTEAD_OF_HIGH_PASS),
        "pr": Bias(975, 1800, 1250, "cutoff_hz"),
        "refr": Bias(1300, 1800, 1500, "refractory_period_us"),
    },
    "dvxplorer": {
        "on": Bias(0, 17, 9, INSTEAD_OF_THRESHOLD),
        "off": Bias(0, 17, 9, INSTEAD_OF_THRESHOLD),
    },
}
"""Camera → biases whose effect is not published. Ranges and defaults: OpenEB 5.1 (recommended
ranges of `*_bias_settings.h`, `genx320mp_CD_standard.bias`), dv-processing (contrast thresholds of
the DVXplorer)."""
DAVIS = ("davis346", "davis240c")
NAMES: Mapping[str, tuple[str, ...]] = {
    **{camera: (*MAPPED.get(camera, {}), *biases) for camera, biases in UNMAPPED.items()},
    **dict.fromkeys(DAVIS, CURRENT_NAMES),
}
"""Camera → its biases."""


def bias_effect(camera: str | None, text: str) -> BiasEffect:
    """What biases such as `diff_on=400,diff_off=200` do to a camera's pixels.

    Args:
        camera: a key of `NAMES`.
        text: `NAME=VALUE,...`; names as the camera's software has them, with or without `bias_`.

    Raises:
        ConfigError: no such camera or bias, a value out of range, or one whose effect is not
            published.
    """
    if camera is None:
        raise ConfigError(
            f"bias is {shown(text)}, but biases belong to a camera; choose its preset, or give "
            f"bias_camera: {', '.join(NAMES)}"
        )
    check_camera(camera)
    values = _read(camera, text)
    if camera in DAVIS:
        return _davis_effect(camera, values)
    numbers = {name: _number(camera, name, value) for name, value in values.items()}
    for name, bias in UNMAPPED[camera].items():
        if name in numbers and numbers[name] != bias.default:
            raise ConfigError(
                f"bias: {name} of {camera} is {numbers[name]}, but what it does is not published; "
                f"leave it at its default, {bias.default}, and give {bias.instead}"
            )
    return _gen31_effect(numbers) if camera == "gen3.1" else BiasEffect()


def check_camera(camera: str | None) -> None:
    """Refuse a camera whose biases are not known.

    Raises:
        ConfigError: with the cameras that are.
    """
    if camera is not None and camera not in NAMES:
        raise ConfigError(f"bias_camera is {shown(camera)}; {suggest(camera, tuple(NAMES))}")


def _read(camera: str, text: str) -> dict[str, str]:
    values: dict[str, str] = {}
    for part in text.split(","):
        name, equals, value = (word.strip() for word in part.partition("="))
        name = name.lower().removeprefix("bias_")
        if not (equals and name and value):
            raise ConfigError(f"bias is {shown(text)}; write NAME=VALUE,NAME=VALUE")
        if name not in NAMES[camera]:
            raise ConfigError(
                f"bias: {camera} has no bias {shown(name)}; {suggest(name, NAMES[camera])}"
            )
        if name in values:
            raise ConfigError(f"bias is {shown(text)}; give {name} once")
        values[name] = value
    return values


def _number(camera: str, name: str, value: str) -> int:
    bias = UNMAPPED[camera].get(name)
    low, high = (bias.low, bias.high) if bias else MAPPED[camera][name]
    if not (re.fullmatch(r"[+-]?\d{1,9}", value) and low <= int(value) <= high):
        raise ConfigError(
            f"bias: {name} of {camera} is {shown(value)}; it must be a whole number, {low}..{high}"
        )
    return int(value)


def _gen31_effect(numbers: Mapping[str, int]) -> BiasEffect:
    """Thresholds in proportion to the differences of voltages.

    Source: Prophesee, "Biases (sensor settings)": the contrast sensitivity of Gen3 is the
        difference between `bias_diff_on` and `bias_diff`, and that between `bias_diff` and
        `bias_diff_off`; Lichtsteiner et al., JSSC 2008: thresholds are proportional to it. Least
        differences: OpenEB 5.1, `gen31_ll_biases.cpp`.
    """
    diff = numbers.get("diff", DIFF_GEN31)
    on, off = numbers.get("diff_on", DIFF_ON_GEN31), numbers.get("diff_off", DIFF_OFF_GEN31)
    if on < diff + 75:
        raise ConfigError(
            f"bias: diff_on of gen3.1 is {on}; it must be at least {diff + 75}, diff + 75"
        )
    if off > diff - 65:
        raise ConfigError(
            f"bias: diff_off of gen3.1 is {off}; it must be at most {diff - 65}, diff - 65"
        )
    return BiasEffect(
        scale_on=(on - diff) / (DIFF_ON_GEN31 - DIFF_GEN31),
        scale_off=(diff - off) / (DIFF_GEN31 - DIFF_OFF_GEN31),
    )


def _davis_effect(camera: str, values: Mapping[str, str]) -> BiasEffect:
    currents = {name: parse_current(camera, name, value) for name, value in values.items()}
    for name in ("pr", "sf"):
        if name in currents:
            raise ConfigError(
                f"bias: {name} of {camera} sets a bandwidth that does not depend on light, which "
                "physical does not have; leave it out and give cutoff_hz"
            )
    given = {"diff", "on", "off"} & currents.keys()
    if given and given != {"diff", "on", "off"}:
        raise ConfigError(
            f"bias: thresholds of {camera} follow from diff, on and off together; only "
            f"{', '.join(sorted(given))} is given"
        )
    refractory = refractory_us(currents["refr"]) if "refr" in currents else None
    if not given:
        return BiasEffect(refractory_us=refractory)
    on = threshold(camera, ("on", currents["on"]), ("diff", currents["diff"]))
    off = threshold(camera, ("diff", currents["diff"]), ("off", currents["off"]))
    return BiasEffect(threshold_on=on, threshold_off=off, refractory_us=refractory)
