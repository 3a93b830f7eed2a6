"""Write a fitted sensor to a config file that a run can be given."""

from __future__ import annotations

from pathlib import Path

import tomli_w

from texvent._version import full_version
from texvent.calibrate.fit import Fit
from texvent.io.atomic import atomic_file
from texvent.options.values import plain
from texvent.sensor import SensorSize

NOT_OF_THE_SENSOR = ("gamma", "sensor_seed")
"""Options that stay out of the file: how the frames of a later run are coded, and which specimen
of the sensor it has."""


def write_preset(
    fit: Fit, path: str | Path, *, size: SensorSize, source: str, overwrite: bool = False
) -> Path:
    """Write the fitted options as TOML, for `texvent simulate --config FILE`.

    Args:
        fit: what `fit_sensor` found.
        path: file to write.
        size: of the sensor.
        source: what it was fitted to, in words, for the comment at the top.
        overwrite: replace an existing file.

    Returns:
        The path.

    Raises:
        OutputError: the file exists already, or cannot be written.
    """
    options = plain(fit.config)
    for name in NOT_OF_THE_SENSOR:
        options.pop(name, None)
    tables = {"run": {"simulator": "physical", "sensor": str(size)}, "simulate": options}
    comment = "\n".join(f"# {line}" for line in describe_fit(fit, source))
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_text(f"{comment}\n\n{tomli_w.dumps(tables)}", encoding="utf-8")
    return Path(path)


def describe_fit(fit: Fit, source: str) -> list[str]:
    """The fit in a few lines: what was fitted, how well, and how well elsewhere."""
    lines = [
        f"Fitted to {' '.join(source.split())} by texvent {full_version()}.",
        f"Frame times were moved by {fit.offset_us} µs; noise was "
        + ("measured at still pixels." if fit.has_noise else "not measured: too few still pixels."),
        "Distance to the recording: 1-STPP + intervals (decades) + |ln| of both count ratios.",
    ]
    for title, span, place in (("fitted  ", fit.span, 0), ("held out", fit.held_out, 1)):
        lines.append(
            f"{title} {span.start_us / 1e6:.3f}..{span.stop_us / 1e6:.3f} s: "
            f"{fit.distances['start'][place]} before, {fit.distances['fitted'][place]} after"
        )
    return lines
