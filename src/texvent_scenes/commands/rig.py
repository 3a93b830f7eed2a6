"""`texvent rig PROMPT`: several cameras on one body, with frames and an IMU."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from texvent.cli.command import read_subject, resolve_command, subject_name
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.outputs import default_event_file
from texvent.cli.run import print_settings
from texvent.errors import ConfigError
from texvent.options.values import option_names, plain
from texvent.runtime.console_progress import ConsoleProgress
from texvent.settings.resolution import Settings
from texvent_scenes.rig.config import RigConfig, check_generator

DESCRIPTION = """Record an embedded scene with a rig: event cameras with lenses, frames beside their
events, an IMU; one clock, true poses, calibration as Kalibr writes it.

  texvent rig "a car, handheld camera" --stereo 0.12 --imu 200 -o car
  texvent rig "a dog" --rig camchain.yaml --frames 30 --layout rosbag1 -o dog"""


@dataclass(frozen=True, kw_only=True)
class RigOptions(RigConfig):
    """Scene and rig."""

    positional: ClassVar[tuple[str, ...]] = ("prompt",)
    input_texts: ClassVar[tuple[str, ...]] = ("imu_noise",)
    main_options: ClassVar[tuple[str, ...]] = (
        "out", "rig", "stereo", "frames", "exposure", "shutter", "imu", "layout", "duration",
        "sensor", "simulator", "preset", "seed", "config", "overwrite",
    )  # fmt: skip

    prompt: str = REQUIRED
    """Scene: a quoted sentence ("handheld camera" makes it move), or a scene file."""

    @property
    def config(self) -> RigConfig:
        """The options without the prompt."""
        return RigConfig(**{name: getattr(self, name) for name in option_names(RigConfig)})


@dataclass(frozen=True, kw_only=True)
class RigOutputOptions:
    """Output folder and messages."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    out: Path | None = None
    """Folder to write. Without it: a name made from the prompt, in the current folder."""
    overwrite: bool = False
    """Replace a folder that a rig was recorded into."""
    config: Path | None = None
    """TOML or YAML file with options of the simulation; flags override it."""
    print_config: bool = False
    """Print all resolved options of the simulation as TOML, ready for --config, and stop."""
    quiet: bool = False
    """No progress and no summary; only warnings and errors."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    settings, own, output = resolve_command(
        "generate",
        arguments,
        RigOptions(),
        description=DESCRIPTION,
        prog="texvent rig",
        output=RigOutputOptions(),
        # Before other options are parsed: generators of videos have some of the same name.
        check=lambda defaults: check_generator(defaults.generator),
    )
    if output.print_config:
        return print_settings(settings)
    _refuse_sensor(settings, own, arguments)
    out = output.out or default_event_file(subject_name(own.prompt)).with_suffix("")
    from texvent_scenes.rig.recorder import record_rig  # brings what writes HDF5 and bags

    subject = read_subject(own.prompt, getattr(settings.source, "assets", None))
    with ConsoleProgress(is_quiet=output.quiet) as progress:
        tally = record_rig(
            subject, settings, own.config, out, overwrite=output.overwrite, progress=progress
        )
        for camera, count in tally.events.items():
            frames = f", {tally.frames[camera]} frames" if camera in tally.frames else ""
            progress.announce(f"{camera:<8} {count:,} events{frames}")
    if not output.quiet:
        write_out(f"{out}\n")
    return 0


def _refuse_sensor(settings: Settings, own: RigOptions, arguments: Sequence[str]) -> None:
    """Refuse a sensor beside a rig file, which has the cameras' resolutions.

    Raises:
        ConfigError: both are given.
    """
    is_given = any(word == "--sensor" or word.startswith("--sensor=") for word in arguments)
    if own.rig is not None and is_given:
        sensor: Any = plain(settings.run.sensor)
        raise ConfigError(
            f"--sensor {sensor} and --rig {own.rig} both say how large the cameras are; leave "
            "--sensor out, and give each camera of the file its resolution"
        )
