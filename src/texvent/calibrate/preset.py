"""Write a fitted sensor to a config file that a run can be given."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

import tomli_w

from texvent._version import full_version
from texvent.calibrate.estimates import Estimate, Kept, describe_estimates
from texvent.calibrate.fit import Fit
from texvent.io.atomic import atomic_file
from texvent.options.values import plain
from texvent.sensor import SensorSize
from texvent.simulate.physical.config import PhysicalConfig

NOT_OF_THE_SENSOR = ("gamma", "sensor_seed")
"""Options that stay out of the file: how the frames of a later run are coded, and which specimen
of the sensor it has."""


class Measured(Protocol):
    """What a scene without frames tells."""

    @property
    def found(self) -> Sequence[Estimate]:
        """Measured constants."""
        ...

    @property
    def kept(self) -> Sequence[Kept]:
        """Those that it does not tell."""
        ...

    @property
    def remarks(self) -> Sequence[str]:
        """What else is to be known, a line each."""
        ...


def write_preset(
    config: PhysicalConfig,
    lines: Sequence[str],
    path: str | Path,
    *,
    size: SensorSize,
    overwrite: bool = False,
) -> Path:
    """Write options as TOML, for `texvent simulate --sensor FILE`.

    Args:
        config: what was found.
        lines: what is known of it, for the comment at the top.
        path: file to write.
        size: of the sensor.
        overwrite: replace an existing file.

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


def describe_scene(measured: Measured, source: str, what: str) -> list[str]:
    """What was measured without frames: a line each for constants and remarks.

    Args:
        measured: the constants.
        source: file of the events.
        what: what the sensor saw, in words.
    """
    return [
        f"Measured from {' '.join(source.split())}, {what}, by texvent {full_version()}.",
        *describe_estimates(measured.found, measured.kept),
        *measured.remarks,
    ]


def describe_fit(fit: Fit, source: str) -> list[str]:
    """The fit in a few lines: what was fitted, how well, and how well elsewhere."""
    lines = [
        f"Fitted to {' '.join(source.split())} by texvent {full_version()}.",
        f"Frame times were moved by {fit.offset_us} µs; noise was "
        + (
            "measured at still pixels."
            if fit.noise is not None
            else "not measured: too few still pixels."
        ),
        "Distance to the recording: 1-STPP + intervals (decades) + |ln| of both count ratios.",
    ]
    for title, span, place in (("fitted  ", fit.span, 0), ("held out", fit.held_out, 1)):
        lines.append(
            f"{title} {span.start_us / 1e6:.3f}..{span.stop_us / 1e6:.3f} s: "
            f"{fit.distances['start'][place]} before, {fit.distances['fitted'][place]} after"
        )
    return lines
