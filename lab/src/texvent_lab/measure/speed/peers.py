"""Other programs' simulators on our frames, and ours on the same 8-bit grey frames.

Noise, refractory time and bandwidth are off everywhere, so that what is compared is the core that
turns brightness into events. Peers are installed by name (`pip install 'texvent-lab[peers]'`)
and are never a dependency; one that is missing is reported as such.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib import metadata
from typing import Any

from texvent.extending import SIMULATORS
from texvent.pipeline import video_to_events
from texvent.settings.resolution import resolve
from texvent.simulate.model_options import with_contrast_threshold
from texvent.video import Video

Simulate = Callable[[Video, float], int]
"""Frames and contrast threshold → number of events, all of them made and held in memory."""


@dataclass(frozen=True)
class Contender:
    """A simulator core that takes frames."""

    name: str
    package: str
    needs: tuple[str, ...]
    """Modules without which it cannot run."""
    prepare: Callable[[], Simulate]
    """Import what it needs and return the simulator."""
    own_threshold: float | None = None
    """Where it is run as it comes, not at our event count."""

    @property
    def version(self) -> str | None:
        """Version of its package, or None where it is not installed."""
        try:
            return metadata.version(self.package)
        except metadata.PackageNotFoundError:
            return None

    def missing(self) -> str | None:
        """Why it cannot run here, or None."""
        for module in self.needs:
            try:
                importlib.import_module(module)
            except ImportError as error:
                return f"{module} is not installed ({error})"
        return None


def _prepare_eventcv(upsample: str) -> Simulate:
    eventcv: Any = importlib.import_module("eventcv")

    def simulate(clip: Video, threshold: float) -> int:
        events = eventcv.simulate(
            clip.pixels,
            fps=_fps(clip),
            pos_thres=threshold,
            neg_thres=threshold,
            sigma_thres=0.0,
            refractory_us=0,
            cutoff_hz=0.0,
            leak_rate_hz=0.0,
            shot_noise_rate_hz=0.0,
            upsample=upsample,
        )
        return len(events)

    return simulate


def _prepare_shipped_eventcv() -> Simulate:
    eventcv: Any = importlib.import_module("eventcv")

    def simulate(clip: Video, threshold: float) -> int:
        shown = eventcv.simulate(
            clip.pixels, fps=_fps(clip), pos_thres=threshold, neg_thres=threshold
        )
        return len(shown)

    return simulate


def _prepare_evlib() -> Simulate:
    torch: Any = importlib.import_module("torch")
    evlib: Any = importlib.import_module("evlib.simulation")
    torch.set_num_threads(1)

    def simulate(clip: Video, threshold: float) -> int:
        config = evlib.ESIMConfig(
            positive_threshold=threshold,
            negative_threshold=threshold,
            refractory_period_ms=0.0,
            device="cpu",
            dtype="float32",
        )
        core = evlib.ESIMSimulator(config)
        return sum(len(core.process_frame(frame.pixels, frame.t_us * 1e-6)[0]) for frame in clip)

    return simulate


def _prepare_ours(model: str, preset: str) -> Simulate:
    simulator_class = SIMULATORS.load(model)
    config = simulator_class.presets[preset]
    config = replace(config, noise="none") if hasattr(config, "noise") else config

    def simulate(clip: Video, threshold: float) -> int:
        simulator = simulator_class(with_contrast_threshold(config, threshold))
        return sum(len(simulator.step(frame)) for frame in clip)

    return simulate


def _prepare_pipeline(interpolate: str) -> Simulate:
    def simulate(clip: Video, threshold: float) -> int:
        options = {
            "preset": "paper",
            "interpolate": interpolate,
            "noise": "none",
            "contrast_threshold": threshold,
        }
        steps = video_to_events(clip, resolve("simulate", options)).steps()
        return sum(len(packet) for _, packet in steps)

    return simulate


def _fps(clip: Video) -> float:
    return 1e6 * (len(clip) - 1) / (clip.times_us[-1] - clip.times_us[0])


PEERS = (
    Contender("eventcv, upsample off", "eventcv", ("eventcv",), lambda: _prepare_eventcv("off")),
    Contender("evlib", "evlib", ("torch", "evlib"), _prepare_evlib),
)
ADAPTIVE = Contender(
    "eventcv, adaptive (its default)", "eventcv", ("eventcv",), lambda: _prepare_eventcv("adaptive")
)
AS_SHIPPED = Contender(
    "eventcv, all defaults (adaptive, with its noise)",
    "eventcv",
    ("eventcv",),
    lambda: _prepare_shipped_eventcv(),
    own_threshold=0.2,
)
OURS = (
    Contender("texvent, paper preset", "texvent", (), lambda: _prepare_ours("texvent", "paper")),
    Contender("texvent, default", "texvent", (), lambda: _prepare_ours("texvent", "accurate")),
    Contender("texvent, esim", "texvent", (), lambda: _prepare_ours("esim", "default")),
)
"""One event per pixel and frame; several; and the peers' own model, several."""
OURS_WITH_FLOW = Contender(
    "texvent, paper preset, with flow", "texvent", (), lambda: _prepare_pipeline("flow")
)
