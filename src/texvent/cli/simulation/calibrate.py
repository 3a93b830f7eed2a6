"""`texvent calibrate`: fit the physical model to a recording of a sensor."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal

from texvent._registry import suggest
from texvent.calibrate.estimates import describe_scene, write_preset
from texvent.calibrate.events_only.flicker import measure_flicker
from texvent.calibrate.events_only.static_scene import measure_static_scene
from texvent.calibrate.fit import describe_fit, fit_sensor
from texvent.calibrate.recording import CalibrationRecording
from texvent.capture.open import open_frames
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import (
    CaptureConfig,
    IdleOptions,
    InterpolateConfig,
    ReadingConfig,
    check_choices,
    check_range,
)
from texvent.errors import ConfigError, InputError, shown
from texvent.events import EventStream
from texvent.io.atomic import check_outputs
from texvent.io.files import load
from texvent.runtime.console_progress import ConsoleProgress
from texvent.sensor import parse_sensor
from texvent.settings.resolution import resolve
from texvent.simulation.physical.cameras import PRESETS
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.threshold_map import write_threshold_map

DESCRIPTION = """Fit the physical model to a recording of your sensor. With frames of a moving
scene: thresholds, balance, bandwidth, noise and leak. From events alone: a scene at rest gives
noise, hot pixels and leak, a flickering field thresholds, bandwidth and refractory period. What a
recording does not tell stays as in --start-preset. The result is a config file.

  texvent calibrate --frames slider_depth --events slider_depth/events.txt \\
      --sensor davis240c -o my.toml
  texvent calibrate --events rest.raw -o my.toml
  texvent simulate video.mp4 --sensor my.toml"""
FILES = (".toml", ".yaml", ".yml")


@dataclass(frozen=True, kw_only=True)
class CalibrateOptions:
    """Recording to fit, and files to write."""

    input_texts: ClassVar[tuple[str, ...]] = ("frames", "start_preset")
    outputs: ClassVar[tuple[str, ...]] = ("out", "threshold_map")
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}
    main_options: ClassVar[tuple[str, ...]] = (
        "frames", "events", "flicker_hz", "flicker_ratio", "out",
        "threshold_map", "sensor", "start_preset", "frames_gamma", "seconds", "overwrite",
    )  # fmt: skip

    idle_with: ClassVar[IdleOptions] = {"seconds": ("frames", (None,))}

    frames: str | None = None
    """Video file, image folder or AEDAT4 recording of a moving scene, on the clock of the events.
    Without it, nothing in the scene moves, under steady light."""
    events: Path = REQUIRED
    """Event file."""
    flicker_hz: float | None = None
    """The scene is a flat field whose light switches between two brightnesses, so many times per
    second, within 2 %."""
    flicker_ratio: float | None = None
    """Brightness of the bright half of a cycle over that of the dark one. Without it,
    thresholds are only compared with one another."""
    out: Path = REQUIRED
    """Config file to write, .toml."""
    threshold_map: Path | None = None
    """File to write, .npz: the thresholds of each pixel, measured from a flickering field. The
    config file then names it, and simulates this very sensor."""
    sensor: str | None = None
    """Sensor size, for event formats that do not store it."""
    format: str | None = None
    """Event format, where the extension does not say."""
    start_preset: str = "default"
    """Preset of the physical model, or a file of texvent calibrate, with what is known so far."""
    frames_gamma: float = 1.0
    """Exponent that makes the frames linear: 1 for those of a DAVIS, 2.2 for ordinary video."""
    keep: tuple[Literal["balance", "cutoff_hz"], ...] = ()
    """Options of --start-preset that frames and events shall not change: cutoff_hz, where it was
    measured from a flickering field."""
    seconds: float = 1.0
    """Part of each half of a recording with frames that is simulated, s."""
    overwrite: bool = False
    """Replace files that exist already."""
    quiet: bool = False
    """Do not log the search."""

    def __post_init__(self) -> None:
        check_choices(self)
        check_range("seconds", self.seconds, 0.1)
        check_range("frames_gamma", self.frames_gamma, 0.1, 10.0)
        check_range("flicker_hz", self.flicker_hz, 0.01, 1000)
        check_range("flicker_ratio", self.flicker_ratio, 1.1, 1e4)
        self._check_scene()
        if self.start_preset not in PRESETS and not self.start_preset.endswith(FILES):
            raise ConfigError(
                f"unknown preset {shown(self.start_preset)}; "
                f"{suggest(self.start_preset, tuple(PRESETS))}"
            )

    def _check_scene(self) -> None:
        if self.flicker_hz is None and (self.flicker_ratio or self.threshold_map):
            raise ConfigError("--flicker-ratio and --threshold-map are for --flicker-hz")
        if self.threshold_map is not None and self.threshold_map.suffix != ".npz":
            raise ConfigError(f"--threshold-map is {self.threshold_map}; its name must end in .npz")
        if self.frames is None and self.keep:
            raise ConfigError("--keep is for a scene with --frames")
        if self.flicker_hz is not None and self.frames is not None:
            raise ConfigError("--flicker-hz is measured from events alone; leave out --frames")

    @property
    def start_config(self) -> PhysicalConfig:
        """Options from which the search starts.

        Raises:
            ConfigError: the file is for another model.
            InputError: it cannot be read.
        """
        config = PRESETS.get(self.start_preset)
        if config is None:
            config = resolve("simulate", {}, config=self.start_preset).simulate
        if not isinstance(config, PhysicalConfig):
            raise ConfigError(f"{self.start_preset} is not for the physical model")
        return dataclasses.replace(config, gamma=self.frames_gamma)


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    groups = {
        "input": CalibrateOptions(),
        "capture": ReadingConfig(),
        "interpolate": InterpolateConfig(max_intermediate=16, frames_per_pixel=2.0),
    }
    options, reading, interpolate = parse_configs(
        arguments, groups, prog="texvent calibrate", description=DESCRIPTION
    )
    outputs = options.out, options.threshold_map
    check_outputs([one for one in outputs if one is not None], overwrite=options.overwrite)
    start = options.start_config
    if not options.events.exists():
        raise InputError(f"no such file: {options.events}")
    size = parse_sensor(options.sensor) if options.sensor else None
    events = load(options.events, format=options.format, size=size)
    progress = ConsoleProgress(is_quiet=options.quiet)
    if options.frames is not None:
        frames = open_frames(options.frames, CaptureConfig(**vars(reading)))
        recording = CalibrationRecording(frames, events, interpolate)
        config, lines = _fit(recording, start, options, progress)
    else:
        config, lines = _measure(events, start, options)
    for line in lines:
        progress.announce(line)
    written = write_preset(
        config, lines, options.out, size=events.size, overwrite=options.overwrite
    )
    write_out(f"{written}\n")
    if options.threshold_map is not None:
        write_out(f"{options.threshold_map}\n")
    return 0


def _fit(
    recording: CalibrationRecording,
    start: PhysicalConfig,
    options: CalibrateOptions,
    progress: ConsoleProgress,
) -> tuple[PhysicalConfig, list[str]]:
    """Fit frames and events."""
    fit = fit_sensor(
        recording,
        start=start,
        seconds=options.seconds,
        keep=options.keep,
        report=progress.announce,
    )
    source = " and ".join(dict.fromkeys((str(options.frames), str(options.events))))
    return fit.config, describe_fit(fit, source)


def _measure(
    events: EventStream, start: PhysicalConfig, options: CalibrateOptions
) -> tuple[PhysicalConfig, list[str]]:
    """Measure a known scene from events alone."""
    source = str(options.events)
    if options.flicker_hz is None:
        static = measure_static_scene(events, start)
        return static.config, describe_scene(static, f"{source}, a scene at rest")
    flicker = measure_flicker(events, start, hz=options.flicker_hz, ratio=options.flicker_ratio)
    what = f"{source}, a field that flickers at {flicker.cycles.hz:.5g} Hz"
    lines = describe_scene(flicker, what)
    config = flicker.config
    if options.threshold_map is not None:
        if not flicker.found:
            raise InputError(f"no threshold map is written: {flicker.kept[0].reason}")
        written = write_threshold_map(
            flicker.thresholds, options.threshold_map, overwrite=options.overwrite
        )
        config = dataclasses.replace(config, threshold_map=written.resolve())
    return config, lines
