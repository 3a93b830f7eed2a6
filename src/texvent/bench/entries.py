"""What the benchmark runs: every simulator by every way of filling the time between frames."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Literal, TypeAlias

from texvent._registry import SIMULATORS
from texvent.bench.oracle import TrueFrames, film
from texvent.bench.scenes import Scene
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.pipeline import video_to_events
from texvent.settings import Settings, resolve
from texvent.simulate.thresholds import contrast_threshold_of, with_contrast_threshold
from texvent.video import FrameStream

Track: TypeAlias = Literal["frames", "true frames"]
"""What a simulator is given: 24 frames per second in 8 bits, or the scene at any instant."""

INTERPOLATIONS: dict[str, Track] = {
    "none": "frames",
    "blend": "frames",
    "flow": "frames",
    "exact": "true frames",
}
"""Interpolator → the track it belongs to."""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One row of the benchmark."""

    simulator: str
    interpolate: str
    preset: str | None = None
    """Name of the options; default: the simulator's first preset."""

    @property
    def name(self) -> str:
        """How tables call it."""
        preset = f" {self.preset}" if self.preset else ""
        return f"{self.simulator}{preset}, {self.interpolate}"

    @property
    def track(self) -> Track:
        """Whether it is given the true intermediate frames."""
        return INTERPOLATIONS[self.interpolate]

    def settings(self, seed: int) -> Settings:
        """Resolved options of a run.

        Raises:
            ConfigError: the simulator, its preset or the interpolator does not exist.
        """
        options = {
            "simulator": self.simulator,
            "preset": self.preset,
            "interpolate": self.interpolate,
            "seed": seed,
        }
        return resolve("simulate", options)

    @property
    def default_threshold(self) -> float | None:
        """Contrast threshold of the preset, log units; None for a simulator that has none."""
        try:
            return contrast_threshold_of(self.settings(0).simulate)
        except ConfigError:
            return None

    def simulate(self, scene: Scene, seed: int, threshold: float | None) -> EventStream:
        """Events of one run.

        Args:
            scene: what is filmed.
            seed: of the simulator's own noise.
            threshold: contrast threshold δ, log units; None leaves the preset's.

        Raises:
            TexventError: the simulator cannot run as it is, such as without its weights.
        """
        settings = self.settings(seed)
        if threshold is not None:
            simulate = with_contrast_threshold(settings.simulate, threshold)
            settings = dataclasses.replace(settings, simulate=simulate)
        video: FrameStream = film(scene) if self.track == "frames" else TrueFrames(scene)
        return video_to_events(video, settings).packets.collect()


def default_entries() -> list[Entry]:
    """Every registered simulator by every interpolator, each with its first preset."""
    return [
        Entry(simulator=simulator, interpolate=interpolate)
        for simulator in SIMULATORS.names()
        for interpolate in INTERPOLATIONS
    ]
