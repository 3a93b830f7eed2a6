"""Constants of a sensor as an estimate gives them: value, interval, or why the old value stays."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from texvent.simulate.physical.config import PhysicalConfig


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


class Kept(NamedTuple):
    """A constant that the recording does not tell."""

    name: str
    value: object
    """That of the start preset."""
    reason: str

    def __str__(self) -> str:
        value = f" {self.value:.4g}" if isinstance(self.value, float | int) else ""
        return f"{self.name}{value}: {self.reason}"


def with_estimates(config: PhysicalConfig, found: Iterable[Estimate]) -> PhysicalConfig:
    """Options with the constants that were found; those that are no option are left out."""
    values: dict[str, Any] = {one.name: one.value for one in found if hasattr(config, one.name)}
    if "refractory_period_us" in values:
        values["refractory_period_us"] = round(values["refractory_period_us"])
    return dataclasses.replace(config, **values)


def describe_estimates(found: Iterable[Estimate], kept: Iterable[Kept]) -> list[str]:
    """One line per constant, the measured ones first."""
    return [*(f"found {one}" for one in found), *(f"kept {one}" for one in kept)]
