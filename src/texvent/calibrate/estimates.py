"""Estimates of sensor constants, their bootstrap intervals, and the preset file that keeps them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import tomli_w
from numpy.typing import NDArray

from texvent._version import full_version
from texvent.io.atomic import atomic_file
from texvent.options.values import plain
from texvent.sensor import SensorSize
from texvent.simulation.physical.config import PhysicalConfig

Float64Array: TypeAlias = NDArray[np.float64]
LEVEL = 0.95
"""Share of repeated recordings whose interval holds the true value."""
RESAMPLES = 200


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


def bootstrap(
    estimate: Callable[..., Float64Array],
    units: tuple[int, ...],
    *,
    resamples: int = RESAMPLES,
) -> Float64Array:
    """Percentile intervals of some estimates.

    With several kinds of units, such as windows of time and groups of pixels, each kind is drawn on
    its own and the weights multiply: Owen, *The pigeonhole bootstrap*, Annals of Applied Statistics
    2007, whose intervals are rather too wide than too narrow.

    Args:
        estimate: one argument per kind of unit, how often each unit counts, [units] float64; gives
            [k] estimates, NaN where there is none.
        units: how many there are of each kind.
        resamples: how often is drawn; the draws are always the same.

    Returns:
        [2, k] lower and upper end of the 95 % intervals; NaN where most resamples gave none.
    """
    random = np.random.default_rng(0)
    drawn = [
        estimate(*(random.multinomial(n, np.full(n, 1 / n)).astype(np.float64) for n in units))
        for _ in range(resamples)
    ]
    return percentile_interval(np.array(drawn))


def percentile_interval(drawn: Float64Array) -> Float64Array:
    """The middle 95 % of every column, [2, k]; NaN where fewer than half of the values are numbers.

    Args:
        drawn: [n, k] estimates of n resamples.
    """
    tail = (1 - LEVEL) / 2
    ends = np.full((2, drawn.shape[1]), np.nan)
    for column in range(drawn.shape[1]):
        values = drawn[np.isfinite(drawn[:, column]), column]
        if values.size * 2 >= len(drawn):
            ends[:, column] = np.quantile(values, [tail, 1 - tail])
    return ends
