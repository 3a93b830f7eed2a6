"""Rows of the benchmarks: simulators by interpolators, or config files."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal, Self, TypeAlias

from texvent.config import InterpolateConfig
from texvent.errors import ConfigError, FileFormatError, InputError, MissingDependencyError
from texvent.events import EventStream
from texvent.extending import INTERPOLATORS, SIMULATORS
from texvent.frames import FrameStream
from texvent.run.prepare import prepare_video
from texvent.run.rate_search import ThresholdMatch, find_threshold
from texvent.settings.resolution import Settings, resolve
from texvent.simulation.model_options import contrast_threshold_of, with_contrast_threshold
from texvent_lab.bench.kept_frames import keep_frames
from texvent_lab.bench.oracle.recording import TrueFrames, render_video
from texvent_lab.bench.oracle.scenes import Scene

Track: TypeAlias = Literal[
    "frames",
    "true frames",
    "frames, sensor known",
    "true frames, sensor known",
    "recorded",
]
"""Input of a simulator: frames as a camera records them, or the scene at any instant; and whether
it knows the sensor. "recorded" marks events of a sensor, which no simulator made."""

INTERPOLATIONS = ("none", "blend", "flow", "exact")
"""Interpolators that are compared; "exact" gets the true frames, all others the camera's frames."""

CALIBRATED = ("physical", "calibrated")
"""Simulator and preset that know the oracle's sensor."""
CALIBRATED_FRAMES_PER_PIXEL = 2.0
"""Frames per pixel of motion: with fewer, what is missing between frames costs more than what is
left of the sensor's constants."""
SENSOR_FILE = Path(__file__).parents[1] / "oracle" / "sensor.toml"
THRESHOLD_FILE = SENSOR_FILE.with_name("sensor_thresholds.npz")
"""Their options and the thresholds of each pixel, from `texvent_lab.measure.oracle_sensor`."""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One row of the benchmark."""

    simulator: str
    interpolate: str
    preset: str | None = None
    """Name of the options; default: the simulator's first preset."""
    is_rate_matched: bool = True
    """Whether the contrast threshold is fitted to the number of true events, or kept."""
    rife_flow: Literal["once", "each"] | None = None
    """Instants at which RIFE estimates the motion; default: the interpolator's own."""

    @property
    def name(self) -> str:
        """Name in tables."""
        preset = f" {self.preset}" if self.preset else ""
        return f"{self.simulator}{preset}, {self.interpolate}"

    def or_flow(self, *, rife: bool = True) -> Self:
        """This row, by optical flow if it asks for RIFE and that is unwanted or cannot run here."""
        if self.interpolate != "rife" or (rife and missing_rife() is None):
            return self
        return dataclasses.replace(self, interpolate="flow")

    @property
    def track(self) -> Track:
        """Input of the simulator: frames or true frames, and whether it knows the sensor."""
        if self.interpolate == "exact":
            return "true frames, sensor known" if self._is_calibrated else "true frames"
        return "frames, sensor known" if self._is_calibrated else "frames"

    @property
    def _is_calibrated(self) -> bool:
        return (self.simulator, self.preset) == CALIBRATED

    def settings(self, seed: int) -> Settings:
        """Resolved options of a run.

        Raises:
            ConfigError: the simulator, its preset or the interpolator does not exist.
        """
        options = {
            "simulator": self.simulator,
            "preset": None if self._is_calibrated else self.preset,
            "interpolate": self.interpolate,
            "rife_flow": self.rife_flow if self.interpolate == "rife" else None,
            "frames_per_pixel": CALIBRATED_FRAMES_PER_PIXEL if self._is_calibrated else None,
            "seed": seed,
            "threshold_map": THRESHOLD_FILE if self._is_calibrated else None,
        }
        return resolve("simulate", options, config=SENSOR_FILE if self._is_calibrated else None)

    @property
    def default_threshold(self) -> float | None:
        """Contrast threshold from which the fit starts, log units.

        None for a simulator that has none, or whose threshold is kept.
        """
        if not self.is_rate_matched:
            return None
        try:
            return contrast_threshold_of(self.settings(0).simulate)
        except ConfigError:
            return None

    def fit(
        self, count_events: Callable[[float | None], int], target: int
    ) -> tuple[ThresholdMatch | None, float]:
        """The threshold at which the simulator makes as many events as there truly were.

        Args:
            count_events: threshold, or None for the preset's own → number of events.
            target: true events.

        Returns:
            The match, None without a threshold; events per true event before the search.
        """
        default = self.default_threshold
        count = cache(count_events)
        ratio = count(default) / target if target else math.nan
        if default is None:
            return None, ratio
        if not target:
            return ThresholdMatch(default, math.nan, 0), ratio
        return find_threshold(count, target, start=default), ratio

    def simulate(self, scene: Scene, seed: int, threshold: float | None) -> EventStream:
        """Events of one run on a scene of the oracle.

        Args:
            scene: what the camera sees.
            seed: of the simulator's own noise.
            threshold: contrast threshold δ, log units; None leaves the preset's.

        Raises:
            TexventError: the simulator cannot run as it is, such as without its weights.
        """
        video: FrameStream = (
            TrueFrames(scene) if self.interpolate == "exact" else render_video(scene)
        )
        return simulate_video(video, self.settings(seed), threshold)


def missing_rife() -> str | None:
    """Why RIFE cannot run here, such as without its weights; None if it can.

    Raises:
        FileFormatError: the weights are damaged.
    """
    try:
        INTERPOLATORS.load("rife").provenance(InterpolateConfig(interpolate="rife"))
    except FileFormatError:
        raise
    except (InputError, MissingDependencyError) as error:
        return str(error)
    return None


def simulate_video(video: FrameStream, settings: Settings, threshold: float | None) -> EventStream:
    """Events of a video with a contrast threshold, log units, or the settings' own (None).

    Frames of a network are made once for all runs; see `kept_frames`.
    """
    if threshold is not None:
        simulate = with_contrast_threshold(settings.simulate, threshold)
        settings = dataclasses.replace(settings, simulate=simulate)
    return keep_frames(prepare_video(video, settings)).packets.collect()


NAMED_PRESETS: Mapping[str, tuple[str, ...]] = {"texvent": ("accurate", "paper")}
"""Simulator → presets that are compared, by name; of the others it is the first one."""


def simulators_to_compare() -> list[tuple[str, str | None]]:
    """(simulator, preset) of every registered simulator."""
    return [
        (simulator, preset)
        for simulator in SIMULATORS.names()
        for preset in NAMED_PRESETS.get(simulator, (None,))
    ]


def choose_entries(simulators: str | None = None, interpolations: str | None = None) -> list[Entry]:
    """Entries from the words of a command line.

    Args:
        simulators: `NAME` or `NAME:PRESET`, separated by commas; None means all to compare,
            and `CALIBRATED`.
        interpolations: names separated by commas; None means `INTERPOLATIONS`.
    """
    chosen = [*simulators_to_compare(), CALIBRATED]
    if simulators is not None:
        words = (word.partition(":") for word in simulators.split(","))
        chosen = [(simulator, preset or None) for simulator, _, preset in words]
    names = interpolations.split(",") if interpolations is not None else INTERPOLATIONS
    return [
        Entry(simulator=simulator, preset=preset, interpolate=interpolate)
        for simulator, preset in chosen
        for interpolate in names
    ]


@dataclass(frozen=True, kw_only=True)
class ConfigEntry(Entry):
    """A row whose options stand in a config file."""

    path: Path
    """TOML or YAML file."""
    options: tuple[tuple[str, Any], ...] = ()
    """(name, value) of options that replace those of the file."""

    @classmethod
    def read(cls, path: Path, *, is_rate_matched: bool = False) -> ConfigEntry:
        """The row of a config file.

        Raises:
            InputError: the file cannot be read.
            ConfigError: it is wrong.
        """
        settings = resolve("simulate", {}, config=path)
        return cls(
            simulator=settings.run.simulator,
            interpolate=settings.interpolate.interpolate,
            path=path,
            is_rate_matched=is_rate_matched,
        )

    @property
    def name(self) -> str:
        """The file's name without its extension."""
        return self.path.stem

    def settings(self, seed: int) -> Settings:
        """Resolved options of a run.

        Raises:
            ConfigError: the file holds an unknown option, or a value out of range.
        """
        options = {"interpolate": self.interpolate, **dict(self.options), "seed": seed}
        return resolve("simulate", options, config=self.path)


def read_ablations(
    folder: Path, *, is_rate_matched: bool = False, rife: bool = True
) -> list[ConfigEntry]:
    """One row per config file of a folder, E2 before E10; RIFE's by flow where it cannot run.

    Args:
        folder: of the files.
        is_rate_matched: whether contrast thresholds are fitted.
        rife: False takes flow wherever a file asks for RIFE.

    Raises:
        InputError: there is no such folder, or no config file in it.
        ConfigError: a file is wrong.
    """
    paths = sorted(folder.glob("*.toml"), key=_by_number)
    if not paths:
        raise InputError(
            f"no config file in {folder}; give a folder with TOML files, such as the "
            "repository's configs/paper"
        )
    rows = (ConfigEntry.read(path, is_rate_matched=is_rate_matched) for path in paths)
    return [one.or_flow(rife=rife) for one in rows]


def _by_number(path: Path) -> tuple[str, int, str]:
    match = re.fullmatch(r"(\D*)(\d+)(.*)", path.stem)
    return (match[1], int(match[2]), match[3]) if match else (path.stem, -1, "")
