"""From names and single options to the resolved settings of a run.

Precedence, weakest first: the parts' defaults, the preset, a sensor file, the config file, single
options. The command line and the Python API both come through here, so they cannot disagree; a None
of Python is no option, the word `none` of a command line is one.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent._registry import DEFAULT_GENERATOR, GENERATORS, INTERPOLATORS, SIMULATORS, suggest
from texvent.config import (
    CaptureConfig,
    InterpolateConfig,
    RunConfig,
    check_range,
    warn_of_idle,
)
from texvent.errors import ConfigError, shown
from texvent.options.values import option_names, plain, with_options
from texvent.sensor import SENSORS, Sensor, SensorSize, find_sensor, parse_sensor
from texvent.settings.config_files import Command, read_config
from texvent.settings.presets import find_preset
from texvent.simulation.model_options import with_contrast_threshold

DEFAULT_SENSOR = "davis346"
"""Size of a generated scene when no sensor is named and the generator has no wish of its own."""
ALONG_MOTION = "motion"
"""The interpolator of frames that come with motion vectors."""
RENDERED = "exact"
"""The interpolator of what is known at any instant."""
SENSOR_FILES = (".toml", ".yaml", ".yml")
"""Ends of the names of sensor files."""
OF_MOTION = ("motion", "motion_back")
DECIDING = ("generator", "simulator", "preset", "sensor", "camera", *OF_MOTION)
"""Options that decide which other options there are, or their defaults."""


@dataclass(frozen=True, kw_only=True)
class Settings:
    """Everything that decides a run's events; it is stored in every output."""

    run: RunConfig
    source: Any
    """The generator's config, or a CaptureConfig for recorded frames."""
    interpolate: InterpolateConfig
    simulate: Any
    """The simulator's config."""
    generator: str | None = None
    """Name of the generator; None when frames were recorded."""

    @property
    def size(self) -> SensorSize | None:
        """Size of the sensor asked for, or None to keep the size of the frames."""
        return parse_sensor(self.run.sensor) if self.run.sensor else None

    def groups(self) -> dict[str, Any]:
        """Table name (as in config files) → config."""
        source = "generate" if self.generator else "capture"
        return {
            "run": self.run,
            source: self.source,
            "interpolate": self.interpolate,
            "simulate": self.simulate,
        }

    def as_tables(self) -> dict[str, Any]:
        """Nested plain values, ready for TOML and JSON; reading them back gives these settings.

        The device is none of them: it does not decide the events.
        """
        tables: dict[str, Any] = plain(self.groups())
        del tables["run"]["device"]
        if self.generator:
            tables["generate"] = {"generator": self.generator, **tables["generate"]}
        return tables


@dataclass(frozen=True)
class Basis:
    """Layers below single options: the parts with their preset, and options of files."""

    command: Command
    config: str | Path | None
    parts: Mapping[str, Any]
    """Names of the generator, the simulator and the preset; None: the default one."""
    chosen: Mapping[str, Any]
    """Options of files, and those of `DECIDING` that were given."""

    @property
    def defaults(self) -> Settings:
        """The settings without single options."""
        return self.resolve({})

    def resolve(
        self, options: Mapping[str, Any], *, motion_beside: Path | bool | None = None
    ) -> Settings:
        """Settings with single options; arguments and errors as of the function `resolve`."""
        if isinstance(motion_beside, Path) and self.chosen.get("motion") is None:
            options = {"motion": motion_beside, **options}
        where = f"config file {self.config}" if self.config is not None else "options"
        every = {**self.chosen, **options}
        usual = None
        if self.command == "simulate" and every.get("camera") is not None:
            usual = RENDERED
        elif motion_beside or any(every.get(name) is not None for name in OF_MOTION):
            usual = ALONG_MOTION
        settings = _default_settings(self.command, **self.parts, interpolate=usual)
        if every.get("noise_rate_hz") is None:
            settings = _with_noise_of(every.get("sensor"), settings)
        try:
            settings = apply_options(settings, self.chosen, where=where)
        except ConfigError as error:
            message = str(error.args[0])
            if self.config is None or message.startswith(where):
                raise
            raise ConfigError(f"{where}: {message}") from None
        settings = apply_options(settings, options, where="options")
        warn_of_idle(settings.groups().values(), options)
        return settings


def read_basis(
    command: Command, deciding: Mapping[str, Any], config: str | Path | None = None
) -> Basis:
    """Read the files of options, and find the parts that they and the deciding options name.

    Args:
        command: "generate" (from a prompt) or "simulate" (from frames).
        deciding: those of `DECIDING` that were given. A sensor may be a preset file, such as
            `texvent calibrate` writes; a sensor whose constants the simulator knows chooses the
            preset of that name, unless a preset is given.
        config: a TOML or YAML file with options, or an event file with those of its run.

    Raises:
        ConfigError: a wrong file, or a generator where frames are given.
        InputError: a file cannot be read.
    """
    in_file = read_config(config, command) if config is not None else {}
    chosen = {**in_file, **deciding}
    sensor = chosen.get("sensor")
    if isinstance(sensor, str) and sensor.lower().endswith(SENSOR_FILES):
        chosen = {**read_config(chosen.pop("sensor")), **chosen}
    parts = {name: chosen.pop(name, None) for name in ("generator", "simulator", "preset")}
    if command == "simulate" and parts["generator"] is not None:
        where = "generator is set"
        if in_file.get("generator") is not None:
            where = f"config file {config} is for texvent generate: it sets generator"
        raise ConfigError(f"{where}, but frames are simulated, not generated; leave it out")
    if parts["preset"] is None:
        parts["preset"] = sensor_preset(parts["simulator"], chosen.get("sensor"))
    return Basis(command, config, parts, chosen)


def _default_settings(
    command: Command,
    *,
    generator: str | None,
    simulator: str | None,
    preset: str | None,
    interpolate: str | None,
) -> Settings:
    """Settings before any single option: the defaults of the named parts and preset.

    Raises:
        ConfigError: a part or preset of that name does not exist.
    """
    simulator_name, preset_name = find_preset(simulator, preset)
    simulator_class = SIMULATORS.load(simulator_name)
    run = RunConfig(simulator=simulator_name, preset=preset_name)
    generator_name, source, parts = None, CaptureConfig(), [simulator_class]
    if command == "generate":
        generator_name = DEFAULT_GENERATOR if generator is None else generator
        generator_class = GENERATORS.load(generator_name)
        size = getattr(generator_class, "default_sensor", DEFAULT_SENSOR)
        run = dataclasses.replace(run, sensor=size)
        source = generator_class.config_type()
        parts.append(generator_class)
    # Some models and generators prefer an interpolator.
    wishes = [getattr(part, "default_interpolate", None) for part in parts]
    usual = InterpolateConfig.interpolate
    chosen = next((one for one in (*wishes, interpolate) if one is not None), usual)
    return Settings(
        run=run,
        source=source,
        interpolate=InterpolateConfig(interpolate=chosen),
        simulate=simulator_class.presets[preset_name],
        generator=generator_name,
    )


def _with_noise_of(sensor: Any, settings: Settings) -> Settings:
    """The settings with noise for a sensor's fill factor, where it and the model's are known."""
    reference = getattr(SIMULATORS.load(settings.run.simulator), "reference_fill_factor", None)
    known = find_sensor(sensor) if isinstance(sensor, str) else None
    if reference is None or known is None or known.fill_factor is None:
        return settings
    scale = round(settings.simulate.noise_scale * reference / known.fill_factor, 3)
    simulate = dataclasses.replace(settings.simulate, noise_scale=scale)
    return dataclasses.replace(settings, simulate=simulate)


def sensor_preset(simulator: str | None, sensor: str | None) -> str | None:
    """The simulator's preset with the measured constants of a sensor, or None if it has none.

    Example:
        >>> sensor_preset("physical", "davis346"), sensor_preset("texvent", "davis346")
        ('davis346', None)
        >>> sensor_preset("physical", "imx636")
        'evk4'
    """
    if not isinstance(sensor, str):
        return None
    presets = SIMULATORS.load(simulator or RunConfig.simulator).presets
    known = find_sensor(sensor)
    name = known.name if known else sensor.lower()
    # A model may have constants for a family: voltmeter's "davis240" is for "davis240c".
    return next((preset for preset in presets if name.startswith(preset)), None)


def unmeasured_sensor(run: RunConfig) -> str | None:
    """Say which constants of the chosen sensor the simulator knows, if it knows some of sensors."""
    simulator = SIMULATORS.load(run.simulator)
    sensor = None if run.sensor is None else find_sensor(run.sensor)
    if sensor is None or not any(sensor_preset(run.simulator, name) for name in SENSORS):
        return None
    preset = sensor_preset(run.simulator, sensor.name)
    if preset is None:
        measured = [
            name for name in simulator.presets if any(one.startswith(name) for one in SENSORS)
        ]
        return (
            f"{sensor.name} sets the size only: {run.simulator} has measured constants of "
            f"{', '.join(measured)}; those of preset {shown(run.preset)} stand in"
        )
    known: Mapping[str, tuple[str, ...]] = getattr(simulator, "known_constants", {})
    if preset != run.preset or preset not in known:
        return None
    return (
        f"of {sensor.name}, {', '.join(known[preset])} are published or measured; all other "
        f"constants are defaults of {run.simulator}"
    )


def resolve(
    command: Command,
    options: Mapping[str, Any],
    *,
    config: str | Path | None = None,
    motion_beside: Path | bool | None = None,
) -> Settings:
    """Settings of a run from a config file and single options.

    Args:
        command: "generate" (from a prompt) or "simulate" (from frames).
        options: option name → value; None means "not given". Names as in `texvent --help`, with
            underscores.
        config: a TOML or YAML file with options, flat or in the tables `run`, `generate`,
            `capture`, `interpolate`, `simulate`; or an event file, whose run is repeated.
        motion_beside: motion vectors that come with the frames, for where no option names any: a
            path, or True where they are in memory.

    Raises:
        ConfigError: an unknown name, a wrong type, a value out of range, an unreadable file.
    """
    single = {name: value for name, value in options.items() if value is not None}
    if "sensor" in single:
        single["sensor"] = _sensor_text(single["sensor"])
    deciding = {name: single.pop(name) for name in DECIDING if name in single}
    return read_basis(command, deciding, config).resolve(single, motion_beside=motion_beside)


def _sensor_text(sensor: Any) -> Any:
    """A sensor given as an object, a file or numbers (width, height), as files and flags say it."""
    if isinstance(sensor, Sensor):
        return sensor.name
    if isinstance(sensor, Path):
        return str(sensor)
    if isinstance(sensor, (tuple, list)) and len(sensor) == 2:
        return "x".join(str(s) if isinstance(s, str) else shown(s) for s in sensor)
    if not isinstance(sensor, str):
        raise ConfigError(
            f"options: sensor is {shown(sensor)}; it must be a name, a text such as '346x260', or "
            "(width, height)"
        )
    return sensor


def apply_options(settings: Settings, options: Mapping[str, Any], *, where: str) -> Settings:
    """The settings with single options replaced, each in the config that declares it.

    Raises:
        ConfigError: a name that no config declares, or a value that does not fit.
    """
    groups = {
        "run": settings.run,
        "source": settings.source,
        "interpolate": settings.interpolate,
        "simulate": settings.simulate,
    }
    options = dict(options)
    owners = {name: key for key, group in groups.items() for name in option_names(type(group))}
    changed: dict[str, dict[str, Any]] = {}
    if "contrast_threshold" in options and "contrast_threshold" not in owners:
        # One number for models that have one threshold for ON and one for OFF.
        threshold = _as_number(options.pop("contrast_threshold"), where)
        groups["simulate"] = with_contrast_threshold(settings.simulate, threshold)
        changed["simulate"] = {}
    for name, value in options.items():
        if name not in owners:
            raise ConfigError(
                f"{where}: unknown option {shown(name)}; {suggest(name, tuple(owners))}"
            )
        changed.setdefault(owners[name], {})[name] = value
    replaced = {
        key: with_options(groups[key], values, where=where) for key, values in changed.items()
    }
    result = dataclasses.replace(settings, **replaced)
    if result.interpolate.interpolate not in INTERPOLATORS.names():
        INTERPOLATORS.load(result.interpolate.interpolate)
    result.size  # noqa: B018  (parses the sensor, so a wrong name fails before any work)
    return result


def _as_number(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ConfigError(f"{where}: contrast_threshold is {shown(value)}; it must be a number")
    check_range("contrast_threshold", value, 1e-6, 1e6)
    return float(value)
