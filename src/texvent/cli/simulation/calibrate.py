"""`texvent calibrate --frames F --events E -o my.toml`: fit the physical model to a recording."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent._registry import suggest
from texvent.calibrate.fit import fit_sensor
from texvent.calibrate.preset import describe_fit, write_preset
from texvent.calibrate.recording import Recording
from texvent.capture.open import open_frames
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import CaptureConfig, InterpolateConfig, check_range
from texvent.errors import ConfigError, InputError, shown
from texvent.io.atomic import check_output
from texvent.io.files import load
from texvent.runtime.console_progress import ConsoleProgress
from texvent.sensor import parse_sensor
from texvent.simulate.physical.config import PRESETS, PhysicalConfig

DESCRIPTION = """Fit the physical model to a sensor that recorded frames and events: thresholds,
balance, bandwidth, noise and leak. The first half of the recording is fitted, the second tells how
good the fit is. The result is a config file.

  texvent calibrate --frames slider_depth --events slider_depth/events.txt \\
      --sensor davis240c -o my.toml
  texvent simulate video.mp4 --sensor my.toml"""


@dataclass(frozen=True, kw_only=True)
class CalibrateOptions:
    """Which recording, and where the result goes."""

    input_texts: ClassVar[tuple[str, ...]] = ("frames",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}
    main_options: ClassVar[tuple[str, ...]] = (
        "frames", "events", "out", "sensor", "start_preset", "frames_gamma", "seconds", "start",
        "stop", "interpolate", "overwrite",
    )  # fmt: skip

    frames: str = REQUIRED
    """Video file, image folder or AEDAT4 recording, on the clock of the events."""
    events: Path = REQUIRED
    """Event file."""
    out: Path = REQUIRED
    """Config file to write, .toml."""
    sensor: str | None = None
    """Sensor size, for event formats that do not store it."""
    format: str | None = None
    """Event format, where the extension does not say."""
    start_preset: str = "default"
    """Preset of the physical model that the search starts from, and is compared with."""
    frames_gamma: float = 1.0
    """Exponent that makes the frames linear: 1 for those of a DAVIS, 2.2 for ordinary video."""
    seconds: float = 1.0
    """How much of each half of the recording is simulated."""
    overwrite: bool = False
    """Replace the file if it exists already."""
    quiet: bool = False
    """Do not tell what is tried."""

    def __post_init__(self) -> None:
        check_range("seconds", self.seconds, 0.1)
        if self.start_preset not in PRESETS:
            raise ConfigError(
                f"unknown preset {shown(self.start_preset)}; "
                f"{suggest(self.start_preset, tuple(PRESETS))}"
            )

    @property
    def start_config(self) -> PhysicalConfig:
        """Where the search starts."""
        return dataclasses.replace(PRESETS[self.start_preset], gamma=self.frames_gamma)


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    groups = {
        "input": CalibrateOptions(),
        "capture": CaptureConfig(),
        "interpolate": InterpolateConfig(max_intermediate=16),
    }
    options, capture, interpolate = parse_configs(
        arguments, groups, prog="texvent calibrate", description=DESCRIPTION
    )
    check_output(options.out, overwrite=options.overwrite)
    if not options.events.exists():
        raise InputError(f"no such file: {options.events}")
    size = parse_sensor(options.sensor) if options.sensor else None
    events = load(options.events, format=options.format, size=size)
    recording = Recording(open_frames(options.frames, capture), events, interpolate)
    progress = ConsoleProgress(is_quiet=options.quiet)
    fit = fit_sensor(
        recording,
        start=options.start_config,
        seconds=options.seconds,
        report=progress.announce,
    )
    source = " and ".join(dict.fromkeys((options.frames, str(options.events))))
    for line in describe_fit(fit, source):
        progress.announce(line)
    written = write_preset(
        fit, options.out, size=events.size, source=source, overwrite=options.overwrite
    )
    write_out(f"{written}\n")
    return 0
