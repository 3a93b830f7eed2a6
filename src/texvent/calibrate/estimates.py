"""Estimates of sensor constants, and the preset file that keeps them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import tomli_w

from texvent._version import full_version
from texvent.io.atomic import atomic_file
from texvent.options.values import plain
from texvent.sensor import SensorSize
from texvent.simulation.physical.config import PhysicalConfig


class Estimate(NamedTuple):
    """A measured constant."""

    name: str
    """The option of the model."""
    value: float
    low: float
    """Lower end of the 95 % interval; minus infinity if it is open."""
    high: float
    """Upper end; infinity if it is open."""
    unit: str = ""

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        return f"{self.name} {self.value:.4g}{unit} (95 %: {self.interval})"

    @property
    def interval(self) -> str:
        """The interval in words; an infinite end is open."""
        if math.isinf(self.high):
            return f"{self.low:.3g} or more"
        if math.isinf(self.low):
            return f"{self.high:.3g} or less"
        return f"{self.low:.3g} to {self.high:.3g}"


class UnidentifiedOption(NamedTuple):
    """A constant that this recording cannot identify."""

    name: str
    value: object
    """Value of the start preset."""
    reason: str

    def __str__(self) -> str:
        value = f" {self.value:.4g}" if isinstance(self.value, float | int) else ""
        return f"{self.name}{value}: {self.reason}"


@dataclass(frozen=True, kw_only=True, eq=False)
class Measurement:
    """Result of a calibration: the model, measured constants, and options that stay."""

    config: PhysicalConfig
    """The model; options that the recording cannot identify keep their start value."""
    found: tuple[Estimate, ...]
    kept: tuple[UnidentifiedOption, ...]
    remarks: tuple[str, ...] = ()

    def lines(self) -> list[str]:
        """One line per constant, the measured ones first, then the remarks."""
        found, kept = (f"found {one}" for one in self.found), (f"kept {one}" for one in self.kept)
        return [*found, *kept, *self.remarks]


def with_estimates(config: PhysicalConfig, found: Iterable[Estimate]) -> PhysicalConfig:
    """Options with the constants that were found; those that are no option are left out."""
    values: dict[str, Any] = {one.name: one.value for one in found if hasattr(config, one.name)}
    if "refractory_period_us" in values:
        values["refractory_period_us"] = round(values["refractory_period_us"])
    return dataclasses.replace(config, **values)


NOT_OF_THE_SENSOR = ("gamma", "sensor_seed")
"""Options that stay out of the file: how the frames of a later run are coded, and which specimen
of the sensor it has."""


def write_preset(
    config: PhysicalConfig,
    lines: Sequence[str],
    path: str | Path,
    *,
    size: SensorSize,
    overwrite: bool = False,
) -> Path:
    """Write options as TOML, under lines of comment, for `texvent simulate --sensor FILE`.

    Returns:
        The path.

    Raises:
        OutputError: the file exists already, or cannot be written.
    """
    options = plain(config)
    for name in NOT_OF_THE_SENSOR:
        options.pop(name, None)
    tables = {"run": {"simulator": "physical", "sensor": str(size)}, "simulate": options}
    comment = "\n".join(f"# {line}" for line in lines)
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_text(f"{comment}\n\n{tomli_w.dumps(tables)}", encoding="utf-8")
    return Path(path)


def describe_scene(measured: Measurement, source: str) -> list[str]:
    """Lines on a measurement without frames; `source` is the file of the events, and the scene."""
    heading = f"Measured from {' '.join(source.split())}, by texvent {full_version()}."
    return [heading, *measured.lines()]
